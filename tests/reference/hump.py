"""A friction law that rises from stiction to a peak and then falls, and what falling does to sliding.

Rubber and soft plastics grip best at a small slip speed: the coefficient starts at mu_s, rises to mu_p at
the speed v_p and falls to mu_k. Four numbers a user can read off a measured curve fix the law (physics
1.2):

    mu(v) = mu_k + (D + c v) exp(-v/v_0),          D = mu_s - mu_k

The peak is where mu' = 0, so v_p = v_0 - D/c, and mu(v_p) = mu_p gives c v_0 exp(-v_p/v_0) = mu_p - mu_k.
With r = D/(mu_p - mu_k) and u = 1 - v_p/v_0 these two become u exp(1 - u) = r, i.e. (-u) exp(-u) = -r/e:
the equation that Lambert's W function solves,

    u = -W0(-r/e),      v_0 = v_p/(1 - u),      c = D/(v_0 - v_p);
    D = 0:              v_0 = v_p,              c = (mu_p - mu_k) e/v_p.

Stability. A mass slides at v_d under the load N, held by a spring and a damper c_d. A small disturbance w
of its speed meets the force -(c_d + N mu'(v_d)) w, so sliding is steady exactly when
c_d + N mu'(v_d) > 0: on the rising branch always, on the falling branch only with damping enough.
Otherwise the motion grows into stick-slip.

Source: Corless et al., On the Lambert W function, Adv. Comput. Math. 5 (1996) 329, for W; physics
sections 1.2 and 8 item 5. Defaults: physics section 9.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import lambertw


@dataclass(frozen=True)
class Hump:
    """Coefficients at rest, at the peak and at speed [-] and the speed of the peak [m/s].

    Raises ValueError unless the peak is above both ends: otherwise there is no hump.
    """

    at_rest: float = 0.30
    peak: float = 0.42
    peak_speed: float = 0.03
    at_speed: float = 0.35

    def __post_init__(self) -> None:
        if self.peak <= max(self.at_rest, self.at_speed):
            raise ValueError("the peak of a hump must lie above both its ends")

    @property
    def decay_speed(self) -> float:
        """v_0 [m/s], by Lambert's W."""
        ratio = (self.at_rest - self.at_speed) / (self.peak - self.at_speed)
        return float(self.peak_speed / (1.0 + lambertw(-ratio / np.e).real))

    @property
    def rise(self) -> float:
        """c [s/m]; written with v_0 alone, which unlike D/(v_0 - v_p) has no gap at D = 0."""
        lift = self.peak - self.at_speed
        return float(lift * np.exp(self.peak_speed / self.decay_speed) / self.decay_speed)

    def coefficient(self, speed: ArrayLike) -> NDArray[np.float64]:
        """mu(v) [-] at each slip `speed` [m/s] >= 0."""
        v = np.asarray(speed, dtype=float)
        front = self.at_rest - self.at_speed + self.rise * v
        return self.at_speed + front * np.exp(-v / self.decay_speed)

    def slope(self, speed: ArrayLike) -> NDArray[np.float64]:
        """mu'(v) [s/m] at each slip `speed` [m/s] >= 0."""
        v = np.asarray(speed, dtype=float)
        front = self.at_rest - self.at_speed + self.rise * v
        return (self.rise - front / self.decay_speed) * np.exp(-v / self.decay_speed)

    def steepest_fall(self) -> tuple[float, float]:
        """Speed [m/s] and value [s/m] of the most negative slope: at v_p + v_0."""
        speed = self.peak_speed + self.decay_speed
        return speed, float(self.slope(speed))

    def slides_steadily(self, speed: float, normal: float, damping: float) -> bool:
        """Whether steady sliding at `speed` [m/s] is stable under load `normal` [N] and `damping` [N s/m]."""
        return bool(damping + normal * self.slope(speed) > 0.0)
