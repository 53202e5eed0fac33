"""Stops whose bodies begin within each other.

At a rigid one no force brings them apart, and no impulse is due. An elastic one, or a rope, throws them: the energy
k d^2/2 of its spring k, passed by d, gives what it holds, of reduced inertia m, the speed d sqrt(k/m). A little of
it is a stop that carries a load at rest; a speed that no machine leaves a stop with is a position that was not meant.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from fairlead.component.assembly import Instance, PortRef
from fairlead.component.given import Parameter
from fairlead.errors import Fault
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels.structure import Structure
from fairlead.system.arrays.blocks import Block
from fairlead.system.compiled.asking import guards_at
from fairlead.system.compiled.named_parts import rigid_stops
from fairlead.system.compiled.system import System

DEEP = 1e-6
"""How far bodies may begin within each other without a remark [m, rad]: rounding of places, and far less than any."""
PLACES = ("m", "rad")
SPRINGS = {"N/m": ("m", "m/s", 10.0), "N*m/rad": ("rad", "rad/s", 100.0)}
"""Unit of the stiffness of a stop -> units of its way and its speed, and the speed from which on it is remarked.

Chosen: more than a valve spring or a buffer of a machine throws at, far less than a wrong sign of a length gives."""


def overlaps(system: System) -> Iterator[Fault]:
    """One remark for each stop that begins passed, by however little if it is rigid, by far if it is elastic."""
    yield from rigid_overlaps(system)
    yield from elastic_overlaps(system)


def elastic_overlaps(system: System) -> Iterator[Fault]:
    """One remark for each elastic stop whose spring is so far in at the start that it throws what it holds."""
    if not any(_spring(block) for block in system.blocks):
        return
    here = system.instance()
    depth = guards_at(here, here.start, system.initial)
    for guard, machine in enumerate(system.memory["guard_machines"].tolist()):
        block, _ = system.machine_owners[machine]
        units = _spring(block)
        if units is None or not depth[guard] > DEEP:
            continue
        way, rate, fast = units
        s, slot = block.kernel.structure, int(system.memory["guard_place"][guard, 3])
        known = s.guards[s.zones[int(here.zones[machine])]]
        if slot < len(known) and known[slot]["unit"] == way:
            instance = next(i for i in block.instances if i.path == system.machine_names[machine])
            lightness = _lightness(system.flat, instance, rate)
            thrown = float(depth[guard]) * math.sqrt(instance.values.stiffness * lightness)
            if thrown > fast:
                what = f"{instance.path} begins {depth[guard]:.3g} {way} past the place where it takes hold."
                what += f" Its spring throws what it holds to some {thrown:.2g} {rate}."
                yield Fault(instance.where, what, "Give positions at the start that are apart, or another length.")


def _spring(block: Block) -> tuple[str, str, float] | None:
    """Units and limit of what has the stiffness of a stop among its parameters; None of anything else."""
    declared = block.instances[0].type.declaration.parameters.get("stiffness")
    return SPRINGS.get(declared.unit) if isinstance(declared, Parameter) else None


def _lightness(flat: FlatModel, instance: Instance, rate: str) -> float:
    """One over the inertia of the ends against each other; ends that are given, or have no inertia, count nothing."""
    ports = instance.type.declaration.ports.items()
    places = (flat.place(PortRef(instance.path, name)) for name, port in ports if port.domain.across[-1][1] == rate)
    ends = ((flat.groups[index], ratio) for index, ratio, _ in places)
    return sum(ratio**2 / group.mass for group, ratio in ends if group.free and group.mass > 0.0)


def rigid_overlaps(system: System) -> Iterator[Fault]:
    """One remark for each rigid stop that begins passed."""
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
