"""What is known of parameters after a fit: intervals, and combinations that the data do not tell.

With J = dr/dz at the solution, psi = rho'(r) and residuals in groups g that share a noise (problem.py), an M-estimator
has about the covariance (Huber, Robust Statistics, 1981, section 7.6, there for one group)

    K^2 A^-1 B A^-1,   A = sum of m_g J_g'J_g,   B = sum of q_g J_g'J_g,   K = 1 + p/n var(psi')/mean(psi')^2
    m_g = mean of psi' in g,   q_g = sum of psi^2 in g / (n_g - h_g),   h_g = tr(m_g A^-1 J_g'J_g)

where h_g is the part of the p parameters that group g tells. Of least squares psi = r, so that one group gives
s^2 (J'J)^-1; a noise that is given makes q_g = 1. The factor is that of Student's distribution, its degrees of freedom
those of the sum over the groups (Satterthwaite, Biometrics Bull. 2:110, 1946), by which the bootstrap is widened, too.

The singular value of a direction v of z says how much the data feel it. The data do not tell that combination where
s/value exceeds the range between the bounds, or where the value is not above the error of the differences.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.studies.differences.steps import Step
from fairlead.studies.fits.fit_file import LINEAR
from fairlead.studies.fits.problem import Group, Problem

Floats = NDArray[np.float64]
LEVEL = 0.95
LEAST_FREE = 3.0
"""Of a group by itself: where residuals of one are fewer beyond what it tells, all are taken to share a noise."""
LEAST_SLOPE = 0.05
"""Of the mean of psi', which is negative where most residuals are outliers of cauchy or arctan."""
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


@dataclass(frozen=True)
class Spread:
    """How the values found would scatter: covariance of z, degrees of freedom, and what a bootstrap needs of it."""

    covariance: Floats
    free: Floats
    """By parameter; infinite where all noise is given."""
    groups: tuple[Group, ...]
    draw: Floats
    """[residuals]: psi, in the size that it has where no parameter is fitted."""
    gain: Floats
    """[p, residuals]: change of z for one of psi."""


def spread_of(problem: Problem, j: Floats, r: Floats, kind: str = LINEAR, scale: float = 1.0) -> Spread:
    """Of residuals r with derivatives J [residuals, p] at the solution, under a loss."""
    n, p = j.shape
    weight, slope = loss_slopes(kind, scale, r)
    psi, groups = weight * r, problem.groups
    mean = np.array([max(float(slope[one.at].mean()), LEAST_SLOPE) for one in groups])
    squares = np.array([j[one.at].T @ j[one.at] for one in groups])
    bread = np.asarray(np.linalg.pinv(np.tensordot(mean, squares, 1)), np.float64)
    count = np.array([len(one.at) for one in groups])
    free = count - mean * np.trace(bread @ squares, axis1=1, axis2=2)
    correction = 1.0 + p / n * float(np.var(slope)) / max(float(slope.mean()), LEAST_SLOPE) ** 2
    draw = psi.copy()
    for one, all_of_it, left in zip(groups, count, free, strict=True):
        draw[one.at] *= correction * math.sqrt(all_of_it / max(left, 1.0))
    parts, degrees = [], []
    for pool in _pools([one.known and kind == LINEAR for one in groups], free):
        given, left = groups[pool[0]].known and kind == LINEAR, max(float(free[pool].sum()), 1.0)
        noise = 1.0 if given else sum(float(psi[groups[k].at] @ psi[groups[k].at]) for k in pool) / left
        parts.append(correction**2 * noise * bread @ squares[pool].sum(axis=0) @ bread)
        degrees.append(math.inf if given else left)
    return Spread(np.sum(parts, axis=0), _degrees(parts, degrees), groups, draw, -bread @ j.T)


def _pools(given: Sequence[bool], free: Floats) -> list[list[int]]:
    """Which groups tell one noise together."""
    alone, own = [[k] for k, one in enumerate(given) if one], [k for k, one in enumerate(given) if not one]
    if not own:
        return alone
    return [*alone, *([own] if (free[own] < LEAST_FREE).any() else [[k] for k in own])]


