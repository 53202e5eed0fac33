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

STRIDE = 8
DEGREE = 4
FAR = 1e300


@dataclass(frozen=True)
class Sine:
    """amplitude * sin(omega t + phase), added to a waveform."""

    amplitude: float = 0.0
    omega: float = 0.0
    phase: float = 0.0


@dataclass(frozen=True)
class PiecewisePolynomial:
    """Pieces (k, 8) in the layout above, ordered, without gaps.

    Pieces may overlap: each is then left at its own ends only, as with hysteresis. A run begins in piece `begin` and
    finds the right one from there.
    """

    rows: np.ndarray
    begin: int = 0

    def piece_at(self, x: float) -> int:
        """The piece that holds x; at a border the right one."""
        return int(np.clip(np.searchsorted(self.rows[:, 0], x, side="right") - 1, 0, len(self.rows) - 1))

    def __call__(self, x: float) -> float:
        """Value at x."""
        return _value(self.rows[self.piece_at(x)], x)

    @cached_property
    def is_continuous(self) -> bool:
        """True if the pieces meet, each at the end of the one before, with the same value."""
        size = np.abs(self.rows[:, 3]).max(initial=1e-300)
        left, right = self.rows[:-1], self.rows[1:]
        jumps = np.abs(_values(left, right[:, 0]) - _values(right, right[:, 0]))
        return bool((left[:, 1] == right[:, 0]).all() and (jumps <= 1e-9 * size).all())

    def integral(self, start: float) -> PiecewisePolynomial:
        """Antiderivative that is zero at `start`; pieces of degree at most three."""
        if np.any(self.rows[:, 3 + DEGREE] != 0):
            raise ValueError("a piece of degree four cannot be integrated in this layout")
        rows = self.rows.copy()
        rows[:, 4:] = self.rows[:, 3:7] / np.arange(1, DEGREE + 1)
        rows[:, 3] = 0.0
        for before, row in itertools.pairwise(rows):  # continuous at every border
            row[3] += _value(before, row[0]) - _value(row, row[0])
        whole = PiecewisePolynomial(rows)
        rows[:, 3] -= whole(start)
        return whole

    def derivative(self) -> PiecewisePolynomial:
        """Slope, piece by piece."""
        rows = self.rows.copy()
        rows[:, 3:7] = self.rows[:, 4:] * np.arange(1, DEGREE + 1)
        rows[:, 7] = 0.0
        return PiecewisePolynomial(rows)


def _values(rows: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The value of each piece at a place of its own."""
    found = np.zeros(len(rows))
    for power in range(DEGREE, -1, -1):
        found = found * (x - rows[:, 2]) + rows[:, 3 + power]
    return found


def _value(row: np.ndarray, x: float) -> float:
    return float(horner(row[3:], x - row[2]))


def horner(coefficients: np.ndarray, s: Any) -> Any:
    """c0 + c1 s + c2 s^2 + ...; numpy's own takes longer to read in than a table to evaluate a thousand times."""
    return functools.reduce(lambda value, coefficient: coefficient + value * s, coefficients[::-1])


def pieces(borders: Sequence[float], coefficients: Sequence[Sequence[float]]) -> PiecewisePolynomial:
    """From inner borders b1..bk-1 and k coefficient lists, each about the left border of its piece."""
    edges = [-FAR, *borders, FAR]
    rows = np.zeros((len(coefficients), STRIDE))
    for row, left, right, terms in zip(rows, edges[:-1], edges[1:], coefficients, strict=True):
        reference = left if left > -FAR else (right if right < FAR else 0.0)
        row[:3] = left, right, reference
        row[3 : 3 + len(terms)] = terms
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
