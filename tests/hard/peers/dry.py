"""Bodies with springs and dry contacts as plain numbers, and the zones of their contacts: what a careful user of a
solver with events would write. Nothing here imports fairlead.

    M a = load(t) - springs - G' F        slip = G v - belt(t)
    zone 0   the slip stays zero; F is what that takes, at most `stiction`
    zone 1, -1   F = zone times `sliding`
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Reals = NDArray[np.float64]
Zones = NDArray[np.int64]
EQUAL = 1e-9
"""Shares of a limit within which contacts let go together, and slip [m/s] that is none: both are rounding."""


@dataclass(frozen=True)
class Dry:
    """One case; n bodies, m contacts."""

    mass: Reals
    speed: Reals
    """At the start; all positions are zero there."""
    load: Callable[[float], Reals]
    slip: Reals
    """(m, n), G."""
    stiction: Callable[[float], Reals]
    sliding: Callable[[float], Reals]
    springs: tuple[tuple[int, int, float, float], ...] = ()
    """Two bodies, stiffness [N/m], damping [N s/m]."""
    belt: Callable[[float], float] = lambda _t: 0.0
    """Speed of the surface under all contacts [m/s]; constant between `breaks`."""
    breaks: tuple[float, ...] = ()
    """Times at which a load, a limit or the belt is not smooth; every tool starts anew there."""

    @property
    def bodies(self) -> int:
        """n."""
        return len(self.mass)

    @cached_property
    def stiffness(self) -> Reals:
        """(n, n)."""
        return self._joined(2)

    @cached_property
    def damping(self) -> Reals:
        """(n, n)."""
        return self._joined(3)

    def _joined(self, which: int) -> Reals:
        joined = np.zeros((self.bodies, self.bodies))
        for spring in self.springs:
            ends = np.zeros(self.bodies)
            ends[[spring[0], spring[1]]] = 1.0, -1.0
            joined += spring[which] * np.outer(ends, ends)
        return joined

    def forces(self, t: float, y: Reals, zones: Zones) -> tuple[Reals, Reals]:
        """Accelerations (n,) and contact forces (m,) while the zones last; y is positions, then speeds."""
        x, v = y[: self.bodies], y[self.bodies :]
        friction = zones * self.sliding(t)
        free = self.load(t) - self.stiffness @ x - self.damping @ v - self.slip.T @ friction
        held = np.flatnonzero(zones == 0)
        if held.size:
            rows = self.slip[held]
            friction[held] = np.linalg.solve((rows / self.mass) @ rows.T, rows @ (free / self.mass))
            free = free - rows.T @ friction[held]
        return free / self.mass, friction

    def rates(self, t: float, y: Reals, zones: Zones) -> Reals:
        """dy/dt (2n,)."""
        return np.concatenate([y[self.bodies :], self.forces(t, y, zones)[0]])

    def guards(self, t: float, y: Reals, zones: Zones) -> Reals:
        """(m,), negative while the zone lasts: force over stiction [N], or slip back through zero [m/s]."""
        slips = self.slip @ y[self.bodies :] - self.belt(t)
        return np.where(zones == 0, np.abs(self.forces(t, y, zones)[1]) - self.stiction(t), -zones * slips)

    def settled(self, t: float, y: Reals, zones: Zones, fired: Zones | None = None) -> tuple[Reals, Zones]:
        """State and zones from t on: what stands still is held; of what is overloaded the first to give way lets go,
        as in a load that is built up, until nothing is overloaded. `fired` are contacts whose guard has just risen."""
        slips = self.slip @ y[self.bodies :] - self.belt(t)
        stopped = (np.abs(slips) < EQUAL) if fired is None else np.isin(np.arange(len(zones)), fired) & (zones != 0)
        zones = np.where(stopped, 0, zones)
        zones = np.where((zones == 0) & (np.abs(slips) > 1e-6), np.sign(slips), zones).astype(np.int64)
        if fired is not None:
            broke = [k for k in fired if zones[k] == 0 and not stopped[k]]
            zones[broke] = np.sign(self.forces(t, y, zones)[1][broke])
        y = self._without_slip(t, y, zones)
        for _ in range(len(zones)):
            force = np.where(zones == 0, np.abs(self.forces(t, y, zones)[1]) / np.maximum(self.stiction(t), 1e-300), 0)
            if force.max() <= 1.0 + EQUAL:
                break
            worst = force >= force.max() * (1.0 - EQUAL)
            zones = np.where(worst, np.sign(self.forces(t, y, zones)[1]), zones).astype(np.int64)
        return y, zones

    def _without_slip(self, t: float, y: Reals, zones: Zones) -> Reals:
        """The same, the slip of held contacts taken away to the last digit."""
        held = np.flatnonzero(zones == 0)
        if not held.size:
            return y
        rows, y = self.slip[held], y.copy()
        left = rows @ y[self.bodies :] - self.belt(t)
        y[self.bodies :] -= (rows / self.mass).T @ np.linalg.solve((rows / self.mass) @ rows.T, left)
        return y
