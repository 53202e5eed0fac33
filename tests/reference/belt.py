"""A block on a moving belt, held back by a spring: stick-slip with exact times.

The belt carries the block away until the spring pulls with the stiction force F_s. The contact breaks
away, friction drops at once to the Coulomb force F_k < F_s, the spring pulls the block back through a
part of a sine wave, the block comes to the belt's speed again and sticks. This repeats for ever: a
bowed string, a squealing brake, a door hinge. It happens *because* F_k < F_s; with equal forces the block
would come to rest at x = F_k/k.

With x the position of the block (spring relaxed at x = 0), v_d the belt speed, dF = F_s - F_k and
w = sqrt(k/m):

    stick:  x' = v_d                        until k x = F_s
    slip:   m x'' = F_k - k x               from x = F_s/k, x' = v_d  until x' = v_d again
            x = F_k/k + (dF/k) cos(w t) + (v_d/w) sin(w t)

With z = dF/(v_d sqrt(k m)) the speed of a slip is again v_d after

    slip time 2 (pi - atan z)/w,            at x = F_k/k - dF/k, the mirror image of the breakaway,
    stick time 2 dF/(k v_d),                the belt carries the block back from the one to the other.

While it sticks the spring force goes from F_k - dF to F_k + dF = F_s; while it slips it overshoots both
ends, to F_k -+ sqrt(dF^2 + v_d^2 k m), because the block still has the speed of the belt. The slip
speed reaches v_d (1 + sqrt(1 + z^2)), and throughout the slip the belt is the faster of the two: friction
keeps one sign.

In the frame of the belt this is the block of physics section 1.8, pulled over a fixed floor by a spring
whose far end moves at v_d: spring force, slip speed and all times are the same.

Source: Rabinowicz, The nature of the static and kinetic coefficients of friction, J. Appl. Phys. 22 (1951)
1373, for the experiment; the formulas follow in three lines from the two equations above (physics
section 8 item 4). Defaults: the benchmark `belt`.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class StickSlipBelt:
    """Mass [kg], spring stiffness [N/m], belt speed [m/s], stiction and Coulomb force [N]; stuck at t = 0.

    At t = 0 the spring is relaxed and the block rides on the belt (x = 0, x' = v_d).
    """

    mass: float = 1.0
    stiffness: float = 100.0
    speed: float = 0.2
    stiction: float = 10.0
    coulomb: float = 6.0

    @property
    def drop(self) -> float:
        """Drop of the friction force at breakaway dF [N]."""
        return self.stiction - self.coulomb

    @property
    def frequency(self) -> float:
        """Natural frequency w = sqrt(k/m) [rad/s]."""
        return float(np.sqrt(self.stiffness / self.mass))

    @property
    def drop_ratio(self) -> float:
        """z = dF/(v_d sqrt(k m)) [-]: the elastic jump compared with the belt speed."""
        return self.drop / (self.speed * np.sqrt(self.stiffness * self.mass))

    @property
    def slip_time(self) -> float:
        """Duration of each slip [s]."""
        return float(2.0 * (np.pi - np.arctan(self.drop_ratio)) / self.frequency)

    @property
    def stick_time(self) -> float:
        """Duration of each stick [s] but the first, which starts from a relaxed spring."""
        return 2.0 * self.drop / (self.stiffness * self.speed)

    @property
    def period(self) -> float:
        """Duration of one cycle [s]."""
        return self.slip_time + self.stick_time

    @property
    def first_breakaway(self) -> float:
        """Time of the first breakaway [s]: F_s/(k v_d)."""
        return self.stiction / (self.stiffness * self.speed)

    @property
    def greatest_slip_speed(self) -> float:
        """Largest |x' - v_d| [m/s], reached in the middle of a slip."""
        return float(self.speed * (1.0 + np.sqrt(1.0 + self.drop_ratio**2)))

    @property
    def lowest_position(self) -> float:
        """Smallest position ever reached after the first breakaway [m], where the block stands still."""
        inertia = self.speed * np.sqrt(self.stiffness * self.mass)
        return float((self.coulomb - np.hypot(self.drop, inertia)) / self.stiffness)

    def breakaways(self, count: int) -> NDArray[np.float64]:
        """Times of the first `count` switches from stick to slip [s]."""
        return self.first_breakaway + self.period * np.arange(count, dtype=float)

    def captures(self, count: int) -> NDArray[np.float64]:
        """Times of the first `count` switches from slip to stick [s]."""
        return self.breakaways(count) + self.slip_time

    def slipping(self, time: ArrayLike) -> NDArray[np.bool_]:
        """Whether the block slips at each `time` [s] >= 0."""
        t = np.asarray(time, dtype=float)
        return (t > self.first_breakaway) & (self._phase(t) < self.slip_time)

    def position(self, time: ArrayLike) -> NDArray[np.float64]:
        """Position of the block [m] at each `time` [s] >= 0."""
        t = np.asarray(time, dtype=float)
        phase = self._phase(t)
        angle = self.frequency * phase
        swing = self.drop * np.cos(angle) + self.stiffness * self.speed / self.frequency * np.sin(angle)
        slip = (self.coulomb + swing) / self.stiffness
        stick = (self.coulomb - self.drop) / self.stiffness + self.speed * (phase - self.slip_time)
        later = np.where(phase < self.slip_time, slip, stick)
        return np.where(t <= self.first_breakaway, self.speed * t, later)

    def velocity(self, time: ArrayLike) -> NDArray[np.float64]:
        """Speed of the block over ground [m/s] at each `time` [s] >= 0."""
        angle = self.frequency * self._phase(np.asarray(time, dtype=float))
        slip = self.speed * np.cos(angle) - self.drop / np.sqrt(self.stiffness * self.mass) * np.sin(angle)
        return np.where(self.slipping(time), slip, self.speed)

    def friction(self, time: ArrayLike) -> NDArray[np.float64]:
        """Force of the belt on the block [N], in the direction of the belt, at each `time` [s] >= 0."""
        return np.where(self.slipping(time), self.coulomb, self.stiffness * self.position(time))

    def _phase(self, t: NDArray[np.float64]) -> NDArray[np.float64]:
        """Time since the last breakaway [s]; meaningless before the first."""
        return np.mod(t - self.first_breakaway, self.period)
