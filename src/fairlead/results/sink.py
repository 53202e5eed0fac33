"""What takes the signals and events of one run: a folder (recorder.py) or memory (in_memory.py).

    sink.append(t, values, side)     rows of signals, in order of time
    sink.events(rows)                zone changes
    sink.finish(status, summary)     no more follows
    sink.result()                    the `Result`, once it is finished

As a context manager a sink finishes by itself: with status `finished`, or `interrupted` or `failed` when an exception
passes through.
"""

from __future__ import annotations

import abc
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

import fairlead.results.run_file as run_file
from fairlead.errors import FairleadError, listing
from fairlead.results.events import Event
from fairlead.results.signal import Signal
from fairlead.results.trajectory import Result

Block = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.int8]]


class Sink(abc.ABC):
    """Checks what comes in, and keeps the record of the run; where rows and events go, its subclasses say."""

    def __init__(self, signals: Iterable[Signal], header: Mapping[str, Any]) -> None:
        """Take `signals`, none twice, and the `header` of the record. Raises FairleadError for twins."""
        self.signals = without_twins(signals)
        self._record: dict[str, Any] = {"status": run_file.RUNNING, **run_file.stamp(), **header}
        self._last_time = -np.inf
        self._open = True

    def append(self, t: ArrayLike, values: ArrayLike, side: ArrayLike) -> None:
        """Record rows: times `t` (k,) [s], `values` (k, m) in SI, `side` (k,).

        At an event the time occurs twice: with side -1 and the values on its left, then with side +1
        and those on its right. A row inside a step, on the curve through the rows of the step, has side 2, every
        other side 0. The arrays are copied.
        """
        rows = np.array(t, dtype="f8", ndmin=1)
        block = (
            rows,
            np.array(values, dtype="f8").reshape(len(rows), len(self.signals)),
            np.array(side, dtype="i1", ndmin=1),
        )
        self._check_order(*block)
        self._take(block)

    def event(self, t: float, component: str, zone_from: str, zone_to: str, guard: str) -> None:
        """Log one zone change: when, whose, from and to which zone, and the guard that fired."""
        self.events([Event(t, component, zone_from, zone_to, guard)])

    def finish(self, status: str, summary: Mapping[str, Any]) -> None:
        """Put `status` and `summary` into the record; nothing is taken any more."""
        if not self._open:
            raise FairleadError(f"{self._named()} is finished already.")
        self._open = False
        self._close(status, summary)

    @abc.abstractmethod
    def events(self, rows: Iterable[Sequence[Any]]) -> None:
        """Log zone changes: rows of (t [s], component, zone before, zone after, guard)."""

    @abc.abstractmethod
    def result(self) -> Result:
        """What was recorded, of a finished run."""

    @abc.abstractmethod
    def _take(self, block: Block) -> None:
        """Keep the rows of a checked block."""

    @abc.abstractmethod
    def _close(self, status: str, summary: Mapping[str, Any]) -> None:
        """Keep the record with how the run ended."""

    @abc.abstractmethod
    def _named(self) -> str:
        """What messages call the run."""

    def _ended(self, status: str, summary: Mapping[str, Any]) -> dict[str, Any]:
        return {**self._record, **summary, "status": status, "ended": run_file.now()}

    def __enter__(self) -> Self:
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

    def _check_order(self, t: NDArray[np.float64], values: Any, side: NDArray[np.int8]) -> None:
        """Refuse rows that run backwards: readers search the times by bisection."""
        if len(side) != len(t):
            raise FairleadError(f"{len(t)} times were recorded with {len(side)} sides; they must be as many.")
        backwards = np.flatnonzero(np.diff(t, prepend=self._last_time) < 0)
        if backwards.size or np.isnan(t).any():
            where = t[backwards[0]] if backwards.size else np.nan
            raise FairleadError(f"Recorded times must not run backwards: {where} s follows a later time.")
        self._last_time = t[-1] if len(t) else self._last_time


def without_twins(signals: Iterable[Signal]) -> tuple[Signal, ...]:
    """The signals. Raises FairleadError when two have one name."""
    signals = tuple(signals)
    counts = Counter(signal.name for signal in signals)
    twins = [name for name, count in counts.items() if count > 1]
    if twins:
        raise FairleadError(f"Signals are recorded under the same name: {listing(twins)}.")
    return signals
