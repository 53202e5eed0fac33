"""The table of a sweep: one Parquet file, replaced as a whole every few seconds, so that it can be read at any time.

A row for each case: `case` (its number in the design, -1 in rows of other designs), `key`, the values, `status`,
`sentence`, the figures, counters, `broken`, seconds and host. Units and what the columns are stand in the metadata of
the file, under `fairlead`. Writing takes at most a twentieth of the time.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fairlead.cases.row import COUNTED, Row, Value
from fairlead.errors import FairleadError, UsageError, listing, shown
from fairlead.studies.sweeps.ranges import column_of

if TYPE_CHECKING:
    import pandas

FILE, PART = "cases.parquet", "cases.parquet.new"
FORMAT = "fairlead-sweep-1"
PERIOD, SHARE = 1.0, 0.05
TOLD = ("key", "case", "status", "sentence")
COST = ("seconds", "loop", "host")
OWN = (*TOLD, *COUNTED, "limits_broken", *COST)
"""Columns that every table has; no parameter and no figure may have their names."""
NO_CASE = -1
"""Number of a row that is of no case of the design: an earlier one in the same folder had it."""
TEXTS = ("key", "status", "sentence", "host")
MISSING = "The table of a sweep is a Parquet file, which needs pyarrow.\n    Install it: pip install 'fairlead[sweep]'"


def arrow() -> Any:
    """The package pyarrow with its parquet. Raises UsageError where it is not installed."""
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        raise UsageError(MISSING) from None
    return pyarrow


@dataclass(frozen=True)
class Heading:
    """What a table is about."""

    name: str
    scene: str
    total: int
    parameters: tuple[str, ...]
    texts: tuple[str, ...]
    """Those among them whose values are words."""
    units: Mapping[str, str]
    """Of the figures."""
    design: Mapping[str, Any] = field(default_factory=dict)
    about: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    """Unit and description of parameters, where they are known."""

    def refuse(self) -> None:
        """Raise UsageError for two columns of one name."""
        names = [*OWN, *self.parameters, *self.units]
        if twice := sorted({name for name in names if names.count(name) > 1}):
            raise UsageError(
                f"Two columns would be called {listing(twice)}.\n    Name the figure otherwise: --figure NAME=..."
            )

    def plain(self) -> dict[str, Any]:
        """For the metadata."""
        return {"format": FORMAT, **vars(self)}


class SweepTable:
    """The rows of a sweep so far, in memory and in a folder."""

    def __init__(self, folder: Path, heading: Heading, *, force: bool = False) -> None:
        """Open the table in a folder, or begin it. Raises UsageError where another sweep has left one."""
        heading.refuse()
        self.folder, self.heading, self._arrow = folder, heading, arrow()
        self._schema, self._parts, self._rows = self._columns(), [], list[dict[str, Any]]()
        self._written, self._pause, self._whole = time.monotonic(), PERIOD, True
        if (folder / FILE).exists() and not force:
            self._parts.append(self._earlier())
        with _disk(folder):
            folder.mkdir(parents=True, exist_ok=True)

    def keys(self) -> set[str]:
        """Keys of all rows that are there, of whatever design."""
        return {key for part in self._parts for key in part["key"].to_pylist()}

    def number(self, cases: Iterable[tuple[int, str]]) -> None:
        """Give rows the numbers that their cases have in the design: (number, key) of those that are there.

        The same row stands once for each of its cases. A row that is of none of them stands once, as NO_CASE.
        """
        table = self._arrow.concat_tables(self._parts or [self._schema.empty_table()])
        first: dict[str, int] = {}
        for at, key in enumerate(table["key"].to_pylist()):
            first.setdefault(key, at)
        wanted = [(number, first[key]) for number, key in cases]
        used = {at for _, at in wanted}
        wanted += [(NO_CASE, at) for at in first.values() if at not in used]
        found = table.take(self._arrow.array([at for _, at in wanted], self._arrow.int64()))
        numbers = self._arrow.array([number for number, _ in wanted], self._arrow.int64())
        made = found.set_column(found.schema.get_field_index("case"), self._schema.field("case"), numbers)
        self._whole = self._whole and made.equals(table)
        self._parts = [made]

    def add(self, number: int, row: Row) -> None:
        """Take a row; it reaches the disk when it is time."""
        values = {name: column_of(value) for name, value in row.values.items()}
        texts = {name: str(row.values[name]) for name in self.heading.texts if name in row.values}
        figures = {name: float(row.figures[name]) if name in row.figures else None for name in self.heading.units}
        counters = {name: row.counters.get(name) for name in COUNTED}
        told = {"key": row.key, "case": number, "status": row.status, "sentence": row.sentence}
        cost = {"limits_broken": len(row.broken), "seconds": row.seconds, "loop": row.loop, "host": row.host}
        self._rows.append({**values, **texts, **figures, **counters, **told, **cost})
        self._whole = False
        if time.monotonic() - self._written > self._pause:
            self.write()

    def again(self, number: int, key: str) -> None:
        """The same row once more, under another number."""
        self._gather()
        for part in self._parts:
            found = part.filter(self._arrow.compute.equal(part["key"], key)).slice(0, 1)
            if found.num_rows:
                at = found.schema.get_field_index("case")
                self._parts.append(found.set_column(at, "case", self._arrow.array([number], self._arrow.int64())))
                self._whole = False
                return

    def write(self) -> None:
        """Replace the file by one with all rows. Raises FairleadError when the disk refuses."""
        if self._whole:
            return
        begun = time.monotonic()
        self._gather()
        table = self._arrow.concat_tables(self._parts or [self._schema.empty_table()])
        self._parts = [table.combine_chunks()]
        part = self.folder / PART
        with _disk(self.folder):
            try:
                self._arrow.parquet.write_table(self._parts[0], part)
                part.replace(self.folder / FILE)
            finally:
                part.unlink(missing_ok=True)
        self._written, self._whole = time.monotonic(), True
        self._pause = max(PERIOD, (self._written - begun) / SHARE)

    def frame(self) -> pandas.DataFrame:
        """The rows of the design, in its order."""
        self._gather()
        return of_design(self._arrow.concat_tables(self._parts or [self._schema.empty_table()]))

    @property
    def others(self) -> int:
        """How many rows are of other designs."""
        return sum(part["case"].to_pylist().count(NO_CASE) for part in self._parts)

    def _gather(self) -> None:
        if self._rows:
            self._parts.append(self._arrow.Table.from_pylist(self._rows, schema=self._schema))
            self._rows = []

    def _columns(self) -> Any:
        pa, heading = self._arrow, self.heading
        kinds = {name: pa.string() for name in (*TEXTS, *heading.texts)} | {"case": pa.int64()}
        kinds |= {name: pa.int64() for name in (*COUNTED, "limits_broken")}
        names = [
            "case",
            "key",
            *heading.parameters,
            "status",
            *heading.units,
            *COUNTED,
            "limits_broken",
            "sentence",
            *COST,
        ]
        told = json.dumps(heading.plain(), default=str).encode()
        return pa.schema([(name, kinds.get(name, pa.float64())) for name in names], metadata={b"fairlead": told})

    def _earlier(self) -> Any:
        """What is there already, if it is of this sweep."""
        table, heading = read(self.folder)
        way_out = "Choose another folder (--out, in Python out=), or replace it (--force, in Python force=True)."
        if heading["scene"] != self.heading.scene:
            what = "of another model, other figures, another budget or another version"
            raise UsageError(f"{self.folder / FILE} has cases {what}.\n    {way_out}")
        if table.schema.names != self._schema.names:
            had = listing([*heading["parameters"]])
            raise UsageError(f"{self.folder / FILE} has cases of other parameters: {had}.\n    {way_out}")
        try:
            return table.cast(self._schema).replace_schema_metadata(self._schema.metadata)
        except self._arrow.ArrowInvalid:
            words = listing([name for name in heading["texts"] if name not in self.heading.texts])
            what = f"has words for {words}, where this sweep has numbers"
            raise UsageError(f"{self.folder / FILE} {what}.\n    {way_out}") from None


def of_design(table: Any) -> pandas.DataFrame:
    """The rows of a table that are of its design, in the order of that."""
    frame = table.to_pandas()
    return frame[frame["case"] != NO_CASE].sort_values("case", kind="stable").reset_index(drop=True)


def read(place: Path) -> tuple[Any, dict[str, Any]]:
    """The table in a folder or file, and its heading. Raises UsageError, FairleadError.

    The file is opened once: a reader that opens it by name for its schema and again for its rows may find the rows of
    another table, since a running sweep replaces it.
    """
    pa = arrow()
    file = place / FILE if place.is_dir() else place
    if not file.exists():
        raise UsageError(
            f"{shown(str(place))} has no table of a sweep ({FILE}).\n    Make one: fairlead sweep MODEL --grid ..."
        )
    try:
        table = pa.parquet.read_table(pa.BufferReader(file.read_bytes()))
        heading = json.loads((table.schema.metadata or {})[b"fairlead"])
    except KeyError:
        raise UsageError(f"{file} is no table of a sweep of fairlead.") from None
    except (OSError, ValueError) as error:
        way_out = "Remove it, and sweep again."
        raise FairleadError(f"{file} cannot be read: {' '.join(str(error).split())[:200]}\n    {way_out}") from error
    if heading.get("format") != FORMAT:
        raise UsageError(f"{file} was written by another version of fairlead.")
    return table, heading


def is_sweep(place: Path) -> bool:
    """Whether a path is a sweep: a folder with its table, or the table."""
    return (place / FILE).is_file() or (place.is_file() and place.suffix == ".parquet")


class _disk:  # noqa: N801 - reads as a word in a with
    """Turn a refusal of the operating system into a sentence."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: Any, error: BaseException | None, trace: Any) -> None:
        if isinstance(error, OSError):
            reason = error.strerror or str(error)
            raise FairleadError(
                f"The table cannot be written to {self.folder}: {reason}.\n"
                "    Make room, and type the same again: it goes on with what was written before."
            ) from error


def texts_among(values: Mapping[str, Sequence[Value]]) -> tuple[str, ...]:
    """Names of parameters with a value that is no number."""
    return tuple(name for name, each in values.items() if any(isinstance(column_of(one), str | bool) for one in each))
