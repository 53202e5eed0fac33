"""Figures and zone changes over the parameters, each point run once.

A point is z, the change of every parameter in its own size; z = 0 is the model as it is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fairlead.cases.cases import Cases
from fairlead.cases.row import REFUSED, Row
from fairlead.results.events import Event
from fairlead.studies.sensitivities.parameters import Varied

Floats = NDArray[np.float64]
Told = Callable[[str], None]


@dataclass(frozen=True)
class Point:
    """One run: its row and its zone changes in order."""

    row: Row
    events: tuple[Event, ...]

    def figure(self, name: str) -> float:
        """A figure; NaN where the run has none."""
        return self.row.figures.get(name, math.nan)


@dataclass
class Runs:
    """The runs of a model that a sensitivity needs; points that come again are not run again."""

    cases: Cases
    varied: Sequence[Varied]
    told: Told | None = None
    made: dict[tuple[float, ...], Point] = field(default_factory=dict)

    @property
    def accuracy(self) -> float:
        """Of the runs; what two of them differ by within it is no difference."""
        return float(self.cases.model.netlist.run.accuracy)

    def at(self, z: Floats) -> Point:
        """The run at a point."""
        key = tuple(z.tolist())
        if key not in self.made:
            if self.told is not None:
                self.told(f"{self.cases.name}: run {len(self.made) + 1}")
            values = {one.name: one.at(change) for one, change in zip(self.varied, key, strict=True) if change}
            self.made[key] = Point(*self.cases.followed(values))
        return self.made[key]

    def along(self, index: int, change: float) -> Point:
        """The run with one parameter changed."""
        return self.at(self.step(index, change))

    def step(self, index: int, change: float) -> Floats:
        """The point with one parameter changed."""
        z = np.zeros(len(self.varied))
        z[index] = change
        return z

    def figure(self, name: str) -> Callable[[Floats], Floats]:
        """One figure over z, shape (1,)."""
        return lambda z: np.array([self.at(z).figure(name)])

    def reach(self, index: int, steps: Sequence[float], side: float) -> float:
        """The largest of the steps on one side at which the model has such a value; 0 where there is none."""
        for size in steps:
            if self.along(index, side * size).row.status != REFUSED:
                return size
        return 0.0
