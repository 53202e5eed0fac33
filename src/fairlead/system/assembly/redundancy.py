"""How held contacts that close a circle share the force, as rows of the equations.

Bodies and contacts that all hold do not determine every force: forces s with  C^T s = 0  may be added at will
(C: the slips as sums of speeds). Of all that balance the bodies those of least  sum s^2  are taken. Then
every force is a difference over its contact,

    s_j = C_j w        w: one number a body, zero at a prescribed one

and the signed sum of forces round every circle is zero. Each w is an unknown (`block.share`), which keeps the
equations sparse. For every contact of a circle that holds, and every body in one:

    C_j v' = -slip/tau + g_j (s_j - C_j w)             0 = sum_j g_j C_jb (s_j - C_j w)

with g_j = C_j M^-1 C_j^T. Both brackets vanish, for what the first equations have on the left lies in the range
of C, and the second leave of the bracket what is normal to it. Speeds eliminated, forces and w have a symmetric
positive definite matrix, whatever holds, so that every order of pivots serves. Of held bodies that hang on
nothing prescribed one has w = 0. Which, is found by union-find over the contacts that hold, the ratio of speeds
carried along, because there may be gears (`unite` in rigid_clusters.py).

A contact that slides in name only, because others hold its two sides together, has no slip whose sign could
tell when it holds again. It does when its share falls below its friction: s_j = C_j w, limited.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels import layout
from fairlead.kernels.layout import AT_REST, DRIVEN, FREE
from fairlead.system.arrays.blocks import Block, Floats, Memory
from fairlead.system.arrays.portions import Portion
from fairlead.system.assembly.program import Entries
from fairlead.system.numbering.contact_cycles import REST, ends, moved_apart
from fairlead.system.numbering.unknowns import Numbering

SPEEDS = ("m/s", "rad/s")
Stops = dict[str, list[int]]  # zone -> guards, by slot, on the slip that lead into a zone that holds


def circle_entries(numbering: Numbering, m: int, first: int) -> Entries:
    """What df/dy has more; `first` is where the factors g_j begin among the partial derivatives."""
    made = Entries()

    def add(row: int, column: int, partial: int, coef: float) -> None:
        made.add(np.array([row + m]), np.array([column]), np.array([partial]), np.array([coef]))

    for j, pair in enumerate(numbering.circles):
        force = numbering.own[pair.path, pair.unknown]
        bodies = [(numbering.share[index], coef) for index, coef in pair.ends if index in numbering.share]
        add(force, force, first + j, pair.sense)
        for body, coef in bodies:
            add(force, body, first + j, -coef)
            add(body, force, first + j, coef * pair.sense)
            for other, its in bodies:
                add(body, other, first + j, -coef * its)
    for k, body in enumerate(numbering.share.values()):
        add(body, body, first + len(numbering.circles) + k, -1.0)
    return made


def circle_arrays(
    flat: FlatModel, blocks: Sequence[Block], portions: Sequence[Portion], numbering: Numbering, first: int
) -> Memory:
    """What the callbacks need to know of the circles (the names are explained in layout.py)."""
    place = {i.path: (b, s, k) for b, s in zip(blocks, portions, strict=True) for k, i in enumerate(b.instances)}
    nodes = {index: k for k, index in enumerate(dict.fromkeys(g for p in numbering.circles for g, _ in p.ends))}
    pairs, coefs = [], []
    zones: list[tuple[int, int, int]] = []
    apart = set(moved_apart(numbering.circles, numbering.share))
    for pair in numbering.circles:
        block, portion, i = place[pair.path]
        (a, coef_a), (b, coef_b) = pair.ends
        at = [numbering.share.get(index, numbering.zero) for index in (a, b)]
        machine = block.machines[i, 0] if len(block.kernel.structure.zones) > 1 else -1
        pairs.append((numbering.own[pair.path, pair.unknown], nodes[a], nodes[b], *at, machine, len(zones)))
        coefs.append((coef_a, coef_b, pair.sense, 1 / inertia(flat, pair.ends)))
        zones += _zones(block, portion, i, pair.unknown, told=pair.path not in apart)
    bodies = [(nodes[index], at) for index, at in numbering.share.items()]
    stiff = [1 / (flat.groups[index].mass or 1.0) for index in numbering.share]
    return {
        "circle_pairs": np.array(pairs, dtype=np.int64).reshape(-1, layout.CIRCLE),
        "circle_coef": np.array(coefs, dtype=float).reshape(-1, layout.CIRCLE_COEFS),
        "circle_zones": np.array(zones, dtype=np.int64).reshape(-1, layout.CIRCLE_ZONE),
        "circle_seen": np.full(len(pairs), -1, dtype=np.int64),
        "circle_still": np.zeros(len(pairs), dtype=np.int64),
        "circle_bodies": np.array(bodies, dtype=np.int64).reshape(-1, layout.BODY),
        "circle_pins": np.array(stiff, dtype=float),
        "circle_nodes": np.array([(_hangs_on(flat, g), 0, 0, 0) for g in nodes],
                                 dtype=np.int64).reshape(-1, layout.NODE),
        "circle_ratio": np.ones(len(nodes)),
        "partials": np.concatenate([np.ones(first), np.zeros(len(pairs) + len(bodies))]),
    }


def inertia(flat: FlatModel, held: Sequence[tuple[int, float]]) -> float:
    """What resists a force between two groups, by what it moves there: 1/(a^2/m_a + b^2/m_b); 1 kg if none has mass."""
    free = [(flat.groups[g].mass, coef) for g, coef in held if g != REST and flat.groups[g].free]
    ease = sum(coef**2 / mass for mass, coef in free if mass > 0)
    return 1 / ease if ease > 0 else 1.0


def _hangs_on(flat: FlatModel, index: int) -> int:
    if index == REST:
        return AT_REST
    return FREE if flat.groups[index].free else DRIVEN


def _zones(block: Block, portion: Portion, i: int, unknown: str, *, told: bool) -> list[tuple[int, int, int]]:
    """By zone: 1 if it holds, the first guard on the slip that leads to one that does (or -1), its direction if `told`.

    Between motions that are given and move apart nothing slides in name: there it is not told.
    """
    s, kind = block.kernel.structure, block.kernel.variant.type.declaration.zones
    holding = s.holds[unknown]
    stop = stops(block, holding)
    guard = portion.guards + i * s.slots
    return [
        (int(zone in holding), guard + stop[zone][0] if stop.get(zone) else -1, told * kind.direction(zone))
        for zone in s.zones
    ]


def stops(block: Block, holding: Sequence[str]) -> Stops:
    """Guards on the slip that lead from a zone that slides into one that holds."""
    s = block.kernel.structure
    into = [s.zones.index(zone) for zone in holding]
    return {
        zone: [k for k, g in enumerate(s.guards[zone]) if g["unit"] in SPEEDS and g["to"] in into]
        for zone in s.zones
        if zone not in holding
    }


def guard_inertias(
    flat: FlatModel, blocks: Sequence[Block], portions: Sequence[Portion], count: int
) -> Floats:
    """Per guard on the slip of a contact that may hold: the inertia that resists its force; 0 for all others."""
    made = np.zeros(count)
    for block, portion in zip(blocks, portions, strict=True):
        s = block.kernel.structure
        for unknown, speeds in s.pairs.items():
            slots = sorted({k for ks in stops(block, s.holds[unknown]).values() for k in ks})
            if slots:
                each = [inertia(flat, ends(flat, instance.path, speeds)) for instance in block.instances]
                at = portion.guards + s.slots * np.arange(block.count)
                for k in slots:
                    made[at + k] = each
    return made
