"""`.. paramtable::` of PINT's docstrings: the parameters of a component, as its own documentation lists them."""

from __future__ import annotations

import importlib
from typing import Any

from docutils import nodes
from docutils.parsers.rst import directives
from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective


class ParamTable(SphinxDirective):
    option_spec = {"class": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        module, _, name = self.options["class"].rpartition(".")
        component = getattr(importlib.import_module(module), name)()
        lines = []
        for each in component.params:
            parameter = getattr(component, each)
            lines.append(f"- ``{each}`` [{str(parameter.units) or 1}]: {parameter.description}")
        parent = nodes.container()
        self.state.nested_parse(StringList(lines, source=self.options["class"]), 0, parent)
        return parent.children


def setup(app: Any) -> dict[str, bool]:
    app.add_directive("paramtable", ParamTable)
    return {"parallel_read_safe": True}
