"""Tables and fences of Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """Lines of a table, followed by an empty one; nothing when there are no rows."""
    body = [f"| {' | '.join(cell(text) for text in row)} |" for row in rows]
    return [f"| {' | '.join(head)} |", f"|{'---|' * len(head)}", *body, ""] if body else []


def cell(text: str) -> str:
    """Text that stands in one cell as it is."""
    quoted = str(text).replace("|", "\\|").replace("\n", " ")
    return quoted if "`" in quoted else quoted.replace("*", "\\*").replace("<", "&lt;").replace("_", "\\_")


def fence(language: str, text: str) -> list[str]:
    """A block of code."""
    return [f"```{language}", *text.rstrip("\n").splitlines(), "```", ""]
