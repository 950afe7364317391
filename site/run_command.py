"""The directive `{command}`: runs a line of the shell when the site is built and shows it with what it prints. A command that fails, fails the build.

Commands of a page run one after another in a folder of their own. `:lines:` shows so many lines of the output, `:hidden:` none.
"""

from __future__ import annotations

import subprocess
import tempfile
from pathlib import Path

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective

_folders: dict[str, tempfile.TemporaryDirectory] = {}


class Command(SphinxDirective):
    has_content = True
    option_spec = {"lines": directives.positive_int, "hidden": directives.flag}  # noqa: RUF012

    def run(self) -> list[nodes.Node]:
        page = self.env.docname
        if page not in _folders:
            _folders[page] = tempfile.TemporaryDirectory(prefix="twofold-site-")
        shown = []
        for line in self.content:
            done = subprocess.run(
                ["bash", "-c", line], check=False, cwd=Path(_folders[page].name), capture_output=True, text=True, timeout=120,
            )  # fmt: skip
            if done.returncode != 0:
                raise ExtensionError(f"{page}: `{line}` ends with status {done.returncode}: {done.stderr.strip()}")
            printed = (done.stdout + done.stderr).splitlines()
            if "lines" in self.options and len(printed) > self.options["lines"]:
                printed = [*printed[: self.options["lines"]], "..."]
            shown += [f"$ {line}", *([] if "hidden" in self.options else printed)]
        block = nodes.literal_block("\n".join(shown), "\n".join(shown))
        block["language"] = "console"
        return [block]


def setup(app):
    app.add_directive("command", Command)
    app.connect("build-finished", lambda *_: [folder.cleanup() for folder in _folders.values()])
    return {"parallel_read_safe": False}
