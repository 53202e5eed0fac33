"""The step of central differences, from the noise floor of the engine.

A run computes r(z) with an error that is smooth in part (its accuracy) and rough in part (from step sizes and located
switches). The rough part limits differences. Its size comes from a table of differences of r at points very near each
other (More and Wild, SIAM J. Sci. Comput. 33, 2011): the k-th differences of noise of deviation e have the variance
e^2 (2k)!/(k!)^2. Then steps on a ladder are tried; the error of D(h) is at most about

    noise/(h sqrt 2)  +  |D(h) - D(h/4)|        (rounding and truncation)

and the step is that with the smallest error.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
POINTS = 6
NEAR = 1e-9
"""Distance of the points of the table: a relative change of a parameter that means nothing to it."""
LADDER = tuple(0.05 * 4.0**-k for k in range(8))
CHAOS = 0.01
"""Noise over the spread of what is measured from which on a course cannot be foretold."""


@dataclass(frozen=True)
class Step:
    """The step of one parameter, in z, and the deviation that remains in its derivative over the derivative's size."""

    size: float
    error: float
    deviation: float
    """Norm of what remains in the derivative."""


def noise_floor(residuals: Callable[[Floats], Floats], z: Floats, bounds: tuple[Floats, Floats]) -> float:
    """Root mean square of the rough part of one residual, from POINTS runs along the diagonal of all parameters."""
    return noise_of(near(residuals, z, bounds))


def near(residuals: Callable[[Floats], Floats], z: Floats, bounds: tuple[Floats, Floats]) -> Floats:
    """Residuals at POINTS points very near each other, shape (POINTS, residuals)."""
    inward = np.where(z + POINTS * NEAR <= bounds[1], 1.0, -1.0)
    return np.array([residuals(z + k * NEAR * inward) for k in range(POINTS)])


def noise_of(table: Floats) -> float:
    """Root mean square of the rough part of the columns of such a table."""
    found = []
    for order in range(1, POINTS):
        table = np.diff(table, axis=0)
        if order >= 2:  # the first contain the slope
            found.append(math.sqrt(float((table**2).mean()) * math.factorial(order) ** 2 / math.factorial(2 * order)))
    return float(np.median(found))


def steps(residuals: Callable[[Floats], Floats], z: Floats, bounds: tuple[Floats, Floats], noise: float) -> list[Step]:
    """The step of each parameter."""
    return [step_of(residuals, z, index, bounds, noise) for index in range(len(z))]


def step_of(
    residuals: Callable[[Floats], Floats], z: Floats, index: int, bounds: tuple[Floats, Floats], noise: float,
    ladder: Sequence[float] = LADDER,
) -> Step:  # fmt: skip
    """The step of one parameter. The ladder is left where its noise alone exceeds the smallest error so far."""
    slopes = [difference(residuals, z, index, ladder[0], bounds)]
    errors: list[float] = []
    for size, next_size in itertools.pairwise(ladder):
        rough = noise * math.sqrt(len(slopes[0])) / (size * math.sqrt(2))
        if errors and rough > min(errors):
            break
        slopes.append(difference(residuals, z, index, next_size, bounds))
        error = rough + float(np.linalg.norm(slopes[-2] - slopes[-1]))
        errors.append(error if math.isfinite(error) else math.inf)
    best = int(np.argmin(errors))
    slope = float(np.linalg.norm(slopes[best]))
    return Step(ladder[best], errors[best] / slope if slope > 0 else math.inf, errors[best])


def difference(
    residuals: Callable[[Floats], Floats], z: Floats, index: int, size: float, bounds: tuple[Floats, Floats]
) -> Floats:
    """Central difference over one parameter; at a bound, one-sided."""
    ends = []
    for side in (-1.0, 1.0):
        moved = z.copy()
        moved[index] = np.clip(z[index] + side * size, bounds[0][index], bounds[1][index])
        ends.append(moved)
    return (residuals(ends[1]) - residuals(ends[0])) / (ends[1][index] - ends[0][index])


def jacobian(
    residuals: Callable[[Floats], Floats], z: Floats, sizes: list[Step], bounds: tuple[Floats, Floats]
) -> Floats:
    """Derivatives of all residuals, shape (residuals, parameters)."""
    columns = [difference(residuals, z, k, one.size, bounds) for k, one in enumerate(sizes)]
    return np.stack(columns, axis=1)
