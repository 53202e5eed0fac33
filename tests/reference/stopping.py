"""A block sliding on a floor stops after v^2/(2 mu g), and then it stays.

Friction of a sliding block does not depend on its speed (Coulomb, 1785): mu m g against the motion.
The deceleration mu g is constant, so speed falls along a straight line and reaches zero at
t = v/(mu g). What happens next is the whole difficulty of dry friction in one example: a solver that
goes on with "mu m g against the motion" pushes the block backwards. The right answer is that the
contact force drops to what is needed, here nothing, and the block rests for ever.

Source: any first mechanics text; physics section 8 item 6.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

GRAVITY = 9.81  # [m/s^2]


@dataclass(frozen=True)
class StoppingBlock:
    """A block of any mass, thrown along a level floor with `speed` [m/s] > 0; `friction` is mu [-]."""

    speed: float = 0.3
    friction: float = 0.35
    gravity: float = GRAVITY

    @property
    def stopping_time(self) -> float:
        """Time to rest [s]: v/(mu g)."""
        return self.speed / (self.friction * self.gravity)

    @property
    def stopping_distance(self) -> float:
        """Distance to rest [m]: v^2/(2 mu g)."""
        return self.speed**2 / (2.0 * self.friction * self.gravity)

    def position(self, time: ArrayLike) -> NDArray[np.float64]:
        """Distance travelled [m] at each `time` [s] >= 0, constant once the block is at rest."""
        t = np.minimum(np.asarray(time, dtype=float), self.stopping_time)
        return self.speed * t - 0.5 * self.friction * self.gravity * t**2

    def velocity(self, time: ArrayLike) -> NDArray[np.float64]:
        """Speed [m/s] at each `time` [s] >= 0, exactly zero once the block is at rest."""
        t = np.minimum(np.asarray(time, dtype=float), self.stopping_time)
        return self.speed - self.friction * self.gravity * t
