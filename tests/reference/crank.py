"""A body that follows a shaft by x = X(angle), in the one coordinate of the shaft: no constraint, no projection.

    (J + m X'^2) angle'' + m X' X'' angle'^2 = torque(t) + force X'

force: what acts on the body along x, friction included. Friction of the body sticks at standstill of the shaft, up to
`stiction`, and changes its sign where X' goes through zero while the shaft turns: both are events of the integration,
by DOP853 (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.5) at rtol 1e-12.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

Path = Callable[[float], tuple[float, float, float]]


def crank(radius: float, rod: float, offset: float = 0.0) -> Path:
    """X, X', X'' of a crank and its rod."""

    def path(angle):
        s, c = np.sin(angle), np.cos(angle)
        d = radius * s - offset
        root = np.sqrt(rod**2 - d**2)
        first = -radius * s - radius * c * d / root
        second = -radius * c + (radius * s * d - (radius * c) ** 2) / root - (radius * c * d) ** 2 / root**3
        return radius * c + root, first, second

    return path


@dataclass
class Follower:
    """The machine; `force(x, v)` acts on the body along x besides its friction."""

    path: Path
    moment: float
    mass: float
    torque: Callable[[float], float] = lambda t: 0.0
    force: Callable[[float], float] = lambda x: 0.0
    stiction: float = 0.0
    coulomb: float = 0.0

    def inertia(self, angle: float) -> float:
        """Inertia of all at the shaft."""
        return self.moment + self.mass * self.path(angle)[1] ** 2

    def energy(self, angle, speed):
        """Kinetic energy."""
        return self.inertia(angle) * speed**2 / 2

    def rates(self, t: float, y: np.ndarray, friction: float) -> list[float]:
        """Speed and acceleration of the shaft; `friction` is the force on the body along x."""
        x, first, second = self.path(y[0])
        push = self.torque(t) + (self.force(x) + friction) * first - self.mass * first * second * y[1] ** 2
        return [y[1], push / self.inertia(y[0])]

    def at(self, times, angle: float, speed: float) -> np.ndarray:
        """(angle, speed) at each of `times`, rows; the first is the start."""
        made, t, y = np.zeros((len(times), 2)), times[0], np.array([angle, speed])
        sense = 0.0 if self.coulomb == 0 else float(np.sign(self.path(angle)[1] * speed))
        if self.coulomb > 0 and speed == 0.0 and abs(self.needed(t, angle)) > self.stiction:
            sense = -float(np.sign(self.needed(t, angle)))
        while t < times[-1]:
            here = (times >= t) & (times <= times[-1])
            stuck = self.coulomb > 0 and sense == 0.0
            piece = solve_ivp(
                (lambda t, y: [0.0, 0.0]) if stuck else (lambda t, y, s=sense: self.rates(t, y, -s * self.coulomb)),
                (t, times[-1]), y, method="DOP853", rtol=1e-12, atol=1e-14, dense_output=True,
                max_step=0.01 if stuck else np.inf, events=self._events(stuck, sense),
            )  # fmt: skip
            inside = here & (times <= piece.t[-1])
            if inside.any():
                made[inside] = piece.sol(times[inside]).T
            t, y = piece.t[-1], piece.y[:, -1]
            if piece.status == 1:
                sense, y = self._after(t, y, stuck, sense)
        return made

    def needed(self, t: float, angle: float) -> float:
        """The friction that keeps the shaft at rest."""
        x, first, _ = self.path(angle)
        return -self.torque(t) / first - self.force(x)

    def _events(self, stuck: bool, sense: float) -> list:
        """Stuck: friction is used up. Else: the speed of the body comes to zero, from the side of its sense."""
        if self.coulomb == 0:
            return []

        def used_up(t, y):
            return self.stiction - abs(self.needed(t, y[0]))

        def stops(t, y):
            return sense * self.path(y[0])[1] * y[1]

        one = used_up if stuck else stops
        one.terminal, one.direction = True, -1
        return [one]

    def _after(self, t, y, stuck, sense):
        """The sense from now on, 0 if the body sticks, and the state: it stopped with the shaft, or in dead centre."""
        if not stuck and abs(self.path(y[0])[1]) < abs(y[1]) * 1e-3:
            return -sense, y
        needed = self.needed(t, y[0])
        sticks = not stuck and abs(needed) <= self.stiction
        return (0.0 if sticks else -np.sign(needed)), np.array([y[0], 0.0])
