"""Puts the pages of the site together: those of site/, those of docs/ as they are, the paper's equations, the Python modules and the gallery.

    python site/assemble.py TARGET KATEX

A file of docs/ that no heading below names is listed under "More"; a notebook of site/gallery is listed by its title and its line `about`. A notebook whose line `needs` names packages that are not
installed is shown without results, and that is said on standard error.
"""

from __future__ import annotations

import importlib
import importlib.util
import re
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

#: The pages of docs/, by subject.
SUBJECTS = {
    "The paper, verified": ["claims", "discrepancies", "equations", "notation", "compare", "accuracy", "reliability"],
    "Motions": ["exact-motion", "averaged-solution", "numerical-motion", "plans", "two-deformations"],
    "Pulsars and waves": ["pulsars", "spin-down", "timing-model", "worked-pulsar", "worked-wave"],
    "Data": ["inference", "bounds", "scenes", "sweep"],
    "The program": ["architecture", "performance", "figures", "report", "python", "crates", "site"],
}

#: Where links to files without a page of their own lead.
PAGES = {"../python/README.md": "../start/python.md"}


def main(target: Path, katex: Path) -> None:
    shutil.copytree(ROOT / "site", target, ignore=shutil.ignore_patterns("*.py", "__pycache__", "requirements.txt"))
    guide(target)
    equations(target / "docs")
    modules(target / "api")
    gallery(target)
    static(target / "_static" / "katex", katex)


def guide(site: Path) -> None:
    """The pages of docs/, listed on the first page."""
    target = site / "docs"
    for path in sorted((ROOT / "docs").rglob("*.*")):
        copy = target / path.relative_to(ROOT / "docs")
        copy.parent.mkdir(parents=True, exist_ok=True)
        if path.suffix == ".md":
            copy.write_text(with_links(path.read_text(), path))
        else:
            shutil.copy(path, copy)
    subjects = {subject: [name for name in names if (target / f"{name}.md").exists()] for subject, names in SUBJECTS.items()}
    subjects["The paper, verified"].insert(2, "typeset")
    listed = {name for names in subjects.values() for name in names}
    subjects["More"] = sorted(path.stem for path in target.glob("*.md") if path.stem not in listed)
    with (site / "index.md").open("a") as page:
        for subject, names in subjects.items():
            if names:
                page.write("\n" + tree([f"docs/{name}" for name in names], subject, hidden=True))
    parts = sorted(f"reliability/{path.stem}" for path in (target / "reliability").glob("*.md"))
    with (target / "reliability.md").open("a") as page:
        page.write("\n" + tree(parts, hidden=True))


def with_links(text: str, path: Path) -> str:
    """A page whose links to files of the repository that are no pages are the files' names."""

    def link(match: re.Match[str]) -> str:
        words, to = match[1], match[2]
        file = to.split("#")[0]
        if to in PAGES:
            return f"[{words}]({PAGES[to]})"
        if not file or re.match(r"[a-z]+:", to):
            return match[0]
        found = (path.parent / file).resolve()
        if not found.exists():
            raise SystemExit(f"{path.relative_to(ROOT)}: link to nothing: {to}")
        if found.is_relative_to(ROOT / "docs"):
            return match[0]
        name = str(found.relative_to(ROOT))
        return f"`{name}`" if name.endswith(words.strip("`")) else f"{words} (`{name}`)"

    # Links stand outside of blocks of code.
    pieces = re.split(r"(^```.*?^```$)", text, flags=re.MULTILINE | re.DOTALL)
    pieces[::2] = [re.sub(r"(?<!!)\[([^\]]+)\]\(([^)\s]+)\)", link, piece) for piece in pieces[::2]]
    return "".join(pieces)


def equations(target: Path) -> None:
    """The paper's equations, typeset."""
    rows = re.findall(r"^\| \((\d+)\) \| (?:`(\w+)`)? ?\| (.*?) \|", (ROOT / "docs/equations.md").read_text(), re.MULTILINE)
    about = {int(number): (label, subject) for number, label, subject in rows}
    text = (ROOT / "command/data/equations.tex").read_text()
    entries = re.findall(r"^% \((\d+)\) (\w+)(?:: (.*))?\n((?:[^%\n].*\n|\n)*)", text, re.MULTILINE)
    if {int(number) for number, kind, *_ in entries if kind == "printed"} != set(about):
        raise SystemExit("command/data/equations.tex and docs/equations.md have not the same equations")
    page = [
        "# The paper's equations, typeset",
        "As printed; where that does not hold, the form that does; and the form that is computed with, where it is another one. [equations.md](equations.md) says what implements each "
        "and what checks it, [discrepancies.md](discrepancies.md) derives what is corrected. The paper's $\\bar s$ is written $s$.",
    ]
    last = 0
    for number, kind, remark, latex in entries:
        if int(number) != last:
            last = int(number)
            _label, subject = about[last]
            # A symbol keeps its case.
            words = subject[0].upper() + subject[1:] if re.match(r"[a-z]{3,} ", subject) else subject
            page += [f"## Eq. ({number})", f"{words}."]
        heading = {"printed": "", "corrected": "**What holds.**", "used": "**As computed.**", "note": "**Note.**"}[kind]
        if heading or remark:
            page.append(f"{heading} {remark}".strip())
        if latex.strip():
            page.append(f"```{{math}}\n{latex.strip()}\n```")
    (target / "typeset.md").write_text("\n\n".join(page) + "\n")


