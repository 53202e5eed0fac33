"""What is connected with what: parts of an undirected graph, and layers of a directed one without circles.

A graph is the neighbours of every vertex, `{vertex: [neighbour, ...]}`. Everything comes in the order in which it was
put in, so no result depends on hashes. Only what nearly every model needs is here; rarer questions (bridges, the
shortest path of a rigid loop) go to networkx, whose import takes a tenth of a second.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import TypeVar

V = TypeVar("V", bound=Hashable)


def of_paths(vertices: Iterable[V], paths: Iterable[Sequence[V]]) -> dict[V, list[V]]:
    """The graph of these vertices, in which the neighbours in every path are joined; both ways are in it."""
    graph: dict[V, list[V]] = {vertex: [] for vertex in vertices}
    for path in paths:
        for vertex in path:
            graph.setdefault(vertex, [])
        for one, two in pairwise(path):
            graph[one].append(two)
            graph[two].append(one)
    return graph


def connected_parts(graph: Mapping[V, Iterable[V]]) -> Iterator[list[V]]:
    """Connected components, each breadth first from its first vertex."""
    reached: set[V] = set()
    for start in graph:
        if start in reached:
            continue
        reached.add(start)
        part = [start]
        for vertex in part:
            for other in graph[vertex]:
                if other not in reached:
                    reached.add(other)
                    part.append(other)
        yield part


def ranks(followers: Mapping[V, Iterable[V]]) -> dict[V, int]:
    """The rank of every vertex: 0 with none before it, else one more than the highest before it (Kahn 1962).

    Every vertex is a key, also one without followers. What lies on a circle or behind one has no rank.
    """
    before = dict.fromkeys(followers, 0)
    for found in followers.values():
        for vertex in found:
            before[vertex] += 1
    layer, rank, known = [vertex for vertex, count in before.items() if not count], 0, {}
    while layer:
        known.update(dict.fromkeys(layer, rank))
        rank, last, layer = rank + 1, layer, []
        for vertex in last:
            for other in followers[vertex]:
                before[other] -= 1
                if not before[other]:
                    layer.append(other)
    return known
