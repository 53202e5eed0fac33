"""Kinematic groups: nodes tied by rigid links and gears become one degree of freedom.

A union-find whose links carry a ratio and an offset,  position_b = ratio * position_a + offset.
Inertias add with the ratio squared. A loop that contradicts itself is an error that names the loop.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from fairlead.component.assembly import Assembly, Instance, Kind, PortRef, of_classes
from fairlead.component.declare import TRANSLATIONAL
from fairlead.component.replies import AnswerError
from fairlead.errors import Fault, listing
from fairlead.flatten.flat_model import Group, Node, Prescribed

ALONG = TRANSLATIONAL.name
NEXT_TO_NOTHING = 1e-12  # m or m/s, and rad: a difference of two start values that is none
AGREES = 1e-9  # relative; ratios and offsets of a loop are products of a few rounded numbers


@dataclass
class Ties:
    """Union-find over nodes. Each node knows its parent and how it moves with it."""

    parent: list[int]
    ratio: list[float] = field(default_factory=list)
    offset: list[float] = field(default_factory=list)

    def root(self, node: int) -> tuple[int, float, float]:
        """Root of a node, and ratio and offset of the node with respect to it."""
        ratio, offset = 1.0, 0.0
        while self.parent[node] != node:
            ratio, offset = ratio * self.ratio[node], ratio * self.offset[node] + offset
            node = self.parent[node]
        return node, ratio, offset

    def tie(self, a: int, b: int, ratio: float, offset: float) -> bool:
        """Demand b = ratio * a + offset; False if that contradicts what is tied already."""
        root_a, ra, oa = self.root(a)
        root_b, rb, ob = self.root(b)
        if root_a == root_b:
            agrees = math.isclose(rb, ratio * ra, rel_tol=AGREES)
            return agrees and math.isclose(ob, ratio * oa + offset, rel_tol=AGREES, abs_tol=AGREES)
        self.parent[root_b] = root_a  # rb * root_b + ob = ratio * (ra * root_a + oa) + offset
        self.ratio[root_b] = ratio * ra / rb
        self.offset[root_b] = (ratio * oa + offset - ob) / rb
        return True


def group(
    assembly: Assembly, nodes: list[Node], node_of: Mapping[PortRef, int]
) -> tuple[list[Group], dict[int, tuple[int, float, float]], list[Fault]]:
    """Merge tied nodes; returns groups, node -> (group, ratio, offset), and contradictions."""
    count = len(nodes)
    ties = Ties(list(range(count)), [1.0] * count, [0.0] * count)
    faults = _apply_ties(assembly, node_of, ties)
    members: dict[int, list[tuple[int, float, float]]] = {}
    for node in range(count):
        root, ratio, offset = ties.root(node)
        members.setdefault(root, []).append((node, ratio, offset))
    facts = _facts(assembly, node_of, faults)
    groups: list[Group] = []
    group_of: dict[int, tuple[int, float, float]] = {}
    for number, tied in enumerate(members.values()):
        inside = _told_by_a_body(tied, nodes, facts)
        made, wrong = _group(nodes, inside, facts)
        groups.append(made)
        faults += wrong
        group_of |= {node: (number, ratio, offset) for node, ratio, offset in inside}
    return groups, group_of, faults


def _told_by_a_body(tied: list[tuple[int, float, float]], nodes: list[Node], facts: Any
                    ) -> list[tuple[int, float, float]]:  # fmt: skip
    """The same group told by the motion of one body, and that first: its speed is an unknown, and errors have its unit.

    That is one that goes along rather than one that turns, and the heaviest of these where told by one motion: a matter
    of the scene, not of who is written first. A group without mass is told by its first node.
    """
    if len(tied) == 1:  # by itself
        return tied
    share = [ratio**2 * sum(value for kind, *_, value in facts.get(node, ()) if kind == "inertia")
             for node, ratio, _ in tied]  # fmt: skip
    alike = [share[k] > 0.0 and nodes[node].domain.name == ALONG for k, (node, *_) in enumerate(tied)]
    chosen = alike if any(alike) else [own > 0.0 for own in share]
    most = max((own for own, is_one in zip(share, chosen, strict=True) if is_one), default=0.0)
    first = next((k for k, own in enumerate(share) if chosen[k] and own >= (1.0 - AGREES) * most), 0)
    _, unit, zero = tied[first]
    again = [(node, ratio / unit, offset - ratio / unit * zero) for node, ratio, offset in tied]
    return [again[first], *again[:first], *again[first + 1 :]]


def _apply_ties(assembly: Assembly, node_of: Mapping[PortRef, int], ties: Ties) -> list[Fault]:
    faults: list[Fault] = []
    written: list[tuple[int, int, str]] = []  # the two nodes of every tie, and whose it is
    for instance in of_classes(assembly.instances.values(), lambda kind: kind.answers.ties is not None):
        for a, b, ratio, offset in asked(instance, "ties", faults) or ():
            one, two = node_of[PortRef(instance.path, a)], node_of[PortRef(instance.path, b)]
            if not ties.tie(one, two, ratio, offset):
                names = [instance.path, *_between(written, one, two)]
                gap = _gap(ties, instance, (one, two, ratio, offset))
                what = f"the rigid loop {' - '.join(dict.fromkeys(names))} contradicts itself: {gap}."
                way_out = (
                    f"Its ratios and lengths must agree all round, or one of {listing(dict.fromkeys(names))} must go."
                )
                faults.append(Fault(instance.where, what, way_out))
            written.append((one, two, instance.path))
    return faults


def _between(written: list[tuple[int, int, str]], one: int, two: int) -> list[str]:
    """Whose ties lead from one node to another, by the shortest way."""
    import networkx as nx

    graph = nx.Graph()
    for a, b, path in written:
        graph.add_edge(a, b, path=path)
    loop = nx.shortest_path(graph, one, two) if one in graph and two in graph else []
    return [graph.edges[edge]["path"] for edge in itertools.pairwise(loop)]


def _gap(ties: Ties, instance: Instance, tie: tuple[int, int, float, float]) -> str:
    """How far the loop is from closing: by its ratio, else by its length."""
    one, two, ratio, offset = tie
    (_, ra, oa), (_, rb, ob) = ties.root(one), ties.root(two)
    if not math.isclose(rb, ratio * ra, rel_tol=AGREES):
        return f"{instance.path} has the ratio {ratio:g}, the others make it {rb / ra:g}"
    return f"{instance.path} has the length {offset:g}, the others leave {ob - ratio * oa:g}"


def asked(instance: Instance, name: str, faults: list[Fault]) -> Any:
    """What a method of a component says of these values; None if it has none, or a wrong one, which is told."""
    method = getattr(instance.type.answers, name)
    try:
        return method(instance.values) if method is not None else None
    except AnswerError as error:  # once a class will do
        told = {fault.what for fault in faults}
        faults += [
            fault for fault in error.at(instance.where, instance.path)
            if not any(what.endswith(fault.what.removeprefix(instance.path)) for what in told)
        ]  # fmt: skip
        return None


def _tells_of_motion(kind: Kind) -> bool:
    """Whether a class says anything of how what it is joined to moves."""
    return any(said is not None for said in (kind.answers.inertia, kind.answers.start, kind.answers.prescribes))


def _facts(
    assembly: Assembly, node_of: Mapping[PortRef, int], faults: list[Fault]
) -> dict[int, list[tuple[str, Instance, PortRef, Any]]]:
    """Per node: inertias, start values and prescriptions of its components."""
    facts: dict[int, list[tuple[str, Instance, PortRef, Any]]] = {}
    for instance in of_classes(assembly.instances.values(), _tells_of_motion):
        says = instance.type.answers
        for kind in ("inertia", "start"):
            for port, value in (asked(instance, kind, faults) or {}).items():
                ref = PortRef(instance.path, port)
                facts.setdefault(node_of[ref], []).append((kind, instance, ref, value))
        for port, outputs in (says.prescribes() if says.prescribes is not None else {}).items():
            ref = PortRef(instance.path, port)
            facts.setdefault(node_of[ref], []).append(("prescribes", instance, ref, outputs))
    return facts


def _group(nodes: list[Node], inside: list[tuple[int, float, float]], facts: Any) -> tuple[Group, list[Fault]]:
    mass, starts, prescribed, faults, name = 0.0, [], [], [], ""
    for node, ratio, offset in inside:
        for kind, instance, ref, value in facts.get(node, ()):
            if kind == "inertia":
                mass += ratio**2 * value
                name = name or instance.path
            elif kind == "start":
                starts.append((instance, ref, *_at_group(value, ratio, offset), ratio, offset))
            else:
                prescribed.append((instance, Prescribed(ref, value)))
    if len(prescribed) > 1 and any(given.outputs is not None for _, given in prescribed):
        first, second, *_ = prescribed
        ends = f"({first[1].by}, {second[1].by})"
        what = f"{first[0].path} and {second[0].path} both prescribe the motion of one body {ends}."
        faults.append(Fault(second[0].where, what, "Keep one of them, or put a Spring between."))
    position, wrong = _agreed(starts, 2, nodes[inside[0][0]].domain.rest)
    rate, also = _agreed(starts, 3)
    if prescribed and all(given.outputs is None for _, given in prescribed) and rate:
        mover = next(s for s in starts if s[3])
        what = f"{mover[1]} starts with a speed of {mover[3]:g} on a body that {prescribed[0][0].path} keeps at rest."
        faults.append(Fault(mover[0].where, what, f"Leave out the speed, or disconnect {prescribed[0][0].path}."))
    made = Group(
        name or str(nodes[inside[0][0]].ports[0]), nodes[inside[0][0]].domain,
        tuple(n for n, _, _ in inside), tuple(r for _, r, _ in inside), tuple(o for _, _, o in inside),
        mass, (position, rate), prescribed[0][1] if prescribed else None,
        (any(s[2] is not None for s in starts), any(s[3] is not None for s in starts)),
    )  # fmt: skip
    return made, faults + wrong + also


def _at_group(value: Any, ratio: float, offset: float) -> tuple[float | None, float | None]:
    position, rate = value if isinstance(value, tuple) else (value, None)
    return None if position is None else (position - offset) / ratio, None if rate is None else rate / ratio


def _agreed(starts: list[Any], column: int, rest: float = 0.0) -> tuple[float, list[Fault]]:
    """The start value that all who give one agree on; `rest` when nobody does. Column 2 position, 3 rate."""
    given = [s for s in starts if s[column] is not None]
    for instance, ref, *other, ratio, offset in given[1:]:
        one, value = given[0], other[column - 2]
        shift = offset if column == 2 else 0.0
        far = max(abs(one[5] / one[4]), abs(offset / ratio)) if column == 2 else 0.0  # a place is what two are apart
        if not math.isclose(value, one[column], rel_tol=AGREES, abs_tol=NEXT_TO_NOTHING + AGREES * far):
            variable, unit = instance.type.declaration.ports[ref.port].domain.across[column - 2]
            what = (
                f"{ref}.{variable} starts at {ratio * value + shift:g} {unit}; {one[1]}, tied to it, starts so that "
                f"it would be {ratio * one[column] + shift:g} {unit}."
            )
            return one[column], [Fault(instance.where, what, "Give one of them, or values that agree.")]
    return (given[0][column] if given else rest), []
