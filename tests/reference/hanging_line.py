"""A line with a load along its length: the tension at a point is everything beyond it.

Hang a rope, or tow one through water: every metre adds its weight or drag w to the pull, so the tension
grows along a straight line from the tail load, T(s) = T_tail + w (L - s), and the line stretches by the
integral of T/EA, (T_tail L + w L^2/2)/EA. The material parameters do not enter the tension at all: a good
test that a model adds its forces up correctly, mass by mass.

Source: any first mechanics text; physics section 4.6 for the drag, section 8 item 14. Default: 6.57 N/m.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class HangingLine:
    """A line of `length` [m] held at s = 0; `load` along it [N/m], `tail` load [N], `stiffness` EA [N]."""

    length: float = 14.0
    load: float = 6.57
    tail: float = 150.0
    stiffness: float = 500e3

    def tension(self, position: ArrayLike) -> NDArray[np.float64]:
        """Tension [N] at each `position` [m] from the held end."""
        return self.tail + self.load * (self.length - np.asarray(position, dtype=float))

    def stretch(self) -> float:
        """Elongation of the whole line [m] (small strain)."""
        return (self.tail * self.length + 0.5 * self.load * self.length**2) / self.stiffness

    def chain_tension(self, elements: int) -> NDArray[np.float64]:
        """Tension [N] of each of `elements` equal elements when the load sits in nodes (half at the ends).

        It equals the continuous tension at the middle of each element: no discretisation error at all.
        """
        middle = (np.arange(elements) + 0.5) * self.length / elements
        return self.tension(middle)


def drag_per_length(density: float, coefficient: float, diameter: float, speed: float) -> float:
    """Tangential drag per length [N/m] of a towed line: 1/2 rho C_t pi d U |U| (SI units)."""
    return 0.5 * density * coefficient * np.pi * diameter * speed * abs(speed)
