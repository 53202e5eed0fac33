"""Devices put in their places: names, positions, overlaps and slits."""

from __future__ import annotations

import functools
import itertools
import math
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from fairlead.components.route.window import Window

from fairlead.component import Stations

TOUCHES = 1e-6  # m; ends that are this close are one place
MOST_TURNS = 6  # of a line round one device; a capstan has three or four


@dataclass(frozen=True)
class Placed:
    """A device at its place on the route: `begin` and `end` [m] may be infinite at the ends of the route."""

    name: str
    number: int  # in the list of the netlist
    station: Any
    begin: float
    end: float

    def window(self, height: float = 1.0) -> Window:
        """Its window, counting `height` per length."""
        return Window(self.begin, self.end, height, self.station.edge)

    @functools.cached_property
    def curvature(self) -> float:
        """1/m; 0 when straight."""
        radius = self.station.bend_radius()
        return 1 / radius if radius else 0.0


def place(stations: Iterable[Any]) -> list[Placed]:
    """Positions of all devices in the order of the list; one without `start` begins where the last ended."""
    placed: list[Placed] = []
    at = 0.0
    for number, (name, station) in enumerate(zip(Stations.names(stations := list(stations)), stations, strict=True)):
        start = at if station.start is None else station.start
        begin, end = station.span(start)
        placed.append(Placed(name, number, station, begin, end))
        at = end if math.isfinite(end) else start
    return placed


def misplaced(stations: Iterable[Any]) -> Iterator[tuple[str, str, str]]:
    """(parameter, what is wrong, way out) for names given twice, devices that overlap, and slits between them."""
    placed = place(stations)
    for name, count in Counter(one.name for one in placed).items():
        if count > 1:
            again = [one.number for one in placed if one.name == name][1]
            yield f"stations[{again}].name", f"{count} devices are called {name}", "Give each a name of its own."
    for one in placed:
        turns = getattr(one.station, "angle", 0.0) / (2 * math.pi)
        if turns > MOST_TURNS:
            what = f"{one.name} turns the line {turns:.3g} times round; {MOST_TURNS} are allowed"
            yield f"stations[{one.number}].angle", what, "A bare number is in rad; write 90 deg for degrees."
    ordered = sorted(placed, key=lambda one: (one.begin, one.end))
    for before, after in itertools.pairwise(ordered):
        gap = after.begin - before.end
        if gap < -TOUCHES:
            what = (
                f"{after.name} begins at {after.begin:g} m, before {before.name} ends at {before.end:g} m: they "
                f"overlap by {-gap:.3g} m"
            )
            yield f"stations[{after.number}]", what, "Move one of them, or leave out `start` to begin where it ends."
    for one in placed:
        if one.station.start is not None and one.number and _out_of_order(placed[one.number - 1], one):
            what = f"{one.name} stands after {placed[one.number - 1].name} in the list, but lies inboard of it"
            yield f"stations[{one.number}]", what, "List the devices from the winch to the sea."


def _out_of_order(before: Placed, after: Placed) -> bool:
    return after.end <= before.begin and after.begin < before.begin


def slits(placed: Iterable[Placed], element: float) -> Iterator[tuple[Placed, Placed, float]]:
    """Gaps between devices that are shorter than an element, so that a node is in both and in neither."""
    ordered = sorted(placed, key=lambda one: (one.begin, one.end))
    for before, after in itertools.pairwise(ordered):
        gap = after.begin - before.end
        if TOUCHES < gap < element:
            yield before, after, gap
