"""A run that touches no disk: its rows, events and record stay in memory."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import fairlead.results.run_file as run_file
from fairlead.errors import FairleadError
from fairlead.results.events import Event
from fairlead.results.signal import Signal
from fairlead.results.sink import Block, Sink
from fairlead.results.trajectory import Result


class MemorySeries:
    """Recorded signals in memory, as `retrieve.SeriesReader` gives those of a file."""

    def __init__(self, signals: tuple[Signal, ...], blocks: Sequence[Block]) -> None:
        """Join `blocks` of (t (k,), values (k, m), side (k,))."""
        nothing = (np.empty(0), np.empty((0, len(signals))), np.empty(0, "i1"))
        self.signals = signals
        self._t, self._values, self._side = (np.concatenate(parts) for parts in zip(nothing, *blocks, strict=True))
        self._position = {signal.name: index for index, signal in enumerate(signals)}

    def time(self) -> NDArray[np.float64]:
        """The recorded times (n,) [s]."""
        return self._t

    def side(self) -> NDArray[np.int8]:
        """Return -1 left of an event, +1 right of it, 2 inside a step, 0 elsewhere (n,)."""
        return self._side

    def values(self, names: list[str]) -> NDArray[np.float64]:
        """The values (n, len(names)) of recorded signals."""
        return self._values[:, [self._position[name] for name in names]]


class MemoryRun(Sink):
    """Keeps the signals and events of one run."""

    def __init__(self, signals: Iterable[Signal], header: Mapping[str, Any]) -> None:
        """Take `signals`, none twice, and the `header` of the record. Raises FairleadError for twins."""
        super().__init__(signals, header)
        self._blocks: list[Block] = []
        self._events: list[Event] = []

    def events(self, rows: Iterable[Sequence[Any]]) -> None:
        """Keep zone changes: rows of (t [s], component, zone before, zone after, guard)."""
        self._events += [Event(*row) for row in rows]

    def result(self) -> Result:
        """What was recorded. Raises FairleadError while the run goes on."""
        if self._open:
            raise FairleadError(f"{self._named()} has not finished.")
        series = MemorySeries(self.signals, self._blocks)
        return Result(None, run_file.as_read(self._record), series, self._events)

    def _take(self, block: Block) -> None:
        self._blocks.append(block)

    def _close(self, status: str, summary: Mapping[str, Any]) -> None:
        self._record = self._ended(status, summary)

    def _named(self) -> str:
        return "The run in memory"
