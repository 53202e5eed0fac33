"""A core inside a hose round a bend: two capstans, one inside the other.

The core (tension T_c) presses its bulkheads on the hose with T_c d(theta); core and hose together (T =
T_c + T_h) press on the guide with T d(theta). If the core slides in the hose and the hose slides on the
guide,

    dT_c/d(theta) = mu_b T_c,      dT/d(theta) = mu_d T,      T_h = T - T_c.

The hose has to pass on to the guide what the core gives it and is left with the difference. If the guide
grips better than the bulkheads (mu_d T > mu_b T_c) the hose is pushed into compression towards the pulled
end: a ruck. So the hose moves with the core only while the bulkheads can drag it over the guide,

    mu_d <= mu_d* = mu_b T_c/(T_c + T_h)                                  (slip threshold, item 11)

with the tensions at the entry of the bend, before anything slips.

Source: physics sections 4.2, 7a and 8 items 10, 11, by the argument of the capstan twice.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class DoubleCapstan:
    """Tensions at the held end [N] and the coefficients guide-hose and bulkhead-hose [-], both slipping."""

    core_hold: float
    hose_hold: float
    guide_friction: float
    bulkhead_friction: float

    def core(self, angle: ArrayLike) -> NDArray[np.float64]:
        """Core tension [N] at each `angle` [rad] from the held end."""
        return self.core_hold * np.exp(self.bulkhead_friction * np.asarray(angle, dtype=float))

    def total(self, angle: ArrayLike) -> NDArray[np.float64]:
        """Tension of core and hose together [N] at each `angle` [rad] from the held end."""
        return (self.core_hold + self.hose_hold) * np.exp(
            self.guide_friction * np.asarray(angle, dtype=float)
        )

    def hose(self, angle: ArrayLike) -> NDArray[np.float64]:
        """Hose tension [N], negative when compressed, at each `angle` [rad] from the held end."""
        return self.total(angle) - self.core(angle)

    @property
    def slip_threshold(self) -> float:
        """Guide friction mu_d* [-] above which the bulkheads cannot drag the hose through the bend."""
        return self.bulkhead_friction * self.core_hold / (self.core_hold + self.hose_hold)
