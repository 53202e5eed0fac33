"""What is known of parameters after a fit: intervals, and combinations that the data do not tell.

With J = dr/dz at the solution, s^2 (J'J)^-1 is the covariance of z for independent noise of deviation s; a robust
loss has the sandwich of it (Huber 1981, section 6.3). The bootstrap draws blocks of residuals anew (Kuensch 1989), so
that noise may hang together over a block, and takes one Gauss-Newton step from the solution for each draw.

The singular value of a direction v of z says how much the data feel it. The data do not tell that combination where
s/value exceeds the range between the bounds, or where the value is not above the error of the differences.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.studies.differences.steps import Step
from fairlead.studies.fits.fit_file import LINEAR
from fairlead.studies.fits.problem import Problem

Floats = NDArray[np.float64]
LEVEL = 0.95
DRAWS = 400
BLOCKS = 40
"""Blocks of residuals of each target that the bootstrap draws from, at most."""
TAKES_PART = 0.2
"""Share of a direction from which on a parameter is named in its sentence."""


@dataclass(frozen=True)
class Interval:
    """Of one parameter, in SI: its value, and 95 % intervals; None where the data do not tell it."""

    value: float
    low: float | None
    high: float | None
    drawn: tuple[float, float] | None
    """By the bootstrap."""


@dataclass(frozen=True)
class Direction:
    """A singular value of J, and the share of each parameter in its direction."""

    value: float
    deviation: float
    """Standard deviation along it, in z."""
    shares: dict[str, float]
    told: bool
    sentence: str


def intervals(
    problem: Problem, z: Floats, j: Floats, r: Floats, slopes: tuple[Floats, Floats], directions: Sequence[Direction],
    seed: int,
) -> list[Interval]:  # fmt: skip
    """Of every parameter. `slopes`: first and second derivative factors of the loss, 1 and 1 for least squares."""
    from scipy import stats

    n, p = j.shape
    hidden = {name for one in directions if not one.told for name, share in one.shares.items()
              if abs(share) >= TAKES_PART}  # fmt: skip
    if n <= p and not problem.known_noise:
        hidden = {one.name for one in problem.sought}
    bread = np.asarray(np.linalg.pinv(j.T @ (slopes[0][:, None] * j)), np.float64)
    if problem.known_noise and (slopes[0] == 1).all():
        covariance, factor = bread, float(stats.norm.ppf((1 + LEVEL) / 2))
    else:
        free = max(n - p, 1)
        pull = slopes[0] * r
        spread = float(pull @ pull) / free
        meat = j.T @ j * spread if (slopes[0] == 1).all() else j.T @ (pull[:, None] ** 2 * j) * n / free
        covariance, factor = bread @ meat @ bread, float(stats.t.ppf((1 + LEVEL) / 2, free))
    drawn = _bootstrap(problem, j, r, slopes[0], bread, seed)
    made = []
    for k, one in enumerate(problem.sought):
        value = _back(problem, z, k, z[k])
        if one.name in hidden:  # what the data do not tell may be wider than a float holds
            made.append(Interval(value, None, None, None))
            continue
        half = factor * math.sqrt(max(covariance[k, k], 0.0))
        low, high = (_back(problem, z, k, z[k] + side * half) for side in (-1, 1))
        shares = [(1 - LEVEL) / 2, (1 + LEVEL) / 2]
        quantiles = [_back(problem, z, k, z[k] + q) for q in np.quantile(drawn[:, k], shares)]
        made.append(Interval(value, low, high, (quantiles[0], quantiles[1])))
    return made


def directions(problem: Problem, j: Floats, r: Floats, sizes: Sequence[Step]) -> list[Direction]:
    """The singular directions of J, the best told first, each with a sentence."""
    n, p = j.shape
    _, values, rows = np.linalg.svd(j, full_matrices=False)
    deviation = 1.0 if problem.known_noise else math.sqrt(float(r @ r) / max(n - p, 1))
    floor = math.sqrt(sum(one.deviation**2 for one in sizes if math.isfinite(one.deviation)))
    low, high = problem.bounds
    made = []
    for value, row in zip(values, rows, strict=True):
        row = row * np.sign(row[np.argmax(np.abs(row))])
        width = float(np.abs(row) @ (high - low))
        across = deviation / value if value > 0 else math.inf
        told = bool(value > floor and across < width)
        shares = {one.name: float(share) for one, share in zip(problem.sought, row, strict=True)}
        made.append(Direction(float(value), across, shares, told, _sentence(problem, shares, told, across)))
    return made


def _sentence(problem: Problem, shares: dict[str, float], told: bool, across: float) -> str:
    part = {name: share for name, share in shares.items() if abs(share) >= TAKES_PART}
    logs = {one.name: one.log for one in problem.sought}
    if len(part) == 1:
        (name,) = part
        return f"{name} is told within {_percent(across)}." if told else f"The data do not tell {name}."
    words = " and ".join(f"{name} {'up' if share > 0 else 'down'} ({abs(share):.2f})" for name, share in part.items())
    if told:
        return f"The combination {words} is told within {_percent(across)}."
    between = "product" if all(share > 0 for share in part.values()) else "ratio"
    also = f" A {between} of powers of them is free." if all(logs[name] for name in part) else ""
    names = " and ".join(part)
    return (
        f"The data do not tell {names} apart: {words} together change nothing that was measured.{also} "
        f"Fix one of them, or measure something that feels them differently."
    )


def _percent(across: float) -> str:
    return f"{100 * across:.2g} %" if across < 10 else "more than its own size"


def _bootstrap(problem: Problem, j: Floats, r: Floats, weights: Floats, bread: Floats, seed: int) -> Floats:
    """Changes of z, shape (draws, parameters), from residuals drawn in blocks within each target."""
    chance, starts = np.random.default_rng(seed), np.cumsum([0, *(one.count for one in problem.targets)])
    centred, n, p = r.copy(), *j.shape
    centred *= math.sqrt(n / max(n - p, 1))
    made = np.empty((DRAWS, p))
    for draw in range(DRAWS):
        taken = []
        for begin, end in itertools.pairwise(starts.tolist()):
            size = end - begin
            length = max(1, round(size ** (1 / 3)), size // BLOCKS if size > BLOCKS * 50 else 1)
            firsts = chance.integers(0, size, -(-size // length))
            taken.append((begin + (firsts[:, None] + np.arange(length)) % size).ravel()[:size])
        sample = np.concatenate(taken)
        signs = chance.choice([-1.0, 1.0], 1) if n < BLOCKS else 1.0
        made[draw] = -bread @ (j.T @ (weights * (signs * centred[sample])))
    return made


def _back(problem: Problem, z: Floats, index: int, value: float) -> float:
    """A value of z as the parameter in SI."""
    moved = z.copy()
    moved[index] = value
    return problem.values(moved)[problem.sought[index].name]


def loss_slopes(kind: str, scale: float, r: Floats) -> tuple[Floats, Floats]:
    """Rho' of a loss at (r/scale)^2, and ones, as scipy.optimize.least_squares defines its losses."""
    if kind == LINEAR:
        return np.ones_like(r), np.ones_like(r)
    z = (r / scale) ** 2
    first = {"soft_l1": lambda: (1 + z) ** -0.5, "huber": lambda: np.where(z <= 1, 1.0, z**-0.5),
             "cauchy": lambda: 1 / (1 + z), "arctan": lambda: 1 / (1 + z**2)}[kind]()  # fmt: skip
    return first, np.ones_like(r)


def loss_sum(kind: str, scale: float, r: Floats) -> float:
    """The sum of a loss, scale^2/2 sum of rho((r/scale)^2), as scipy.optimize.least_squares makes it small."""
    if kind == LINEAR:
        return 0.5 * float(r @ r)
    z = (r / scale) ** 2
    rho = {"soft_l1": lambda: 2 * (np.sqrt(1 + z) - 1), "huber": lambda: np.where(z <= 1, z, 2 * np.sqrt(z) - 1),
           "cauchy": lambda: np.log1p(z), "arctan": lambda: np.arctan(z)}[kind]()  # fmt: skip
    return 0.5 * scale**2 * float(rho.sum())
