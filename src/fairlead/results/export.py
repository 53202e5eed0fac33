"""A result in the forms of other tools: xarray, pandas, CSV."""

from __future__ import annotations

import csv
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Protocol, get_args

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import UsageError, shown
from fairlead.results.kept_lists import Events
from fairlead.results.layout import SIDE, SIDE_SIGNAL, TIME
from fairlead.results.signal import Signal
from fairlead.results.table import Table

if TYPE_CHECKING:
    import pandas
    import xarray

Side = Literal["left", "right", "both"]
SIDES = get_args(Side)


class Record(Protocol):
    """What an export needs of a result."""

    run: dict[str, Any]

    @property
    def signals(self) -> tuple[Signal, ...]:
        """All signals, in order."""

    @property
    def t(self) -> NDArray[np.float64]:
        """Times (n,) [s]."""

    @property
    def side(self) -> NDArray[np.int8]:
        """Side of an event (n,)."""

    def columns(self, names: Iterable[str] | None = None) -> NDArray[np.float64]:
        """Return signals side by side (n, m)."""

    @property
    def events(self) -> Events:
        """Zone changes in order."""

    def unit(self, name: str) -> str:
        """Return the unit of a signal."""

    def chosen(self, names: str | Iterable[str] | None) -> list[str]:
        """Return the names of signals that names or patterns pick."""

    def named(self, file: str) -> Path:
        """Return what messages call a file of the run."""

    def run_table(self) -> Table:
        """Return the entries of run.json."""

    def __contains__(self, name: object) -> bool:
        """Tell whether a signal was recorded."""


def rows_of(result: Record, side: Side) -> NDArray[np.int64]:
    """The numbers of the rows that an export has: all (`both`), or of several at one time the first or the last.

    Raises UsageError for another word.
    """
    if side not in SIDES:
        raise UsageError(f"side = {shown(side)} is none of {', '.join(SIDES)}.")
    new = np.diff(result.t) > 0.0
    if side == "both" or not len(result.t):
        return np.arange(len(result.t))
    return np.flatnonzero(np.append(new, True) if side == "right" else np.append(True, new))


def to_xarray(result: Record, names: Iterable[str] | None = None, side: Side = "both") -> xarray.Dataset:
    """Return signals along the coordinate `time`, one variable each, with `units` and `long_name`.

    Time repeats at an event; `side` tells the two rows apart. With `left` or `right` every time occurs once, with the
    values before or after the event, as `interp`, `reindex` and `sel(method="nearest")` want it.
    """
    import xarray

    chosen, rows = _chosen(result, names), rows_of(result, side)
    about = {signal.name: signal for signal in result.signals}
    variables = {
        name: (TIME, values, {"units": about[name].unit, "long_name": about[name].description or name})
        for name, values in zip(chosen, result.columns(chosen)[rows].T, strict=True)
    }
    coordinates = {
        TIME: (TIME, result.t[rows], {"units": "s", "long_name": "time"}),
        SIDE: (TIME, result.side[rows], {"long_name": SIDE_SIGNAL.description}),
    }
    simple = {key: value for key, value in result.run.items() if isinstance(value, str | int | float)}
    # NetCDF has no attribute that is true or false
    plain = {key: str(value).lower() if isinstance(value, bool) else value for key, value in simple.items()}
    return xarray.Dataset(variables, coordinates, attrs=plain)


def to_pandas(result: Record, names: Iterable[str] | None = None, side: Side = "both") -> pandas.DataFrame:
    """Return signals as columns, indexed by time [s]; `frame.attrs["units"]` maps names to units.

    With `side` left or right every time occurs once, with the values before or after an event.
    """
    import pandas

    chosen, rows = _chosen(result, names), rows_of(result, side)
    index = pandas.Index(result.t[rows], name="time [s]")
    frame = pandas.DataFrame(result.columns(chosen)[rows], index=index, columns=chosen)
    frame.attrs["units"] = {name: result.unit(name) for name in chosen}
    return frame


def to_csv(result: Record, path: str | Path, names: Iterable[str] | None = None) -> None:
    """Write `time [s]`, `side` and one column per signal, its unit in brackets in the header.

    Numbers are written with as many digits as it takes to read the same number back.
    """
    chosen = _chosen(result, names)
    header = ["time [s]", SIDE, *(f"{name} [{result.unit(name)}]" for name in chosen)]
    with Path(path).open("w", encoding="utf-8", newline="") as file:
        table = csv.writer(file)
        table.writerow(header)
        rows = zip(result.t.tolist(), result.side.tolist(), result.columns(chosen).tolist(), strict=True)
        table.writerows((t, side, *values) for t, side, values in rows)


def _chosen(result: Record, names: Iterable[str] | None) -> list[str]:
    return [signal.name for signal in result.signals] if names is None else list(names)
