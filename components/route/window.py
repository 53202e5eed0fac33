"""How much of a node lies in a device: windows that sum to one wherever the nodes are.

A node stands for the line from half an element behind it to half an element before it. Its weight in a device
on [begin, end] is the share of that piece inside; the pieces tile the line, so the weights of all nodes times
their lengths sum to the length of the device, for any mesh, and where one device ends and the next begins the
two weights sum to one. With equal elements this is the trapezoid with an edge of one element.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass

from fairlead.component.piecewise import PiecewisePolynomial, constant, linear_table

BEYOND = 1.0  # m; how far past its last corner a window that goes on for ever is told


@dataclass(frozen=True)
class Reach:
    """The piece of line that a node stands for: `behind` it (inboard) and `ahead` [m]."""

    behind: float
    ahead: float

    @property
    def length(self) -> float:
        """Length of the piece [m]."""
        return self.behind + self.ahead

    def widened(self, edge: float | None) -> Reach:
        """The same with an edge set by hand: as if the piece had that length."""
        return self if edge is None else Reach(edge / 2, edge / 2)


@dataclass(frozen=True)
class Window:
    """A device on [begin, end] of the route (either may be infinite) and what it counts, per length."""

    begin: float
    end: float
    height: float = 1.0
    edge: float | None = None

    def corners(self, reach: Reach) -> list[float]:
        """Where the weight of a node begins or ceases to change."""
        r = reach.widened(self.edge)
        borders = [b for b in (self.begin, self.end) if math.isfinite(b)]
        return [place for b in borders for place in (b - r.ahead, b + r.behind)]

    def weight(self, place: float, reach: Reach) -> float:
        """Share of the piece of a node at `place` that lies inside, times the height."""
        r = reach.widened(self.edge)
        inside = min(self.end, place + r.ahead) - max(self.begin, place - r.behind)
        return self.height * min(max(inside / r.length, 0.0), 1.0)


def total(windows: Iterable[Window], reach: Reach) -> PiecewisePolynomial:
    """The sum of windows over the place of a node: straight lines between corners."""
    windows = tuple(windows)
    places = sorted({corner for window in windows for corner in window.corners(reach)})
    places = [a for a, b in itertools.pairwise([*places, math.inf]) if b - a > 1e-9]
    if not places:
        return constant(sum(window.height for window in windows))
    if len(places) == 1:
        places.append(places[0] + BEYOND)
    return linear_table(places, [sum(window.weight(place, reach) for window in windows) for place in places])
