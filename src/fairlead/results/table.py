"""A small table: what `result.margins()`, `.limits`, `.energy` and `model.statics()` are made of.

    table["margin"]         a column, as a list
    table[0]                a row, as a dict; `for row in table` goes through them
    table.to_pandas()       a pandas.DataFrame; units are in `.attrs["units"]`
    table                   itself, in a notebook or at a prompt, no longer than a screen
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any, overload

from fairlead.errors import FairleadError, did_you_mean, printable, shown

if TYPE_CHECKING:
    import pandas

MOST_ROWS = 24
"""Shown of a longer table; all are in `to_pandas()`."""
WIDEST, WIDEST_CELL = 110, 36
MOST_NOTES = 6
LONGEST_CELL = 200  # of a page, which breaks lines


class NoColumnError(FairleadError, KeyError):
    """A column that a table has not."""

    def __str__(self) -> str:
        return str(self.args[0])  # KeyError would show the message in quotes.


class NoRowError(FairleadError, IndexError):
    """A row that a table has not."""


@dataclass(frozen=True, repr=False)
class Table:
    """Rows of equal length under named columns, with the unit of each column ("" for none).

    A cell is a text, a number, True or False, or None where there is nothing to tell.
    """

    title: str
    columns: tuple[str, ...]
    units: tuple[str, ...]
    rows: tuple[tuple[Any, ...], ...]
    notes: tuple[str, ...] = ()
    """What is to be said of it, shown below."""

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return (dict(zip(self.columns, row, strict=True)) for row in self.rows)

    @overload
    def __getitem__(self, which: str) -> list[Any]: ...
    @overload
    def __getitem__(self, which: int) -> dict[str, Any]: ...

    def __getitem__(self, which: str | int) -> Any:
        """The column of that name, or the row of that number. Raises NoColumnError, NoRowError."""
        if isinstance(which, int):
            return dict(zip(self.columns, self.rows[row_of(which, self.rows)], strict=True))
        if not isinstance(which, str) or which not in self.columns:
            raise NoColumnError(f"{shown(which)}: the columns are {', '.join(self.columns)}. {self._instead(which)}")
        at = self.columns.index(which)
        return [row[at] for row in self.rows]

    def _instead(self, which: object) -> str:
        """What to write for a row that is asked for by its first cell, or for a misspelt name."""
        heads = [row[0] for row in self.rows if isinstance(row[0], str)]
        if isinstance(which, str) and which in heads:
            number = [row[0] for row in self.rows].index(which)
            return f"\n    {shown(which)} is a row: [{number}] gives it."
        near = did_you_mean(which, self.columns) or did_you_mean(which, heads)
        return near if near else "\n    A row goes by its number: [0] is the first."

    def to_pandas(self) -> pandas.DataFrame:
        """All rows; `frame.attrs["units"]` maps columns to units."""
        import pandas

        frame = pandas.DataFrame(list(self.rows), columns=list(self.columns))
        frame.attrs["units"] = dict(zip(self.columns, self.units, strict=True))
        return frame

    def __repr__(self) -> str:
        named = zip(self.columns, self.units, strict=True)
        head = [_cut(_text(f"{name} [{unit}]" if unit else name)) for name, unit in named]
        cells = [head, *([_cut(_text(cell)) for cell in row] for row in self.rows[:MOST_ROWS])]
        widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
        lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in cells]
        lines = [line if len(line) <= WIDEST else f"{line[: WIDEST - 3]}..." for line in lines]
        return "\n".join([_cut(_text(self.title), WIDEST), *(line.rstrip() for line in lines), *self._below()])

    def _repr_html_(self) -> str:
        head = "".join(f"<th>{escape(name)}{_unit(unit)}</th>" for name, unit in zip(self.columns, self.units))
        body = "".join(f"<tr>{''.join(f'<td>{escape(_cut(_text(cell), LONGEST_CELL))}</td>' for cell in row)}</tr>"
                       for row in self.rows[:MOST_ROWS])  # fmt: skip
        more = "".join(f"<p>{escape(line)}</p>" for line in self._below())
        title = f"<caption><b>{escape(_cut(_text(self.title), WIDEST))}</b></caption>"
        return f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>{more}"

    def _below(self) -> list[str]:
        notes = [_cut(f"note: {_text(note)}", WIDEST) for note in self.notes[:MOST_NOTES]]
        return [*_left_out(self.rows), *notes]


def row_of(which: int, rows: Sequence[Any], called: str = "rows") -> int:
    """The number of a row, also counted from the end; `called` is what rows are. Raises NoRowError."""
    if isinstance(which, bool):
        raise NoRowError(f"{which} is no number; {f'{called} are 0 to {len(rows) - 1}' if rows else 'there are none'}")
    if isinstance(which, int) and not -len(rows) <= which < len(rows):
        raise NoRowError(f"{which}: {f'{called} are 0 to {len(rows) - 1}' if rows else f'there are no {called}'}")
    return which


def _left_out(rows: Sequence[Any]) -> list[str]:
    left = len(rows) - MOST_ROWS
    return [f"... and {left} more rows; .to_pandas() has all {len(rows)}"] if left > 0 else []


def _unit(unit: str) -> str:
    return f" [{escape(unit)}]" if unit else ""


def _text(cell: Any) -> str:
    if cell is None:
        return ""
    if isinstance(cell, bool):
        return "yes" if cell else "no"
    if isinstance(cell, float):
        return "any" if math.isinf(cell) else f"{cell:.6g}"
    return " ".join(printable(str(cell)).split())


def _cut(text: str, most: int = WIDEST_CELL) -> str:
    return text if len(text) <= most else f"{text[: most - 3]}..."
