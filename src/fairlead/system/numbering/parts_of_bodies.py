"""Bodies in parts: ties that say what they carry, and the balances that say it.

Ports that are tied move as one body, with one balance in which what the ties carry cancels. A class that `bears` wants
to know it. Then the body falls into parts, one for each side of such a tie, and every part has its own balance

    0 = sum of forces on the part - m_part a,      a the acceleration of the whole body

with what its ties carry among the forces. That of the body, m v' = sum of all forces, is the sum of them and stays as
it is. So a body of n + 1 parts and n ties has n + 1 rows more and as many unknowns: what n ties carry, and `a` itself;
it has one position and one speed. Where the motion of the body is given, `a` is too, and the part at which it is given
has no row: what that takes acts there, and is a reaction of the whole body.

Ties that close a ring leave open what each of them carries, and are refused.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from fairlead.component.assembly import Instance, PortRef
from fairlead.errors import Fault
from fairlead.flatten.flat_model import FlatModel


@dataclass(frozen=True)
class Part:
    """A part of a body: its nodes, and the row of its balance; None where that follows from the others."""

    group: int
    nodes: tuple[int, ...]
    told_by: tuple[str, str] | None  # instance and unknown of the tie in whose row its balance is; None for the first
    mass: float  # as it counts at the group


def parts_of_bodies(flat: FlatModel) -> list[Part]:
    """All parts, of each body the first one first; none where no tie says what it carries."""
    return _found(flat)[0]


def rings(flat: FlatModel) -> list[Fault]:
    """Ties that close a ring with others, and those of bodies without any mass."""
    return _found(flat)[1]


def weighed(flat: FlatModel, parts: Iterable[Part]) -> list[Part]:
    """The same parts with the masses they have now."""
    inertia = _inertias(flat)
    return [replace(one, mass=_mass(one.nodes, inertia)) for one in parts]


def _found(flat: FlatModel) -> tuple[list[Part], list[Fault]]:
    bearing = flat.those(lambda kind: kind.answers.bears)
    if not bearing:
        return [], []
    pieces = _pieces(flat)
    beside: dict[int, list[tuple[int, Instance]]] = {}
    groups: dict[int, None] = {}
    for instance in bearing:
        (a, b, *_), *_ = instance.type.answers.ties(instance.values)  # type: ignore[misc]
        one, other = (pieces[flat.node_of[PortRef(instance.path, port)]] for port in (a, b))
        beside.setdefault(one, []).append((other, instance))
        beside.setdefault(other, []).append((one, instance))
        groups[flat.place(PortRef(instance.path, a))[0]] = None
    inertia, members, given = _inertias(flat), _members(pieces), _given(flat)
    parts: list[Part] = []
    faults: list[Fault] = []
    for group in groups:
        held = list(dict.fromkeys(pieces[node] for node in given.get(group, ())))
        first = held[0] if held else pieces[flat.groups[group].nodes[0]]
        told: dict[int, Instance | None] = {first: None}
        used, queue = set[str](), [first]
        for piece in queue:
            for other, instance in beside.get(piece, ()):
                if instance.path in used:
                    continue
                used.add(instance.path)
                if other in told:
                    what = f"{instance.path} closes a ring of rigid links, and what it carries there is not determined."
                    faults.append(Fault(instance.where, what, "Leave one of the links out."))
                    continue
                told[other] = instance
                queue.append(other)
        if len(held) > 1:
            link = next(i for i in told.values() if i is not None)
            what = f"{link.path} lies between two places whose motion is given, and what it carries is not determined."
            faults.append(Fault(link.where, what, "Give the motion of one of them only."))
        if flat.groups[group].free and flat.groups[group].mass == 0:
            name, where = next((i.path, i.where) for i in told.values() if i is not None)
            what = f"{name} joins nodes without any mass, and nothing says how they move."
            turns = flat.groups[group].domain.name == "rotational"
            faults.append(Fault(where, what, f"Add {'an Inertia' if turns else 'a Mass'} at one of its ends."))
        for piece, by in told.items():
            row = None if by is None else (by.path, by.type.answers.bears)
            parts.append(Part(group, tuple(members[piece]), row, _mass(members[piece], inertia)))
    return parts, faults


def _given(flat: FlatModel) -> dict[int, list[int]]:
    """By group the nodes at which its motion is given: what that takes acts there, so their part has no row."""
    found: dict[int, list[int]] = {}
    for instance in flat.instances:
        says = instance.type.answers.prescribes
        for port in says() if says is not None else ():
            node = flat.node_of[PortRef(instance.path, port)]
            found.setdefault(flat.group_of[node][0], []).append(node)
    return found


def _pieces(flat: FlatModel) -> list[int]:
    """By node a node that stands for all that are tied with it by ties that do not say what they carry."""
    above = list(range(len(flat.nodes)))

    def top(node: int) -> int:
        while above[node] != node:
            above[node] = above[above[node]]
            node = above[node]
        return node

    for instance in flat.instances:
        says = instance.type.answers
        if says.ties is not None and not says.bears:
            for a, b, *_ in says.ties(instance.values):
                one, other = (top(flat.node_of[PortRef(instance.path, port)]) for port in (a, b))
                above[other] = one
    return [top(node) for node in range(len(flat.nodes))]


def _members(pieces: list[int]) -> dict[int, list[int]]:
    found: dict[int, list[int]] = {}
    for node, piece in enumerate(pieces):
        found.setdefault(piece, []).append(node)
    return found


def _inertias(flat: FlatModel) -> dict[int, float]:
    """Inertia of every node, as it counts at its group."""
    found: dict[int, float] = {}
    for instance in flat.instances:
        says = instance.type.answers.inertia
        for port, value in (says(instance.values) if says is not None else {}).items():
            node = flat.node_of[PortRef(instance.path, port)]
            found[node] = found.get(node, 0.0) + flat.group_of[node][1] ** 2 * value
    return found


def _mass(nodes: Iterable[int], inertia: Mapping[int, float]) -> float:
    return sum(inertia.get(node, 0.0) for node in nodes)
