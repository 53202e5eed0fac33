"""A block on a slope holds exactly when tan(alpha) <= mu_s.

Weight pulls along the slope with m g sin(alpha) and presses on it with m g cos(alpha). Friction can
answer with anything up to mu_s m g cos(alpha), so mass and gravity cancel out of the question whether
the block holds. If it does not hold, it slides down with g (sin(alpha) - mu_k cos(alpha)). Between
mu_k and mu_s lies a range of angles where a block at rest stays at rest and a block that slides keeps
sliding: the state of a contact is not a function of the forces on it alone.

Source: any first mechanics text; physics section 8 item 7.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tests.reference.stopping import GRAVITY


@dataclass(frozen=True)
class InclinedBlock:
    """A block released at rest on a slope of `angle` [rad]; stiction and Coulomb coefficients [-]."""

    angle: float
    stiction: float = 0.40
    coulomb: float = 0.35
    gravity: float = GRAVITY

    @property
    def holds(self) -> bool:
        """Whether the block, at rest, stays at rest: sin(alpha) <= mu_s cos(alpha)."""
        return bool(np.sin(self.angle) <= self.stiction * np.cos(self.angle))

    @property
    def acceleration(self) -> float:
        """Acceleration down the slope [m/s^2] after release from rest: zero while it holds."""
        if self.holds:
            return 0.0
        return self.gravity * (np.sin(self.angle) - self.coulomb * np.cos(self.angle))

    def position(self, time: ArrayLike) -> NDArray[np.float64]:
        """Distance slid down the slope [m] at each `time` [s] >= 0."""
        return 0.5 * self.acceleration * np.asarray(time, dtype=float) ** 2

    def holding_force(self, mass: float) -> float:
        """Friction force [N] up the slope on a block of `mass` [kg], at rest or sliding down."""
        if self.holds:
            return mass * self.gravity * np.sin(self.angle)
        return self.coulomb * mass * self.gravity * np.cos(self.angle)
