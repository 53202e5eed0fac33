"""The search: least squares from several starts, with differences whose step comes from the engine's noise."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import FairleadError
from fairlead.studies.differences.steps import CHAOS, Step, jacobian, noise_floor, steps
from fairlead.studies.fits.bootstrap import block_lengths, changes_of_z
from fairlead.studies.fits.fit_file import LINEAR, Asked, Law
from fairlead.studies.fits.known import Direction, Interval, directions, intervals, loss_sum, spread_of
from fairlead.studies.fits.problem import FAR, TIME, Problem, Record, Target, records_of, targets_of

Floats = NDArray[np.float64]
Told = Callable[[str], None]
PRECISION = 1e-8
"""Relative change of parameters at which a search ends."""
LITTLE = 0.01
"""Change of the sum of squares at which a search ends, in variances of the noise: 1 is one standard error."""
MOST_TURNS = 30
MOST_NOISES, SAME_NOISE = 5, 0.05
"""Fits at most for the noise that is left under a robust loss, and the change of it that is none."""
ROUNDING = 10.0
"""Noise floors of the engine that a residual is rounding below."""
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
    blocks: dict[tuple[str, str], int]
    """Residuals that the bootstrap draws together, by record and signal."""
    remarks: tuple[str, ...] = ()
    """What a reader must know of the fit: features without a value, no residual to spare."""


@dataclass(frozen=True)
class Error:
    """How far a record's signal is off: mean without sign, and root mean square, in the unit of the signal."""

    mean: float
    rms: float


class Counted:
    """Residuals over z that count their runs."""

    def __init__(self, problem: Problem, runs: int = 0) -> None:
        """`runs` so far."""
        self.problem, self.runs = problem, runs

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

    No search begins where a fit to all targets ended, which has seen what is to be foretold; nor may `also`. But if the
    targets are met better there, all searches have ended in other minima. Then one more begins there: what it comes to
    is what a search of these targets alone, from better starts, would have come to.
    """
    problem = Problem((*asked.sought, *law.sought), tuple(targets))
    counted, sizes = Counted(problem), [like.steps[one.name] for one in problem.sought]
    best, _ = _searches(asked, counted, sizes, None, also)
    least, _, place = _best_place(asked, counted, [("", problem.z(like.values[one.name] for one in problem.sought))])
    if place is not None and least < best.cost * (1 - CLOSE):
        best = min(best, _search(asked, counted, place, sizes), key=lambda each: each.cost)
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
        record, values = targets[0].record, problem.values(inside)
        if said := _without(targets, values):
            raise FairleadError(f"{said}\n    Begin at other values.")
        raise FairleadError(f"At the start of the parameters no record's run finishes ({record.name}: "
                            f"{record.sentence(values)})\n    Begin at other values.")  # fmt: skip
    noise = noise_floor(counted, inside, bounds)
    sizes = steps(counted, inside, bounds, noise)
    best, starts = _searches(asked, counted, sizes, told, also)
    if loss.kind != LINEAR and not problem.known_noise:
        counted, best, starts = _with_noise_left(asked, counted, best, starts, sizes, noise)
        problem = counted.problem
    sizes = steps(counted, best.x, bounds, noise_floor(counted, best.x, bounds))
    r, j = counted(best.x), jacobian(counted, best.x, sizes, bounds)
    ways = directions(problem, j, r, sizes)
    spread = spread_of(problem, j, r, loss.kind, loss.scale)
    lengths = block_lengths(spread)
    known = intervals(problem, best.x, spread, changes_of_z(spread, lengths, asked.given.seed), ways)
    names = [one.name for one in problem.sought]
    found_ways = dict(zip(names, known, strict=True))
    return Fitted(problem, problem.values(best.x), float(best.cost), r, found_ways, tuple(ways), noise,
                  dict(zip(names, sizes, strict=True)), tuple(starts), counted.runs,
                  {(one.record, one.signal): length
                   for one, length in zip(problem.groups, lengths, strict=True) if one.in_order},
                  tuple(_remarks(problem, best.x)))  # fmt: skip


def _remarks(problem: Problem, z: Floats) -> Iterator[str]:
    if said := _without(problem.targets, problem.values(z)):
        yield f"{said} The search cannot follow them, and tells nothing of the parameters. Begin at other values."
    count, sought = sum(one.count for one in problem.targets), len(z)
    if count <= sought and not problem.known_noise:
        numbers = f"{count} number{'s' * (count > 1)}", f"{sought} parameter{'s' * (sought > 1)}"
        yield (f"The data are {numbers[0]} for {numbers[1]}: they leave nothing over to tell the noise from, so no "
               f"interval is told. Fit curves (by: time), or give more features or records.")  # fmt: skip


def _without(targets: Iterable[Target], values: dict[str, float]) -> str:
    """Features that have no value in the model, record by record; "" where all have one."""
    found = [(one.record.name, names) for one in targets if (names := one.without(values))]
    told = "; ".join(f"{', '.join(names)} of {record}" for record, names in found)
    return told and f"No value in the model, at these values of the parameters: {told}."


def _with_noise_left(
    asked: Asked, counted: Counted, best: Any, starts: list[Start], sizes: list[Step], noise: float
) -> tuple[Counted, Any, list[Start]]:
    """The fit again with the noise that it leaves, until that changes no more, and what the starts come to with it."""
    loss, problem = asked.given.loss, counted.problem

    def sums(places: Sequence[Floats]) -> list[float]:
        return [loss_sum(loss.kind, loss.scale, counted(place)) for place in places]

    ended = [problem.z(one.ended.values()) for one in starts if math.isfinite(one.loss)]
    for _ in range(MOST_NOISES):
        ends, before = np.cumsum([one.count for one in problem.targets]), _noise_left(problem)
        parts = zip(problem.targets, np.split(counted(best.x), ends[:-1]), strict=True)
        problem = replace(problem, targets=tuple(one.with_noise_of(part, ROUNDING * noise) for one, part in parts))
        counted = Counted(problem, counted.runs)
        places = [best.x, *ended]
        best = _search(asked, counted, _inside(places[int(np.argmin(sums(places)))], problem.bounds), sizes)
        now = _noise_left(problem)
        if len(before) and (np.abs(now - before) <= SAME_NOISE * now).all():
            break
    found = iter(sums(ended))
    starts = [replace(one, loss=next(found)) if math.isfinite(one.loss) else one for one in starts]
    end = problem.values(best.x)
    return counted, best, [*starts, Start(end, end, float(best.cost), "with the noise that is left")]


def _noise_left(problem: Problem) -> Floats:
    return np.array([noise for one in problem.targets for noise in one.left.values()])


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
