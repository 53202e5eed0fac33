"""What something else carries along, such as line on a drum: it then counts as part of what carries it.

A component that says so (`Carries`) ties the speed of a node to that of another in one of its zones. A node deep
in that zone is left out of the unknowns: it stands where the carrier takes it, its inertia is the carrier's, and what
acts on it acts on the carrier. Laws that answer to nothing else (see influence.py) are left out with it:

    z[i] = ratio z[carrier] + offset        w[carrier] += ratio w[i]

The first guards that would change that, forward and backward, are kept: when one of their machines changes, the
whole goes on. So are those of what the ratio comes from, such as the layers of a drum.
"""

from __future__ import annotations

from collections import defaultdict
from typing import NamedTuple

import numpy as np

from fairlead.component.declare import Carries
from fairlead.component.instantiate import PortRef
from fairlead.system.asking import call, guards_at, partials_at
from fairlead.system.blocks import place_of_motion
from fairlead.system.influence import Influence, influence
from fairlead.system.left_out import Look
from fairlead.system.moving import Following, Moving, Rider
from fairlead.system.probing import Guards
from fairlead.system.rest import Floats, Integers
from fairlead.system.shares import shares
from fairlead.system.structure import Structure
from fairlead.system.system import Instance

KEPT_FREE = 24
"""Carried nodes nearest to where they are let go that stay unknowns: they come off before the next look."""
MOST = 0.9
"""Share of the unknowns that may be left; more is not worth it."""
LEAST_CARRIED = 16
"""Fewer nodes than this are not worth it."""


class Bond(NamedTuple):
    """What ties a node to its carrier: path, law, and how its force depends on the speed of either."""

    path: str
    law: int
    own: float
    other: float


class Carriage:
    """Finds what is carried in one System."""

    def __init__(self, system: Instance) -> None:
        """Look at the whole; nothing is evaluated yet."""
        self.system = system
        self.bonds = [b for b in system.blocks if b.kernel.variant.type.declaration.carries is not None]
        self._known: tuple[Influence, Guards, Integers] | None = None
        self._ends: dict[str, tuple[int, float, int, float] | None] = {}

    @property
    def count(self) -> int:
        """Nodes that are in the zone in which they are carried."""
        found = 0
        for block in self.bonds:
            says = block.kernel.variant.type.declaration.carries
            assert says is not None
            zone = block.kernel.structure.zones.index(says.zone)
            found += int(np.count_nonzero(self.system.zones[block.machines[:, 0]] == zone))
        return found

    def moving(self, t: float, y: Floats) -> Moving | None:
        """What is left of the unknowns at (t, y [n]) without what is carried; None if hardly less."""
        if not self.bonds:
            return None
        if self._known is None:
            own = self.system.numbering.own
            circles = np.array([own[p.path, p.unknown] for p in self.system.numbering.circles], dtype=np.int64)
            self._known = influence(self.system), Guards(self.system), circles
        riders = self._riders(t, y)
        while len(riders) >= LEAST_CARRIED:
            found = Look(self.system, *self._known, riders, following(self.system, riders, t, y), t, y)
            hindered = found.hindered()
            if not hindered:
                return found.moving() if np.count_nonzero(found.kept) <= MOST * self.system.n else None
            riders = [rider for rider in riders if rider.group not in hindered]
        return None

    def _riders(self, t: float, y: Floats) -> list[Rider]:
        """Nodes that are carried now, but those that come off soon."""
        partials, guards = partials_at(self.system, t, y), guards_at(self.system, t, y)
        first_law = 0
        found: dict[int, list[tuple[float, Rider]]] = defaultdict(list)
        for block, share in zip(self.system.blocks, shares(self.system.blocks)[0], strict=True):
            s, says = block.kernel.structure, block.kernel.variant.type.declaration.carries
            if says is not None:
                here = np.flatnonzero(self.system.zones[block.machines[:, 0]] == s.zones.index(says.zone))
                slopes = partials[share.flows :][: block.count * len(s.d_flows)].reshape(block.count, -1)[here]
                own, other = (
                    _slope(s, slopes, f"port:{says.node}", f"port:{port}:v") for port in (says.node, says.by)
                )  # fmt: skip
                of_guards = guards[share.guards :][: block.count * s.slots].reshape(block.count, -1)[here]
                nearest = of_guards[:, : len(s.guards[says.zone])].max(axis=1, initial=-np.inf)
                for k, i in enumerate(here.tolist()):
                    bond = Bond(block.instances[i].path, first_law + i, float(own[k]), float(other[k]))
                    rider = self._rider(bond, says) if bond.own else None
                    if rider is not None:
                        found[rider.by].append((float(nearest[k]), rider))
            first_law += block.count
        return [
            rider for of_one in found.values()
            for _, rider in sorted(of_one, key=lambda pair: pair[0])[: max(len(of_one) - KEPT_FREE, 0)]
        ]  # fmt: skip

    def _rider(self, bond: Bond, says: Carries) -> Rider | None:
        if bond.path not in self._ends:
            self._ends[bond.path] = self._ends_of(bond.path, says)
        ends = self._ends[bond.path]
        if ends is None:
            return None
        group, of_node, by, of_by = ends
        ratio = -bond.other / bond.own * of_by / of_node
        return Rider(group, by, ratio, bond.law, abs(bond.own) * of_node**2)


    def _ends_of(self, path: str, says: Carries) -> tuple[int, float, int, float] | None:
        """Groups of a bond's node and of its carrier, and their ratios; None if it cannot carry."""
        flat, numbering = self.system.flat, self.system.numbering
        group, of_node, _ = flat.place(PortRef(path, says.node))
        by, of_by, _ = flat.place(PortRef(path, says.by))
        if group == by or not flat.groups[group].free or group not in numbering.rate:
            return None
        if flat.groups[by].free and by not in numbering.rate:
            return None
        return group, of_node, by, of_by