def _degrees(parts: Sequence[Floats], degrees: Sequence[float]) -> Floats:
    """Degrees of freedom of the variances of all parameters, which are sums over pools."""
    variances = np.array([np.diag(one) for one in parts])
    uncertain = (variances**2 / np.array(degrees)[:, None]).sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.where(uncertain > 0.0, variances.sum(axis=0) ** 2 / uncertain, math.inf))


def intervals(
    problem: Problem, z: Floats, spread: Spread, drawn: Floats, directions: Sequence[Direction]
) -> list[Interval]:
    """Of every parameter; `drawn` are changes of z by the bootstrap [draws, p]."""
    from scipy import stats

    n, p = len(spread.draw), len(z)
    hidden = {name for one in directions if not one.told for name, share in one.shares.items()
              if abs(share) >= TAKES_PART}  # fmt: skip
    if n <= p and not problem.known_noise:
        hidden = {one.name for one in problem.sought}
    made = []
    for k, one in enumerate(problem.sought):
        value = _back(problem, z, k, z[k])
        if one.name in hidden:  # what the data do not tell may be wider than a float holds
            made.append(Interval(value, None, None, None))
            continue
        factor = float(stats.t.ppf((1 + LEVEL) / 2, spread.free[k]))
        half = factor * math.sqrt(max(spread.covariance[k, k], 0.0))
        low, high = (_back(problem, z, k, z[k] + side * half) for side in (-1, 1))
        shares, wider = [(1 - LEVEL) / 2, (1 + LEVEL) / 2], factor / float(stats.norm.ppf((1 + LEVEL) / 2))
        quantiles = [_back(problem, z, k, z[k] + wider * q) for q in np.quantile(drawn[:, k], shares)]
        made.append(Interval(value, low, high, (quantiles[0], quantiles[1])))
    return made


def directions(problem: Problem, j: Floats, r: Floats, sizes: Sequence[Step]) -> list[Direction]:
    """The singular directions of J, the best told first, each with a sentence."""
    n, p = j.shape
    _, values, rows = np.linalg.svd(j, full_matrices=False)
    deviation = 1.0 if problem.known_noise or n <= p else math.sqrt(float(r @ r) / (n - p))
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


def _back(problem: Problem, z: Floats, index: int, value: float) -> float:
    """A value of z as the parameter in SI."""
    moved = z.copy()
    moved[index] = value
    return problem.values(moved)[problem.sought[index].name]


def loss_slopes(kind: str, scale: float, r: Floats) -> tuple[Floats, Floats]:
    """psi/r and psi' of a loss; psi = d/dr of scale^2/2 rho((r/scale)^2), as scipy.optimize.least_squares has it."""
    if kind == LINEAR:
        return np.ones_like(r), np.ones_like(r)
    z = (r / scale) ** 2
    first, second = {
        "soft_l1": lambda: ((1 + z) ** -0.5, -0.5 * (1 + z) ** -1.5),
        "huber": lambda: (np.where(z <= 1, 1.0, np.maximum(z, 1.0) ** -0.5),
                          np.where(z <= 1, 0.0, -0.5 * np.maximum(z, 1.0) ** -1.5)),
        "cauchy": lambda: (1 / (1 + z), -((1 + z) ** -2)),
        "arctan": lambda: (1 / (1 + z**2), -2 * z / (1 + z**2) ** 2),
    }[kind]()  # fmt: skip
    return first, first + 2 * z * second


def loss_sum(kind: str, scale: float, r: Floats) -> float:
    """The sum of a loss, scale^2/2 sum of rho((r/scale)^2), as scipy.optimize.least_squares makes it small."""
    if kind == LINEAR:
        return 0.5 * float(r @ r)
    z = (r / scale) ** 2
    rho = {"soft_l1": lambda: 2 * (np.sqrt(1 + z) - 1), "huber": lambda: np.where(z <= 1, z, 2 * np.sqrt(z) - 1),
           "cauchy": lambda: np.log1p(z), "arctan": lambda: np.arctan(z)}[kind]()  # fmt: skip
    return 0.5 * scale**2 * float(rho.sum())
