"""Where the boxes of a picture go: layers from left to right, few crossings, straight lines where possible.

Every wire and arrow is a point of its own between boxes. Layers are distances (breadth first) from what does
not move, so boxes and points alternate and every line leads to a neighbouring layer; the order inside a layer
follows the mean height of its neighbours, as in the method of Sugiyama, Tagawa and Toda (1981), IEEE Trans.
SMC 11(2), 109.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import networkx as nx

from fairlead.flatten.picture import Picture

LETTER, BOX_HEIGHT, PORT_HEIGHT, PADDING, DOT = 6.6, 38.0, 12.0, 12.0, 4.0  # px, for text of 12 px
BETWEEN_LAYERS, BETWEEN_BOXES = 58.0, 22.0
SWEEPS = 12  # the order settles after a few

Vertex = tuple[str, int]  # ("box", number), ("wire", number) or ("arrow", number)


@dataclass
class Place:
    """Centre and size of a box or point [px], and its layer."""

    x: float
    y: float
    width: float
    height: float
    layer: int


def place(drawn: Picture) -> dict[Vertex, Place]:
    """A place for every box, wire and arrow."""
    graph = _graph(drawn)
    places: dict[Vertex, Place] = {}
    floor = 0.0
    for members in nx.connected_components(graph):
        part = graph.subgraph(members)
        layers = _ordered(part, _layers(part, drawn))
        found = _spread(part, layers, drawn)
        top = min(p.y - p.height / 2 for p in found.values())
        for vertex in found:
            found[vertex].y += floor - top
        floor = max(p.y + p.height / 2 for p in found.values()) + 2 * BETWEEN_BOXES
        places |= found
    return places


def _graph(drawn: Picture) -> nx.Graph:
    graph = nx.Graph()
    graph.add_nodes_from(("box", k) for k in range(len(drawn.boxes)))
    for number, wire in enumerate(drawn.wires):
        graph.add_edges_from((("box", box), ("wire", number)) for box, _ in wire.ends)
    for number, arrow in enumerate(drawn.arrows):
        graph.add_edges_from((("box", end[0]), ("arrow", number)) for end in (arrow.source, arrow.target))
    return graph


def _layers(part: nx.Graph, drawn: Picture) -> list[list[Vertex]]:
    """Vertices by distance from the first box that is anchored, or else the first."""
    boxes = sorted(v for v in part if v[0] == "box")
    root = next((v for v in boxes if drawn.boxes[v[1]].anchored), boxes[0])
    return [sorted(layer) for layer in nx.bfs_layers(part, root)]


def _ordered(part: nx.Graph, layers: list[list[Vertex]]) -> list[list[Vertex]]:
    """Each layer sorted by the mean rank of its neighbours, forwards and backwards in turn."""
    for sweep in range(SWEEPS):
        rank = {v: k / max(len(layer) - 1, 1) for layer in layers for k, v in enumerate(layer)}
        for layer in layers if sweep % 2 == 0 else reversed(layers):
            near = {v: [rank[w] for w in part[v]] for v in layer}
            layer.sort(key=lambda v: (sum(near[v]) / len(near[v]) if near[v] else 0.0, v))
            rank |= {v: k / max(len(layer) - 1, 1) for k, v in enumerate(layer)}
    return layers


def _spread(part: nx.Graph, layers: list[list[Vertex]], drawn: Picture) -> dict[Vertex, Place]:
    """Coordinates: columns as wide as their boxes, heights drawn towards the neighbours."""
    places: dict[Vertex, Place] = {}
    x = 0.0
    for number, layer in enumerate(layers):
        sizes = [_size(v, drawn) for v in layer]
        column = max(width for width, _ in sizes)
        y = 0.0
        for vertex, (width, height) in zip(layer, sizes, strict=True):
            places[vertex] = Place(x + column / 2, y + height / 2, width, height, number)
            y += height + BETWEEN_BOXES
        x += column + BETWEEN_LAYERS
    for _ in range(2 * SWEEPS):
        for layer in layers:
            _pull(part, layer, places)
    return places


def _pull(part: nx.Graph, layer: list[Vertex], places: dict[Vertex, Place]) -> None:
    """Move a layer towards the mean height of its neighbours in other layers; boxes push each other apart."""
    for vertex in layer:
        others = [places[w].y for w in part[vertex]]
        if others:
            places[vertex].y = sum(others) / len(others)
    wanted = sum(places[v].y for v in layer)
    for upper, lower in pairwise(layer):
        least = places[upper].y + (places[upper].height + places[lower].height) / 2 + BETWEEN_BOXES
        places[lower].y = max(places[lower].y, least)
    shift = (wanted - sum(places[v].y for v in layer)) / len(layer)
    for vertex in layer:
        places[vertex].y += shift


def _size(vertex: Vertex, drawn: Picture) -> tuple[float, float]:
    if vertex[0] != "box":
        return 2 * DOT, 2 * DOT
    box = drawn.boxes[vertex[1]]
    ports = {end for wire in drawn.wires for end in wire.ends} | {e for a in drawn.arrows for e in (a.source, a.target)}
    height = max(BOX_HEIGHT, PORT_HEIGHT * (1 + sum(number == vertex[1] for number, _ in ports)))
    return max(len(box.name), len(box.caption)) * LETTER + 2 * PADDING, height
