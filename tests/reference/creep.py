"""A very viscous contact that imitates sticking: it creeps, it leaks, and it breaks away a little late.

The binding-friction law replaces "no motion below F_s" by a steep line T = g0 v: a stuck contact is one
that creeps. With the prism of Tomlinson, Cooke and Cosserat (2003) the slope is the sum of the viscous
plateau f_m and of the sliding law's linear passage through zero of half width v_l (physics 1.3, 1.4):

    g0 = f_m + F(v_l)/v_l,      f_m = f_n + F_s/v_c,      v_l = v_n = b v_c

so that for f_n = 0, b = 4 and F(v_l) = F_s the slope is 1.25 F_s/v_c. Three consequences, all exact:

*creep*       a constant load af < F_s moves the contact at v = af/g0 (item 1);
*leak*        a preloaded spring k relaxes through the contact: F(t) = F(0) exp(-k t/g0) (item 3);
*breakaway*   pulled through a spring whose end moves at v_d, the load obeys F' = k (v_d - F/g0), so F reaches
              F_s at t_b = -(g0/k) ln(1 - F_s/(g0 v_d)) (item 2), later than the rigid F_s/(k v_d) by about
              x_b/v_d with x_b = F_s^2/(2 g0 k v_d), the distance crept before breakaway.

All three leave out the mass of the block, which matters only for the first m/g0 seconds.

Source: Tomlinson, Cooke and Cosserat, J. Systems and Control Engineering 217 (2003) 139, DOI
10.1177/095965180321700207; physics sections 1.4 and 8 items 1-3.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class BoundContact:
    """A contact with breakaway force `stiction` [N] and creep speed v_c [m/s]; widths a, b of the prism.

    `sliding_at_edge` is F(v_l) [N], the sliding law at the edge of its linear passage; None means F_s.
    """

    stiction: float = 5.0
    creep_speed: float = 1e-4
    width: float = 4.0
    nominal: float = 0.0
    sliding_at_edge: float | None = None

    @property
    def slope(self) -> float:
        """Slope g0 of force over speed while bound [N s/m]."""
        edge = self.stiction if self.sliding_at_edge is None else self.sliding_at_edge
        return self.nominal + self.stiction / self.creep_speed + edge / (self.width * self.creep_speed)

    def creep(self, load: ArrayLike) -> NDArray[np.float64]:
        """Speed [m/s] under a steady `load` [N] below the stiction force."""
        return np.asarray(load, dtype=float) / self.slope

    def leaked_load(self, initial: float, stiffness: float, time: ArrayLike) -> NDArray[np.float64]:
        """Load [N] left at each `time` [s] in a spring of `stiffness` [N/m] first loaded to `initial` [N]."""
        return initial * np.exp(-stiffness * np.asarray(time, dtype=float) / self.slope)

    def breakaway_time(self, stiffness: float, speed: float) -> float:
        """Time [s] at which a spring [N/m] whose end moves at `speed` [m/s] has loaded the contact to F_s.

        Raises ValueError when the end moves slower than the creep at F_s: then the load never gets there.
        """
        lag = self.stiction / (self.slope * speed)
        if lag >= 1.0:
            raise ValueError(f"pulled at {speed} m/s the contact creeps away and never breaks away")
        return float(-self.slope / stiffness * np.log1p(-lag))

    def breakaway_time_first_order(self, stiffness: float, speed: float) -> float:
        """The same [s], to first order in the creep: F_s/(k v_d) + x_b/v_d (physics section 8 item 2)."""
        crept = self.stiction**2 / (2.0 * self.slope * stiffness * speed)
        return self.stiction / (stiffness * speed) + crept / speed

    def crept_before_breakaway(self, stiffness: float, speed: float) -> float:
        """Distance crept before breakaway [m]: what the pulled end did and the spring did not take up."""
        return speed * self.breakaway_time(stiffness, speed) - self.stiction / stiffness
