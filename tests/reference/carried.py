"""A block put down on a moving belt slides until it has the belt's speed, then rides along.

While the block is slower than the belt, friction mu_k m g drives it forward: here friction does not
brake, it is the engine. At t = v_belt/(mu_k g) both have one speed and the contact sticks, at a speed
that is not zero: sticking means zero *relative* velocity. The force then drops to zero.
Of the work the belt does, mu_k m g v_belt t = m v_belt^2, half becomes the kinetic energy of the block
and half becomes heat, whatever the friction is.

Source: any first mechanics text; physics section 8 item 8.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tests.reference.stopping import GRAVITY


@dataclass(frozen=True)
class CarriedBlock:
    """A block at rest at t = 0 on a belt of speed `belt` [m/s] > 0, Coulomb coefficient `friction` [-]."""

    belt: float = 0.3
    friction: float = 0.35
    gravity: float = GRAVITY

    @property
    def capture_time(self) -> float:
        """Time at which the block sticks to the belt [s]: v_belt/(mu_k g)."""
        return self.belt / (self.friction * self.gravity)

    @property
    def slid_length(self) -> float:
        """Length of the mark the block leaves on the belt [m]: v_belt^2/(2 mu_k g)."""
        return self.belt**2 / (2.0 * self.friction * self.gravity)

    def velocity(self, time: ArrayLike) -> NDArray[np.float64]:
        """Speed of the block over ground [m/s] at each `time` [s] >= 0."""
        return np.minimum(self.friction * self.gravity * np.asarray(time, dtype=float), self.belt)

    def position(self, time: ArrayLike) -> NDArray[np.float64]:
        """Distance of the block over ground [m] at each `time` [s] >= 0."""
        t = np.asarray(time, dtype=float)
        sliding = np.minimum(t, self.capture_time)
        return 0.5 * self.friction * self.gravity * sliding**2 + self.belt * (t - sliding)

    def heat(self, mass: float) -> float:
        """Energy turned into heat [J] for a block of `mass` [kg]: half of what the belt supplied."""
        return 0.5 * mass * self.belt**2