def _slope(structure: Structure, slopes: Floats, target: str, key: str) -> Floats:
    """By instance: how what its law gives to a target changes with one of its inputs, of all its slopes (k, e)."""
    for e, (k, j) in enumerate(structure.d_flows):
        if structure.targets[k] == target and structure.inputs[j] == key:
            return slopes[:, e]
    return np.zeros(len(slopes))


def following(system: Instance, riders: list[Rider], t: float, y: Floats) -> Following:
    """What stands where for what is carried at (t, y [n])."""
    numbering, flat = system.numbering, system.flat
    call(system, "rhs", t, y, np.zeros(system.n))
    z = system.memory["z"]
    place, ratio, offset = np.arange(len(z)), np.ones(len(z)), np.zeros(len(z))
    row, share = np.arange(numbering.w_dump + 1), np.ones(numbering.w_dump + 1)
    groups, by = [rider.group for rider in riders], np.array([rider.by for rider in riders])
    x, v = (np.array([where[group] for group in groups]) for where in (numbering.position, numbering.rate))
    mass = np.array([flat.groups[group].mass for group in groups])
    own, bond = np.array([rider.ratio for rider in riders]), np.array([rider.bond for rider in riders])
    masses: dict[int, float] = {}
    for carrier in dict.fromkeys(by.tolist()):
        mine, free = by == carrier, flat.groups[carrier].free
        for at, variable in ((x, "x"), (v, "v"), (numbering.acceleration + v, "a")):
            place[at[mine]], coef, _ = place_of_motion(flat, numbering, carrier, 1.0, 0.0, variable)
            ratio[at[mine]] = own[mine] * coef
        row[v[mine]] = numbering.balance[carrier] if free else system.n + numbering.reactions[carrier]
        share[v[mine]] = own[mine] if free else -own[mine]
        masses[carrier] = float((own[mine] ** 2 * mass[mine]).sum())
    row[x] = numbering.w_dump
    offset[x] = y[x] - ratio[x] * z[place[x]]
    return Following(
        place, ratio, offset, row, share, np.concatenate([x, v]), mass, bond, masses, frozenset(groups)
    )  # fmt: skip
