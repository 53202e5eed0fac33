"""The equations of motion of the single bend, written down once more: right-hand side and analytic Jacobian.

Every node carries a hose mass and a core mass; springs and dampers join neighbours, the core pulls only. Both
contacts of a node are a function of the slip speed alone, without zones, hysteresis or latch,

    line:   T = sgn(v) min(g0 |v|, N mu(|v|)),      g0 = 1.25 N mu_s/v_c
    tanh:   T = N mu(|v|) tanh(v/v_c)

the first being what the robust binding law amounts to (physics 1.10, remark). N_12 follows from both tensions
at the node and the window at the hose's place, N_23 from the core tension and the window at the core's place
(physics 3.3, 4.0). Each counts the arc that the node has, half the way between its neighbours of that layer.
End connectors are merged: node 0 is driven, node n is one mass.
"""

from typing import NamedTuple

import numpy as np
from bend_scene import BendScene
from scipy.sparse import csc_matrix


class Motion(NamedTuple):
    """Positions and speeds of all nodes, each of shape (n + 1,)."""

    hose: np.ndarray
    core: np.ndarray
    hose_speed: np.ndarray
    core_speed: np.ndarray


class Forces(NamedTuple):
    """What the Jacobian and the tables need of one evaluation; (n,) per element, (n + 1,) per node."""

    hose_tension: np.ndarray
    core_tension: np.ndarray
    taut: np.ndarray
    load: np.ndarray
    core_load: np.ndarray
    guide: np.ndarray
    guide_slope: np.ndarray
    bulkhead: np.ndarray
    bulkhead_slope: np.ndarray


def friction(v: np.ndarray, stiction: float, coulomb: float, decay: float, creep: float, law: str) -> tuple:
    """Friction coefficient with sign, and its slope, at slip speeds `v` [m/s]."""
    bump = (stiction - coulomb) * np.exp(-((v / decay) ** 2))
    sliding, falling = coulomb + bump, -2.0 * np.abs(v) / decay**2 * bump
    if law == "tanh":
        rise = np.tanh(v / creep)
        return sliding * rise, sliding * (1.0 - rise**2) / creep + falling * np.abs(rise)
    steep = 1.25 * stiction / creep
    bound = steep * np.abs(v) < sliding
    return np.where(bound, steep * v, np.sign(v) * sliding), np.where(bound, steep, falling)


def node_mean(tension: np.ndarray) -> np.ndarray:
    """Mean tension of the elements next to each node [N]; the one element at the ends."""
    return np.concatenate([tension[:1], 0.5 * (tension[:-1] + tension[1:]), tension[-1:]])


