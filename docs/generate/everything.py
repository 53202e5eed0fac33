"""Writes all generated pages and their pictures into docs/generated; nothing of it is kept in git.

A page is written only when it changed, so that a second build reads few pages again. Runs for pictures are kept by the
text of the netlist.
"""

from __future__ import annotations

from pathlib import Path

from generate import commands, components, gallery


def write_pages(docs: Path) -> None:
    """All pages of docs/generated."""
    folder = docs / "generated"
    pages = {**commands.pages(), **components.pages(docs, folder), **gallery.pages(docs, folder)}
    for name, text in pages.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
    for old in folder.rglob("*.md"):
        if str(old.relative_to(folder)) not in pages:
            old.unlink()
