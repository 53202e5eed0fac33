"""Where the search of a larger law begins too: at the fit of a law that it contains.

A law contains another one if for some p its components have all numbers that those of the other have. This p is sought
from the numbers alone, between the bounds and without a run:

    min over p of   sum over numbers n of ((n(p) - n of the contained law)/size)^2

Numbers are those of components that both have; a size is the larger of the two, with p at its start. What none of
them tells, such as the speed of a fall of friction whose height is zero, is tried at its start, and at both bounds.
What comes out is a place to begin and no more: whether it is any good the records say.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.component.numbers import numbers
from fairlead.errors import ModelError
from fairlead.model import Model
from fairlead.studies.fits.problem import FAR, Problem

Floats = NDArray[np.float64]
TURNS = 50
NEAR = 0.05
"""Distance of all numbers, in their sizes, at which equal names are enough: bounds may not let them be equal."""


@dataclass(frozen=True)
class Contained:
    """A law that was fitted: the names of its parameters, and all numbers of its model, for the values it came to."""

    fitted: frozenset[str]
    numbers: dict[str, float]

    @classmethod
    def of(cls, model: Model, values: Mapping[str, float]) -> Contained:
        """What there is of a model at values of its parameters."""
        return cls(frozenset(values), _numbers(model, values))


def _numbers(model: Model, values: Mapping[str, float]) -> dict[str, float]:
    made = model.beside(values)
    return {name: value for name, (value, _) in numbers(made.netlist, made.assembly.entries).items()}


def places(problem: Problem, model: Model, like: Contained) -> list[Floats]:
    """Where a search over the parameters of a problem begins, for a model to be like the contained one."""
    (low, high), names = problem.bounds, [one.name for one in problem.sought]
    own = _z(problem, {one.name: one.start for one in problem.sought})
    by_name = _z(problem, {one.name: like.numbers.get(one.name, one.start) for one in problem.sought})
    fitted = np.array([name in like.fitted for name in names])
    try:
        distance = _Distance(problem, model, like.numbers, own)
    except ModelError:
        return []
    found, told = by_name, np.array([name in like.numbers for name in names])
    if np.abs(distance(by_name)).max(initial=0.0) > NEAR:
        found, told = distance.least(np.where(fitted, by_name, own))
        told |= fitted
    if told.all():
        return [found]
    return [found, np.where(told, found, low), np.where(told, found, high)]


def _z(problem: Problem, values: Mapping[str, float]) -> Floats:
    """What is searched, for values that are brought between the bounds."""
    return problem.z(min(max(values[one.name], one.low), one.high) for one in problem.sought)


class _Distance:
    """Numbers of a model's components less those of the contained law, in their sizes, over z."""

    def __init__(self, problem: Problem, model: Model, wanted: Mapping[str, float], start: Floats) -> None:
        """Raises ModelError when the model refuses the start."""
        self.problem, self.model = problem, model
        mine = _numbers(model, problem.values(start))
        self.names = [name for name in mine if "." in name and name in wanted]
        self.wanted = np.array([wanted[name] for name in self.names])
        size = np.maximum(np.abs(self.wanted), np.abs([mine[name] for name in self.names]))
        self.size = np.where(size > 0, size, 1.0)

    def __call__(self, z: Floats) -> Floats:
        try:
            found = _numbers(self.model, self.problem.values(z))
        except ModelError:
            return np.full(len(self.names), FAR)
        return (np.array([found[name] for name in self.names]) - self.wanted) / self.size

    def least(self, start: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """Where it is least, at bounds if it is no more there, and which parameters have a part in it."""
        from scipy.optimize import least_squares

        low, high = self.problem.bounds
        room = 1e-6 * (high - low)
        best = least_squares(self, np.clip(start, low + room, high - room), bounds=(low, high), max_nfev=TURNS)
        z, least = best.x, float(best.fun @ best.fun)
        for k, end in [(k, bound[k]) for k in range(len(z)) for bound in (low, high)]:
            at = np.where(np.arange(len(z)) == k, end, z)
            off = self(at)
            if best.jac[:, k].any() and float(off @ off) <= least:
                z, least = at, float(off @ off)
        return z, best.jac.any(axis=0)
