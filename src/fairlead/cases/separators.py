"""Files that a spreadsheet saved with semicolons or tabs, told by their first line."""

from __future__ import annotations

from collections.abc import Sequence

from fairlead.errors import shown

MARKS = {";": "semicolons", "\t": "tabs"}


def separated_otherwise(first: Sequence[str]) -> tuple[str, str] | None:
    """What is wrong with the first line of a CSV file that has no comma but another mark, and the way out."""
    for mark, name in MARKS.items():
        if len(first) == 1 and mark in first[0]:
            return (f"this file is separated by {name}: {shown(first[0])}",
                    "Save it with commas between the columns, and numbers with a point.")  # fmt: skip
    return None
