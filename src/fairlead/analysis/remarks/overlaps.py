"""Rigid stops whose bodies begin within each other: no force brings them apart, and no impulse is due."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from fairlead.errors import Fault
from fairlead.kernels.structure import Structure
from fairlead.system.compiled.asking import guards_at
from fairlead.system.compiled.named_parts import rigid_stops
from fairlead.system.compiled.system import System

DEEP = 1e-6
"""How far bodies may begin within each other without a remark [m, rad]: rounding of places, and far less than any."""
PLACES = ("m", "rad")


def overlaps(system: System) -> Iterator[Fault]:
    """One remark for each stop that begins passed."""
    stops = set(rigid_stops(system))
    if not stops:
        return
    here = system.instance()
    depth = guards_at(here, here.start, system.initial)
    for guard, machine in enumerate(system.memory["guard_machines"].tolist()):
        name = system.machine_names[machine]
        if name not in stops or not depth[guard] > DEEP:
            continue
        block, _ = system.machine_owners[machine]
        s = block.kernel.structure
        known = s.guards[s.zones[int(here.zones[machine])]]
        slot = int(system.memory["guard_place"][guard, 3])
        if slot < len(known) and leads_to_contact(s, known[slot]):
            unit = known[slot]["unit"]
            instance = next(i for i in block.instances if i.path == name)
            what = f"{name}: what it keeps apart begins {depth[guard]:.3g} {unit} within each other, and stays so."
            yield Fault(instance.where, what, "Give positions at the start that are apart, or another length.")


def leads_to_contact(s: Structure, guard: Mapping[str, Any]) -> bool:
    """True for a guard on a place that leads to a zone in which a row takes any force."""
    rigid = {s.zones.index(zone) for unknown in s.rigid for zone in s.holds[unknown]}
    return guard["to"] in rigid and guard["unit"] in PLACES
