"""Tables as a user writes them, turned into piecewise polynomials; `waveforms.py` has quantities in time.

A table is a list of [x, y] pairs, a map {x: [...], y: [...], kind: linear|cubic, beyond: constant|line}, or
{file: data.csv} with the same two words, and columns: [time, force] where the file has more than two. Beyond its ends
a table stays constant unless it says `line`.
"""

from __future__ import annotations

import csv
import functools
import hashlib
import io
import itertools
import math
import pathlib
import re
from collections.abc import Callable, Iterator, Mapping, Set
from typing import Any

from fairlead.component.given import Table
from fairlead.component.piecewise import (
    PiecewisePolynomial,
    linear_table,
    monotone_cubic_table,
)  # fmt: skip
from fairlead.errors import did_you_mean, listing, shown
from fairlead.quantities import NUMBER, QuantityError, article, fits, kind, parse_unit, written

WORDS = {"kind": ("linear", "cubic"), "beyond": ("constant", "line")}
CALLED = {"omega": ("frequency",), "period": ("every", "over"), "width": ("wide",), "duration": ("over", "stay"),
          "n": ("count",), "number": ("count",), "height": ("to",), "value": ("to",), "end": ("stop",), "x": ("t",),
          "time": ("at", "t"), "offset": ("from",), "slope": ("rate",), "until": ("stop",)}  # fmt: skip
"""What others call a setting of a quantity in time."""
MOST_POINTS = 100_000
MOST_BYTES = 10_000_000
MOST_KEPT = 16
"""Tables of files that are kept as they were read; cases of a sweep or a fit ask for the same ones again and again."""
CSV_FORM = "Write two numbers in a row, a comma between them and a point in them: 0.5,12.3"
MINUS = str.maketrans("\u2212\u2010\u2011\u2012\u2013\uff0d", "------")
"""What prints as a minus and is none."""
IN_BRACKETS = re.compile(r"(?P<name>[^\[\](){}]*)(?:\[(?P<square>[^\[\]]*)\]|\((?P<round>[^()]*)\))\s*")
"""A name with its unit in brackets."""
# Where a number of a table stands: the path to it in the netlist, and what a message says before it.
Place = tuple[tuple[str | int, ...], str]


class TableError(ValueError):
    """What is wrong in a table or a waveform: `path` leads to the place inside it, `what` reads on from its name.

    `of_name`: the name at the end of the path is wrong, not the value that stands under it.
    """

    def __init__(
        self, what: str, way_out: str = "", path: tuple[str | int, ...] = (), *, of_name: bool = False
    ) -> None:
        super().__init__(what, way_out)
        self.what, self.way_out, self.path, self.of_name = what, way_out, path, of_name

    def __str__(self) -> str:
        return f"{'.'.join(map(str, self.path))}{': ' if self.path else ''}{self.what}. {self.way_out}".strip()

    def below(self, *path: str | int) -> TableError:
        """The same, seen from further up."""
        return TableError(self.what, self.way_out, (*path, *self.path), of_name=self.of_name)


def si_at(value: Any, unit: str, *path: str | int) -> float:
    """A quantity in SI; what is wrong with it is told at `path`. Raises TableError."""
    try:
        return written(value, unit)
    except QuantityError as error:
        raise TableError(f" = {error.what}", error.allowed, path) from None


def read_table(value: Any, declared: Table, folder: pathlib.Path) -> PiecewisePolynomial:
    """A table in SI. Raises TableError with what is wrong and what is allowed."""
    if isinstance(value, PiecewisePolynomial):
        return value
    return points(value, declared.x, declared.y, "x", folder)


