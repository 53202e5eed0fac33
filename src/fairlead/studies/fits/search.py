"""The search: least squares from several starts, with differences whose step comes from the engine's noise."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import FairleadError
from fairlead.studies.differences.steps import CHAOS, Step, jacobian, noise_floor, steps
from fairlead.studies.fits.fit_file import Asked, Law
from fairlead.studies.fits.known import Direction, Interval, directions, intervals, loss_slopes, loss_sum
from fairlead.studies.fits.problem import FAR, TIME, Problem, Record, Target, records_of, targets_of

Floats = NDArray[np.float64]
Told = Callable[[str], None]
PRECISION = 1e-8
"""Relative change of parameters at which a search ends."""
LITTLE = 0.01
"""Change of the sum of squares at which a search ends, in variances of the noise: 1 is one standard error."""
MOST_TURNS = 30
CLOSE = 0.01
"""A contained law's fit is where a search begins if the loss there is at most this share above the best so far. Bounds
such as those of a logarithm keep a law from being quite the one it contains."""
Places = Sequence[tuple[str, Floats]]
"""Further places to begin at, each with the law it comes from."""


@dataclass(frozen=True)
class Start:
    """One search: where it began and ended, and the loss there."""

    begun: dict[str, float]
    ended: dict[str, float]
    loss: float
    sentence: str


@dataclass(frozen=True)
class Fitted:
    """A fit: values in SI, their intervals, what the data tell, and how it was found."""

    problem: Problem
    values: dict[str, float]
    loss: float
    residuals: Floats
    intervals: dict[str, Interval]
    directions: tuple[Direction, ...]
    noise: float
    steps: dict[str, Step]
    starts: tuple[Start, ...]
    runs: int


@dataclass(frozen=True)
class Error:
    """How far a record's signal is off: mean without sign, and root mean square, in the unit of the signal."""

    mean: float
    rms: float


class Counted:
    """Residuals over z that count their runs."""

    def __init__(self, problem: Problem) -> None:
        """No run yet."""
        self.problem, self.runs = problem, 0

    def __call__(self, z: Floats) -> Floats:
        """All residuals."""
        self.runs += len(self.problem.targets)
        return self.problem.residuals(z)


def chaotic(records: list[Record], problem: Callable[[list[Target]], Problem]) -> dict[str, bool]:
    """Whether a change of parameters that means nothing changes the course of each record.

    It is compared with how much the record varies; with how much the residuals do at the start, if it is constant.
    """
    found = {}
    for record in records:
        one = problem([Target(record, TIME)])
        floor = noise_floor(one.residuals, one.start, one.bounds)
        spread = np.concatenate([np.full(v.size, np.std(v) / (record.measured.noise[name] or np.std(v) or 1.0))
                                 for name, v in record.measured.values.items()])  # fmt: skip
        varies = float(np.sqrt((spread**2).mean())) or float(np.std(one.residuals(one.start)))
        found[record.name] = bool(floor > CHAOS * varies)
    return found


def foretelling(asked: Asked, targets: list[Target], law: Law, like: Fitted, also: Places = ()) -> dict[str, float]:
    """Values of the parameters fitted to some of the targets, from all starts, by the steps of a fit.

    No search begins where a fit to all targets ended, which has seen what is to be foretold; nor may `also`.
    """
    problem = Problem((*asked.sought, *law.sought), tuple(targets))
    best, _ = _searches(asked, Counted(problem), [like.steps[one.name] for one in problem.sought], None, also)
    return problem.values(best.x)


def _searches(asked: Asked, counted: Counted, sizes: list[Step], told: Told | None, also: Places
              ) -> tuple[Any, list[Start]]:  # fmt: skip
    """The best of all searches, and what each came to."""
    problem, found, starts = counted.problem, [], []
    for number, begin in enumerate(_starts(problem, asked.given.starts, asked.given.seed)):
        begin = _inside(begin, problem.bounds)
        if number and (counted(begin) == FAR).any():
            starts.append(Start(problem.values(begin), problem.values(begin), float("inf"), "no run finishes there"))
            continue
        one = _search(asked, counted, begin, sizes)
        found.append(one)
        starts.append(Start(problem.values(begin), problem.values(one.x), float(one.cost), str(one.message)))
        if told is not None:
            told(f"start {number + 1}: loss {one.cost:.6g}")
    best = min(found, key=lambda each: each.cost)
    least, law, place = _best_place(asked, counted, also)
    if place is not None and least <= (1 + CLOSE) * best.cost:
        one = _search(asked, counted, place, sizes)
        starts.append(Start(problem.values(place), problem.values(one.x), float(one.cost), str(one.message)))
        best = min(best, one, key=lambda each: each.cost)
        if told is not None:
            told(f"from the fit of {law}, which this law contains: loss {one.cost:.6g}")
    return best, starts


