"""Which contacts may close a circle of held contacts: side by side, in a ring, between driven bodies.

Bodies are nodes, all prescribed ones together one node, and every contact that may hold an edge. An edge that
lies on no circle is a bridge: however many contacts hold, its force is determined by the bodies it holds.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from fairlead.component.instantiate import PortRef
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels.structure import Structure

REST = -1  # stands for all groups that never move


@dataclass(frozen=True)
class HeldPair:
    """An unknown force that holds two groups together:  slip = sum of coefficient * speed over both ends."""

    path: str
    unknown: str
    ends: tuple[tuple[int, float], tuple[int, float]]  # group (or REST), coefficient of its speed
    sense: float  # what a group takes in over that coefficient, for an unknown of one


def circles(flat: FlatModel, structures: Mapping[str, Structure]) -> list[HeldPair]:
    """Those that lie on a circle, in the order of the instances."""
    pairs = [pair for instance in flat.instances for pair in _pairs(flat, instance.path, structures[instance.path])]
    edges = [_edge(flat, pair) for pair in pairs]
    if _forest(edges):
        return []
    import networkx as nx  # takes a tenth of a second; most scenes have no circle

    parallel = Counter(edges)
    bridges = {_sorted(edge) for edge in nx.bridges(nx.Graph(edge for edge in edges if edge[0] != edge[1]))}
    return [pair for pair, edge in zip(pairs, edges, strict=True) if parallel[edge] > 1 or edge not in bridges]


def _pairs(flat: FlatModel, path: str, structure: Structure) -> Iterator[HeldPair]:
    for unknown, speeds in structure.pairs.items():
        ends = [end(flat, path, port, speed) for port, speed in speeds.items()]
        if len(ends) <= 2:
            one, other = (*ends, (REST, 1.0))[:2]
            yield HeldPair(path, unknown, (one, other), structure.senses[unknown])


def end(flat: FlatModel, path: str, port: str, speed: float) -> tuple[int, float]:
    """The group a port belongs to, and what a unit of its speed adds to the slip, for a `speed` at the port."""
    index, ratio, _ = flat.place(PortRef(path, port))
    prescribed = flat.groups[index].prescribed
    return (REST, 1.0) if prescribed is not None and prescribed.outputs is None else (index, speed * ratio)


def _edge(flat: FlatModel, pair: HeldPair) -> tuple[int, int]:
    one, other = (index if index != REST and flat.groups[index].free else REST for index, _ in pair.ends)
    return _sorted((one, other))


def _sorted(edge: tuple[int, int]) -> tuple[int, int]:
    return min(edge), max(edge)


def _forest(edges: Sequence[tuple[int, int]]) -> bool:
    """True if no edge closes a circle: by union-find, before anything dearer is asked."""
    above: dict[int, int] = {}
    for edge in edges:
        one, other = (_root(above, node) for node in edge)
        if one == other:
            return False
        above[one] = other
    return True


def _root(above: dict[int, int], node: int) -> int:
    top = node
    while top in above:
        top = above[top]
    while node != top:  # all on the way point to the top from now on
        above[node], node = top, above[node]
    return top
