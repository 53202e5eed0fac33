"""Results that will be large are told before the run, where a grid says how many rows there are, or soon in it."""

from __future__ import annotations

import pathlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from fairlead.cli.terminal import echo

if TYPE_CHECKING:
    from fairlead import Model

EARLY = 0.05
"""Share of what is too large from which on it is told how large the whole will be."""
FORESEEN = 0.1
"""Share of the run from which on its rate tells of the rest: a start may chatter."""
APART = 1e-3
"""Share of the run between two looks that are remembered."""
MUCH = 10.0
"""Of what is too large: it is told at any time."""
NUMBER = 8
"""Bytes of a number in the results."""


class Growing:
    """Called with (fraction done, time, None) as progress is, which it passes on; tells once of what will be large."""

    def __init__(self, model: Model, folder: pathlib.Path, large: float, progress: Callable[..., None] | None) -> None:
        """`large` is in bytes."""
        self.model, self.folder, self.large, self.progress = model, folder, large, progress
        self.told = False
        self.seen: list[tuple[float, int]] = []

    def before(self) -> None:
        """Tell of it before the run, where `record.every` gives the rows."""
        from fairlead.running import chosen_signals

        every = self.model.netlist.record.every
        if every is None:
            return
        run = self.model.netlist.run
        rows, signals = (run.stop - run.start) / every, len(chosen_signals(self.model.netlist, self.model.system))
        size = NUMBER * rows * (signals + 1)
        if size > self.large:
            less = f"Record fewer signals (record.signals) or less often (record.every is {every:g} s)."
            self._tell(size, f" ({rows:.0f} rows of {signals} signals, and those of jumps)", less)

    def __call__(self, fraction: float, time: float, counters: Any) -> None:
        """Look at what is written by now."""
        if self.progress is not None:
            self.progress(fraction, time, counters)
        if self.told or not 0 < fraction < 1:
            return
        from fairlead.results.store import SERIES_FILE, TEMPORARY

        files = (self.folder / name for name in (SERIES_FILE, TEMPORARY))
        size = max((file.stat().st_size for file in files if file.exists()), default=0)
        if not self.seen or fraction - self.seen[-1][0] > APART:
            self.seen.append((fraction, size))
        whole = self._whole(fraction, size)
        if whole > self.large and size > EARLY * self.large:
            every = self.model.netlist.record.every
            less = "Give record.every a time" if every is None else f"Record less often (record.every is {every:g} s)"
            now = f" at this rate (t = {time:.4g} s)" if fraction >= FORESEEN else f" and more (t = {time:.4g} s)"
            self._tell(whole, now, f"{less}, or record fewer signals.")

    def _whole(self, fraction: float, size: int) -> float:
        """Bytes at the end, if it goes on as in the second half so far; 0 while that says little."""
        if fraction < FORESEEN:
            return size if size > MUCH * self.large else 0.0
        begun = next((one for one in self.seen if fraction / 2 <= one[0] < fraction), (0.0, 0))
        return size + (size - begun[1]) / (fraction - begun[0]) * (1 - fraction)

    def _tell(self, size: float, why: str, way_out: str) -> None:
        self.told = True
        echo(f"note: the results will take about {size / 1e6:.0f} MB{why}. {way_out}", err=True)