def modules(target: Path) -> None:
    """A page for each module of the Python package."""
    names = sorted(path.stem for path in (ROOT / "python/twofold").glob("[a-z]*.py") if path.stem != "sweep")
    for name in names:
        try:
            importlib.import_module(f"twofold.{name}")
        except ImportError as error:
            print(f"site: not documented: twofold.{name} ({error})", file=sys.stderr)
            continue
        (target / f"{name}.md").write_text(
            f"# twofold.{name}\n\n```{{eval-rst}}\n.. automodule:: twofold.{name}\n   :members:\n```\n"
        )
    kernels = [name for name in dir(importlib.import_module("twofold").kernels) if not name.startswith("_")]
    functions = "\n".join(f".. autofunction:: twofold.kernels.{name}" for name in kernels)
    (target / "kernels.md").write_text(
        "# twofold.kernels\n\nClosed formulas of the paper on arrays; numbers and arrays are broadcast.\n\n"
        f"```{{eval-rst}}\n{functions}\n```\n"
    )
    pages = ["kernels", *(name for name in names if (target / f"{name}.md").exists())]
    with (target / "index.md").open("a") as page:
        page.write("\n" + tree(pages, "Modules"))


def gallery(target: Path) -> None:
    """The list of notebooks, and of those that are not executed."""
    cards, skipped, names = [], [], []
    folder = target / "gallery"
    paths = [path for path in folder.glob("*.md") if path.stem != "index"]
    settings = {path: dict(re.findall(r"^(about|needs|order): (.*)$", path.read_text(), re.MULTILINE)) for path in paths}
    for path in sorted(paths, key=lambda path: (int(settings[path].get("order", 99)), path.stem)):
        text = path.read_text()
        title, its = re.search(r"^# (.*)$", text, re.MULTILINE), settings[path]
        if title is None or "about" not in its:
            raise SystemExit(f"site/gallery/{path.name}: must be a notebook with a title and a line `about: ...`")
        missing = [name for name in its.get("needs", "").split() if importlib.util.find_spec(name) is None]
        if missing:
            print(f"site: not executed: gallery/{path.name}, for want of {', '.join(missing)}", file=sys.stderr)
            skipped.append(f"gallery/{path.name}")
            note = f"\n\n:::{{note}}\nNot executed when this site was built, for want of {', '.join(missing)}.\n:::\n"
            # A kernel would say which language it speaks.
            text = text.replace("---\n", "---\nlanguage_info:\n  name: python\n  pygments_lexer: ipython3\n", 1)
            path.write_text(text.replace(title[0], title[0] + note, 1))
        names.append(path.stem)
        cards.append(f":::{{grid-item-card}} {title[1]}\n:link: {path.stem}\n:link-type: doc\n\n{its['about']}\n:::")
    grid = "::::{grid} 1 2 2 2\n:gutter: 3\n\n" + "\n\n".join(cards) + "\n::::\n"
    with (folder / "index.md").open("a") as page:
        page.write("\n" + grid + "\n" + tree(names, hidden=True))
    (target / "not-executed.txt").write_text("\n".join(skipped))


def static(target: Path, katex: Path) -> None:
    """KaTeX's style sheet and fonts: one format, which all browsers read."""
    (target / "fonts").mkdir(parents=True)
    for font in (katex / "fonts").glob("*.woff2"):
        shutil.copy(font, target / "fonts")
    css = (katex / "katex.min.css").read_text()
    css = re.sub(r',url\(fonts/[^)]*\.(?:woff|ttf)\) format\("\w+"\)', "", css)
    if css.count("url(") != len(list((target / "fonts").iterdir())):
        raise SystemExit("KaTeX's style sheet and fonts do not belong together")
    (target / "katex.min.css").write_text(css)
    shutil.copy(katex.parent / "LICENSE", target)


def tree(names: list[str], caption: str | None = None, *, hidden: bool = False) -> str:
    options = [":hidden:"] if hidden else [":maxdepth: 1"]
    if caption:
        options.append(f":caption: {caption}")
    return "\n".join(["```{toctree}", *options, "", *names, "```", ""])


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
