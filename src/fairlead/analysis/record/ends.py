"""Where no law says what follows: elements that are inside out (strains.py), parts that are used up (used_up.py).

`Model.run` looks at every row that it records (watch.py). A run that is stepped from outside records none, so it looks
at the end of every step; so does what is exported, which has the table of `limits`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.record.strains import INSIDE_OUT, Strains
from fairlead.analysis.record.used_up import UsedUp
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.compiled.system import System


class Limit(NamedTuple):
    """One that ends a run: where `sign` times a recorded value is above `most`."""

    column: int
    sign: float
    most: float
    sentence: str
    """What is so, without the time."""


@dataclass(frozen=True)
class Ends:
    """Watches the recorded values at the end of a step."""

    strains: Strains
    used_up: UsedUp

    @classmethod
    def of(cls, system: System, recorded: Sequence[OutputSignal]) -> Ends:
        """Those among the recorded signals."""
        return cls(Strains.of(system, recorded), UsedUp.of(system, recorded))

    @property
    def any(self) -> bool:
        """True if there is something to look at."""
        return bool(len(self.strains.names) or len(self.used_up.names))

    def at(self, t: float, values: NDArray[np.float64]) -> str | None:
        """Why the run ends here, as `Model.run` says it; None where it goes on."""
        when, rows = np.array([t]), values[None, :]
        found = self.strains.end(when, rows) or self.used_up.end(when, rows)
        return None if found is None else found[1]

    def limits(self) -> Iterator[Limit]:
        """The same as a table."""
        strains, used_up = self.strains, self.used_up
        just_above = math.nextafter(-INSIDE_OUT, 0.0)
        for name, column, allowed in zip(strains.names, strains.columns.tolist(), strains.allowed, strict=True):
            if allowed < 1.0:
                yield Limit(column, -1.0, just_above, strains.sentence((name,)))
        for name, column, most in zip(used_up.names, used_up.columns.tolist(), used_up.most.tolist(), strict=True):
            yield Limit(column, 1.0, most, used_up.sentence((name,)))
