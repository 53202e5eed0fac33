"""The directory a run leaves behind, written as the run goes.

    run.json      what was run and how it went: `status` first, then header and summary
    series.nc     the recorded signals (see `store.py`)
    events.csv    one line for every zone change, in order
    *.png, report.html    when asked for (see `fairlead.report`)

`status` is `running` from the start; the end of the run replaces it by `finished`, `interrupted`
(Ctrl-C), `budget` (a budget was used up) or `failed`. A directory whose status is still `running`
although its process is gone was killed (see `lock.py`).

Signals and events reach the disk at most every `FLUSH_PERIOD` of wall time and at the end, so a
killed run loses no more than that, or its first `FIRST_FLUSH`. Flushing never takes more than a small share
of the time.
"""

from __future__ import annotations

import os
import time as clock
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import fairlead.results.run_file as run_file
from fairlead.errors import FairleadError
from fairlead.results.claim import FINISHED, Claim
from fairlead.results.events import EVENT_FILE, Event, EventWriter
from fairlead.results.retrieve import SeriesReader
from fairlead.results.seal import sealed
from fairlead.results.signal import Signal
from fairlead.results.sink import Block, Sink, without_twins
from fairlead.results.store import SERIES_FILE, SeriesWriter
from fairlead.results.trajectory import Result
from fairlead.results.waiting import Waiting

FLUSH_PERIOD = 0.5
FIRST_FLUSH = 2.0
"""Wall seconds until the file is laid out: for 500 signals that takes a fifth of a second, and a run that is shorter
lays it out once, at its end."""
LARGEST_SHARE_OF_FLUSHING = 0.05


class RunDirectory(Sink):
    """Takes the signals and events of one run and writes them; `create` it, `finish` it."""

    def __init__(self, claimed: Claim, signals: tuple[Signal, ...], header: Mapping[str, Any]) -> None:
        super().__init__(signals, header)
        self.path = claimed.path
        self._claim = claimed
        self._record["locked"] = claimed.locked
        self._own = run_file.Watched(self.path, self._record)
        self._flushed = clock.monotonic()
        self._pause = FIRST_FLUSH
        self._result: Result | None = None
        run_file.write(self.path, {**self._record, "status": run_file.CLAIMED})
        claimed.clear()
        self._waiting = Waiting(self.path)
        self._series = SeriesWriter(self.path / SERIES_FILE, signals)
        self._events = EventWriter(self.path / EVENT_FILE)
        run_file.write(self.path, self._record)

    @classmethod
    def create(
        cls, path: str | Path, signals: Iterable[Signal], header: Mapping[str, Any], force: bool = False
    ) -> RunDirectory:
        """Make the directory `path` ready for a new run and return its writer.

        A killed or failed run is replaced. A run with results to keep (finished, interrupted, out
        of budget) and a folder of something else are not: UsageError, unless `force`. A run that is
        still going on never is. Only files that a run writes are ever removed, and results that are
        replaced only when the new run has finished; until then they are in the folder `earlier`.
        """
        path, signals = Path(path), without_twins(signals)
        with _disk(path):
            claimed = Claim.take(path, force)
            try:
                return cls(claimed, signals, header)
            except BaseException:
                claimed.release(finished=False)
                raise

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
            self._own.check()
            self._write_blocks()
            self._events.flush()
        self._flushed = clock.monotonic()
        self._pause = max(FLUSH_PERIOD, (self._flushed - start) / LARGEST_SHARE_OF_FLUSHING)

    def result(self) -> Result:
        """What was recorded, of a run that is finished; also when another run has taken the directory since.

        Raises FairleadError while the run goes on. Signals are read from the directory when they are asked for; those
        of another run never are.
        """
        if self._result is None:
            raise FairleadError(f"{self._named()} has not finished.")
        return self._result

    def _take(self, block: Block) -> None:
        self._waiting.add(block)
        full = self._waiting.memory_is_full
        self.flush(at_once=full and self._series.is_laid_out)
        if full and not self._series.is_laid_out:
            with _disk(self.path):
                self._waiting.set_aside()

    def _named(self) -> str:
        return f"The run in {self.path}"

    def _close(self, status: str, summary: Mapping[str, Any]) -> None:
        """Write what is left, close the files and put `status` and `summary` into run.json.

        Raises FairleadError when the disk refuses, or when another run has taken the directory.
        """
        try:
            with _disk(self.path):
                self._own.check()
                run = self._write_all(status, summary)
                series = SeriesReader.of_written(self.path / SERIES_FILE, self.signals, self._series.rows)
                self._result = Result(self.path, run, series)
                self._claim.release(finished=status == FINISHED)
        finally:
            self._claim.release(finished=False)

    def _write_all(self, status: str, summary: Mapping[str, Any]) -> dict[str, Any]:
        """Rows and events first: a run.json that says `finished` has all of them beside it, as it says. Gives that."""
        left: dict[str, Any] = {}
        try:
            self._write_blocks(last=True)
            self._events.close()
            self._series.close()
            left = sealed(self.path / SERIES_FILE, self.path / EVENT_FILE)
        except BaseException:
            status = "failed"  # Rows are missing.
            raise
        finally:
            written = run_file.write(self.path, self._ended(status, {**summary, **left}))
            self._events.close()
            self._series.close()
        return written

    def _write_blocks(self, last: bool = False) -> None:
        for t, values, side in self._waiting.give_back():
            self._series.write(t, values, side, self._waiting.rows - len(t), last)


@contextmanager
def _disk(path: Path) -> Iterator[None]:
    """Turn a refusal of the operating system into a message that names the directory."""
    try:
        yield
    except (OSError, RuntimeError) as error:  # h5py raises either.
        reason = getattr(error, "strerror", None) or str(error)
        named = getattr(error, "filename", None)
        if isinstance(named, str | os.PathLike) and Path(named).name != path.name:
            reason = f"{reason} ({Path(named).name})"
        raise FairleadError(
            f"Results cannot be written to {path}: {reason}.\n"
            "    Make room or choose another directory (--out, in Python out=); what was written before is kept."
        ) from error
