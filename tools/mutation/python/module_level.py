"""What stands outside of functions, which mutmut leaves out: `module_level.py TREE` makes each mutant in the source by itself and runs the tests of that file.

TREE is that of scripts/mutation-python. The work is done in its folder module_level, from twofold and tests of the tree. What it finds is kept in module_level.tsv of the tree,
until the end in module_level.part; a mutant that was caught is not run again.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from mutmut.mutation.file_mutation import create_mutations

os.chdir(sys.argv[1])
kept = Path("module_level.tsv").absolute()
part = kept.with_suffix(".part")
known = {tuple(line.split("\t")) for file in (kept, part) if file.exists() for line in file.read_text().splitlines()}
place = Path("module_level")
shutil.rmtree(place, ignore_errors=True)
for folder in ("twofold", "tests"):
    shutil.copytree(folder, place / folder)
shutil.copy("pyproject.toml", place)
os.chdir(place)


def passes(tests: str) -> bool:
    command = [sys.executable, "-m", "pytest", "-qx", "-p", "no:cacheprovider", tests]
    try:
        return subprocess.run(command, env={**os.environ, "PYTHONPATH": ".", "PYTHONDONTWRITEBYTECODE": "1"}, capture_output=True, timeout=300).returncode == 0
    except subprocess.TimeoutExpired:
        return False


found = []
for path in sorted(Path("twofold").glob("*.py")):
    source = path.read_text()
    module, mutations, *_ = create_mutations(str(path), source)
    tests = "tests/test_core.py::test_names_that_are_offered" if path.stem == "__init__" else f"tests/test_{path.stem}.py"
    if not passes(tests):
        sys.exit(f"{tests} fails without a mutant")
    for mutation in mutations:
        if mutation.contained_by_top_level_function is not None:
            continue
        mutant = module.deep_replace(mutation.original_node, mutation.mutated_node).code
        before, after = (set(code.splitlines()) for code in (source, mutant))
        was, now = (" ".join(line.strip() for line in code.splitlines() if line not in other) for code, other in ((source, after), (mutant, before)))
        outcome = "caught"
        if (path.name, was, now, outcome) not in known:
            path.write_text(mutant)
            outcome = "survived" if passes(tests) else "caught"
        found.append("\t".join((path.name, was, now, outcome)))
        part.write_text("\n".join(found) + "\n")
    path.write_text(source)
part.rename(kept)