def points(value: Any, x_unit: str, y_unit: str, x_name: str, folder: pathlib.Path) -> PiecewisePolynomial:
    """A table of these units as pieces, `x_name` is what its first column is called. Raises TableError."""
    words = {"kind": "linear", "beyond": "constant"}
    at: Callable[[int, int], Place] = _row
    if isinstance(value, Mapping):
        only(value, {x_name, "y", "file", "columns", *WORDS})
        for word, allowed in WORDS.items():
            words[word] = str(value.get(word, words[word]))
            if words[word] not in allowed:
                raise TableError(f" = {shown(words[word])} is not known", f"Allowed: {listing(allowed)}.", (word,))
        if "file" in value:
            data = _bytes(value["file"], folder)
            digest = hashlib.blake2b(data).digest()
            key = (digest, str(value["file"]), repr(value.get("columns")), x_unit, y_unit, x_name, *words.values())
            if key not in _KEPT:
                rows, at = _from_file(data, value["file"], value.get("columns"), (x_unit, y_unit))
                _keep(key, _shaped(rows, at, x_unit, y_unit, x_name, words))
            return _KEPT[key]
        rows, at = _columns(value, x_name), functools.partial(_column, (x_name, "y"))
    else:
        rows = value
    return _shaped(rows, at, x_unit, y_unit, x_name, words)


_KEPT: dict[tuple[Any, ...], PiecewisePolynomial] = {}


def _keep(key: tuple[Any, ...], table: PiecewisePolynomial) -> None:
    """Keep a table by the content of its file and all that shapes it; the one that was kept first goes."""
    if len(_KEPT) >= MOST_KEPT:
        _KEPT.pop(next(iter(_KEPT)), None)
    table.rows.setflags(write=False)  # models share it
    _KEPT[key] = table


def _shaped(
    rows: Any, at: Callable[[int, int], Place], x_unit: str, y_unit: str, x_name: str, words: Mapping[str, str]
) -> PiecewisePolynomial:
    """Rows of two as pieces. Raises TableError."""
    if not isinstance(rows, list) or any(not isinstance(row, list | tuple) or len(row) != 2 for row in rows):
        commas = isinstance(rows, list) and any(isinstance(row, list) and len(row) in (3, 4) for row in rows)
        hint = " Numbers have a decimal point, not a decimal comma." if commas else ""
        raise TableError(
            "this is not a table",
            f"Write a list of [{x_name}, y] pairs, or a map with {x_name}, y and kind, or with file.{hint}",
        )
    if not 2 <= len(rows) <= MOST_POINTS:
        raise TableError(f"a table has 2 to {MOST_POINTS} points, this one has {len(rows)}")
    x = [si_at(row[0], x_unit, *at(k, 0)[0]) for k, row in enumerate(rows)]
    y = [si_at(row[1], y_unit, *at(k, 1)[0]) for k, row in enumerate(rows)]
    for k, (before, after) in enumerate(itertools.pairwise(x)):
        if not after > before:
            path, said = at(k + 1, 0)
            raise TableError(f"{said}{x_name} must rise from point to point; {after:g} follows {before:g}", "", path)
    shape = linear_table if words["kind"] == "linear" else monotone_cubic_table
    return shape(x, y, beyond=words["beyond"])


def _row(k: int, column: int) -> Place:
    """In a list of pairs."""
    return (k, column), ""


def _column(names: tuple[str, str], k: int, column: int) -> Place:
    """In two lists."""
    return (names[column], k), ""


def _columns(value: Mapping[str, Any], x_name: str) -> list[list[Any]]:
    x, y = value.get(x_name), value.get("y")
    if not isinstance(x, list) or not isinstance(y, list) or len(x) != len(y):
        raise TableError(f"{x_name} and y must be lists of the same length")
    return [list(pair) for pair in zip(x, y, strict=True)]


def _bytes(name: Any, folder: pathlib.Path) -> bytes:
    """What a CSV file inside the netlist's folder holds. Raises TableError."""
    try:
        return _inside(folder, str(name)).read_bytes()
    except (OSError, ValueError, RuntimeError) as error:  # no name of a file, or a link that leads to itself
        if isinstance(error, TableError):
            raise
        reason = getattr(error, "strerror", None) or "this is no path to a file"
        raise TableError(f" = {shown(name)} cannot be read: {reason}", "", ("file",)) from error


