"""The directory a run leaves behind, written as the run goes.

    run.json      what was run and how it went: `status` first, then header and summary
    series.nc     the recorded signals (see `store.py`)
    events.csv    one line for every zone change, in order
    *.png, report.html    when asked for (see `fairlead.report`)

`status` is `running` from the start; the end of the run replaces it by `finished`, `interrupted`
(Ctrl-C), `budget` (a budget was used up) or `failed`. A directory whose status is still `running`
although its process is gone was killed.

Signals and events reach the disk at most every `FLUSH_PERIOD` of wall time and at the end, so a
killed run loses no more than that. Flushing never takes more than a small share of the time.
"""

from __future__ import annotations

import time as clock
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from types import TracebackType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

import fairlead.results.claim as claim
import fairlead.results.run_file as run_file
from fairlead.errors import FairleadError, listing
from fairlead.results.events import EVENT_FILE, Event, EventWriter
from fairlead.results.signal import Signal
from fairlead.results.store import SERIES_FILE, SeriesWriter

FLUSH_PERIOD = 0.5
LARGEST_SHARE_OF_FLUSHING = 0.05
MOST_BYTES_IN_MEMORY = 2**24

Block = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int8]]


class RunDirectory:
    """Takes the signals and events of one run and writes them; `create` it, `finish` it.

    As a context manager it finishes by itself: with status `finished`, or `interrupted` or `failed`
    when an exception passes through.
    """

    def __init__(self, path: Path, signals: tuple[Signal, ...], header: Mapping[str, Any]) -> None:
        self.path = path
        self.signals = signals
        self._record = {"status": run_file.RUNNING, **run_file.stamp(), **header}
        self._blocks: list[Block] = []
        self._bytes = 0
        self._flushed = clock.monotonic()
        self._pause = FLUSH_PERIOD
        self._last_time = -np.inf
        self._open = True
        with _disk(path):
            run_file.write(path, self._record)
            self._series = SeriesWriter(path / SERIES_FILE, signals)
            self._events = EventWriter(path / EVENT_FILE)

    @classmethod
    def create(
        cls, path: str | Path, signals: Iterable[Signal], header: Mapping[str, Any], force: bool = False
    ) -> RunDirectory:
        """Make the directory `path` ready for a new run and return its writer.

        A killed or failed run is replaced. A run with results to keep (finished, interrupted, out
        of budget), a run that is still going on and a folder of something else are not: UsageError,
        unless `force`. Only files that a run writes are ever removed, and results that are replaced
        only when the new run has finished; until then they are in the folder `earlier`.
        """
        path, signals = Path(path), tuple(signals)
        _refuse_twins(signals)
        with _disk(path):
            claim.claim(path, force)
        return cls(path, signals, header)

    def append(self, t: ArrayLike, values: ArrayLike, side: ArrayLike) -> None:
        """Record rows: times `t` (k,) [s], `values` (k, m) in SI, `side` (k,).

        At an event the time occurs twice: with side -1 and the values on its left, then with side +1
        and those on its right. Everywhere else side is 0. The arrays are copied.
        """
        rows = np.array(t, dtype="f8", ndmin=1)
        block = (
            rows,
            np.array(values, dtype="f8").reshape(len(rows), len(self.signals)),
            np.array(side, dtype="i1", ndmin=1),
        )
        self._check_order(*block)
        self._blocks.append(block)
        self._bytes += block[1].nbytes
        self.flush(at_once=self._bytes > MOST_BYTES_IN_MEMORY)

    def event(self, t: float, component: str, zone_from: str, zone_to: str, guard: str) -> None:
        """Log one zone change: when, whose, from and to which zone, and the guard that fired."""
        self.events([Event(t, component, zone_from, zone_to, guard)])

    def events(self, rows: Iterable[Sequence[Any]]) -> None:
        """Log zone changes: rows of (t [s], component, zone before, zone after, guard)."""
        self._events.append(Event(*row) for row in rows)
        self.flush()

    def flush(self, at_once: bool = False) -> None:
        """Bring what was recorded to the disk if it is time to; `at_once`: in any case.

        Costs nothing when it is not time yet, so it may be called often.
        """
        start = clock.monotonic()
        if not at_once and start - self._flushed < self._pause:
            return
        with _disk(self.path):
            self._write_blocks()
            self._events.flush()
        self._flushed = clock.monotonic()
        self._pause = max(FLUSH_PERIOD, (self._flushed - start) / LARGEST_SHARE_OF_FLUSHING)

    def finish(self, status: str, summary: Mapping[str, Any]) -> None:
        """Write what is left, close the files and put `status` and `summary` into run.json."""
        if not self._open:
            raise FairleadError(f"The run in {self.path} is finished already.")
        self._open = False
        with _disk(self.path):
            try:
                self._write_blocks(last=True)
            except BaseException:
                status = "failed"  # Rows are missing.
                raise
            finally:
                end = {"status": status, "ended": run_file.now()}
                run_file.write(self.path, {**self._record, **summary, **end})
                self._events.close()
                self._series.close()
            if status == claim.FINISHED:
                claim.drop_earlier(self.path)

    def __enter__(self) -> RunDirectory:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if not self._open:
            return
        if error is None:
            self.finish("finished", {})
        else:
            status = "interrupted" if isinstance(error, KeyboardInterrupt) else "failed"
            with suppress(FairleadError):  # A full disk must not hide the error that came first.
                self.finish(status, {"error": str(error)})

    def _write_blocks(self, last: bool = False) -> None:
        if not self._blocks:
            return
        t, values, side = (np.concatenate(parts) for parts in zip(*self._blocks, strict=True))
        self._series.write(t, values, side, last)
        self._blocks, self._bytes = [], 0

    def _check_order(self, t: NDArray[np.float64], values: Any, side: NDArray[np.int8]) -> None:
        """Refuse rows that run backwards: readers search the times by bisection."""
        if len(side) != len(t):
            raise FairleadError(f"{len(t)} times were recorded with {len(side)} sides; they must be as many.")
        backwards = np.flatnonzero(np.diff(t, prepend=self._last_time) < 0)
        if backwards.size or np.isnan(t).any():
            where = t[backwards[0]] if backwards.size else np.nan
            raise FairleadError(f"Recorded times must not run backwards: {where} s follows a later time.")
        self._last_time = t[-1] if len(t) else self._last_time


def _refuse_twins(signals: tuple[Signal, ...]) -> None:
    counts = Counter(signal.name for signal in signals)
    twins = [name for name, count in counts.items() if count > 1]
    if twins:
        raise FairleadError(f"Signals are recorded under the same name: {listing(twins)}.")


@contextmanager
def _disk(path: Path) -> Iterator[None]:
    """Turn a refusal of the operating system into a message that names the directory."""
    try:
        yield
    except (OSError, RuntimeError) as error:  # h5py raises either.
        reason = getattr(error, "strerror", None) or str(error)
        raise FairleadError(
            f"Results cannot be written to {path}: {reason}.\n"
            "    Make room or choose another directory with --out; what was written before is kept."
        ) from error
