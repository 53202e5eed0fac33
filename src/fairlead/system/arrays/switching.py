"""Tables that lead from a fired guard to the new zone, and the names of guards, machines and zones.

A machine is a position in `zones`: the zone of an instance, or the interval in force of one of its tables.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from fairlead.component.assembly import PortRef
from fairlead.component.keys import PORT, key
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels import layout
from fairlead.kernels.structure import Structure
from fairlead.system.arrays.blocks import Block, Integers, Memory
from fairlead.system.arrays.timing import tables

NO_GUARD = (0, 0, 0)
Named = tuple[str, str]  # name and unit


def guards(blocks: Sequence[Block]) -> tuple[list[Named], Memory]:
    """Name and unit of every guard slot, and the arrays that `switch` follows."""
    place, machines = [], []
    to: list[tuple[int, int, int]] = []
    named: list[Named] = []
    for block in blocks:
        first = len(to)
        to += _targets(block)
        slots = _slots(block)
        zoned = len(block.kernel.structure.zones) > 1
        owners = block.machines[:, 0].tolist() if slots else []
        for instance, machine in zip(block.instances, owners, strict=bool(slots)):
            for k, (name, unit) in enumerate(slots):
                place.append((machine if zoned else -1, first, len(slots), k))
                machines.append(machine)
                named.append((f"{instance.path} {name}", unit))
    return named, {
        "guard_place": np.array(place, dtype=np.int64).reshape(-1, layout.GUARD_ROW),
        "guard_to": np.array(to, dtype=np.int64).reshape(-1, layout.TO),
        "guard_machines": np.array(machines, dtype=np.int64),
    }


def _targets(block: Block) -> list[tuple[int, int, int]]:
    """By zone and slot: the zone it leads to (-1: none), the machine, the step of a table's interval."""
    s = block.kernel.structure
    found: list[tuple[int, int, int]] = []
    for zone in s.zones:
        known = s.guards[zone]
        found += [(g["to"], g["machine"], g["step"]) for g in known] + [NO_GUARD] * (s.slots - len(known))
    return found


def _slots(block: Block) -> list[Named]:
    """Names of the guards that share a slot, in all zones, and their unit."""
    shared = _sharing(block)
    return [("/".join(dict.fromkeys(g["name"] for g in slot)), min(g["unit"] for g in slot)) for slot in shared]


def _sharing(block: Block) -> list[list[dict[str, Any]]]:
    """By slot: the guards of all zones that share it."""
    s = block.kernel.structure
    guards = s.guards.values()
    return [[known[k] for known in guards if k < len(known) and known[k]["name"]] for k in range(s.slots)]


def holds(blocks: Sequence[Block]) -> tuple[Integers, int]:
    """(machine, zone that holds) of every hold row, and how many rows hold always."""
    found, always = [], 0
    for block in blocks:
        s = block.kernel.structure
        for zones in s.holds.values():
            if len(s.zones) == 1:
                always += block.count
            else:
                found += [(machine, s.zones.index(zone)) for machine in block.machines[:, 0] for zone in zones]
    return np.array(found, dtype=np.int64).reshape(-1, layout.HOLD), always


def holders(blocks: Sequence[Block], n: int) -> Integers:
    """The machine whose zone decides whether a row holds, for each of n rows; -1 where none does."""
    holder = np.full(n, -1, dtype=np.int64)
    for block in blocks:
        s = block.kernel.structure
        if len(s.zones) > 1:
            for unknown in s.holds:
                holder[block.flow_index[:, s.targets.index(f"own:{unknown}")]] = block.machines[:, 0]
    return holder


def stops(flat: FlatModel, blocks: Sequence[Block]) -> tuple[list[str], Memory]:
    """Stops of which a side moves as given, by name, and the rows of all that let bodies stay as they touch.

    What the others keep is kept by no linear invariant of a method: a given place is exact, that of the body is not,
    and a body in a relation of positions is moved back to that after every step. It would be moved into its stop, or
    off.
    """
    given, loose, related = list[str](), list[int](), _related(flat, blocks)
    for block in blocks:
        s = block.kernel.structure
        for unknown, ports in s.stops.items():
            rows = block.flow_index[:, s.targets.index(f"own:{unknown}")].tolist()
            for row, instance in zip(rows, block.instances, strict=True):
                at = [flat.place(PortRef(instance.path, port))[0] for port in ports]
                groups = [flat.groups[k] for k in at]
                heavy = all(one.mass > 0 for one in groups if one.free)
                if any(one.prescribed is not None and one.prescribed.outputs is not None for one in groups):
                    given.append(instance.path)
                elif not (heavy and related.intersection(at)):
                    loose.append(row)
    return given, {"loose": np.array(loose, dtype=np.int64)}


def _related(flat: FlatModel, blocks: Sequence[Block]) -> set[int]:
    """Groups between which relations of positions are kept."""
    found = set[int]()
    for block in blocks:
        if block.kernel.structure.positions:
            ports = [name for name, one in block.kernel.variant.type.declaration.ports.items() if one.domain.mechanical]
            found.update(flat.place(PortRef(one.path, port))[0] for one in block.instances for port in ports)
    return found


def takes_impulse(blocks: Sequence[Block], n: int) -> Integers:
    """For each of n rows what it takes where it holds: 0 it never holds, 1 an impulse of rounding, 2 any impulse.

    3 for a relation of positions: any impulse, and it never meets what it keeps.
    """
    takes = np.zeros(n, dtype=np.int64)
    for block in blocks:
        s = block.kernel.structure
        for unknown in s.holds:
            most = 3 if unknown in s.positions else 2 if unknown in s.rigid else 1
            takes[block.flow_index[:, s.targets.index(f"own:{unknown}")]] = most
    return takes


