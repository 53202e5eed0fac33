"""A long rod held along its length by friction: how far a pull reaches, and what stays after letting go.

A rod lies on a floor that resists sliding with q per length. Pull its end with F: the first piece slides
and passes on F - q s, so tension falls along a straight line and is zero at s = F/q. Beyond that nothing
has moved or even felt the pull. The end has moved by the integral of strain, and half the work has become
heat:

    slipped length F/q,   end travel F^2/(2 EA q),   work F^3/(3 EA q), of it stored 1/2 and dissipated 1/2.

Let go: the end springs back, but friction now points the other way and only half as far: over F/(2 q) the
tension climbs with slope +q from zero and meets the old line, which stays locked in beyond. The end keeps
half its travel. This is a spring with a memory: F over travel is a parabola going up and another coming
down (Masing's rule: the branch of a reversal is the first one at twice the scale).

Source: the virtual anchor of a buried pipeline; Masing (1926) for the branches; physics section 8 item
12.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class FrictionAnchor:
    """A rod of `stiffness` EA [N] on a floor that holds `grip` q [N/m], longer than any slipped length."""

    stiffness: float = 100e3
    grip: float = 160.0

    def slipped_length(self, force: float) -> float:
        """Length that has moved [m] under the first pull `force` [N]: F/q."""
        return force / self.grip

    def end_travel(self, force: float) -> float:
        """Travel of the pulled end [m] at the first loading to `force` [N]: F^2/(2 EA q)."""
        return force**2 / (2.0 * self.stiffness * self.grip)

    def end_travel_unloading(self, force: float, greatest: float) -> float:
        """Travel of the end [m] when the pull has come down from `greatest` to `force` [N], 0 <= F <= F_max.

        Masing: the travel lost is twice the first-loading travel of half the drop.
        """
        return self.end_travel(greatest) - 2.0 * self.end_travel(0.5 * (greatest - force))

    def residual(self, greatest: float) -> float:
        """Travel left after letting go [m]: half of the greatest."""
        return self.end_travel_unloading(0.0, greatest)

    def work(self, force: float) -> float:
        """Work of the pull [J] at the first loading to `force` [N]: F^3/(3 EA q)."""
        return force**3 / (3.0 * self.stiffness * self.grip)

    def dissipated(self, force: float) -> float:
        """Part of the work turned into heat [J]: half of it."""
        return 0.5 * self.work(force)

    def loop_energy(self, amplitude: float) -> float:
        """Heat per full cycle between -F and +F [J]: (2/3) F^3/(EA q)."""
        return 2.0 / 3.0 * amplitude**3 / (self.stiffness * self.grip)

    def tension(self, force: float, position: ArrayLike) -> NDArray[np.float64]:
        """Tension [N] at each `position` [m] from the pulled end, at the first loading to `force` [N]."""
        return np.maximum(force - self.grip * np.asarray(position, dtype=float), 0.0)
