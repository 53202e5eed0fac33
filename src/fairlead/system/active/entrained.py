"""Entrained nodes: what something else takes along, such as line on a drum, counts as part of what takes it along.

A component that says so (`Carries`) ties the speed of a node to that of its carrier in one of its zones. Its law gives
the ratio of the two speeds: a number, or a product of parameters and inputs, as the radius of a drum. A node deep in
that zone is left out of the unknowns: it stands where the carrier takes it, its inertia is the carrier's, and what acts
on it acts on the carrier:

    z[i] = ratio z[carrier] + offset        w[carrier] += ratio w[i]
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from fairlead.component.assembly import PortRef
from fairlead.component.declare import Carries
from fairlead.component.keys import PARAMETER, key
from fairlead.system.active.rest import Floats, Integers
from fairlead.system.arrays.blocks import Block, place_of_motion
from fairlead.system.arrays.portions import Portion, portions
from fairlead.system.compiled.asking import call, guards_at, partials_at
from fairlead.system.compiled.system import Instance

KEPT_FREE = 24
"""Nodes nearest to where they are let go that stay unknowns: they come off before the next look."""


class Node(NamedTuple):
    """One node: its group, the carrier's, ratio of speeds, the bond's law and damping, where its ratio is read in z."""

    group: int
    by: int
    ratio: float
    law: int
    bond: float
    read: tuple[int, ...]


class Entrained(NamedTuple):
    """By place in z and by row of w what stands for it, and how much of it; for what is not entrained, itself.

    z[i] = ratio z[place] + offset;  what would be added to w[i] is added, `share` times, to w[row]
    """

    place: Integers
    ratio: Floats
    offset: Floats
    row: Integers
    share: Floats
    unknowns: Integers
    """Positions of the nodes, then their rates."""
    mass: Floats
    """By node: its own inertia."""
    bond: Floats
    """Likewise: how strongly it is tied, force over slip."""
    masses: dict[int, float]
    """By group: the inertia that it takes along."""
    nodes: tuple[Node, ...]

    @property
    def groups(self) -> frozenset[int]:
        """Groups that are entrained."""
        return frozenset(node.group for node in self.nodes)

    @property
    def laws(self) -> list[int]:
        """The laws of their bonds."""
        return [node.law for node in self.nodes]

    @property
    def carriers(self) -> Integers:
        """Where in z the positions of the carriers stand."""
        return np.unique(self.place[self.unknowns[: len(self.mass)]])

    def added_up(self, w: Floats) -> Floats:
        """Rows of w with those of the nodes added to those of their carriers."""
        rates, made = self.unknowns[len(self.mass) :], w.copy()
        np.add.at(made, self.row[rates], self.share[rates] * w[rates])
        return made

    def aligned(self, system: Instance, t: float, y: Floats) -> Floats:
        """The unknowns [n] with every node where its carrier is at t, and as fast."""
        call(system, "rhs", t, y, np.zeros(system.n))
        made, u = y.copy(), self.unknowns
        made[u] = self.ratio[u] * system.memory["z"][self.place[u]] + self.offset[u]
        return made


def entrained(system: Instance, nodes: Sequence[Node], t: float, y: Floats) -> Entrained:
    """What stands where with these nodes entrained at (t, y [n])."""
    numbering, flat = system.numbering, system.flat
    call(system, "rhs", t, y, np.zeros(system.n))
    z = system.memory["z"]
    place, ratio, offset = np.arange(len(z)), np.ones(len(z)), np.zeros(len(z))
    row, share = np.arange(numbering.w_dump + 1), np.ones(numbering.w_dump + 1)
    x, v = (np.array([where[n.group] for n in nodes], dtype=np.int64) for where in (numbering.position, numbering.rate))
    mass, masses = np.array([flat.groups[node.group].mass for node in nodes]), defaultdict[int, float](float)
    for node, x_at, v_at, m in zip(nodes, x.tolist(), v.tolist(), mass.tolist(), strict=True):
        for at, variable in ((x_at, "x"), (v_at, "v"), (numbering.acceleration + v_at, "a")):
            place[at], ratio[at], _ = place_of_motion(flat, numbering, node.by, node.ratio, 0.0, variable)
        free = flat.groups[node.by].free
        row[v_at] = numbering.balance[node.by] if free else system.n + numbering.reactions[node.by]
        share[v_at] = node.ratio if free else -node.ratio
        masses[node.by] += node.ratio**2 * m
    row[x] = numbering.w_dump
    offset[x] = y[x] - ratio[x] * z[place[x]]
    return Entrained(
        place, ratio, offset, row, share, np.concatenate([x, v]), mass, np.array([node.bond for node in nodes]),
        dict(masses), tuple(nodes),
    )  # fmt: skip


class Bonds:
    """The bonds of one System: what may entrain a node."""

    def __init__(self, system: Instance) -> None:
        """Look for them; nothing is evaluated yet."""
        self.system = system
        said = [(block, block.kernel.variant.type.declaration.carries) for block in system.blocks]
        self.blocks = [(block, says) for block, says in said if says is not None]

    @property
    def count(self) -> int:
        """Nodes that are in the zone in which they are taken along."""
        return sum(len(_in_zone(self.system, block, says)) for block, says in self.blocks)

    def nodes(self, t: float, y: Floats) -> list[Node]:
        """Nodes that are taken along at (t, y [n]), but those that come off soon."""
        system, law = self.system, 0
        partials, guards = partials_at(system, t, y), guards_at(system, t, y)
        found: dict[int, list[tuple[float, Node]]] = defaultdict(list)
        for block, portion in zip(system.blocks, portions(system.blocks)[0], strict=True):
            says = block.kernel.variant.type.declaration.carries
            if says is not None:
                for nearest, node in self._of(block, says, portion, law, partials, guards):
                    found[node.by].append((nearest, node))
            law += block.count
        return [
            node for of_one in found.values()
            for _, node in sorted(of_one, key=lambda pair: pair[0])[: max(len(of_one) - KEPT_FREE, 0)]
        ]  # fmt: skip

    def _of(
        self, block: Block, says: Carries, portion: Portion, law: int, partials: Floats, guards: Floats
    ) -> list[tuple[float, Node]]:
        """The nodes of one block, and the guard of each that is nearest to letting it go."""
        s, here = block.kernel.structure, _in_zone(self.system, block, says)
        slopes = partials[portion.flows :][: block.count * len(s.d_flows)].reshape(block.count, -1)
        entry = [s.targets.index(f"port:{says.node}"), s.inputs.index(f"port:{says.node}:v")]
        own = slopes[here, [list(pair) for pair in s.d_flows].index(entry)]
        of_guards = guards[portion.guards :][: block.count * s.slots].reshape(block.count, -1)[here]
        nearest = of_guards[:, : len(s.guards[says.zone])].max(axis=1, initial=-np.inf)
        ratio, read = _ratios(self.system, block, here)
        made = []
        for k, i in enumerate(here.tolist()):
            ends = self._ends(block.instances[i].path, says)
            if ends is not None and own[k]:
                group, of_node, by, of_by = ends
                bond = float(abs(own[k])) * of_node**2
                own_ratio = float(ratio[k]) * of_by / of_node
                made.append((float(nearest[k]), Node(group, by, own_ratio, law + i, bond, read[k])))
        return made

    def _ends(self, path: str, says: Carries) -> tuple[int, float, int, float] | None:
        """Groups of a bond's node and of its carrier, and their ratios; None if it cannot entrain."""
        flat, numbering = self.system.flat, self.system.numbering
        group, of_node, _ = flat.place(PortRef(path, says.node))
        by, of_by, _ = flat.place(PortRef(path, says.by))
        if group == by or not flat.groups[group].free or group not in numbering.rate:
            return None
        if flat.groups[by].free and by not in numbering.rate:
            return None
        return group, of_node, by, of_by


