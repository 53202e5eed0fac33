"""What a run computed, as its reader sees it: signals by name, events, and run.json.

How it is used:

    result = Result.open("runs/belt")
    result["block.v"]                  numpy array (n,), in the unit result.unit("block.v")
    result.t                           numpy array (n,), [s]; an event's time occurs twice
    result.match("line.*.tension")     names
    result.at("block.v", 0.25)         a value between the recorded rows, never across an event
    result.events                      zone changes
    result.run                         run.json as a dict
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

import fairlead.results.run_file as run_file
from fairlead.arguments import keywords_told
from fairlead.errors import FairleadError, UsageError, shown
from fairlead.results.asked import refuse_no_file, times_of
from fairlead.results.curves import Curves
from fairlead.results.damage import DamagedResultsError
from fairlead.results.events import EVENT_FILE, Event, read_events
from fairlead.results.kept import earlier
from fairlead.results.kept_lists import Events, RunRecord, Signals
from fairlead.results.named import Names
from fairlead.results.plateau import first_row
from fairlead.results.retrieve import SeriesReader
from fairlead.results.seal import require_intact
from fairlead.results.series import Series
from fairlead.results.store import SERIES_FILE

if TYPE_CHECKING:
    import pandas
    import xarray

    from fairlead.results.export import Side
    from fairlead.results.table import Table

T = TypeVar("T")


class Extremes(NamedTuple):
    """The lowest and the highest value of a signal, in its unit, and when [s]."""

    lowest: float
    t_lowest: float
    highest: float
    t_highest: float


class Result:
    """One run directory, read lazily: a signal is read when it is first asked for.

    `path` is the directory; None for a run that stayed in memory (`run(out=None)`).

    A run that has taken the place of this one in the directory is never read instead: UsageError. Files that are
    damaged are told by name: DamagedResultsError; what else there is can still be read.
    """

    def __init__(
        self, path: Path | None, run: Mapping[str, Any], series: Series, events: list[Event] | None = None
    ) -> None:  # fmt: skip
        """Take a run and its rows; `events` are its zone changes where they are not in the directory."""
        self.path = path
        self.run: dict[str, Any] = RunRecord(run)
        self._series = series
        self._given_events = events
        self._names = Names({signal.name: signal for signal in series.signals}, self._place)
        self._cache: dict[str, NDArray[np.float64]] = {}
        self._own = None if path is None else run_file.Watched(path, run)

    @classmethod
    def open(cls, path: str | os.PathLike[str]) -> Self:
        """Open the run directory `path`, of a finished, running, failed or killed run.

        Raises UsageError when there is no such directory or no series in it, DamagedResultsError when one of the
        two cannot be read.
        """
        if not isinstance(path, str | os.PathLike) or b"\0" in os.fsencode(path):
            raise UsageError(f"Result.open: path = {shown(path)} is not a path.\n    {run_file.GIVE}")
        path = Path(path)
        run, status = run_file.load_as_it_is(path)
        if run["status"] == run_file.CLAIMED or not (path / SERIES_FILE).exists():
            run_file.refuse_another(path, run)
            raise UsageError(_unreadable(path, status))
        try:
            require_intact(path / SERIES_FILE, run)
            series = SeriesReader(path / SERIES_FILE)
        except DamagedResultsError:
            run_file.refuse_another(path, run)
            raise
        result = cls(path, {**run, "status": status}, series)
        result._refuse_another()
        return result

    @cached_property
    def signals(self) -> Signals:
        """All recorded signals, in the order of recording."""
        return Signals(self._series.signals)

    @cached_property
    def t(self) -> NDArray[np.float64]:
        """Recorded times (n,) [s]; never decreasing, an event's time occurs twice."""
        return self._mine(self._series.time)

    @cached_property
    def side(self) -> NDArray[np.int8]:
        """Return -1 in rows on the left of an event, +1 on its right, 2 inside a step, 0 elsewhere (n,)."""
        return self._mine(self._series.side)

    @cached_property
    def _curves(self) -> Curves:
        switches = None
        if self.run.get("record_every"):
            switches = np.array([event.t for event in self.events], dtype="f8")
        return Curves(self.t, self.side, switches)

    @cached_property
    def _extremes(self) -> Mapping[str, tuple[float, float, float, float]]:
        from fairlead.results.run_schema import extremes

        return extremes(self.named(run_file.RUN_FILE), self.run)

    @keywords_told
    def extremes(self, name: str) -> Extremes:
        """Lowest and highest value of the signal `name`, and when: (lowest, t_lowest, highest, t_highest), in SI and s.

        They come from the dense output of every step, whatever was recorded; of a run that was killed, from its rows.
        A time is the first at which the signal is at the extreme but for 1e-9 of its range: rounding decides nothing.
        """
        self._names.one(name)
        if name in self._extremes:
            return Extremes(*self._extremes[name])
        values = self[name]
        if not np.isfinite(values).any():
            return Extremes(np.nan, np.nan, np.nan, np.nan)
        t_low, t_high = (float(self.t[first_row(values, least=least)]) for least in (True, False))
        return Extremes(float(np.nanmin(values)), t_low, float(np.nanmax(values)), t_high)

    @cached_property
    def events(self) -> Events:
        """Zone changes in order: (t, component, zone_from, zone_to, guard)."""
        return Events(self._mine(self._read_events))

    def _read_events(self) -> list[Event]:
        if self._given_events is not None:
            return self._given_events
        require_intact(self.folder / EVENT_FILE, self.run)
        return read_events(self.folder / EVENT_FILE)

    @property
    def folder(self) -> Path:
        """The directory of the run. Raises UsageError for a run that stayed in memory, or has been replaced there."""
        if self.path is None:
            what = f"The run of {self.run.get('name', 'this model')} stayed in memory, so it has no folder."
            raise UsageError(f"{what}\n    Run it without out=None, or with out=FOLDER, to have files of it.")
        self._refuse_another()
        return self.path

    def named(self, file: str) -> Path:
        """What messages call a file of the run, also of one that stayed in memory."""
        return Path(self._place) / file

    @property
    def _place(self) -> str:
        return "memory" if self.path is None else str(self.path)

    @property
    def status(self) -> str:
        """How the run ended: finished, interrupted, budget, failed, killed; or running."""
        return str(self.run["status"])

    @property
    def ok(self) -> bool:
        """True if the run reached its stop."""
        return self.status == "finished"

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        return self._columns([self._names.one(name).name])[:, 0]

    def __contains__(self, name: object) -> bool:
        return name in self._names.signals

    def __len__(self) -> int:
        return len(self._names.signals)

    def __iter__(self) -> Iterator[str]:
        return iter(self._names.signals)

    def unit(self, name: str) -> str:
        """Return the SI unit of the signal `name`. Raises UnknownSignalError."""
        return self._names.one(name).unit

    @keywords_told
    def match(self, pattern: str) -> list[str]:
        """Return the recorded names that fit a pattern such as `line.*.tension` (see `signal.matching`)."""
        return self._names.match(pattern)

    @keywords_told
    def at(self, name: str, t: ArrayLike, side: Side = "right") -> Any:
        """Return the value of the signal `name` at the times `t` [s] (a number, a text with its unit, or an array).

        Between two recorded rows the value is that of the dense output of the step, within the accuracy of the run,
        where every step was recorded. On a grid (`record.every`) it is that of a cubic through four rows, where nothing
        switches between them, or of a straight line (`results/curves.py`). Nothing goes across an event: the
        rows on both sides of it have the same time. At an event itself `side` chooses the value
        before it (`left`), after it (`right`) or both, as a last axis of length 2.

        What changes and changes back within a step is not seen, as friction over a small range of speeds that a heavy
        body passes at once; nor is a curved signal within the accuracy that no unknown feels, as the force of a drag on
        a given motion while something else moves too: give `run.max_step`.

        Raises FairleadError for a time that the run did not reach.
        """
        values = self[name]
        times = times_of(t)
        if not len(self.t) or not np.all((times >= self.t[0]) & (times <= self.t[-1])):
            reached = f"from {self.t[0]:g} s to {self.t[-1]:g} s" if len(self.t) else "at no time"
            raise FairleadError(f"{name} was recorded {reached}; there is no value at t = {times} s.")
        if side == "both":
            return np.stack([self._curves.before(values, times), self._curves.after(values, times)], axis=-1)
        if side not in ("left", "right"):
            raise FairleadError(f"side = {side!r} is none of left, right, both.")
        found = self._curves.before(values, times) if side == "left" else self._curves.after(values, times)
        return found if found.ndim else float(found)

    def events_table(self) -> pandas.DataFrame:
        """Return the zone changes as a table with columns t, component, zone_from, zone_to, guard."""
        import pandas

        return pandas.DataFrame(self.events, columns=list(Event._fields))

    @keywords_told
    def to_xarray(self, names: str | Iterable[str] | None = None, side: Side = "both") -> xarray.Dataset:
        """Return the signals (all, or those of `names` or patterns) as a dataset along `time`, with units.

        The time of an event occurs twice, and `side` tells the rows apart. With `side="right"` (or `"left"`) every
        time occurs once, with the values after (before) the event, as `interp`, `reindex` and `sel(method="nearest")`
        want it. Raises UnknownSignalError, UsageError.
        """
        from fairlead.results.export import to_xarray

        return to_xarray(self, self._names.chosen(names), side)

    @keywords_told
    def to_pandas(self, names: str | Iterable[str] | None = None, side: Side = "both") -> pandas.DataFrame:
        """Return the signals (all, or those of `names` or patterns) as columns over time [s]; units are in `.attrs`.

        `side` as in `to_xarray`. Raises UnknownSignalError, UsageError.
        """
        from fairlead.results.export import to_pandas

        return to_pandas(self, self._names.chosen(names), side)

    @keywords_told
    def to_excel(self, path: str | Path, names: str | Iterable[str] | None = None, side: Side = "both") -> None:
        """Write a workbook `path` with sheets for signals, zone changes and the run; wants the extra `fairlead[excel]`.

        `names` or patterns choose signals; all of them are written when left out.
        `side` as in `to_xarray`. Raises UsageError when openpyxl is missing or a sheet is too small.
        """
        from fairlead.results.excel import to_excel

        refuse_no_file("to_excel", path, names)
        self._refuse_another()
        to_excel(self, path, self._names.chosen(names), side)

    @keywords_told
    def elements(self, pattern: str, side: Side = "both") -> xarray.DataArray:
        """Return the elements of a line (`line.hose[*].tension`) as one array by `time` and `element`.

        Of a line on a route it has the coordinates `along` [m], the place along the line without load, and, where the
        positions of the line were recorded, `place` [m] on the route. `side` as in `to_xarray`. Raises UsageError for
        a pattern of several families, UnknownSignalError.
        """
        from fairlead.results.elements import elements

        return elements(self, pattern, side)

    def families(self) -> Table:
        """Return a table of what `elements` can give: family, unit, how many, the first and the last number."""
        from fairlead.results.elements import families

        return families(self)

    def run_table(self) -> Table:
        """Return the entries of run.json as a table, long ones by kind and size."""
        return RunRecord(self.run).table()

    @keywords_told
    def to_csv(self, path: str | Path, names: str | Iterable[str] | None = None) -> None:
        """Write signals (all, or those of `names` or patterns) to the file `path`, with units and every digit.

        In the run directory a link of that name is replaced, and what it points to stays as it is.
        """
        from fairlead.results.export import to_csv
        from fairlead.results.placing import placing

        refuse_no_file("to_csv", path, names)
        if self.path is None or Path(path).parent.resolve() != self.path.resolve():
            to_csv(self, path, self._names.chosen(names))
            return
        self._refuse_another()
        with placing(Path(path)) as part:
            to_csv(self, part, self._names.chosen(names))

    @keywords_told
    def columns(self, names: str | Iterable[str] | None = None) -> NDArray[np.float64]:
        """Return several signals (all, or those of `names` or patterns) side by side, shape (rows, signals), in SI."""
        return self._columns(self._names.chosen(names))

    def _columns(self, names: list[str]) -> NDArray[np.float64]:
        missing = list(dict.fromkeys(self._names.one(name).name for name in names if name not in self._cache))
        if missing:
            values = np.asfortranarray(self._mine(lambda: self._series.values(missing)))
            values.flags.writeable = False  # The cache is handed out; a caller must not change it.
            self._cache.update(zip(missing, values.T, strict=True))
        if len(names) == 1:
            return self._cache[names[0]][:, None]
        if not names:
            return np.empty((len(self.t), 0))
        return np.stack([self._cache[name] for name in names], axis=1)

    def _mine(self, read: Callable[[], T]) -> T:
        """Return what `read` gives, if it is of this run: its run.json is replaced before its other files are."""
        try:
            found = read()
        except DamagedResultsError:
            self._refuse_another()
            raise
        self._refuse_another()
        return found

    def _refuse_another(self) -> None:
        if self._own is not None:
            self._own.check()

    def chosen(self, names: str | Iterable[str] | None) -> list[str]:
        """The names of signals: all, one or several, each a name or a pattern. Raises UnknownSignalError."""
        return self._names.chosen(names)

    def __repr__(self) -> str:
        """Never raises: a prompt shows it also when the files are gone, and says so."""
        named = f"{self._place!r}: {shown(self.run.get('name', 'run'))}, {self.status}"
        return f"Result({named}, {self._reach()}, {len(self.signals)} signals, zone changes: {self._changes()})"

    def _reach(self) -> str:
        try:
            return f"t = {self.t[0]:g} ... {self.t[-1]:g} s" if len(self.t) else "no rows"
        except FairleadError as error:
            return _first_sentence(error)

    def _changes(self) -> str:
        try:
            return str(len(self.events))
        except FairleadError:
            return "not to be read"

    def _repr_html_(self) -> str:
        from fairlead.results.notebook import as_html

        facts = [
            ("status", self.status),
            ("directory", self._place),
            ("recorded", self._reach()),
            ("zone changes", self._changes()),
        ]
        return as_html(str(self.run.get("name", "run")), facts, self.signals)


def _first_sentence(error: FairleadError) -> str:
    return str(error).splitlines()[0].rstrip(".")


def _unreadable(path: Path, status: str) -> str:
    """Why a run has no series, in words."""
    kept = earlier(path)
    way_out = f"The results that it was to replace are in {kept}." if kept else "Run it again."
    if status == run_file.RUNNING:
        return f"The run in {path} has not written a row yet.\n    Wait some seconds; rows come every half second."
    if status != run_file.KILLED:
        return f"The run in {path} ({status}) has no {SERIES_FILE} any more.\n    {way_out}"
    return (
        f"The run in {path} was {status} before its first rows were written, in its first seconds; there is nothing "
        f"to read.\n    {way_out}"
    )
