"""What stands outside of functions, which mutmut leaves out: `module_level.py TREE` makes each mutant in the source by itself and runs the tests of that file.

What it finds is kept in module_level.tsv of the tree; a mutant that was caught is not run again.
"""

import os
import subprocess
import sys
from pathlib import Path

from mutmut.mutation.file_mutation import create_mutations

os.chdir(sys.argv[1])
kept = Path("module_level.tsv")
known = {tuple(line.split("\t")) for line in kept.read_text().splitlines()} if kept.exists() else set()
found = []
for path in sorted(Path("twofold").glob("*.py")):
    source = path.read_text()
    module, mutations, *_ = create_mutations(str(path), source)
    tests = "tests/test_core.py::test_names_that_are_offered" if path.stem == "__init__" else f"tests/test_{path.stem}.py"
    try:
        for mutation in mutations:
            if mutation.contained_by_top_level_function is not None:
                continue
            mutant = module.deep_replace(mutation.original_node, mutation.mutated_node).code
            before, after = (set(code.splitlines()) for code in (source, mutant))
            was, now = (" ".join(line.strip() for line in code.splitlines() if line not in other) for code, other in ((source, after), (mutant, before)))
            outcome = "caught"
            if (path.name, was, now, outcome) not in known:
                path.write_text(mutant)
                try:
                    run = subprocess.run([sys.executable, "-m", "pytest", "-qx", "-p", "no:cacheprovider", tests], env={**os.environ, "PYTHONPATH": ".", "PYTHONDONTWRITEBYTECODE": "1"}, capture_output=True, timeout=300)
                    outcome = "survived" if run.returncode == 0 else "caught"
                except subprocess.TimeoutExpired:
                    pass
            found.append("\t".join((path.name, was, now, outcome)))
    finally:
        path.write_text(source)
kept.write_text("\n".join(found) + "\n")
