"""Tries a built site: every link within it leads to a page and a place there is, and no page asks a server for anything.

    python site/check.py FOLDER
"""

from __future__ import annotations

import re
import sys
import tempfile
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """The ids of a page, its links, and what it loads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.loads: list[str] = []
        self.errors: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        its = {name: value or "" for name, value in attrs}
        for name in ("id", "name") if tag == "a" else ("id",):
            if name in its:
                self.ids.add(its[name])
        if tag == "a" and "href" in its:
            self.links.append(its["href"])
        elif tag == "link" and its.get("rel") not in ("canonical", "search", "index", "next", "prev"):
            self.loads.append(its.get("href", ""))
        if tag in ("script", "img", "iframe", "source", "video", "audio", "embed") and "src" in its:
            self.loads.append(its["src"])
        self.loads += re.findall(r"url\(([^)]+)\)", its.get("style", ""))
        if "katex-error" in its.get("class", ""):
            self.errors.append(its.get("title", "a formula"))


def complaints(folder: Path) -> list[str]:
    pages = {path: Page(path.read_text()) for path in folder.rglob("*.html")}
    found = []
    for path, page in pages.items():
        name = path.relative_to(folder)
        found += [f"{name}: formula not set: {error}" for error in page.errors]
        for to in page.links + page.loads:
            parts = urlsplit(to)
            if parts.scheme == "data" or (to in page.links and parts.scheme in ("http", "https", "mailto")):
                continue
            if parts.scheme or parts.netloc:
                found.append(f"{name}: asks a server for {to}")
                continue
            file = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if not file.is_file():
                found.append(f"{name}: link to nothing: {to}")
            elif parts.fragment and file in pages and unquote(parts.fragment) not in pages[file].ids:
                found.append(f"{name}: no such place: {to}")
    # Style sheets, too.
    for path in folder.rglob("*.css"):
        for to in re.findall(r"""(?:@import\s+|url\()["']?([^"')]+)""", path.read_text()):
            if to.startswith(("data:", "#")):
                continue
            if re.match(r"(\w+:)?//", to):
                found.append(f"{path.relative_to(folder)}: asks a server for {to}")
            elif not (path.parent / re.split("[?#]", to)[0]).is_file():
                found.append(f"{path.relative_to(folder)}: link to nothing: {to}")
    return found


def test_of_itself() -> None:
    """A page with a fault must be found out, or the verdict on the site means nothing."""
    faults = {
        "": '<p><a href="#here" id="here">here</a> <a href="https://a.b/">away</a> <a href="other.html#there">there</a></p>',
        "asks a server for https://a.b/c.js": '<script src="https://a.b/c.js"></script>',
        "asks a server for //a.b/c.css": '<link rel="stylesheet" href="//a.b/c.css">',
        "link to nothing: gone.html": '<a href="gone.html">gone</a>',
        "link to nothing: gone.png": '<img src="gone.png" alt="">',
        "no such place: #gone": '<a href="#gone">gone</a>',
        "no such place: other.html#gone": '<a href="other.html#gone">gone</a>',
        "formula not set: wrong": '<span class="katex-error" title="wrong">x</span>',
        "sheet.css: asks a server for https://a.b/font": '<link rel="stylesheet" href="sheet.css">',
    }
    for fault, body in faults.items():
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name).resolve()
            (folder / "page.html").write_text(f"<html><body>{body}</body></html>")
            (folder / "other.html").write_text('<p id="there">there</p>')
            (folder / "sheet.css").write_text("p {src: url(https://a.b/font)}" if "sheet.css" in fault else "")
            found = complaints(folder)
            if (not found) if fault else found:
                sys.exit(f"site: test of the check: {fault or 'no fault'}: {found}")
            if fault and not any(fault in one for one in found):
                sys.exit(f"site: test of the check: {fault} is not among {found}")


if __name__ == "__main__":
    test_of_itself()
    folder = Path(sys.argv[1]).resolve()
    found = complaints(folder)
    if not (folder / "index.html").is_file():
        found.append(f"{folder} has no index.html")
    for line in found:
        print(f"site: {line}", file=sys.stderr)
    if found:
        sys.exit(1)
    count = len(list(folder.rglob("*.html")))
    print(f"site: {count} pages in {folder}, every link within them leads somewhere, none asks a server for anything")
