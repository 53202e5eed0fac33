"""Piecewise polynomials: x-y tables and quantities given in time, ready for kernels.

A table becomes rows  [left, right, reference, c0, c1, c2, c3, c4],  one a piece: between left and
right its value is  c0 + c1 s + ... + c4 s^4,  s = x - reference. A kernel is told which piece is in
force and never compares x; outside its piece the polynomial simply continues, so a law stays smooth
while a step is tried.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

DEGREE = 4
LEFT, RIGHT, REFERENCE, TERMS = range(4)
"""Positions in a row; TERMS is that of c0."""
STRIDE = TERMS + DEGREE + 1
"""Numbers in a row."""
FAR = 1e300
"""Stands for infinity at the ends, where a kernel may still multiply by zero."""
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Sine:
    """amplitude * sin(omega t + phase), added to a waveform."""

    amplitude: float = 0.0
    omega: float = 0.0
    phase: float = 0.0


@dataclass(frozen=True)
class PiecewisePolynomial:
    """Pieces, as `rows` (k, STRIDE) in the layout above, ordered, without gaps.

    Pieces may overlap: each is then left at its own ends only, as with hysteresis. A run begins in piece `begin` and
    finds the right one from there.
    """

    rows: Floats
    begin: int = 0

    @property
    def left(self) -> Floats:
        """Where each piece begins (k,)."""
        return self.rows[:, LEFT]

    @property
    def right(self) -> Floats:
        """Where each piece ends (k,)."""
        return self.rows[:, RIGHT]

    @property
    def terms(self) -> Floats:
        """The coefficients of each piece (k, DEGREE + 1), the constant first."""
        return self.rows[:, TERMS:]

    @property
    def borders(self) -> list[float]:
        """Where one piece follows another (k - 1)."""
        return [float(x) for x in self.left[1:]]

    @property
    def never_changes(self) -> bool:
        """True for a constant."""
        return len(self.rows) == 1 and not self.terms[0, 1:].any()

    def piece_at(self, x: float) -> int:
        """The piece that holds x; at a border the right one."""
        begun = int(self.left.searchsorted(x, side="right"))
        return min(max(begun - 1, 0), len(self.rows) - 1)

    def __call__(self, x: float) -> float:
        """Value at x."""
        return _value(self.rows[self.piece_at(x)], x)

    @cached_property
    def is_continuous(self) -> bool:
        """True if the pieces meet, each at the end of the one before, with the same value."""
        size, at = np.abs(self.terms[:, 0]).max(initial=1e-300), self.left[1:]
        jumps = np.abs(_values(self.rows[:-1], at) - _values(self.rows[1:], at))
        return bool((self.right[:-1] == at).all() and (jumps <= 1e-9 * size).all())

    def jump_at(self, x: float) -> float:
        """How far the value rises at once at x; zero where no piece begins."""
        k = int(np.searchsorted(self.left, x))
        begins = 0 < k < len(self.rows) and self.left[k] == x
        return _value(self.rows[k], x) - _value(self.rows[k - 1], x) if begins else 0.0

    def integral(self, start: float) -> PiecewisePolynomial:
        """Antiderivative that is zero at `start`; raises ValueError for pieces of a degree above three."""
        if np.any(self.terms[:, DEGREE] != 0):
            raise ValueError("a piece of degree four cannot be integrated in this layout")
        whole = PiecewisePolynomial(self.rows.copy())
        whole.terms[:, 1:] = self.terms[:, :-1] / np.arange(1, DEGREE + 1)
        whole.terms[:, 0] = 0.0
        for before, row in itertools.pairwise(whole.rows):  # continuous at every border
            row[TERMS] += _value(before, row[LEFT]) - _value(row, row[LEFT])
        whole.terms[:, 0] -= whole(start)
        return whole

    def derivative(self) -> PiecewisePolynomial:
        """Slope, piece by piece."""
        slope = PiecewisePolynomial(self.rows.copy())
        slope.terms[:, :-1] = self.terms[:, 1:] * np.arange(1, DEGREE + 1)
        slope.terms[:, -1] = 0.0
        return slope


def _values(rows: Floats, x: Floats) -> Floats:
    """The value (k,) of each piece at a place of its own."""
    found = np.zeros(len(rows))
    for power in range(DEGREE, -1, -1):
        found = found * (x - rows[:, REFERENCE]) + rows[:, TERMS + power]
    return found


def _value(row: Floats, x: float) -> float:
    return float(horner(row[TERMS:].tolist(), x - float(row[REFERENCE])))


def horner(coefficients: Floats, s: Any) -> Any:
    """c0 + c1 s + c2 s^2 + ...; numpy's own takes longer to read in than a table to evaluate a thousand times."""
    return functools.reduce(lambda value, coefficient: coefficient + value * s, coefficients[::-1])


def pieces(borders: Sequence[float], coefficients: Sequence[Sequence[float]]) -> PiecewisePolynomial:
    """From inner borders b1..bk-1 and k coefficient lists, each about the left border of its piece."""
    edges = [-FAR, *borders, FAR]
    rows = np.zeros((len(coefficients), STRIDE))
    for row, left, right, terms in zip(rows, edges[:-1], edges[1:], coefficients, strict=True):
        reference = left if left > -FAR else (right if right < FAR else 0.0)
        row[:TERMS] = left, right, reference
        row[TERMS : TERMS + len(terms)] = terms
    return PiecewisePolynomial(rows)


def constant(value: float) -> PiecewisePolynomial:
    """The same value everywhere, one piece."""
    return pieces([], [[value]])


def linear_table(x: Sequence[float], y: Sequence[float], *, beyond: str = "constant") -> PiecewisePolynomial:
    """Straight lines between points; beyond the ends constant, or the last slope (`beyond="line"`)."""
    slopes = np.diff(y) / np.diff(x)
    return _with_ends(x, y, [[a, b] for a, b in zip(y, slopes, strict=False)], (slopes[0], slopes[-1]), beyond)


def monotone_cubic_table(x: Sequence[float], y: Sequence[float], *, beyond: str = "constant") -> PiecewisePolynomial:
    """Shape-preserving cubic (Fritsch and Butland 1984, as in PCHIP); beyond the ends as `linear_table`."""
    from scipy.interpolate import PchipInterpolator

    cubic = PchipInterpolator(x, y)
    ends = cubic.derivative()([x[0], x[-1]])
    return _with_ends(x, y, cubic.c[::-1].T.tolist(), (ends[0], ends[1]), beyond)


def _with_ends(
    x: Sequence[float], y: Sequence[float], inner: list[list[float]], slopes: tuple[float, float], beyond: str
) -> PiecewisePolynomial:
    """Pieces between the points and the two beyond them; the left one is written about its right border."""
    left, right = slopes if beyond == "line" else (0.0, 0.0)
    return pieces(list(x), [[y[0], left], *inner, [y[-1], right]])
