"""Whether two flat models are one structure with other numbers, and what keeps them from being so."""

from __future__ import annotations

from collections.abc import Iterator

from fairlead.component.alike import agree
from fairlead.component.values import Variant
from fairlead.errors import listing
from fairlead.flatten.flat_model import FlatModel, Group


def difference(one: FlatModel, other: FlatModel) -> str:
    """What is built otherwise in `other`, as the end of a sentence; "" for the same structure.

    The structure is: components with their class variants, connections, what moves with what at which ratio, which
    bodies have mass, and whose motion is given.
    """
    return next(_differences(one, other), "")


def _differences(one: FlatModel, other: FlatModel) -> Iterator[str]:
    before, after = ([instance.path for instance in flat.instances] for flat in (one, other))
    if before != after:
        changed = sorted(set(before) ^ set(after))
        yield f"it has other components ({listing(changed, 3)})" if changed else "its components stand in another order"
    for old, new in zip(one.instances, other.instances, strict=True):
        if old.variant is not new.variant and old.variant != new.variant:
            yield f"{old.path} is of another kind ({_kinds(old.variant, new.variant)})"
    if one.nodes is not other.nodes and one.nodes != other.nodes:
        yield "other ports are joined"
    if one.sources is not other.sources and [*one.sources.items()] != [*other.sources.items()]:
        yield "other signals are joined"
    if len(one.groups) != len(other.groups):
        yield "other bodies move together"
    if one.groups is not other.groups:
        for was, now in zip(one.groups, other.groups, strict=True):
            if _relation(was) != _relation(now):
                yield f"{was.name} moves with other bodies, or otherwise with them, or has got or lost its mass"


def _kinds(was: Variant, now: Variant) -> str:
    """What a component was and is; where both are called alike, which of its parameters are given now, or no longer."""
    if was.label != now.label:
        return f"{was.label} before, {now.label} now"
    given = [f"with {name}" for name in sorted({*was.absent} - {*now.absent})]
    left = [f"without {name}" for name in sorted({*now.absent} - {*was.absent})]
    return f"a {was.label} {' and '.join([*given, *left]) or 'with other parts'} now"


def _relation(group: Group) -> tuple[object, ...]:
    moves = (group.nodes, group.ratios, group.offsets, group.prescribed)
    return (group.name, group.domain.name, moves, group.mass > 0)


def on_groups(flat: FlatModel, numbers: set[int]) -> set[str]:
    """Components with a port on one of these groups."""
    nodes = [flat.nodes[node] for number in numbers for node in flat.groups[number].nodes]
    return {port.instance for node in nodes for port in node.ports}


def unlike(one: FlatModel, other: FlatModel) -> set[int]:
    """Groups whose mass or start is another one, if only by the sign of a zero."""
    if one.groups is other.groups:
        return set()
    pairs = enumerate(zip(one.groups, other.groups, strict=True))
    return {k for k, (was, now) in pairs if not agree((was.mass, was.start), (now.mass, now.start))}


