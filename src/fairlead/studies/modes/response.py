"""The answer of a linearised model to what acts on it, over frequency.

H(w) = C (i w I - A)^-1 B + D with the states of linear.py. Where a force acts on parts that hold together, the rows of
the contacts take their share of it: B comes from the same solution as A.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.studies.modes.linear import Linear, shares
from fairlead.studies.modes.signals import Acting, Seen
from fairlead.studies.modes.spectrum import Mode

Floats = NDArray[np.float64]
Complex = NDArray[np.complex128]
POINTS = 400
AROUND = 10.0
"""Without a range: so many times below the lowest frequency of a mode, and above the highest."""
NO_MODE = (0.1, 100.0)
"""The range [Hz] where no mode has a frequency."""


@dataclass(frozen=True)
class Response:
    """Complex answer `values` at `frequencies` [Hz], shape (k,): amplitude and phase of `out` for 1 of `acting`."""

    acting: str
    out: str
    unit: str
    frequencies: Floats
    values: Complex

    @property
    def phase(self) -> Floats:
        """Of the answer [deg], between -180 and 180."""
        found: Floats = np.degrees(np.angle(self.values))
        return found


def response(found: Linear, acting: Acting, out: Seen, unit: str, frequencies: Floats) -> Response:
    """The response at frequencies [Hz]."""
    at = found.equations.at
    rates, follows = shares(found, acting.column[at])
    states, row = found.onto @ rates, out.row[at] @ found.spread
    direct = acting.direct + float(out.row[at][~found.equations.differential] @ follows)
    n, i = len(found.matrix), 1j
    answers = [row @ np.linalg.solve(i * w * np.eye(n) - found.matrix, states) + direct if n else direct
               for w in 2 * math.pi * frequencies]  # fmt: skip
    return Response(acting.name, out.name, unit, frequencies, np.array(answers, dtype=complex))


def range_of(modes: list[Mode]) -> tuple[float, float]:
    """Frequencies [Hz] around those of the modes."""
    found = [abs(one.value) / (2 * math.pi) for one in modes]
    return (min(found) / AROUND, max(found) * AROUND) if found else NO_MODE


def spaced(low: float, high: float) -> Floats:
    """Frequencies at equal ratios."""
    made: Floats = np.geomspace(low, high, POINTS)
    return made
