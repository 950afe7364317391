"""What mutmut found, by file: `record.py TREE`, by scripts/mutation-python. `record.py TREE again` has what was not caught run again.

Left out is what changes no value: the words of an error (a test that looks at them may catch it all the same) and the looks of a figure. What is proved equivalent stands in
equivalent.tsv: file, function, the line as it was, as it is in the mutant (`*`: any), proof.
"""

import ast
import os
import sys
from collections import Counter
from pathlib import Path

from mutmut.mutation.data import SourceFileMutationData
from mutmut.mutation.diff_apply import get_diff_for_mutant, read_functions_from_index
from mutmut.stats import status_by_exit_code

import libcst

CAUGHT = ("killed", "timeout", "segfault")
HERE = Path(__file__).parent.resolve()

#: Arguments and keys by which figures look as they do.
LOOKS = set(
    "color lw ls fontsize zorder layout figsize pad aspect labelsize width length markersize markeredgewidth marker markerfacecolor loc bbox_to_anchor ncols frameon borderaxespad borderpad"
    " handlelength columnspacing arrowstyle shrinkA shrinkB arrowprops textcoords ha va path_effects rasterized shading cmap solid_capstyle linewidth foreground edgecolor facecolor capsize"
    " direction top right which".split()
)


class Values(ast.NodeTransformer):
    """A function without the words of its errors and without looks."""

    def visit_Raise(self, node):
        for part in ast.walk(node):
            if isinstance(part, ast.Constant) and isinstance(part.value, str):
                part.value = ""
        return node

    def visit_Call(self, node):
        self.generic_visit(node)
        node.keywords = [keyword for keyword in node.keywords if keyword.arg not in LOOKS]
        return node

    def visit_Dict(self, node):
        self.generic_visit(node)
        kept = [(key, value) for key, value in zip(node.keys, node.values) if not (isinstance(key, ast.Constant) and str(key.value).removeprefix("XX").removesuffix("XX").lower() in {look.lower() for look in LOOKS})]
        node.keys, node.values = [key for key, _ in kept], [value for _, value in kept]
        return node


def of_values(function):
    return ast.dump(Values().visit(ast.parse(libcst.Module([function]).code.strip())))


def again(tree):
    os.chdir(tree)
    for path in Path("twofold").glob("*.py"):
        data = SourceFileMutationData(path=path)
        data.load()
        data.exit_code_by_key = {name: code if status_by_exit_code[code] in CAUGHT else None for name, code in data.exit_code_by_key.items()}
        if data.exit_code_by_key:
            data.save()


def main(tree):
    listed = [line.split("\t") for line in (HERE / "equivalent.tsv").read_text().splitlines()]
    os.chdir(tree)
    counts, left, used = {}, [], set()
    for path in sorted(Path("twofold").glob("*.py")):
        data = SourceFileMutationData(path=path)
        data.load()
        counts[path.name] = Counter()
        for name, code in data.exit_code_by_key.items():
            status = status_by_exit_code[code]
            if status in CAUGHT:
                counts[path.name]["caught"] += 1
                continue
            if code is None:
                counts[path.name]["not run"] += 1
                continue
            before, after = read_functions_from_index(name, path)
            lines = get_diff_for_mutant(name, path=path).splitlines()[2:]
            was, now = (" ".join(line[1:].strip() for line in lines if line.startswith(sign)) for sign in "-+")
            proved = [k for k, (file, function, *change, _) in enumerate(listed) if (file, function) == (path.name, before.name.value) and change[0] == was and change[1] in ("*", now)]
            used.update(proved)
            kind = "equivalent" if proved else "no value" if of_values(before) == of_values(after) else "left"
            counts[path.name][kind] += 1
            if kind == "left":
                left.append(f"{path.name}\t{before.name.value}\t{was}\t{now}\t{status}\n")
    kinds = ("caught", "equivalent", "no value", "left", "not run")
    rows = [",".join(["file", "mutants", *kinds]), *(",".join(map(str, [name, count.total(), *(count[kind] for kind in kinds)])) for name, count in counts.items())]
    print("\n".join(rows))
    for k in set(range(len(listed))) - used:
        print(f"listed, but caught or no mutant: {listed[k]}")
    (HERE / "record.csv").write_text("\n".join(rows) + "\n")
    (HERE / "not_caught.tsv").write_text("".join(left))


again(sys.argv[1]) if sys.argv[2:] else main(sys.argv[1])