def _in_zone(system: Instance, block: Block, says: Carries) -> Integers:
    """Instances of a block of bonds that are in the zone in which they take their node along."""
    zones = block.kernel.structure.zones
    if len(zones) == 1:
        return np.arange(block.count)
    return np.flatnonzero(system.zones[block.machines[:, 0]] == zones.index(says.zone))


def _ratios(system: Instance, block: Block, which: Integers) -> tuple[Floats, list[tuple[int, ...]]]:
    """By instance: the ratio of the speeds of node and carrier, and the places of z it is read from."""
    s = block.kernel.structure
    ratio, places = np.full(len(which), s.carries[0][1]), []
    for text, power in s.carries[1:]:
        if key(text).kind == PARAMETER:
            factor = block.parameters[which, s.parameters.index(key(text).number)]
        else:
            j = s.inputs.index(text)
            at = block.in_index[which, j]
            factor = block.in_coef[which, j] * system.memory["z"][at] + block.in_offset[which, j]
            places.append(at)
        ratio = ratio * factor**power
    return ratio, [tuple(int(at[k]) for at in places) for k in range(len(which))]


def nothing_entrained(system: Instance) -> Entrained:
    """Every place stands for itself."""
    places, rows = system.numbering.dump + 1, system.numbering.w_dump + 1
    return Entrained(
        np.arange(places), np.ones(places), np.zeros(places), np.arange(rows), np.ones(rows),
        np.zeros(0, np.int64), np.zeros(0), np.zeros(0), {}, (),
    )  # fmt: skip
