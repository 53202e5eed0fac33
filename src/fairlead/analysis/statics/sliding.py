"""Tension along a line that slides steadily, in closed form: capstans, guides, slopes, the sea.

Per length of line in a piece of route, sliding in direction d (+1 outboard),

    dT/ds = d mu (pressed + |T| curvature) - fall - drag + inertia          (|T|: max(T, 0) where nothing is outside)

which is linear, so that T exp(d mu curvature s) and its sums with a straight line solve it. With d = +-1 and the
friction from rest it gives the cone of tensions that can be held. Where friction grows as the load per length to a
power (`load_exponent`), the bracket is q_ref (q/q_ref)^n, and Runge and Kutta's method solves it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

LARGEST = 700.0  # of what a float can be, e to that
SHORT = 1e-12  # of an exponent: below it the tension changes along a straight line
STEPS = 32  # of a piece, where friction is no straight line: of the order four, 1e-8 of a turn at mu = 0.5


@dataclass(frozen=True)
class Piece:
    """A piece of route on which nothing changes.

    `curvature` [1/m]; `pressed` [N/m] what presses besides tension; `load` [N/m] all that acts outboard per length
    beside friction: fall + drag, less inertia; `all_round`: the line is held from outside too; `lightened` [N]: mass
    per length times speed squared, by which a line that runs round a curve presses as if its tension were less.
    Friction grows as the load per length to the `exponent`, from what it is at `reference` [N/m].
    """

    begin: float
    end: float
    curvature: float = 0.0
    pressed: float = 0.0
    load: float = 0.0
    all_round: bool = False
    lightened: float = 0.0
    exponent: float = 1.0
    reference: float = 1.0

    @property
    def length(self) -> float:
        """Length [m]."""
        return self.end - self.begin

    def counts(self, load: Any) -> Any:
        """What of a load per length [N/m] friction is in proportion to; of a number or an array."""
        return counts(load, self.exponent, self.reference)

    def part(self, begin: float, end: float) -> Piece | None:
        """What of it lies between two places; None when nothing does."""
        begin, end = max(begin, self.begin), min(end, self.end)
        return replace(self, begin=begin, end=end) if end > begin else None


def counts(load: Any, exponent: float, reference: float) -> Any:
    """What of a load [N/m] friction is in proportion to that grows as a power of it; of a number or an array."""
    return load if exponent == 1.0 else reference * (load / reference) ** exponent


def beyond(piece: Piece, tension: float, friction: float, run: float) -> float:
    """Tension [N] after `run` [m] (outboard positive) from where it is `tension`; `friction` is d mu."""
    return piece.lightened + _presses(piece, tension - piece.lightened, friction, run)


def _presses(piece: Piece, tension: float, friction: float, run: float) -> float:
    """The same for the tension that presses; where it changes its sign, the wall changes."""
    if piece.exponent != 1.0:
        return _by_runge_and_kutta(piece, tension, friction, run)
    while True:
        sign = 1.0 if tension > 0 or (tension == 0 and _slope(piece, friction, 0.0) * run > 0) else -1.0
        wall = sign if sign > 0 or piece.all_round else 0.0  # +1 inner wall, -1 outer wall, 0 none
        rate, straight = friction * piece.curvature * wall, friction * piece.pressed - piece.load
        turn = _vanishes(tension, rate, straight)
        if turn is None or not 0 < turn / run < 1:
            return _linear(tension, rate, straight, run)
        tension, run = 0.0, run - turn
        if straight == 0:
            return 0.0


def _by_runge_and_kutta(piece: Piece, tension: float, friction: float, run: float) -> float:
    """The same where friction is no straight line over the tension."""
    h = run / STEPS
    for _ in range(STEPS):
        k1 = _slope_by_power(piece, friction, tension)
        k2 = _slope_by_power(piece, friction, tension + h / 2 * k1)
        k3 = _slope_by_power(piece, friction, tension + h / 2 * k2)
        tension += h / 6 * (k1 + 2 * (k2 + k3) + _slope_by_power(piece, friction, tension + h * k3))
    return tension


def _slope_by_power(piece: Piece, friction: float, tension: float) -> float:
    wall = piece.curvature * (abs(tension) if piece.all_round else max(tension, 0.0))
    return friction * float(piece.counts(piece.pressed + wall)) - piece.load


def along(
    piece: Piece, tension: float, friction: float, places: NDArray[np.float64], *, begin: bool
) -> NDArray[np.float64]:
    """Tensions [N] at places of the piece (n,), at whose begin (or end) it is `tension`."""
    runs = places - (piece.begin if begin else piece.end)
    return np.array([beyond(piece, tension, friction, float(run)) if run else tension for run in runs])


def _slope(piece: Piece, friction: float, tension: float) -> float:
    return friction * (piece.pressed + tension * piece.curvature) - piece.load


def _linear(tension: float, rate: float, straight: float, run: float) -> float:
    """Solution of dT/ds = rate T + straight."""
    if abs(rate * run) < SHORT:
        return tension + straight * run
    if rate * run > LARGEST:  # a line that nothing could haul
        return math.copysign(math.inf, tension + straight / rate)
    return tension * math.exp(rate * run) + straight * math.expm1(rate * run) / rate


def _vanishes(tension: float, rate: float, straight: float) -> float | None:
    """Where the solution is zero, from here; None if nowhere or here."""
    if tension == 0:
        return None
    if rate == 0:
        return -tension / straight if straight else None
    inside = straight / (rate * tension + straight) if rate * tension + straight else 0.0
    return math.log(inside) / rate if inside > 0 else None