class Bend:
    """Right-hand side and Jacobian; y = (x_h, x_c, v_h, v_c) of nodes 1..n-1, (x, v) of node n, two works."""

    def __init__(self, scene: BendScene, law: str) -> None:
        if scene.by_place:
            raise ValueError("loads by place are only in the convex engine")
        self.scene, self.law, self.n = scene, law, scene.elements
        self.hose_k, self.core_k = scene.hose_stiffness / scene.pitch, scene.core_stiffness / scene.pitch
        self.hose_c = 2.0 * scene.damping_ratio * np.sqrt(scene.hose_stiffness * scene.hose_mass)
        self.core_c = 2.0 * scene.damping_ratio * np.sqrt(scene.core_stiffness * scene.core_mass)
        self.hose_rest = scene.pitch - scene.outboard * scene.hose_share / self.hose_k
        self.core_rest = scene.pitch - scene.outboard * (1.0 - scene.hose_share) / self.core_k
        self.hose_m, self.core_m = scene.hose_mass * scene.node_length, scene.core_mass * scene.node_length
        self.end_m = self.hose_m[-1] + self.core_m[-1]
        self.borders = np.tile([[-0.5], [0.0], [0.5]], self.n + 1)  # slopes of an arc to the node before, itself, after
        self.borders[:, 0], self.borders[:, -1] = (0.0, -0.5, 0.5), (-0.5, 0.5, 0.0)
        self.size = 4 * (self.n - 1) + 4
        self._plan_pattern()

    def initial(self) -> np.ndarray:
        """State at rest under uniform tension."""
        y = np.zeros(self.size)
        inner = y[: 4 * (self.n - 1)].reshape(-1, 4)
        inner[:, 0] = inner[:, 1] = self.scene.start[1:-1]
        y[-4] = self.scene.start[-1]
        return y

    def motion(self, t: float, y: np.ndarray) -> Motion:
        """All nodes, the driven and the merged one included."""
        drive = self.scene.haul(t)
        inner = y[: 4 * (self.n - 1)].reshape(-1, 4)
        ends = ((drive[0], y[-4]), (drive[0], y[-4]), (drive[1], y[-3]), (drive[1], y[-3]))
        return Motion(*(np.concatenate([[a], inner[:, j], [b]]) for j, (a, b) in enumerate(ends)))

    def forces(self, m: Motion) -> Forces:
        """Tensions, loads and friction coefficients."""
        sc = self.scene
        hose = self.hose_k * (np.diff(m.hose) - self.hose_rest) + self.hose_c * np.diff(m.hose_speed)
        stretch = np.diff(m.core) - self.core_rest
        core = self.core_k * stretch + self.core_c * np.diff(m.core_speed)
        taut = (stretch > 0.0) & (core > 0.0)
        core = np.where(taut, core, 0.0)
        load = np.maximum(node_mean(hose + core), 0.0) * self.turn(m.hose)
        core_load = node_mean(core) * self.turn(m.core)
        guide = friction(m.hose_speed, sc.mu, sc.mu, 1.0, sc.creep, self.law)
        slip = m.core_speed - m.hose_speed
        decay = sc.stribeck_speed
        bulkhead = friction(slip, sc.bulkhead_stiction, sc.bulkhead_coulomb, decay, sc.creep, self.law)
        return Forces(hose, core, taut, load, core_load, *guide, *bulkhead)

    def turn(self, place: np.ndarray) -> np.ndarray:
        """Angle that each node stands for [rad], of nodes at these places of one layer."""
        middle = 0.5 * (place[:-1] + place[1:])
        return np.diff(middle, prepend=place[0], append=place[-1]) / self.scene.radius

    def rhs(self, t: float, y: np.ndarray) -> np.ndarray:
        """dy/dt."""
        m = self.motion(t, y)
        f = self.forces(m)
        on_guide = f.load * self.scene.window(m.hose) * f.guide
        on_core = f.core_load * self.scene.window(m.core) * f.bulkhead
        hose = np.diff(f.hose_tension, prepend=0.0, append=self.scene.outboard) - on_guide + on_core
        core = np.diff(f.core_tension, prepend=0.0, append=0.0) - on_core
        dy = np.empty_like(y)
        inner = dy[: 4 * (self.n - 1)].reshape(-1, 4)
        inner[:, 0], inner[:, 1] = m.hose_speed[1:-1], m.core_speed[1:-1]
        inner[:, 2], inner[:, 3] = hose[1:-1] / self.hose_m[1:-1], core[1:-1] / self.core_m[1:-1]
        dy[-4], dy[-3] = y[-3], (hose[-1] + core[-1]) / self.end_m
        dy[-2] = on_guide @ m.hose_speed
        dy[-1] = on_core @ (m.core_speed - m.hose_speed)
        return dy

    def jacobian(self, t: float, y: np.ndarray) -> csc_matrix:
        """Analytic d(dy/dt)/dy along the fixed pattern; the rows of the two works are left out.

        That is harmless: nothing depends on the works, so Newton only finds them one iteration later.
        """
        values = np.concatenate([self._force_slopes(t, y).ravel(), np.ones(2 * (self.n + 1))])
        data = np.bincount(self.slot, weights=values[self.kept] / self.weight, minlength=self.nnz)
        return csc_matrix((data, self.indices, self.indptr), shape=(self.size, self.size))

    def _force_slopes(self, t: float, y: np.ndarray) -> np.ndarray:
        """d(force)/d(motion), shape (2 forces, 4 motions, 3 neighbours, n + 1 nodes)."""
        m = self.motion(t, y)
        f = self.forces(m)
        s = self.scene
        in_hose, in_core = s.window(m.hose), s.window(m.core)
        share = np.full(self.n + 1, 0.5)
        share[[0, -1]] = 1.0
        press = share * self.turn(m.hose) * in_hose * f.guide * (f.load > 0.0)
        squeeze = share * self.turn(m.core) * in_core * f.bulkhead
        out = np.zeros((2, 4, 3, self.n + 1))
        total, inner = node_mean(f.hose_tension + f.core_tension), node_mean(f.core_tension)
        out[0, 0] -= np.maximum(total, 0.0) * in_hose * f.guide * self.borders / s.radius
        out[0, 1] += inner * in_core * f.bulkhead * self.borders / s.radius
        out[1, 1] -= inner * in_core * f.bulkhead * self.borders / s.radius
        for motion, k, c in ((0, self.hose_k, self.hose_c), (1, self.core_k, self.core_c)):
            on = f.taut if motion else np.ones(self.n)
            gains = (
                ((-1.0 - press, 1.0 - press), None)
                if motion == 0
                else ((squeeze - press, squeeze - press), (-1.0 - squeeze, 1.0 - squeeze))
            )
            for force, gain in enumerate(gains):
                if gain is not None:
                    out[force, motion] += k * stencil(*gain, on)
                    out[force, motion + 2] += c * stencil(*gain, on)
        eps = 1e-7 * s.edge
        rub, drag = f.load * in_hose * f.guide_slope, f.core_load * in_core * f.bulkhead_slope
        out[0, 0, 1] -= f.load * f.guide * (s.window(m.hose + eps) - in_hose) / eps
        moved = f.core_load * f.bulkhead * (s.window(m.core + eps) - in_core) / eps
        out[0, 1, 1] += moved
        out[1, 1, 1] -= moved
        out[0, 2, 1] -= rub + drag
        out[0, 3, 1] += drag
        out[1, 2, 1] += drag
        out[1, 3, 1] -= drag
        return out

    def _plan_pattern(self) -> None:
        """Where each slope goes in the compressed matrix: nodes 0 dropped, the last one merged."""
        n = self.n
        column = np.full((4, n + 3), -1)  # shifted by one: neighbours of the ends exist and are dropped
        column[:, 2 : n + 1] = np.arange(4 * (n - 1)).reshape(-1, 4).T
        column[:, n + 1] = [4 * n - 4, 4 * n - 4, 4 * n - 3, 4 * n - 3]
        node = np.arange(1, n + 2)
        rows = np.broadcast_to(column[2:, None, None, node], (2, 4, 3, n + 1))
        cols = np.stack([column[:, node + d] for d in (-1, 0, 1)], axis=1)
        mass = np.stack([self.hose_m, self.core_m])
        mass[:, -1] = self.end_m
        rows = np.concatenate([rows.ravel(), column[:2, node].ravel()])
        cols = np.concatenate([np.broadcast_to(cols, (2, 4, 3, n + 1)).ravel(), column[2:, node].ravel()])
        weight = np.concatenate([np.broadcast_to(mass[:, None, None], (2, 4, 3, n + 1)).ravel(), np.ones(2 * n + 2)])
        weight[-1] = 2.0  # the merged node says x' = v twice
        weight[-n - 2] = 2.0
        self.kept = (rows >= 0) & (cols >= 0)
        self.weight = weight[self.kept]
        place, self.slot = np.unique(cols[self.kept] * self.size + rows[self.kept], return_inverse=True)
        self.nnz, self.indices = place.size, place % self.size
        self.indptr = np.searchsorted(place // self.size, np.arange(self.size + 1))


def stencil(left: np.ndarray, right: np.ndarray, on: np.ndarray) -> np.ndarray:
    """Slopes of left*T_{i-1} + right*T_i to nodes i-1, i, i+1 at unit stiffness; shape (3, n + 1)."""
    before = left * np.concatenate([[0.0], on])
    after = right * np.concatenate([on, [0.0]])
    return np.stack([-before, before - after, after])
