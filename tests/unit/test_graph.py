"""Connected parts and ranks agree with networkx on random graphs, and come in the order of what was put in."""

import random

import networkx as nx
import pytest

from fairlead.flatten.graph import connected_parts, of_paths, ranks


@pytest.mark.parametrize("seed", range(20))
def test_connected_parts_are_those_of_another_library(seed: int) -> None:
    chance = random.Random(seed)
    count = chance.randrange(1, 60)
    paths = [[chance.randrange(count) for _ in range(chance.randrange(1, 4))] for _ in range(chance.randrange(40))]
    other = nx.Graph()
    other.add_nodes_from(range(count))
    for path in paths:
        nx.add_path(other, path)
    found = list(connected_parts(of_paths(range(count), paths)))
    assert [set(part) for part in found] == [set(part) for part in nx.connected_components(other)]
    assert sorted(vertex for part in found for vertex in part) == list(range(count))


@pytest.mark.parametrize("seed", range(20))
def test_ranks_are_the_generations_of_another_library_and_a_circle_has_none(seed: int) -> None:
    chance = random.Random(seed)
    count = chance.randrange(2, 40)
    edges = {tuple(sorted(chance.sample(range(count), 2))) for _ in range(chance.randrange(60))}
    followers = {k: [b for a, b in sorted(edges) if a == k] for k in range(count)}
    other = nx.DiGraph(edges)
    other.add_nodes_from(range(count))
    expected = {k: rank for rank, layer in enumerate(nx.topological_generations(other)) for k in layer}
    assert ranks(followers) == expected
    ring = {**followers, count - 1: [0]}
    turned = nx.DiGraph((a, b) for a in ring for b in ring[a])
    circles = {k for part in nx.strongly_connected_components(turned) if len(part) > 1 for k in part}
    behind = {k for one in circles for k in nx.descendants(turned, one)}
    assert set(ranks(ring)) == set(ring) - circles - behind


def test_parts_come_in_the_order_in_which_vertices_were_put_in() -> None:
    assert list(connected_parts(of_paths("dcba", ["bd", "ac"]))) == [["d", "b"], ["c", "a"]]
