"""Layout of plain-text pages: headings, aligned columns, wrapped paragraphs."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Sequence

WIDTH = 110
WIDEST = 44  # of any column but the last; a longer cell stands on a line of its own
HARD_SPACE = "\N{NO-BREAK SPACE}"
SHORT_BRACKETS = re.compile(r"\|[^|]{1,60}\||\([^()]{1,60}\)")


def heading(title: str) -> list[str]:
    """A section title, after an empty line."""
    return ["", title]


def paragraph(text: str | None, indent: int = 2) -> list[str]:
    """A docstring as it was written, indented."""
    return textwrap.indent(text, " " * indent).splitlines() if text else []


def columns(rows: Iterable[Sequence[str]], indent: int = 2) -> list[str]:
    """Rows with their cells below each other; the last is wrapped, and may have several lines."""
    rows = [tuple(row) for row in rows]
    count = max(map(len, rows), default=0)
    widths = [max((len(r[k]) for r in rows if k < len(r) and len(r[k]) <= WIDEST), default=0) for k in range(count)]
    lines = []
    for row in rows:
        front = " " * indent
        for cell, width in zip(row[:-1], widths, strict=False):
            if len(cell) > width:  # too long for its column: the rest of the row goes below it
                lines.append(front + cell)
                front, cell = " " * len(front), ""
            front += f"{cell:<{width}}  "
        first, *more = row[-1].split("\n")
        lines += wrapped(front + first, len(front))
        lines += [line for text in more for line in wrapped(" " * len(front) + text, len(front))]
    return lines


def wrapped(line: str, hang: int) -> list[str]:
    """A line broken to the width of the page, not inside short brackets; the rest hangs at column `hang`."""
    kept = SHORT_BRACKETS.sub(lambda match: match[0].replace(" ", HARD_SPACE), line)
    below = " " * min(hang, WIDTH - 40)
    lines = textwrap.wrap(kept, WIDTH, subsequent_indent=below, break_long_words=False, break_on_hyphens=False)
    return [text.replace(HARD_SPACE, " ") for text in lines] or [""]
