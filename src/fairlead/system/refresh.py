"""A compiled model with other numbers: numbering, indices, plans and code are those of the one it comes from.

    system = refreshed(old, flat)

The flat model must be of one structure with the old one (flatten/same_wiring.py). Then only numbers are made again,
each by the function that made it first: those of components with other values, of bodies with another start, tables,
sample times and scales. When a mass changes, so do coefficients of the plans, and all but the numbering and the
indices of the blocks is built again. What is shared is frozen.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from fairlead.component.assembly import Instance
from fairlead.component.keys import INPUT, key
from fairlead.component.values import number_given, polynomial
from fairlead.errors import ModelError
from fairlead.flatten.collection import collected_later
from fairlead.flatten.flat_model import FlatModel
from fairlead.flatten.same_wiring import on_groups, unlike
from fairlead.kernels import layout
from fairlead.system.arrays.blocks import (
    Block,
    Floats,
    Integers,
    Memory,
    Tables,
    of_motion,
    parameter_of,
    place_of_input,
)
from fairlead.system.arrays.portions import portions, rows
from fairlead.system.arrays.switching import kinks, machine_owners, machine_zones
from fairlead.system.arrays.timing import first_pieces, samplers, time_places
from fairlead.system.arrays.working import set_apart
from fairlead.system.compiled.build import HOLD_TIME, build
from fairlead.system.compiled.context import ADDRESSES
from fairlead.system.compiled.system import System
from fairlead.system.numbering.initial import starts
from fairlead.system.numbering.loops import cut
from fairlead.system.numbering.parts_of_bodies import weighed
from fairlead.system.numbering.sizes import nominal_faults
from fairlead.system.numbering.tolerances import scales
from fairlead.system.numbering.unknowns import Numbering, nominal_given
from fairlead.system.start.driven import overridden
from fairlead.system.start.places import placed
from fairlead.system.start.speeds import started


@collected_later
def refreshed(old: System, flat: FlatModel) -> System:
    """The System of a flat model that differs from that of `old` by numbers. Raises ModelError for starts."""
    flat = cut(flat, old.flat.loops)
    pairs = zip(old.flat.instances, flat.instances, strict=True)
    fed = _fed_otherwise(old.flat, flat)
    changed = {new.path: new for was, new in pairs if was.values is not new.values or new.path in fed}
    moved = unlike(old.flat, flat)
    heavier = any(old.flat.groups[k].mass != flat.groups[k].mass for k in moved)
    numbering = _numbering(old.numbering, flat, changed.values(), moved)
    heavier = heavier or numbering.parts != old.numbering.parts
    begin, initially, faults = starts(flat, numbering)
    faults += nominal_faults(flat, numbering)
    if faults:
        raise ModelError(faults)
    near = on_groups(flat, moved)
    blocks = [_block(flat, block, numbering, changed, near, heavier=heavier) for block in old.blocks]
    tables = old.tables
    if any(b.kernel.structure.tables and _any_of(b, changed) for b in blocks):
        tables, blocks = _placed(blocks)
    if heavier:
        made = replace(build(flat, numbering, blocks, tables, old.machine_names, begin), subsystem_of=old.subsystem_of)
    else:
        made = _with_numbers(old, flat, numbering, blocks, tables, begin)
    if faults := overridden(made):
        raise ModelError(faults)
    return started(placed(made, initially), initially)


def _fed_otherwise(old: FlatModel, flat: FlatModel) -> set[str]:
    """Components to whose open inputs the composite round them gives another number."""
    before, now = old.assembly.open_inputs, flat.assembly.open_inputs
    return {ref.instance for ref, one in now.items() if before.get(ref) != one}


def _with_numbers(
    old: System, flat: FlatModel, numbering: Numbering, blocks: list[Block], tables: Tables, begin: Floats
) -> System:
    memory: Memory = dict(old.memory)
    other: dict[str, Any] = {}
    memory["sample_period"] = samplers(blocks)["sample_period"]
    if tables is not old.tables:
        memory |= {"tables": tables.vector(), "time_place": time_places(blocks)}
        other = {"kink_guard": kinks(blocks), "machine_zones": machine_zones(blocks, len(old.zones))}
    if tables is not old.tables or any(_begin_by_values(was, now) for was, now in zip(old.blocks, blocks, strict=True)):
        memory["zones"] = np.zeros(len(old.zones), dtype=np.int64)
        timed = first_pieces(blocks, memory["zones"], numbering.open_first)
        other |= {"timed_tables": timed, "zones": memory["zones"]}
    laid, end = portions(blocks)
    memory["blocks"] = rows(blocks, laid, end)["blocks"]
    memory["context"] = _addressed(memory)
    assert old.scales is not None, "a part has the numbers of the whole"
    run = flat.assembly.netlist.run
    return replace(
        old, flat=flat, numbering=numbering, blocks=blocks, tables=tables, initial=begin, accuracy=run.accuracy,
        start=run.start, scales=scales(flat, numbering, old.scales.rounding),
        machine_owners=machine_owners(blocks, len(old.zones)), memory=memory,
        working=set_apart(memory, blocks, samples=True), **other,
    )  # fmt: skip


def _begin_by_values(was: Block, now: Block) -> bool:
    """True if some of a block have other values, and these may say in which zone they begin."""
    return now is not was and now.instances[0].type.answers.begins_in is not None


def _addressed(memory: Memory) -> Integers:
    """The context with the addresses of these arrays."""
    context = memory["context"].copy()
    for name in ADDRESSES:
        context[getattr(layout, name)] = memory[name.lower()].ctypes.data
    return context


def _numbering(old: Numbering, flat: FlatModel, changed: Iterable[Instance], moved: set[int]) -> Numbering:
    """The same numbers for unknowns that begin elsewhere, or have another mass."""
    unknowns = list(old.unknowns)
    for k in moved:
        group = flat.groups[k]
        if k in old.position:
            unknowns[old.position[k]] = replace(unknowns[old.position[k]], start=group.start[0])
        if k in old.rate:
            unknowns[old.rate[k]] = replace(unknowns[old.rate[k]], start=group.start[1])
        at = old.rate.get(k, old.balance.get(k))  # the balance is that of an acceleration where that is an unknown
        if at is not None and unknowns[at].differential:
            unknowns[at] = replace(unknowns[at], mass=group.mass)
    for instance in changed:
        for name, state in instance.type.declaration.states.items():
            at = old.own[instance.path, name]
            start, nominal = number_given(instance.values, state.start), nominal_given(instance, state)
            unknowns[at] = replace(unknowns[at], start=start, nominal=nominal)
    return replace(old, unknowns=unknowns, parts=weighed(flat, old.parts) if old.parts else [])


def _block(
    flat: FlatModel, old: Block, numbering: Numbering, changed: dict[str, Instance], near: set[str], *, heavier: bool
) -> Block:
    """A block with the numbers of components that changed, and of those `near` what moves or is heavier."""
    if not _any_of(old, changed) and not (near and any(i.path in near for i in old.instances)):
        return old
    instances = [changed.get(instance.path, instance) for instance in old.instances]
    fresh = [k for k, instance in enumerate(instances) if instance.path in changed]
    beside = [k for k, instance in enumerate(instances) if instance.path in near]
    return replace(
        old, instances=instances, parameters=_parameters(flat, old, instances, fresh, beside if heavier else []),
        in_offset=_offsets(flat, old, numbering, instances, fresh, beside),
    )  # fmt: skip


def _any_of(block: Block, changed: dict[str, Instance]) -> bool:
    return any(instance.path in changed for instance in block.instances)


def _parameters(
    flat: FlatModel, old: Block, instances: Sequence[Instance], fresh: Sequence[int], heavier: Sequence[int]
) -> Floats:
    """Rows of components with other values, made once for all that share theirs; inverse masses beside."""
    s, made = old.kernel.structure, old.parameters.copy()
    names = s.parameters
    moving = [j for j, name in enumerate(names) if of_motion(s, name)]
    own = [j for j in range(len(names)) if j not in moving]
    known: dict[int, list[float]] = {}
    for i in fresh:
        values = instances[i].values
        if id(values) not in known:
            known[id(values)] = [parameter_of(flat, instances[i], s, names[j], HOLD_TIME) for j in own]
        made[i, own] = known[id(values)]
    for i in heavier:
        made[i, moving] = [parameter_of(flat, instances[i], s, names[j], HOLD_TIME) for j in moving]
    return made


def _offsets(
    flat: FlatModel, old: Block, numbering: Numbering, instances: Sequence[Instance], fresh: Sequence[int],
    beside: Sequence[int],
) -> Floats:  # fmt: skip
    """Inputs that nothing is connected to take a number of the component, and those on a fixed body its place."""
    keys, made = old.kernel.structure.inputs, old.in_offset.copy()
    loose = [j for j, one in enumerate(keys) if key(one).kind == INPUT and (old.in_index[:, j] == numbering.zero).any()]
    for rows_, columns in ((fresh, loose), (beside, range(len(keys)))):
        for i in rows_:
            for j in columns:
                made[i, j] = place_of_input(flat, numbering, instances[i], keys[j])[2]
    return made


def _placed(old: Sequence[Block]) -> tuple[Tables, list[Block]]:
    """All tables of the blocks, in order, and the blocks with their places."""
    tables, blocks = Tables(), []
    for block in old:
        names = block.kernel.structure.tables
        at = [[tables.place(polynomial(i.values.path(name))) for name in names] for i in block.instances]
        blocks.append(replace(block, table_base=np.array(at, dtype=np.int64)) if names else block)
    return tables, blocks
