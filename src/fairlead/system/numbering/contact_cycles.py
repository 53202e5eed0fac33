"""Which contacts may close a circle of held contacts: side by side, in a ring, between driven bodies.

Bodies are nodes, all prescribed ones together one node, and every contact that may hold an edge. An edge that
lies on no circle is a bridge: however many contacts hold, its force is determined by the bodies it holds.

A circle round which the speeds agree only at rest, as that of a screw and its nut whose flanks stick, holds its bodies
at rest. So they are joined with what is at rest by such a circle too: a stop at the nut closes another one there.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from fairlead.component.assembly import Instance
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels.break_away import number_of
from fairlead.kernels.structure import Structure

REST = -1  # stands for all groups that never move
AGREES = 1e-9  # relative; speeds round a circle are products of rounded numbers


@dataclass(frozen=True)
class HeldPair:
    """An unknown force that holds two groups together:  slip = sum of coefficient * speed over both ends."""

    path: str
    unknown: str
    ends: tuple[tuple[int, float], tuple[int, float]]  # group (or REST), coefficient of its speed
    sense: float  # what a group takes in over that coefficient, for an unknown of one


def circles(flat: FlatModel, structures: Mapping[str, Structure]) -> list[HeldPair]:
    """Those that lie on a circle, in the order of the instances."""
    still = _standing(flat, structures)
    pairs = [one for each in flat.instances for one in _pairs(flat, each, structures[each.path], still)]
    edges = [_edge(flat, pair) for pair in pairs]
    if _forest(edges):
        return []
    import networkx as nx  # takes a tenth of a second; most scenes have no circle

    every = edges + _at_rest(pairs, edges)
    parallel = Counter(every)
    bridges = {_sorted(edge) for edge in nx.bridges(nx.Graph(edge for edge in every if edge[0] != edge[1]))}
    return [pair for pair, edge in zip(pairs, edges, strict=True) if parallel[edge] > 1 or edge not in bridges]


def numbers(circles: Sequence[HeldPair], bodies: Collection[int]) -> tuple[list[int], dict[int, int]]:
    """The circles that have one of `bodies` in common are one. Their numbers, from 1, by pair and by body.

    Bodies are those that move freely: no share of a force passes one whose motion is given.
    """
    above: dict[int, int] = {}
    through = [[index for index, _ in pair.ends if index in bodies] for pair in circles]
    for joined in through:
        if len(joined) == 2 and _root(above, joined[0]) != _root(above, joined[1]):
            above[_root(above, joined[0])] = _root(above, joined[1])
    number: dict[int, int] = {}
    of_bodies = {body: number.setdefault(_root(above, body), len(number) + 1) for body in bodies}
    alone = iter(range(len(number) + 1, len(number) + len(circles) + 1))  # between two whose motions are given
    return [of_bodies[joined[0]] if joined else next(alone) for joined in through], of_bodies


def moved_apart(circles: Sequence[HeldPair], bodies: Collection[int]) -> list[str]:
    """Contacts of circles that join motions that are given and not the same, by path: these may contradict each other.

    Bodies as in `numbers`. All that stands is one motion.
    """
    of_pairs, _ = numbers(circles, bodies)
    given: dict[int, set[int]] = {}
    for pair, number in zip(circles, of_pairs, strict=True):
        given.setdefault(number, set()).update(index for index, _ in pair.ends if index not in bodies)
    apart = (pair.path for pair, number in zip(circles, of_pairs, strict=True) if len(given[number]) > 1)
    return list(dict.fromkeys(apart))


def _standing(flat: FlatModel, structures: Mapping[str, Structure]) -> frozenset[int]:
    """Groups whose motion is given, by a law whose speed is nothing else than zero: fixed points."""
    found = set()
    for index, group in enumerate(flat.groups):
        given = group.prescribed
        if given is not None and given.outputs is not None:
            found |= {index} if given.outputs[1] in structures[given.by.instance].zeros else set()
    return frozenset(found)


def _pairs(flat: FlatModel, instance: Instance, structure: Structure, still: frozenset[int]) -> Iterator[HeldPair]:
    path = instance.path
    if not (structure.pairs or structure.ratios):
        return
    for unknown, speeds in {**structure.pairs, **weighed(instance, structure)}.items():
        joined = ends(flat, path, speeds, still)
        moving = [one for one in joined if one[0] != REST]  # a lever whose pivot stands joins two
        if len(moving) <= 2:
            one, other = (*moving, (REST, 1.0), (REST, 1.0))[:2]
            yield HeldPair(path, unknown, (one, other), structure.senses[unknown])


def weighed(instance: Instance, structure: Structure) -> dict[str, dict[str, float]]:
    """Coefficients that are made of parameters, in numbers."""
    return {
        unknown: {port: number_of(text, instance.values) for port, text in texts.items()}
        for unknown, texts in structure.ratios.items()
    }


def ends(
    flat: FlatModel, path: str, speeds: Mapping[str, float], still: Collection[int] = ()
) -> list[tuple[int, float]]:
    """Every group that a slip is a sum of speeds of, with its coefficient: two ports may belong to one, over a gear.

    Those that stand are all REST, as are those of `still`.
    """
    found: dict[int, float] = {}
    for port, speed in speeds.items():
        index, coef = _end(flat, path, port, speed, still)
        found[index] = coef if index == REST else found.get(index, 0.0) + coef
    return list(found.items())


def _end(flat: FlatModel, path: str, port: str, speed: float, still: Collection[int]) -> tuple[int, float]:
    """The group a port belongs to, and what a unit of its speed adds to the slip, for a `speed` at the port."""
    index, ratio, _ = flat.places[path, port]
    prescribed = flat.groups[index].prescribed
    stands = index in still or (prescribed is not None and prescribed.outputs is None)
    return (REST, 1.0) if stands else (index, speed * ratio)


def _edge(flat: FlatModel, pair: HeldPair) -> tuple[int, int]:
    one, other = (index if index != REST and flat.groups[index].free else REST for index, _ in pair.ends)
    return _sorted((one, other))


def _at_rest(pairs: Sequence[HeldPair], edges: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """An edge to what is at rest for every contact that closes a circle round which speeds agree only at rest."""
    above: dict[int, tuple[int, float]] = {}  # of a body: one above it, and its own speed over that of the other
    found = []
    for pair, edge in zip(pairs, edges, strict=True):
        if REST in edge:
            continue  # what hangs on it is at rest anyhow
        (one, slip_one), (other, slip_other) = ((_top(above, index), coef) for index, coef in pair.ends)
        slip_one, slip_other = slip_one * one[1], slip_other * other[1]
        if one[0] != other[0]:
            above[other[0]] = one[0], -slip_one / slip_other
        elif abs(slip_one + slip_other) > AGREES * (abs(slip_one) + abs(slip_other)):
            found.append(_sorted((REST, edge[0])))
    return found


def _top(above: Mapping[int, tuple[int, float]], node: int) -> tuple[int, float]:
    """The body at the top, and the speed of this one over its speed."""
    ratio = 1.0
    while node in above:
        node, own = above[node]
        ratio *= own
    return node, ratio


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
