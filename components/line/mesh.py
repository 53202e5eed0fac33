"""How a line is cut into elements: lengths, modules, bulkheads."""

from __future__ import annotations

import bisect
import functools
import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from fairlead.components.route.window import Reach

from fairlead.errors import Fault, ModelError

MOST_ELEMENTS = 20_000


@dataclass(frozen=True)
class Mesh:
    """Places of the nodes along the line [m], from its inboard end; and which of them are connectors."""

    places: tuple[float, ...]
    connectors: frozenset[int]

    @property
    def elements(self) -> int:
        """How many elements."""
        return len(self.places) - 1

    def length(self, element: int) -> float:
        """Length of an element [m]."""
        return self.places[element + 1] - self.places[element]

    @property
    def lengths(self) -> list[float]:
        """Lengths of all elements [m]."""
        return [self.length(k) for k in range(self.elements)]

    def reach(self, node: int) -> Reach:
        """The piece of line that a node stands for: half of each adjacent element."""
        return self._reaches[node]

    @functools.cached_property
    def _reaches(self) -> list[Reach]:
        halves = [0.0, *(_tidy(length / 2) for length in self.lengths), 0.0]
        return [Reach(behind, ahead) for behind, ahead in itertools.pairwise(halves)]

    def beside(self, node: int, reach: Reach) -> tuple[int, int]:
        """The nodes inboard and outboard of one, half way to which its piece reaches; itself where that is nowhere."""
        here = self.places[node]
        ends = (here - 2 * reach.behind, here + 2 * reach.ahead)
        behind, ahead = (_nearest(self.places, place, 0, self.elements) for place in ends)
        return behind, ahead

    def neighbours(self, node: int) -> list[int]:
        """Elements that meet at a node, inboard first."""
        return [k for k in (node - 1, node) if 0 <= k < self.elements]


def too_fine(length: float, element: float) -> Iterator[tuple[str, str, str]]:
    """The mistake of elements so short that there are more than anybody can wait for."""
    if length > MOST_ELEMENTS * element:
        yield (
            "element",
            f"elements of {element:g} m make {length / element:.3g} of them in {length:g} m; at most {MOST_ELEMENTS}",
            f"Make them at least {length / MOST_ELEMENTS:.2g} m.",
        )


def _tidy(length: float) -> float:
    """Without the rounding of differences, so that equal elements are told to be equal."""
    return round(length, 12)


def cut(length: float, element: float, modules: int = 1, graded: Callable[[float], float] | None = None) -> Mesh:
    """Equal elements near `element` in every module; with `graded(place)` elements of the length it gives there.

    Raises ModelError for grades that make no elements, or too many.
    """
    module = length / modules
    places, connectors = [0.0], {0}
    for k in range(modules):
        begin = k * module
        inner = _equal(module, element) if graded is None else _graded(begin, module, graded)
        places += [begin + x for x in inner]
        connectors.add(len(places) - 1)
        if len(places) > MOST_ELEMENTS + modules:
            raise _ungraded(f"its lengths make more than {MOST_ELEMENTS} elements", "Give longer ones.")
    return Mesh(tuple(places), frozenset(connectors))


def _ungraded(what: str, way_out: str) -> ModelError:
    return ModelError([Fault(None, f"graded: {what}.", way_out)])


def _equal(length: float, element: float) -> list[float]:
    n = max(1, round(length / element))
    return [length * k / n for k in range(1, n + 1)]


def _graded(begin: float, length: float, graded: Callable[[float], float]) -> list[float]:
    """March with the wanted length at the middle of each element, then fit the whole into the module."""
    steps: list[float] = []
    at = 0.0
    while at < length * (1 - 1e-9):
        ahead = graded(begin + at)
        step = graded(begin + at + ahead / 2)
        if not (ahead > 0 and step > 0):
            what = f"an element at {begin + at:g} m would be {min(ahead, step):g} m long"
            raise _ungraded(what, "Give lengths above zero.")
        steps.append(step)
        at += step
        if len(steps) > MOST_ELEMENTS:
            raise _ungraded(f"its lengths make more than {MOST_ELEMENTS} elements", "Give longer ones.")
    over = sum(steps) - length
    if len(steps) > 1 and over > steps[-1] / 2:  # the last piece is nearer to nothing than to an element
        steps.pop()
    scale = length / sum(steps)
    return list(itertools.accumulate(step * scale for step in steps))


def bulkheads(mesh: Mesh, pitch: float | None) -> dict[int, Reach]:
    """Nodes that have a bulkhead, and the piece of core that presses on it.

    Without a pitch, or with one of at most an element, bulkheads are smeared: every node has its piece of them.
    Else they sit at the nodes nearest to multiples of the pitch from the connectors.
    """
    inner = [node for node in range(mesh.elements + 1) if node not in mesh.connectors]
    if pitch is None or pitch <= min(mesh.lengths):
        return {node: mesh.reach(node) for node in inner}
    chosen: set[int] = set()
    for first, last in itertools.pairwise(sorted(mesh.connectors)):
        begin, end = mesh.places[first], mesh.places[last]
        count = max(1, round((end - begin) / pitch))
        for k in range(1, count):
            place = begin + (end - begin) * k / count
            if first + 1 < last:
                chosen.add(_nearest(mesh.places, place, first + 1, last - 1))
    marks = sorted({*chosen, *mesh.connectors})
    found = {}
    for before, node, after in zip(marks, marks[1:], marks[2:], strict=False):
        if node not in mesh.connectors:
            here = mesh.places[node]
            found[node] = Reach(_tidy((here - mesh.places[before]) / 2), _tidy((mesh.places[after] - here) / 2))
    return found


def finest(mesh: Mesh) -> float:
    """Length of the shortest element [m]."""
    return min(mesh.lengths, default=math.inf)


def _nearest(places: Sequence[float], place: float, first: int, last: int) -> int:
    """The node from `first` to `last` that is nearest to a place; of two the inboard one."""
    after = bisect.bisect_left(places, place, first, last)
    before = max(after - 1, first)
    return before if place - places[before] <= places[after] - place else after
