"""Loads that stay so small during a run that the rounding of their corner counts: a sentence, and the way out.

Where a law follows the size of a load F, the corner of |F| at zero is rounded off over a parameter r of the part, which
is meant to be small beside the load: sqrt(F^2 + r^2) - r falls short of |F| by the share r/|F|. An output that declares
`rounded_by` is such a load. A run tells those whose largest size is below `ENOUGH` times r, and not zero but for
rounding of the engine. So a scene whose forces are a thousand times smaller does not lose its friction without a word.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fairlead.component.assembly import Instance
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
    owners: Sequence[Instance]
    """[m]: the part of each, whose parameter rounds it off."""
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
        columns, signals = np.array([k for k, _ in found.values()], dtype=np.int64), [one for _, one in found.values()]
        instances = {one.path: one for one in system.flat.instances} if found else {}
        owners = [instances[_path(system, one)] for one in signals]
        over = [getattr(owner.values, one.rounded_by) for owner, one in zip(owners, signals, strict=True)]
        return cls(signals, owners, columns, np.array(over, dtype=float))

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
            one, owner, most, over = self.signals[k], self.owners[k], float(self.most[k]), float(self.over[k])
            unit = owner.type.declaration.parameters[one.rounded_by].unit
            given = f"{owner.path.rpartition('.')[0] or owner.path}.{one.rounded_by}"
            finer = 10.0 ** math.floor(math.log10(most / ENOUGH) - 1.0 + 1e-9)
            yield (
                f"{one.name} is at most {most:.3g} {one.unit}, and the corner of the law at zero is rounded off over "
                f"{over:.3g} {unit}, which counts beside it. Give {given}: {finer:.0e} {unit}."
            )


def _path(system: System, signal: OutputSignal) -> str:
    """The instance of an output, also where it goes by an outer name."""
    inner = system.flat.assembly.aliases.get(signal.name)
    return signal.name.rpartition(".")[0] if inner is None else inner.instance