def _best_place(asked: Asked, counted: Counted, also: Places) -> tuple[float, str, Floats | None]:
    """Least loss at further places to begin at, the law it comes from, and the place; None when there is none."""
    least: tuple[float, str, Floats | None] = (float("inf"), "", None)
    for law, place in also:
        begin = _inside(place, counted.problem.bounds)
        residuals = counted(begin)
        if not (residuals == FAR).any():
            here = loss_sum(asked.given.loss.kind, asked.given.loss.scale, residuals), law, begin
            least = min(least, here, key=lambda one: one[0])
    return least


def _search(asked: Asked, counted: Counted, begin: Floats, sizes: list[Step]) -> Any:
    """One search, as scipy.optimize.least_squares tells it."""
    from scipy.optimize import least_squares

    loss, bounds = asked.given.loss, counted.problem.bounds
    count = sum(one.count for one in counted.problem.targets)
    return least_squares(counted, begin, jac=lambda z: jacobian(counted, z, sizes, bounds), bounds=bounds,
                         x_scale="jac", loss=loss.kind, f_scale=loss.scale, ftol=max(LITTLE / count, PRECISION),
                         xtol=PRECISION, gtol=1e-12, max_nfev=MOST_TURNS)  # fmt: skip


def fit(asked: Asked, targets: list[Target], law: Law = Law(""), told: Told | None = None,  # noqa: B008
        also: Places = ()) -> Fitted:  # fmt: skip
    """Fit the parameters to the targets. Raises FairleadError when no start gives a run that finishes."""
    problem, loss = Problem((*asked.sought, *law.sought), tuple(targets)), asked.given.loss
    counted, bounds = Counted(problem), problem.bounds
    inside = _inside(problem.start, bounds)
    first = counted(inside)
    if (first == FAR).all():
        record = targets[0].record
        raise FairleadError(f"At the start of the parameters no record's run finishes ({record.name}: "
                            f"{record.sentence(problem.values(inside))})\n    Begin at other values.")  # fmt: skip
    noise = noise_floor(counted, inside, bounds)
    sizes = steps(counted, inside, bounds, noise)
    best, starts = _searches(asked, counted, sizes, told, also)
    sizes = steps(counted, best.x, bounds, noise_floor(counted, best.x, bounds))
    r, j = counted(best.x), jacobian(counted, best.x, sizes, bounds)
    ways = directions(problem, j, r, sizes)
    known = intervals(problem, best.x, j, r, loss_slopes(loss.kind, loss.scale, r), ways, asked.given.seed)
    names = [one.name for one in problem.sought]
    found_ways = dict(zip(names, known, strict=True))
    return Fitted(problem, problem.values(best.x), float(best.cost), r, found_ways, tuple(ways), noise,
                  dict(zip(names, sizes, strict=True)), tuple(starts), counted.runs)  # fmt: skip


def errors(record: Record, values: dict[str, float]) -> dict[str, Error] | None:
    """How far each signal is off; None when the run did not finish."""
    curves = record.computed(values)
    if curves is None:
        return None
    return {name: Error(float(np.abs(got - one).mean()), float(np.sqrt(((got - one) ** 2).mean())))
            for got, (name, one) in zip(curves, record.measured.values.items(), strict=True)}  # fmt: skip


def prepared(asked: Asked, law: Law = Law("")) -> tuple[list[Record], list[Target], dict[str, bool]]:  # noqa: B008
    """Records under a law, what of each is to agree, and which are chaotic. Raises ModelError."""
    records = records_of(asked, law)
    sought = (*asked.sought, *law.sought)
    if asked.given.loss.by == TIME or asked.given.features:
        found: dict[str, bool] = {}
    else:
        found = chaotic(records, lambda targets: Problem(sought, tuple(targets)))
    return records, targets_of(asked, records, found), found


def _starts(problem: Problem, count: int, seed: int) -> list[Floats]:
    """The start of the fit file, then points of a Latin hypercube between the bounds."""
    from scipy.stats import qmc

    low, high = problem.bounds
    more = qmc.LatinHypercube(len(low), rng=np.random.default_rng(seed)).random(count - 1) if count > 1 else []
    return [problem.start, *(low + (high - low) * one for one in more)]


def _inside(z: Floats, bounds: tuple[Floats, Floats]) -> Floats:
    """Strictly between the bounds, as least_squares wants it."""
    room = 1e-6 * (bounds[1] - bounds[0])
    return np.clip(z, bounds[0] + room, bounds[1] - room)