def _from_file(
    data: bytes, name: Any, columns: Any = None, units: tuple[str, str] = ("1", "1")
) -> tuple[list[list[Any]], Callable[[int, int], Place]]:
    """Two columns of a CSV file, and where each number stands.

    `columns` names the two in the first row; without it the file has two.

    A first row of names is a header, also with units: `t [ms]`, `force (kN)`. Nothing is passed over but that, comments
    (#) and empty rows: what is not two numbers in a row is refused by the number of its row.
    """
    said = f" = {shown(name)}, row"
    found, lines, own = [], [], ["", ""]
    picked: list[int] | None = None
    for k, (line, cells) in enumerate(_cells(data, said)):
        if k == 0 and columns is not None:
            picked = _picked(columns, cells, f"{said} {line}")
        if picked is not None and len(cells) > max(picked):
            cells = [cells[k] for k in picked]
        if k == 0 and (columns is not None or _are_names(cells)):
            own = _own_units(cells, units, f"{said} {line}")
            continue
        pair = _pair(cells, f"{said} {line}")
        found.append([f"{number!r} {unit}" if unit else number for number, unit in zip(pair, own, strict=True)])
        lines.append(line)
    return found, lambda k, _: (("file",), f"{said} {lines[k]}: ")


def _are_names(cells: list[str]) -> bool:
    """True for a header: words that differ, none of them a number to anyone: not nan, nor with a printed minus."""
    return len(set(cells)) == len(cells) and all(_is_name(cell) for cell in cells)


def _is_name(cell: str) -> bool:
    try:
        float(cell.translate(MINUS))
    except ValueError:
        return any(letter.isalpha() for letter in cell) and not NUMBER.match(cell.translate(MINUS))
    return False


def _own_units(names: list[str], units: tuple[str, str], said: str) -> list[str]:
    """The units that a header gives its two columns. A title of another length gives none. Raises TableError."""
    if len(names) == 2:
        return [_own_unit(*told, said) for told in zip(names, units, strict=True)]
    if any((told := IN_BRACKETS.fullmatch(name)) and told["square"] for name in names):
        what = f"{said}: the header has {len(names)} column{'s' * (len(names) > 1)} with units; a table has two"
        raise TableError(what, "Name both columns, or write no units.", ("file",))
    return ["", ""]


def _own_unit(name: str, unit: str, said: str) -> str:
    """The unit that a name in the first row gives its column in brackets; "" without one, and if it is that of SI.

    In square brackets nothing else can be meant; in round ones what is no unit is a remark. Raises TableError.
    """
    told = IN_BRACKETS.fullmatch(name)
    if told is None or (own := told["square"] or told["round"]) == "-":
        return ""
    try:
        given = parse_unit(own)
    except QuantityError as error:
        if told["square"] is None:
            return ""
        what = f"{said}: {shown(name)} is no column with a unit: {error.what}"
        raise TableError(what, "Write a unit in the brackets, or none at all.", ("file",)) from None
    if not fits(given.dimension, parse_unit(unit).dimension):
        what = f"{said}: {shown(name)} is a column of another kind: {article(kind(unit))} is wanted here"
        raise TableError(what, "Are the columns in this order? Else leave out the brackets.", ("file",))
    return "" if own == unit else own


def _picked(columns: Any, head: list[str], said: str) -> list[int]:
    """Where two columns stand, by the names in the first row, with or without their units. Raises TableError."""
    if not isinstance(columns, list) or len(columns) != 2:
        raise TableError(f" = {shown(columns)} is no pair", "Write columns: [time, force].", ("columns",))
    bare = [told["name"].strip() if (told := IN_BRACKETS.fullmatch(name)) else name for name in head]
    for name in columns:
        if name not in head and bare.count(name) != 1:
            what = f" = {shown(name)} is no column of it. {did_you_mean(str(name), head)}".rstrip()
            raise TableError(what, f"{said} names {listing(head)}.", ("columns",))
    return [head.index(name) if name in head else bare.index(name) for name in columns]


