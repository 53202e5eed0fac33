"""A measured record: a CSV file with a line of names, a column of times, and columns of signals in some unit.

Names may bear their unit: `angle [deg]`. Times rise. Every mistake is told with its line.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fairlead.cases.separators import separated_otherwise
from fairlead.errors import Fault, Location, did_you_mean, listing, shown
from fairlead.quantities import QuantityError, fits, kind, parse_unit

Floats = NDArray[np.float64]
FEWEST = 3
MOST_BYTES = 50_000_000
MOST_TOLD = 5
"""Mistakes of one sort that are told of one file."""


@dataclass(frozen=True)
class Column:
    """A wanted column: its name, its unit if the fit file gives one, and the unit [text] in which values are wanted."""

    name: str
    unit: str
    wanted: str
    where: Location


@dataclass(frozen=True)
class Table:
    """A CSV file as read: names without units, their units as texts, cells and the line of each row."""

    file: str
    units: dict[str, str]
    cells: list[list[str]]
    lines: list[int]

    @property
    def names(self) -> list[str]:
        """Names of the columns."""
        return list(self.units)


def read_table(file: Path, where: Location) -> tuple[Table | None, list[Fault]]:
    """The cells of a file, or None, and what is wrong with its form; `where` is the place that names the file."""
    if not file.is_file():
        return None, [Fault(where, f"there is no file {file}", "Paths start at the fit file.")]
    if file.stat().st_size > MOST_BYTES:
        return None, [Fault(where, f"{shown(str(file))} has more than {MOST_BYTES} bytes", "Take fewer points.")]
    with file.open(encoding="utf-8-sig", errors="replace", newline="") as stream:
        rows = [[cell.strip() for cell in row] for row in csv.reader(line.replace("\0", "?") for line in stream)]
    filled = [(number, row) for number, row in enumerate(rows, 1) if any(row)]
    if len(filled) < FEWEST + 1:
        what = "this file is empty" if not filled else f"this file has {max(len(filled) - 1, 0)} rows below its names"
        return None, [Fault(Location(str(file), 1, 1), what, f"A record has names and {FEWEST} rows or more.")]
    first, head = filled[0]
    if other := separated_otherwise(head):
        return None, [Fault(Location(str(file), first, 1), *other)]
    parts = [_named(cell) for cell in head]
    names = [name for name, _ in parts]
    if not all(names) or len(set(names)) < len(names) or all(_number(cell) is not None for cell in head):
        what = f"the first line is no line of different names: {shown(', '.join(head))}"
        return None, [Fault(Location(str(file), first, 1), what, "Write time,angle [deg] above the numbers.")]
    faults = [Fault(Location(str(file), line, 1), f"this line has {len(row)} cells, the first one {len(names)}")
              for line, row in filled[1:] if len(row) != len(names)]  # fmt: skip
    if faults:
        return None, faults[:MOST_TOLD]
    return Table(str(file), dict(parts), [row for _, row in filled[1:]], [line for line, _ in filled[1:]]), []


def column_of(table: Table, column: Column) -> tuple[Floats, list[Fault]]:
    """Values of a column in the unit that is wanted, and what is wrong with it."""
    if column.name not in table.units:
        hint = did_you_mean(column.name, table.names)
        what = f"{table.file} has no column {shown(column.name)}. {hint}".rstrip()
        return np.empty(0), [Fault(column.where, what, f"Its columns are {listing(table.names)}.")]
    index = table.names.index(column.name)
    factor, faults = _factor(table, column)
    values = [_number(row[index]) for row in table.cells]
    bad = [k for k, value in enumerate(values) if value is None]
    for k in bad[:MOST_TOLD]:
        place = Location(table.file, table.lines[k], index + 1)
        faults.append(Fault(place, f"{column.name} = {shown(table.cells[k][index])} is not a finite number"))
    return np.array([math.nan if value is None else value for value in values]) * factor, faults


def times_of(table: Table, column: Column) -> tuple[Floats, list[Fault]]:
    """Times [s]; they must rise."""
    times, faults = column_of(table, column)
    if faults:
        return times, faults
    back = np.flatnonzero(np.diff(times) <= 0)
    for k in back[:MOST_TOLD]:
        place = Location(table.file, table.lines[k + 1], table.names.index(column.name) + 1)
        word = "stands still" if times[k + 1] == times[k] else "goes back"
        what = f"time {word}: {times[k + 1]:g} s after {times[k]:g} s"
        faults.append(Fault(place, what, "Each row must be later than the one above it; split the record there."))
    return times, faults


def _factor(table: Table, column: Column) -> tuple[float, list[Fault]]:
    """From the unit of the column to the one wanted: that of the fit file, of the line of names, or the same."""
    text, where = (column.unit, column.where) if column.unit else (table.units[column.name], Location(table.file, 1, 1))
    if not text:
        return 1.0, []
    try:
        given, wanted = parse_unit(text), parse_unit(column.wanted)
    except QuantityError as error:
        return 1.0, [Fault(where, f"{column.name}: {error.what}", error.allowed)]
    if not fits(given.dimension, wanted.dimension):
        what = f"{column.name} is in {text}, {kind(text)}; {kind(column.wanted)} is wanted, such as {column.wanted}"
        return 1.0, [Fault(where, what)]
    return given.factor / wanted.factor, []


def _named(cell: str) -> tuple[str, str]:
    """`angle [deg]` as name and unit."""
    parts = re.fullmatch(r"(.*?)\s*\[([^\]]*)\]", cell)
    return (parts[1].strip(), parts[2].strip()) if parts else (cell, "")


def _number(cell: str) -> float | None:
    try:
        value = float(cell)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


@dataclass(frozen=True)
class Measured:
    """Times [s] of the model, and by signal of the model its measured values in the unit of the model's signal."""

    times: Floats
    values: Mapping[str, Floats]
    noise: Mapping[str, float | None]
    """Standard deviation of the noise of each signal, where it is given."""
