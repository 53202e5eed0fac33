"""Loads that stay so small during a run that the rounding of their corner counts: a sentence, and the way out.

Where a law follows the size of a load, |F|, its corner at zero is rounded off over a parameter of the part, which is
meant to be small beside the load: sqrt(F^2 + r^2) - r falls short of |F| by up to r. An output that declares
`rounded_by` is such a load. One whose largest size is below `ENOUGH` times r is told; what is zero but for rounding of
the engine is no load. A scene made a thousand times smaller is caught by this, where its friction would silently go.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.compiled.system import System

ENOUGH = 100.0
"""Sizes of a load, in what its corner is rounded over, from which on the rounding is small: 1 % at most."""
NO_LOAD = 1e-6
"""Of what the corner is rounded over; a smaller load is taken for rounding."""
MOST_TOLD = 5
Floats = NDArray[np.float64]


@dataclass
class RoundedOff:
    """Watches m loads, in columns `columns` of the rows of a run."""

    signals: Sequence[OutputSignal]
    columns: NDArray[np.int64]
    over: Floats
    """[m]: what the corner of each is rounded over, in its unit."""
    most: Floats = field(init=False)
    """[m]: its largest size so far."""

    def __post_init__(self) -> None:
        """Nothing seen yet."""
        self.most = np.zeros(len(self.signals))

    @classmethod
    def of(cls, system: System, recorded: Sequence[OutputSignal]) -> RoundedOff:
        """Those among the recorded signals; one that has two names counts once."""
        found = {one.at: (k, one) for k, one in enumerate(recorded) if one.rounded_by}
        values = {one.path: one.values for one in system.flat.instances} if found else {}
        over = [float(getattr(values[_path(system, one)], one.rounded_by)) for _, one in found.values()]
        return cls([one for _, one in found.values()], np.array([k for k, _ in found.values()], dtype=np.int64),
                   np.array(over))  # fmt: skip

    def watch(self, rows: Floats) -> None:
        """Take recorded rows, shape (k, recorded)."""
        if len(rows) and len(self.columns):
            np.maximum(self.most, np.nanmax(np.abs(rows[:, self.columns]), axis=0, initial=0.0), out=self.most)

    def remarks(self) -> list[str]:
        """A sentence on each of the first few that stay small."""
        return [*self._told()][:MOST_TOLD]

    def _told(self) -> Iterator[str]:
        small = (self.most > NO_LOAD * self.over) & (self.most < ENOUGH * self.over)
        for k in np.flatnonzero(small).tolist():
            one, most, over = self.signals[k], float(self.most[k]), float(self.over[k])
            part, _, name = one.name.rpartition(".")
            given = f"{part.rpartition('.')[0] or part}.{one.rounded_by}"
            finer = 10.0 ** math.floor(math.log10(most / ENOUGH) - 1.0 + 1e-9)
            yield (
                f"{part}: its {name} is at most {most:.3g} {one.unit}, and the corner of its law at zero is rounded "
                f"off over {over:.3g} {one.unit}, so that what follows from it is too small. Give {given}: "
                f"{finer:.0e} {one.unit}."
            )


def _path(system: System, signal: OutputSignal) -> str:
    """The instance of an output, also where it goes by an outer name."""
    return system.flat.assembly.aliases[signal.name].instance if signal.name in system.flat.assembly.aliases else (
        signal.name.rpartition(".")[0]
    )  # fmt: skip
