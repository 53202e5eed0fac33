"""Waves and natural frequencies of an elastic rod, and of the chain of masses that stands for it.

A push travels along a rod at c = sqrt(EA/m'). Fixed at one end and free at the other, the rod rings with
quarter waves: w_j = (2 j - 1) (pi/2) c/L. Cut into n elements of length l = L/n (springs EA/l, masses
m' l, half a mass at the free end) the same rod has exactly the frequencies

    w_j = 2 sqrt(k/m) sin((2 j - 1) pi/(4 n)),      j = 1..n,

with k = EA/l and m = m' l: right for long waves (error (w l/c)^2/24), and with a ceiling of
2 sqrt(k/m) = 2 c/l that no chain of this element length can exceed. The ceiling, not the
physics of interest, limits the step of an explicit method.

Source: Born and von Karman (1912) for the chain; Rayleigh, Theory of Sound, chapter V;
physics section 8 item 13.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class ElasticRod:
    """A rod of `stiffness` EA [N], `mass` [kg/m] and `length` [m], fixed at one end and free at the other."""

    stiffness: float = 500e3
    mass: float = 4.2
    length: float = 15.0

    @property
    def wave_speed(self) -> float:
        """c = sqrt(EA/m') [m/s]."""
        return float(np.sqrt(self.stiffness / self.mass))

    def frequencies(self, count: int) -> NDArray[np.float64]:
        """The first `count` natural frequencies of the continuous rod [rad/s]."""
        return (
            (2.0 * np.arange(1, count + 1, dtype=float) - 1.0) * 0.5 * np.pi * self.wave_speed / self.length
        )

    def chain_frequencies(self, elements: int) -> NDArray[np.float64]:
        """All natural frequencies [rad/s] of the chain of `elements` springs, half a mass at the free end."""
        odd = 2.0 * np.arange(1, elements + 1) - 1.0
        return self.chain_ceiling(elements) * np.sin(odd * np.pi / (4.0 * elements))

    def chain_ceiling(self, elements: int) -> float:
        """Frequency [rad/s] that no chain of `elements` springs exceeds: 2 sqrt(k/m) = 2 c/l."""
        return 2.0 * self.wave_speed * elements / self.length
