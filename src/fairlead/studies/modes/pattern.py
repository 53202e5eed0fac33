"""Zones by name: which are asked for, and how a pattern of them is said in words.

    {"pad": "held", "c*": "sliding"}

A zone has the name that `fairlead describe TYPE` tells. `held` also stands for the zone in which a contact holds,
`sliding` for that of its direction: the one in force, or, of a contact that holds, the one that its force is nearer to.
A pattern is for those of its parts that have the zone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import Fault, Location, did_you_mean, listing, shown
from fairlead.patterns import picked
from fairlead.system.compiled.asking import guards_at
from fairlead.system.compiled.system import Instance

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
HELD, SLIDING = "held", "sliding"
PLACE = Location("zones")
FEW = 6
"""Contacts in one zone that a sentence names; of more it tells how many they are."""


@dataclass(frozen=True)
class Known:
    """The parts with zones of a model at an instant."""

    instance: Instance
    t: float
    y: Floats

    def asked(self, wanted: Mapping[str, str], faults: list[Fault]) -> Integers:
        """The zones at the instant with those asked instead; what is wrong goes to `faults`."""
        zones, names = self.instance.zones.copy(), dict.fromkeys(self.instance.machine_names)
        for pattern, zone in wanted.items():
            found = set(picked(names, pattern))
            if not found:
                what = f"no part of the name {shown(pattern)} has zones. {did_you_mean(pattern, names)}".rstrip()
                faults.append(Fault(PLACE, what, f"There are {listing(self.shown)}."))
            machines = [k for k, name in enumerate(self.instance.machine_names) if name in found]
            fitting = [(k, number) for k in machines if (number := self.number(k, zone)) is not None]
            zones[[k for k, _ in fitting]] = [number for _, number in fitting]
            if machines and not fitting:  # some may: a line has springs and joints as well
                faults.append(self._no_such(pattern, zone, machines))
        return zones

    def number(self, machine: int, zone: str) -> int | None:
        """The number of a zone of a part, None where it has none of that name."""
        known = list(self.instance.zone_names(machine))
        if zone in known:
            return known.index(zone)
        if zone == HELD:
            return self.held(machine)
        return self.sliding(machine) if zone == SLIDING else None

    def held(self, machine: int) -> int | None:
        """The zone in which a part holds; None where it never does."""
        rows = self.instance.memory["holds"].reshape(-1, 2)
        found = rows[rows[:, 0] == machine, 1]
        return int(found[0]) if len(found) else None

    def sliding(self, machine: int) -> int | None:
        """The zone in which a contact slides; None where it has none, or several in a direction."""
        block, _ = self.instance.machine_owners[machine]
        zones = block.kernel.variant.type.declaration.zones
        names = self.instance.zone_names(machine)
        there = [k for k, name in enumerate(names) if name in (*zones.forward, *zones.backward)]
        if int(self.instance.zones[machine]) in there:
            return int(self.instance.zones[machine])
        return max(there, key=lambda zone: self._nearness(machine, zone)) if len(there) == 2 else None

    @property
    def contacts(self) -> list[int]:
        """Parts that can both hold and slide."""
        return [k for k in range(len(self.instance.zones))
                if self.held(k) is not None and self.sliding(k) is not None]  # fmt: skip

    @property
    def shown(self) -> list[str]:
        """Names of parts that have more than one zone."""
        return list(dict.fromkeys(self.instance.machine_names[k] for k in self.several))

    @property
    def several(self) -> list[int]:
        """Parts with more than one zone of their own; pieces of tables and of what is given in time are none."""
        return [k for k, (block, _) in enumerate(self.instance.machine_owners)
                if len(block.kernel.structure.zones) > 1
                and list(block.kernel.structure.zones) == list(self.instance.zone_names(k))]  # fmt: skip

    def in_words(self, zones: Integers) -> str:
        """A pattern: `held: pad, c1; forward: 12 parts`."""
        found: dict[str, list[str]] = {}
        for k in self.several:
            found.setdefault(self.instance.zone_names(k)[int(zones[k])], []).append(self.instance.machine_names[k])
        return "; ".join(
            f"{zone}: {', '.join(names) if len(names) <= FEW else f'{len(names)} parts'}"
            for zone, names in found.items()
        )

    def _nearness(self, machine: int, zone: int) -> float:
        """The guard that leads to a zone from that in force: the nearer to 0, the nearer it is."""
        now = int(self.instance.zones[machine])
        block, _ = self.instance.machine_owners[machine]
        s = block.kernel.structure
        leading = {slot for slot, one in enumerate(s.guards.get(s.zones[now], ())) if one["to"] == zone}
        values, places = guards_at(self.instance, self.t, self.y), self.instance.memory["guard_place"].reshape(-1, 4)
        mine = [g for g in np.flatnonzero(self.instance.guard_machine == machine).tolist() if places[g, 3] in leading]
        return float(max((values[g] for g in mine), default=-np.inf))

    def _no_such(self, pattern: str, zone: str, machines: Iterable[int]) -> Fault:
        known = dict.fromkeys(name for k in machines for name in self.instance.zone_names(k))
        near = did_you_mean(zone, {*known, HELD, SLIDING} - {zone})
        return Fault(PLACE, f"{pattern} has no zone {shown(zone)}. {near}".rstrip(), f"There are {listing(known)}.")