def _cells(data: bytes, said: str) -> Iterator[tuple[int, list[str]]]:
    """The rows that hold something, each with its number in the file."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        what = f"{said} {line}: the file is not a text in UTF-8 (byte 0x{data[error.start]:02x})"
        raise TableError(what, "Save it as CSV in UTF-8.", ("file",)) from None
    reader = csv.reader(io.StringIO(text, newline=""))
    try:
        for row in reader:
            cells = [cell.strip() for cell in row]
            while cells and not cells[-1]:
                cells.pop()
            if cells and not cells[0].startswith("#"):
                yield reader.line_num, cells
    except csv.Error as error:
        raise TableError(f"{said} {reader.line_num}: {error}", CSV_FORM, ("file",)) from None


def _pair(cells: list[str], said: str) -> list[float]:
    """The two numbers of a row. Raises TableError with what else it holds."""
    if any(";" in cell for cell in cells):
        raise TableError(f"{said}: {shown(','.join(cells))} is separated by semicolons", CSV_FORM, ("file",))
    for column, cell in enumerate(cells, 1):
        number = NUMBER.fullmatch(cell) is not None
        if not number or math.isinf(float(cell)):
            hint = _hint(cell)
            what = f"{said}, column {column}: {shown(cell)} is not a {'finite ' if number else ''}number"
            raise TableError(what, f"{hint}{CSV_FORM}", ("file",))
    if len(cells) != 2:
        what = f"{said}: {'one column' if len(cells) == 1 else f'{len(cells)} columns'}; a table has two"
        raise TableError(what, CSV_FORM, ("file",))
    return [float(cell) for cell in cells]


def _hint(cell: str) -> str:
    """What a cell may have been meant as that begins with a number."""
    begins = NUMBER.match(cell)
    if begins is None:
        return ""
    comma = cell[begins.end() :].startswith(",")
    in_header = "Numbers of a file are in SI, or in the unit in brackets behind the name in the first row. "
    return "A decimal comma is no point. " if comma else in_header


def file_inside(folder: pathlib.Path, name: Any, ending: str) -> pathlib.Path:
    """The file of a name, which must lie in the folder or below, links followed. Raises TableError."""
    try:
        return _inside(folder, str(name), ending)
    except TableError as error:
        raise TableError(error.what, error.way_out) from None
    except (OSError, ValueError, RuntimeError) as error:  # no name of a file, or a link that leads to itself
        reason = getattr(error, "strerror", None) or "this is no path to a file"
        raise TableError(f" = {shown(name)} cannot be read: {reason}") from error


def _inside(folder: pathlib.Path, name: str, ending: str = ".csv") -> pathlib.Path:
    """The file of a name, which must lie below the folder and, as a table, be of a bearable size."""
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise TableError(
            f" = {shown(name)} lies outside the folder of the netlist", "Put the file beside the netlist.", ("file",)
        )
    if path.exists() and not path.is_file():
        what = "a folder" if path.is_dir() else "no ordinary file"
        raise TableError(f" = {shown(name)} is {what}", "Write the name of a file.", ("file",))
    if not path.is_file():
        beside = [file.name for file in folder.iterdir() if file.suffix == ending]
        near = did_you_mean(path.name, beside)
        raise TableError(
            f": there is no file {shown(name)} in the folder of the netlist. {near}".rstrip(" ."), "", ("file",)
        )
    if ending == ".csv" and path.stat().st_size > MOST_BYTES:
        raise TableError(f" = {shown(name)} is larger than {MOST_BYTES} bytes", "", ("file",))
    return path


def only(settings: Any, allowed: Set[str], needed: Set[str] = frozenset()) -> None:
    """Raise TableError for a map that has others than these names, or lacks some."""
    names = listing(sorted(allowed))
    if not isinstance(settings, Mapping):
        raise TableError(f" = {shown(settings)} is not a map", f"Write a map with {names}.")
    for name in settings:
        if name not in allowed:
            meant = next((f"Did you mean {one}?" for one in CALLED.get(str(name), ()) if one in allowed), "")
            what = f"there is no such setting. {meant or did_you_mean(str(name), allowed)}".rstrip(" .")
            raise TableError(what, f"There are {names}.", (str(name),), of_name=True)
    for name in sorted(needed - set(settings)):
        raise TableError(f"{name} is missing", f"Needed: {listing(sorted(needed))}.")


def table_schema(declared: Table) -> dict[str, Any]:
    """JSON Schema of a table."""
    number = {"type": ["number", "string"]}
    pairs = {"type": "array", "items": {"type": "array", "items": number, "minItems": 2, "maxItems": 2}}
    column = {"type": "array", "items": number}
    words = {word: {"enum": list(allowed)} for word, allowed in WORDS.items()}
    named = {"x": column, "y": column, **words, "file": {"type": "string"}}
    in_columns = {"type": "object", "properties": named, "additionalProperties": False}
    return {"description": declared.doc, "anyOf": [pairs, in_columns]}
