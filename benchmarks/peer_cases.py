"""Two friction problems as scipy wants them: a block on a belt, a rod on a floor cut into N blocks.

Each case offers the same few functions, so that every solver in `peers.py` serves both:

    smooth_rhs, smooth_jacobian     friction as a steep smooth function of the slip speed (tanh); creeps
    zone_rhs, zone_jacobian         exact friction, the zone of every contact fixed: -1, +1 slide, 0 stick
    guards, switch                  when a zone ends (guard rises through zero), and what comes next

Unknowns are interleaved, y = (x_0, v_0, x_1, v_1, ...), so the Jacobian is a narrow band. Nothing here
imports fairlead. Source: physics section 8 item 4 for the belt; the chain is the rod of the benchmark
`chain-N`.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.optimize import brentq
from scipy.sparse import csc_matrix

SCALE = 0.1  # length that errors are referred to [m]


@dataclass(frozen=True)
class Belt:
    """Block on a moving belt, stuck with a relaxed spring at t = 0; 50 cycles of stick-slip.

    `drop_ratio`: the smooth law falls from stiction to Coulomb over this many widths v_r of its rise. Its
    peak is scaled so that its greatest value is the stiction force, or every breakaway would come early.
    """

    mass: float = 1.0
    stiffness: float = 100.0
    speed: float = 0.2
    stiction: float = 10.0
    coulomb: float = 6.0
    cycles: int = 50
    drop_ratio: float = 3.0
    bands: tuple[int, int] = (1, 1)

    @property
    def stop(self) -> float:
        """Time of `cycles` full cycles [s]."""
        drop = self.stiction - self.coulomb
        frequency = np.sqrt(self.stiffness / self.mass)
        slip = 2.0 * (np.pi - np.arctan(drop / (self.speed * np.sqrt(self.stiffness * self.mass)))) / frequency
        return float(self.cycles * (slip + 2.0 * drop / (self.stiffness * self.speed)))

    @cached_property
    def peak(self) -> float:
        """Height A [N] of the bump, so that tanh(u) (F_k + A exp(-(u/r)^2)) has its maximum at F_s."""
        u = np.linspace(0.0, 5.0 * self.drop_ratio, 200_001)
        rise, bump = np.tanh(u), np.tanh(u) * np.exp(-((u / self.drop_ratio) ** 2))

        def missing(height: float) -> float:
            return float((self.coulomb * rise + height * bump).max()) - self.stiction

        return float(brentq(missing, 0.0, 10.0 * self.stiction, xtol=1e-13))

    def initial(self) -> tuple[np.ndarray, np.ndarray]:
        """State and zones at t = 0."""
        return np.array([0.0, self.speed]), np.zeros(1, dtype=int)

    def smooth_rhs(self, _t: float, y: np.ndarray, width: float) -> np.ndarray:
        """dy/dt with the friction force tanh(u/v_r) (F_k + A exp(-(u/v_s)^2)), u the slip speed."""
        slip = y[1] - self.speed
        peak = self.peak * np.exp(-((slip / (self.drop_ratio * width)) ** 2))
        force = np.tanh(slip / width) * (self.coulomb + peak)
        return np.array([y[1], (-self.stiffness * y[0] - force) / self.mass])

    def smooth_jacobian(self, _t: float, y: np.ndarray, width: float) -> np.ndarray:
        """Derivative of smooth_rhs, dense."""
        slip, decay = y[1] - self.speed, self.drop_ratio * width
        peak = self.peak * np.exp(-((slip / decay) ** 2))
        rise = np.tanh(slip / width)
        slope = (1.0 - rise**2) / width * (self.coulomb + peak) - rise * 2.0 * slip / decay**2 * peak
        return np.array([[0.0, 1.0], [-self.stiffness / self.mass, -slope / self.mass]])

    def zone_rhs(self, _t: float, y: np.ndarray, zones: np.ndarray) -> np.ndarray:
        """dy/dt while the block sticks (0) or slips backwards on the belt (-1)."""
        if zones[0] == 0:
            return np.array([self.speed, 0.0])
        return np.array([y[1], (-self.stiffness * y[0] - zones[0] * self.coulomb) / self.mass])

    def zone_jacobian(self, _t: float, _y: np.ndarray, zones: np.ndarray) -> np.ndarray:
        """Derivative of zone_rhs, dense."""
        if zones[0] == 0:
            return np.zeros((2, 2))
        return np.array([[0.0, 1.0], [-self.stiffness / self.mass, 0.0]])

    def guards(self, _t: float, y: np.ndarray, zones: np.ndarray) -> np.ndarray:
        """Negative while the zone lasts: spring below stiction [N], or slip not yet over [m/s]."""
        if zones[0] == 0:
            return np.array([self.stiffness * abs(y[0]) - self.stiction])
        return -zones * (y[1] - self.speed)

    def switch(self, _t: float, y: np.ndarray, zones: np.ndarray, _fired: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """State and zones after a guard fired: the belt's own two phases."""
        if zones[0] == 0:
            return y, np.array([-int(np.sign(y[0]))])
        return np.array([y[0], self.speed]), np.array([0])


