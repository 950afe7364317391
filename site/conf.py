"""Sphinx's settings. The pages are assembled by `assemble.py`, see docs/site.md."""

import logging
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

logging.getLogger("traitlets").setLevel(logging.WARNING)

project = "twofold"
author = "the authors of twofold"
html_title = "twofold"

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx_design",
    "sphinxcontrib.katex",
    "param_table",
    "run_command",
]
# Docstrings write code in single backticks, as Markdown does.
default_role = "code"
nitpicky = True
# Types of other packages, which have no page here.
nitpick_ignore_regex = [("py:.*", r"(?!twofold\.).*")]

myst_enable_extensions = ["dollarmath", "colon_fence"]
myst_heading_anchors = 4
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_merge_streams = True
nb_number_source_lines = False
# Notebooks that need a package which is not installed; `assemble.py` lists them.
_skipped = Path(__file__).parents[1] / "target/site/source/not-executed.txt"
nb_execution_excludepatterns = _skipped.read_text().split() if _skipped.exists() else []
suppress_warnings = ["misc.highlighting_failure", "mystnb.unknown_mime_type"]

katex_prerender = True
katex_css_path = "katex/katex.min.css"

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
add_module_names = False

html_theme = "furo"
# Of the assembled pages: the style sheet, and KaTeX with its fonts.
html_static_path = [str(Path(__file__).parents[1] / "target/site/source/_static")]
html_css_files = ["site.css"]
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0072b2", "color-brand-content": "#0072b2"},
    "dark_css_variables": {"color-brand-primary": "#6fb8e6", "color-brand-content": "#6fb8e6"},
}
exclude_patterns = ["not-executed.txt"]
