"""The derivative of one figure to one parameter, or why it has none.

The step h comes from the noise of the figure (differences/steps.py), and D(h) is checked against D(h/4), that is by
halving twice; the error of the derivative is what both differ by, and what noise leaves. With f0 the figure itself,

    jump     f(+-h) - f0 stays the same size while h becomes four times smaller
    corner   (f(h) - f0)/h and (f0 - f(-h))/h stay apart: the slopes on both sides are different

Where f is smooth the first falls by 4, and so does the difference of both slopes, which is h f''. At a corner each
slope stays what it is, to half of what they differ by; where both scatter, the run has more noise than points very near
each other show, and half of the difference counts as error. A jump at some
distance is no fault of the derivative; it is told beside it, as a corner is, and the step stays short of it.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

from fairlead.studies.differences.steps import LADDER, Step, step_of
from fairlead.studies.sensitivities.runs import Floats, Runs
from fairlead.studies.sensitivities.switches import parting

SMOOTH, JUMP, CORNER, UNTOLD = "smooth", "jump", "corner", "untold"
LEAST_RATIO = 0.5
"""Of a smooth figure, what is compared falls to a quarter from one step to the next; of a jump or a corner, to 1."""
ABOVE_NOISE = 10.0
"""A jump or a corner is as many deviations of the noise, so that noise makes none."""
CLEAR = 0.01
"""A corner is seen where both slopes differ by this share."""
TRUSTED = 0.1
"""Relative error from which on a derivative is not told."""
SHRINKS, FEW = 4.0, 4
"""Steps before a jump nearby: so many, each a quarter of the one before."""
SUDDEN = 64.0
"""A figure that moves more than so much more, with a step four times as large, is no polynomial of degree three."""
BISECTIONS = 8
"""Runs that tell a jump at some distance from a corner."""
SEEN = 0.1
"""A jump at some distance is told where it is as large as this share of what the slope makes until there."""
DROWNED = "noise of {:.2g} in the figure drowns it; a smaller run.accuracy may help"
UNSETTLED = "differences do not settle as the step falls: {:.2g} of the derivative is not sure"


@dataclass(frozen=True)
class Derivative:
    """d figure / d parameter in SI, or the sentence that says why it is not told (`value` is None then).

    `elasticity` is the relative change of the figure over that of the parameter; None where one of them is 0. `error`
    is an estimate of what the difference is off; what the accuracy of the run leaves in the figure comes on top.
    `below` and `above` are the slopes on both sides where there is a corner. `step` is that of the difference.
    `sentence` may also tell of a jump at some distance.
    """

    figure: str
    parameter: str
    status: str
    at: float
    """The figure itself."""
    value: float | None
    unit: str
    elasticity: float | None
    error: float | None
    step: float | None
    below: float | None = None
    above: float | None = None
    sentence: str = ""


@dataclass(frozen=True)
class _Found:
    """What became of one figure over one parameter, in changes z."""

    status: str
    sentence: str = ""
    below: float | None = None
    above: float | None = None


def derivative(
    runs: Runs, figure: str, index: int, bounds: tuple[Floats, Floats], noise: float, unit: str
) -> Derivative:
    """The derivative of a figure to the parameter of this index. `bounds`: of z, `noise`: of the figure."""
    varied, begun = runs.varied[index], runs.step(index, 0.0)
    at, asked, made = runs.at(begun).figure(figure), runs.figure(figure), _Side(runs, figure, index, bounds, noise)
    if not made.sides():
        return Derivative(figure, varied.name, UNTOLD, at, None, unit, None, None, None, sentence=made.no_value())
    step = step_of(asked, begun, index, bounds, noise)
    limit, beyond = made.nearest_jump(step)
    if step.size > limit:
        step = step_of(asked, begun, index, bounds, noise, [limit * SHRINKS**-k for k in range(FEW)])
    found = made.verdict(step, beyond)
    slope = made.slope(step.size) if found.status == SMOOTH else None
    value = None if slope is None else slope / varied.scale
    relative = None if value is None or not at or not varied.value else value * varied.value / at
    error = None if value is None else max(step.deviation, made.scatter(step)) / varied.scale
    below, above = (None if one is None else one / varied.scale for one in (found.below, found.above))
    return Derivative(figure, varied.name, found.status, at, value, unit, relative, error, step.size * varied.scale,
                      below, above, found.sentence)  # fmt: skip


@dataclass(frozen=True)
class _Side:
    """One figure over one parameter, on both sides of the model as it is."""

    runs: Runs
    figure: str
    index: int
    bounds: tuple[Floats, Floats]
    noise: float

    def verdict(self, step: Step, beyond: str) -> _Found:
        """Whether there is a derivative, and what is to be said; `beyond`: of what lies farther away."""
        done = self._done()
        for side in self.sides():
            if self._jumps(side, done):
                return _Found(JUMP, self._jump(side, done[-1]))
        if not math.isfinite(step.deviation):
            return _Found(UNTOLD, self.no_value())
        if corner := self._corner(step, done):
            return corner
        off = max(step.deviation, self.scatter(step))
        if off > TRUSTED * abs(self.slope(step.size)) and not self._flat(step.size, done):
            drowned = self.noise / step.size > step.deviation / 2
            share = step.error * (off / step.deviation if step.deviation else 1.0)
            return _Found(UNTOLD, DROWNED.format(self.noise) if drowned else UNSETTLED.format(share))
        return _Found(SMOOTH, beyond)

    def nearest_jump(self, step: Step) -> tuple[float, str]:
        """The largest step without a jump before it, and a sentence about the jump; infinite where none was seen.

        At a jump the figure, or what it is off its slope, moves far more from one step to the next than any smooth one
        would, with other zone changes.
        """
        for size, smaller in reversed(list(itertools.pairwise(self._done()))):
            slope = self.slope(step.size) if smaller >= step.size and math.isfinite(step.deviation) else 0.0
            for side in self.sides():
                ends = [self._end(side, one) for one in (smaller, size)]
                near, far = (self._off(slope, end) for end in ends)
                least = max(ABOVE_NOISE * self.noise, self.runs.accuracy * abs(self._figure(0.0)),
                            SEEN * abs(slope * ends[1]))  # fmt: skip
                if far > max(SUDDEN * near, least):
                    if not self._switch(*ends):
                        continue
                    (one, other), word = self._narrowed(slope, ends[0], ends[1])
                    what = f"it {word} between {self._name(one)} and {self._name(other)}"
                    return smaller, self._with_switch(what, one, other)
        return math.inf, ""

    def _narrowed(self, slope: float, near: float, far: float) -> tuple[tuple[float, float], str]:
        """Two changes between which the figure leaves its slope, and what it does there: a jump keeps its size."""
        least, size = SUDDEN * self._off(slope, near), self._off(slope, far)
        for _ in range(BISECTIONS):
            middle = (near + far) / 2
            near, far = (near, middle) if self._off(slope, middle) > least else (middle, far)
            if self._off(slope, far) < LEAST_RATIO * size:
                return (near, far), "has a corner"
        return (near, far), "jumps"

    def slope(self, size: float) -> float:
        """The difference with a step."""
        high, low = (self._end(side, size) for side in (1.0, -1.0))
        return (self._figure(high) - self._figure(low)) / (high - low)

    def sides(self) -> list[float]:
        """The sides, -1 and 1, on which the model has values of the parameter."""
        return [side for side in (-1.0, 1.0) if self._end(side, LADDER[0]) != 0]

    def _end(self, side: float, size: float) -> float:
        low, high = self.bounds[0][self.index], self.bounds[1][self.index]
        return float(min(max(side * size, low), high))

    def _done(self) -> list[float]:
        """Steps that were run, on both sides, the largest first."""
        ends = {abs(one[self.index]) for one in self.runs.made if all(
            not change for k, change in enumerate(one) if k != self.index)}  # fmt: skip
        return sorted((size for size in {*ends, *LADDER} - {0.0} if self._is_run(size)), reverse=True)

    def _is_run(self, size: float) -> bool:
        return all(tuple(self.runs.step(self.index, self._end(side, size)).tolist()) in self.runs.made
                   for side in (-1.0, 1.0))  # fmt: skip

    def _figure(self, change: float) -> float:
        return self.runs.along(self.index, change).figure(self.figure)

    def _apart(self, side: float, size: float) -> float:
        """How far the figure moves; infinite where it exists on one side only."""
        return self._off(0.0, self._end(side, size))

    def _off(self, slope: float, change: float) -> float:
        """How far the figure is off a straight line; infinite where it exists on one side only."""
        here, there = self._figure(0.0), self._figure(change)
        if math.isnan(here) and math.isnan(there):
            return 0.0
        return math.inf if math.isnan(here) or math.isnan(there) else abs(there - here - slope * change)

    def _jumps(self, side: float, done: Sequence[float]) -> bool:
        last, before = self._apart(side, done[-1]), self._apart(side, done[-2])
        if not math.isfinite(last):
            return True
        size = max(abs(self._figure(0.0)), abs(self._figure(self._end(side, done[-1]))))
        return last > max(ABOVE_NOISE * self.noise, self.runs.accuracy * size) and last > LEAST_RATIO * before

    def _jump(self, side: float, size: float) -> str:
        change = self._end(side, size)
        here, there = self._figure(0.0), self._figure(change)
        ends = [self._name(0.0), self._name(change)]
        what = f"it jumps from {here:.6g} at {ends[0]} to {there:.6g} at {ends[1]}"
        return self._with_switch(what, 0.0, change)

    def _corner(self, step: Step, done: Sequence[float]) -> _Found | None:
        sizes = [size for size in done if size <= step.size][:3]
        if not self._apart_on_both_sides(sizes) or self._scatters(sizes):
            return None
        size, near = sizes[0], self._slopes(sizes[1])
        ends = [self._end(side, size) for side in (-1.0, 1.0)]
        what = f"it has a corner at {self._name(0.0)}: the slopes on both sides differ"
        return _Found(CORNER, self._with_switch(what, *ends), *near)

    def scatter(self, step: Step) -> float:
        """What a derivative is off by because the slopes on both sides differ, and not as at a corner; else 0."""
        sizes = [size for size in self._done() if size <= step.size][:3]
        if not self._apart_on_both_sides(sizes) or not self._scatters(sizes):
            return 0.0
        below, above = self._slopes(sizes[0])
        return abs(above - below) / 2

    def _apart_on_both_sides(self, sizes: Sequence[float]) -> bool:
        """Whether the slopes on both sides differ by more than noise, and go on doing so with a smaller step."""
        if len(self.sides()) < 2 or len(sizes) < 2:
            return False
        (below, above), near = self._slopes(sizes[0]), self._slopes(sizes[1])
        gap, next_gap = abs(above - below), abs(near[1] - near[0])
        return bool(gap > CLEAR * max(abs(below), abs(above)) and next_gap > LEAST_RATIO * gap and
                    next_gap > ABOVE_NOISE * self.noise / sizes[1])  # fmt: skip

    def _scatters(self, sizes: Sequence[float]) -> bool:
        """Whether the slopes of both sides change with the step by half of what they differ by, and more than noise."""
        slopes = [self._slopes(size) for size in sizes]
        gap = abs(slopes[0][1] - slopes[0][0])
        return any(abs(one[0] - other[0]) + abs(one[1] - other[1]) > LEAST_RATIO * gap + ABOVE_NOISE * self.noise / size
                   for (one, other), size in zip(itertools.pairwise(slopes), sizes[1:]))  # fmt: skip

    def _slopes(self, size: float) -> tuple[float, float]:
        """Differences to below and to above."""
        here, ends = self._figure(0.0), [self._end(side, size) for side in (-1.0, 1.0)]
        below, above = ((self._figure(end) - here) / end for end in ends)
        return below, above

    def _flat(self, most: float, done: Sequence[float]) -> bool:
        """Whether the figure moves no more than its noise: then the derivative is 0 within its error."""
        near = [size for size in done if size <= most]
        return all(self._apart(side, size) <= ABOVE_NOISE * self.noise for side in self.sides() for size in near)

    def no_value(self) -> str:
        """Why there is no difference to take."""
        points = [point for z, point in self.runs.made.items()
                  if not any(change for k, change in enumerate(z) if k != self.index)]  # fmt: skip
        point = next((one for one in reversed(points) if not one.row.ok), None)
        if point is not None:
            values = ", ".join(f"{name} = {value:.6g}" for name, value in point.row.values.items())
            return f"the run with {values} is {point.row.status}: {point.row.sentence}"
        return "the figure has no value at some of the values tried: what it asks for does not happen there"

    def _name(self, change: float) -> str:
        varied = self.runs.varied[self.index]
        return f"{varied.name} = {varied.at(change):.8g}"

    def _with_switch(self, what: str, one: float, other: float) -> str:
        switch = self._switch(one, other)
        return f"{what}; {switch}" if switch else what

    def _switch(self, one: float, other: float) -> str:
        """The zone change in which the runs at two changes differ, "" where none does."""
        first, second = self.runs.along(self.index, one), self.runs.along(self.index, other)
        names = f"{self.runs.varied[self.index].at(one):.8g}", f"{self.runs.varied[self.index].at(other):.8g}"
        return parting(first.events, second.events, names)