@dataclass(frozen=True)
class Chain:
    """A rod of 10 kg and EA = 1000 N over 1 m on a rough floor, cut into `blocks`; its right end is pulled.

    Springs between neighbours 1000 N stiffness (N blocks, N/m), dampers 0.002 s times that; contact i holds
    (50/N)(1 + 0.3 sin(1.7 i + 0.3)) newtons. The right end hangs on a spring 2000 N/m and a damper 4 N s/m
    whose far end moves by 0.05 t + 0.04 sin(2 pi t). From rest, 3 s.
    """

    blocks: int = 100
    stop: float = 3.0
    stiffness: float = 1000.0
    damping_time: float = 0.002
    pull_stiffness: float = 2000.0
    pull_damping: float = 4.0
    total_mass: float = 10.0
    total_friction: float = 50.0
    bands: tuple[int, int] = (3, 3)
    _plan: dict = field(default_factory=dict, repr=False, compare=False)

    @property
    def spring(self) -> float:
        """Stiffness between neighbours [N/m]."""
        return self.stiffness * self.blocks

    @property
    def mass(self) -> float:
        """Mass of one block [kg]."""
        return self.total_mass / self.blocks

    @property
    def limit(self) -> np.ndarray:
        """Coulomb force of each contact [N]; stiction is the same."""
        i = np.arange(self.blocks)
        return self.total_friction / self.blocks * (1.0 + 0.3 * np.sin(1.7 * i + 0.3))

    def initial(self) -> tuple[np.ndarray, np.ndarray]:
        """State and zones at t = 0."""
        return np.zeros(2 * self.blocks), np.zeros(self.blocks, dtype=int)

    def pull(self, t: float) -> tuple[float, float]:
        """Position [m] and speed [m/s] of the pulled end of the drive spring."""
        turn = 2.0 * np.pi
        return 0.05 * t + 0.04 * np.sin(turn * t), 0.05 + 0.04 * turn * np.cos(turn * t)

    def elastic(self, t: float, y: np.ndarray) -> np.ndarray:
        """Force of springs and dampers on each block [N]."""
        x, v = y[0::2], y[1::2]
        spring = self.spring
        tension = spring * (x[1:] - x[:-1]) + self.damping_time * spring * (v[1:] - v[:-1])
        force = np.zeros(self.blocks)
        force[:-1] += tension
        force[1:] -= tension
        position, speed = self.pull(t)
        force[-1] += self.pull_stiffness * (position - x[-1]) + self.pull_damping * (speed - v[-1])
        return force

    def smooth_rhs(self, t: float, y: np.ndarray, width: float) -> np.ndarray:
        """dy/dt with friction f_i tanh(v_i/v_r)."""
        limit = self._arrays()["limit"]
        dy = np.empty_like(y)
        dy[0::2] = y[1::2]
        dy[1::2] = (self.elastic(t, y) - limit * np.tanh(y[1::2] / width)) / self.mass
        return dy

    def smooth_jacobian(self, _t: float, y: np.ndarray, width: float) -> csc_matrix:
        """Derivative of smooth_rhs, sparse."""
        plan = self._arrays()
        data = plan["data"].copy()
        rise = np.tanh(y[1::2] / width)
        data[plan["diagonal"]] -= plan["limit"] * (1.0 - rise**2) / (width * self.mass)
        return csc_matrix((data, plan["indices"], plan["indptr"]), shape=(y.size, y.size))

    def zone_rhs(self, t: float, y: np.ndarray, zones: np.ndarray) -> np.ndarray:
        """dy/dt with the zones fixed; a stuck block does not move at all."""
        dy = np.empty_like(y)
        dy[0::2] = y[1::2]
        dy[1::2] = np.where(zones == 0, 0.0, (self.elastic(t, y) - zones * self._arrays()["limit"]) / self.mass)
        return dy

    def zone_jacobian(self, _t: float, y: np.ndarray, zones: np.ndarray) -> csc_matrix:
        """Derivative of zone_rhs, sparse: the speed rows of stuck blocks are empty."""
        plan = self._arrays()
        moves = np.ones(y.size)
        moves[1::2] = zones != 0
        return csc_matrix((plan["data"] * moves[plan["indices"]], plan["indices"], plan["indptr"]), shape=(y.size,) * 2)

    def guards(self, t: float, y: np.ndarray, zones: np.ndarray) -> np.ndarray:
        """Negative while the zone lasts: holding force below its limit (relative), or still sliding (m/s)."""
        limit = self._arrays()["limit"]
        return np.where(zones == 0, np.abs(self.elastic(t, y)) / limit - 1.0, -zones * y[1::2])

    def switch(self, t: float, y: np.ndarray, zones: np.ndarray, fired: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """A block at rest sticks if held, else turns; one that breaks away follows the force on it."""
        y, zones = y.copy(), zones.copy()
        y[1::2][fired] = 0.0
        force = self.elastic(t, y)
        broke = fired & (zones == 0)
        holds = np.abs(force) <= self._arrays()["limit"]
        zones[fired] = np.where(holds & ~broke, 0, np.sign(force)).astype(int)[fired]
        return y, zones

    def _arrays(self) -> dict:
        """Friction limits and the constant part of the Jacobian with its pattern, made once."""
        if not self._plan:
            self._plan.update(limit=self.limit, **self._pattern())
        return self._plan

    def _pattern(self) -> dict:
        n = self.blocks
        couple = np.zeros((n, n))
        for i in range(n - 1):
            couple[i, i] -= 1.0
            couple[i + 1, i + 1] -= 1.0
            couple[i, i + 1] = couple[i + 1, i] = 1.0
        stiff, damp = self.spring * couple, self.damping_time * self.spring * couple
        stiff[-1, -1] -= self.pull_stiffness
        damp[-1, -1] -= self.pull_damping
        full = np.zeros((2 * n, 2 * n))
        full[1::2, 0::2], full[1::2, 1::2] = stiff / self.mass, damp / self.mass
        full[np.arange(0, 2 * n, 2), np.arange(1, 2 * n, 2)] = 1.0
        matrix = csc_matrix(full)
        matrix.sort_indices()
        column = np.repeat(np.arange(2 * n), np.diff(matrix.indptr))
        diagonal = np.flatnonzero((matrix.indices == column) & (column % 2 == 1))
        return {"data": matrix.data, "indices": matrix.indices, "indptr": matrix.indptr, "diagonal": diagonal}
