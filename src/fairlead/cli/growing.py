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
NUMBER = 8
"""Bytes of a number in the results."""


class Growing:
    """Called with (fraction done, time, None) as progress is, which it passes on; tells once of what will be large."""

    def __init__(self, model: Model, folder: pathlib.Path, large: float, progress: Callable[..., None] | None) -> None:
        """`large` is in bytes."""
        self.model, self.folder, self.large, self.progress = model, folder, large, progress
        self.told = False

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
        if size > EARLY * self.large and size / fraction > self.large:
            every = self.model.netlist.record.every
            less = "Give record.every a time" if every is None else f"Record less often (record.every is {every:g} s)"
            self._tell(size / fraction, f" at this rate (t = {time:.4g} s)", f"{less}, or record fewer signals.")

    def _tell(self, size: float, why: str, way_out: str) -> None:
        self.told = True
        echo(f"note: the results will take about {size / 1e6:.0f} MB{why}. {way_out}", err=True)
