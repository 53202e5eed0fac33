"""Settings of the site: `make docs` builds it into docs/_site, which a browser reads from disk, with search.

The pages in docs/generated are written here, before Sphinx reads any page: components, commands, gallery.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from generate.everything import write_pages  # noqa: E402 - found by the line above

project = "fairlead"
author = "The fairlead developers"
extensions = ["myst_nb", "sphinx.ext.autodoc"]
exclude_patterns = [
    "_site", "generated/examples/.kept", "jupyter_execute", "generate", "**/.ipynb_checkpoints",
]  # fmt: skip
html_theme = "furo"
html_title = "fairlead"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_copyright = False
html_show_sourcelink = False
html_show_search_summary = False  # it fetches pages, which a browser refuses from disk
templates_path: list[str] = []
myst_heading_anchors = 3
smartquotes = False  # "--all" is an option, not a dash
myst_enable_extensions = ["colon_fence"]
default_role = "code"  # docstrings say `name`, and mean code
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True
nb_execution_mode = "force"  # the notebook is run by every build, which stops at an error
nb_execution_raise_on_error = True
nb_execution_timeout = 300
suppress_warnings = ["docutils", "myst.header"]  # docstrings are plain text, older pages have several titles


def _plain(app: object, what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """Docstrings are plain text: paragraphs flow, what is indented or aligned (equations, tables) keeps its lines."""
    paragraphs = "\n".join(lines).strip("\n").split("\n\n")
    lines[:] = [line for one in paragraphs for line in (_kept(one) if _aligned(one) else _flowing(one))]


def _aligned(text: str) -> bool:
    return any(line.startswith(" ") or "   " in line for line in text.splitlines())


def _kept(text: str) -> list[str]:
    return [".. code-block:: text", "", *(f"    {line}" for line in text.splitlines()), ""]


def _flowing(text: str) -> list[str]:
    """Stars, bars and closing underscores outside `code` are themselves."""
    parts = re.split(r"(`[^`]+`)", text)
    said = [part if part.startswith("`") else re.sub(r"([*|]|_(?=\W|$))", r"\\\1", part) for part in parts]
    return ["".join(said), ""]


def setup(app: object) -> None:
    """Write the generated pages, and take docstrings as they are."""
    write_pages(HERE)
    app.connect("autodoc-process-docstring", _plain)  # type: ignore[attr-defined]
