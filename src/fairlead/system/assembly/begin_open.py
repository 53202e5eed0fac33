"""Contacts that begin open: those that signals press, round a gear of three shafts that move.

All together they would hold too much, and how they would share is not known. Clutches and brakes of an automatic
gearbox, pressed in turn, never hold all at once.
"""

from __future__ import annotations

from collections.abc import Collection

from fairlead.component.assembly import PortRef
from fairlead.flatten.flat_model import FlatModel
from fairlead.system.arrays.blocks import Block
from fairlead.system.arrays.timing import OPEN
from fairlead.system.numbering.unknowns import Numbering


def may_open(flat: FlatModel, numbering: Numbering, blocks: list[Block], part: set[int]) -> set[str]:
    """Contacts pressed by what changes in a part in which gears of three shafts close circles; none of another part."""
    owners = {path for (path, _), at in numbering.own.items() if at in part}
    alone = not part - {at for (path, _), at in numbering.own.items() if path in owners}
    cannot, many = never_sharing(blocks, owners)
    if not alone or not many or cannot or not owners <= holding(blocks):
        return set()
    can_open = (one for block in blocks if OPEN in block.kernel.structure.zones for one in block.instances)
    by = {one.path: one.type.answers.pressed_by for one in can_open if one.path in owners}
    return {path for path, input_ in by.items() if input_ and _changes(flat, PortRef(path, input_))}


def _changes(flat: FlatModel, ref: PortRef) -> bool:
    """Whether an input is connected to more than what parts without inputs of their own hand on as a parameter."""
    source = flat.sources.get(ref)
    if source is None or source.instance not in flat.assembly.instances:
        return False
    inputs = flat.assembly.instances[source.instance].type.declaration.inputs
    return not inputs or any(_changes(flat, PortRef(source.instance, name)) for name in inputs)


def never_sharing(blocks: list[Block], wanted: Collection[str]) -> tuple[list[str], list[str]]:
    """Of these, who cannot share a load: by a force without fixed numbers at its ports; by joining over two bodies."""
    cannot, many = list[str](), list[str]()
    for block in blocks:
        s = block.kernel.structure
        mine = [instance.path for instance in block.instances if instance.path in wanted]
        cannot += mine if s.holds.keys() - s.pairs.keys() - s.ratios.keys() else []
        ports = [*map(len, s.pairs.values()), *map(len, s.ratios.values())]
        many += mine if max(ports, default=0) > 2 else []
    return cannot, many


def holding(blocks: list[Block]) -> set[str]:
    """Components that hold in the zone they begin in."""
    found: set[str] = set()
    for block in blocks:
        s = block.kernel.structure
        if any(s.zones[0] in zones for zones in s.holds.values()):
            found.update(instance.path for instance in block.instances)
    return found
