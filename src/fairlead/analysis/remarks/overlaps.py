"""Rigid stops whose bodies begin within each other: no force brings them apart, and no impulse is due."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from fairlead.errors import Fault
from fairlead.kernels import layout
from fairlead.kernels.structure import Structure
from fairlead.system.compiled.asking import ask, guards_at
from fairlead.system.compiled.system import Floats, Instance, System

DEEP = 1e-6
"""How far bodies may begin within each other without a remark [m, rad]: rounding of places, and far less than any."""
PLACES = ("m", "rad")


def overlaps(system: System) -> Iterator[Fault]:
    """One remark for each stop that begins passed."""
    stops = set(system.rigid_stops)
    if not stops:
        return
    here = system.instance()
    alone = guards_at(here, here.start, system.initial)
    for number, block in enumerate(system.blocks):
        s = block.kernel.structure
        for k, instance in enumerate(block.instances):
            if instance.path in stops:
                zone = s.zones[int(here.zones[block.machines[k, 0]])]
                for guard, depth in zip(s.guards[zone], _first_values(here, alone, number, k, zone), strict=True):
                    if leads_to_contact(s, guard) and depth > DEEP:
                        what = f"begins {depth:.3g} {guard['unit']} within each other, and stays so."
                        way_out = "Give positions at the start that are apart, or another length."
                        yield Fault(instance.where, f"{instance.path}: what it keeps apart {what}", way_out)


def _first_values(here: Instance, alone: Floats, number: int, k: int, zone: str) -> list[float]:
    """Of every guard of an instance in a zone its value; of a group its first, which tells the place."""
    block = here.blocks[number]
    s = block.kernel.structure
    grouped = np.zeros((block.count, s.members))
    if grouped.size:
        ask(here, number, layout.MEMBERS, np.ones(block.count, dtype=bool), grouped)
    first, values, of_group = int(here.memory["blocks"][number, layout.GUARDS]) + k * s.slots, list[float](), 0
    for slot, members in enumerate(next(iter(s.reads[zone].values()))["guards"]):
        values.append(float(grouped[k, of_group] if len(members) > 1 else alone[first + slot]))
        of_group += len(members) if len(members) > 1 else 0
    return values


def leads_to_contact(s: Structure, guard: Mapping[str, Any]) -> bool:
    """True for a guard on a place that leads to a zone in which a row takes any force."""
    rigid = {s.zones.index(zone) for unknown in s.rigid for zone in s.holds[unknown]}
    return guard["to"] in rigid and guard["unit"] in PLACES