def limits(blocks: Sequence[Block]) -> Integers:
    """1 for every guard that bounds the force of its own contact while that holds."""
    found: list[int] = []
    for block in blocks:
        s = block.kernel.structure
        slots = [max((int(g[k]["limits"]) for g in s.guards.values() if k < len(g)), default=0) for k in range(s.slots)]
        found += slots * block.count
    return np.array(found, dtype=np.int64)


def met(blocks: Sequence[Block]) -> Integers:
    """Guards of places at which a stop is met: they lead to a zone that holds without a limit."""
    found: list[bool] = []
    for block in blocks:
        slots = met_slots(block.kernel.structure)
        found += [slot in slots for slot in range(block.kernel.structure.slots)] * block.count
    return np.flatnonzero(found)


def met_slots(s: Structure) -> set[int]:
    """Slots of a class whose guards are such."""
    rigid = {s.zones.index(zone) for unknown in s.rigid for zone in s.holds[unknown]}
    known = [pair for of_zone in s.guards.values() for pair in enumerate(of_zone)]
    return {slot for slot, guard in known if guard["to"] in rigid and guard["unit"] in ("m", "rad")}


def kinks(blocks: Sequence[Block]) -> Integers:
    """1 for every guard that leads from one piece of a continuous table to the next."""
    smooth = {table.machine for table in tables(blocks) if table.polynomial.is_continuous}
    found: list[int] = []
    for block in blocks:
        slots = [{(g["to"] < 0, g["machine"]) for g in of_slot} for of_slot in _sharing(block)]
        if not any(all(leads for leads, _ in slot) for slot in slots):
            found += [0] * (len(slots) * block.count)
            continue
        for row in block.machines.tolist():
            found += [all(leads and row[machine] in smooth for leads, machine in slot) for slot in slots]
    return np.array(found, dtype=np.int64)


def asked_of_blows(blocks: Sequence[Block]) -> Integers:
    """1 for every guard in a class without a port that takes in anything, or to the next piece of a table.

    Impulses ask them with the speeds before, see `Facts.blow_guard`.
    """
    found: list[int] = []
    for block in blocks:
        tells = not any(key(target).kind == PORT for target in block.kernel.structure.targets)
        pieces = [bool(slot) and all(g["to"] < 0 for g in slot) for slot in _sharing(block)]
        found += [int(tells or piece) for piece in pieces] * block.count
    return np.array(found, dtype=np.int64)


def latches(blocks: Sequence[Block]) -> Integers:
    """1 for every guard in a class that only tells signals, of a zone which that class then remembers."""
    found: list[bool] = []
    for block in blocks:
        tells = not any(key(target).kind == PORT for target in block.kernel.structure.targets)
        found += [tells and any(g["latches"] for g in slot) for slot in _sharing(block)] * block.count
    return np.array(found, dtype=np.int64)


def least(blocks: Sequence[Block]) -> Integers:
    """1 for every guard that is the least of several values, and whose part remembers that they had risen.

    It stays for good in the zone that the guard leads to, or only tells signals. Others are back in their zone as soon
    as one of the values has fallen.
    """
    found: list[bool] = []
    for block in blocks:
        s = block.kernel.structure
        tells = not any(key(target).kind == PORT for target in s.targets)
        final = [not any(guard["name"] for guard in of_zone) for of_zone in s.guards.values()]
        several = ([g for g in slot if g["values"] > 1] for slot in _sharing(block))
        found += [any(tells or final[g["to"]] for g in slot) for slot in several] * block.count
    return np.array(found, dtype=np.int64)


def told(blocks: Sequence[Block], machines: int) -> Memory:
    """Guards of classes that only tell signals, which samples ask for; and room to follow them (`settle_told`)."""
    found: list[bool] = []
    for block in blocks:
        tells = not any(key(target).kind == PORT for target in block.kernel.structure.targets)
        found += [tells] * len(_sharing(block)) * block.count
    sampled = any(block.kernel.structure.period for block in blocks)
    guards = np.flatnonzero(found) if sampled else np.zeros(0, dtype=np.int64)
    return {
        "told_guards": guards.astype(np.int64), "told_fired": np.zeros(len(guards), dtype=np.int64),
        "guards_now": np.zeros(len(found)), "zones_kept": np.zeros(machines, dtype=np.int64),
    }  # fmt: skip


def machine_zones(blocks: Sequence[Block], count: int) -> list[Sequence[str]]:
    """Names of the zones of every machine."""
    names: list[Sequence[str]] = [()] * count
    for block in blocks:
        s = block.kernel.structure
        if len(s.zones) > 1:
            for machine in block.machines[:, 0]:
                names[machine] = s.zones
    for table in tables(blocks):
        names[table.machine] = [f"{table.path} {piece}" for piece in range(len(table.polynomial.rows))]
    return names


def machine_owners(blocks: Sequence[Block], count: int) -> list[tuple[Block, int]]:
    """Block and instance of every machine."""
    owner = {machine: (block, i)
             for block in blocks for i, row in enumerate(block.machines.tolist()) for machine in row}  # fmt: skip
    return [owner[machine] for machine in range(count)]


def machine_kinds(blocks: Sequence[Block], count: int) -> Integers:
    """A number for every machine, the same for machines at the same place of instances of one class variant."""
    numbers: dict[tuple[int, int], int] = {}
    kinds = np.zeros(count, dtype=np.int64)
    for block in blocks:
        for place, machines in enumerate(block.machines.T):
            kinds[machines[machines >= 0]] = numbers.setdefault((block.kernel.address, place), len(numbers))
    return kinds
