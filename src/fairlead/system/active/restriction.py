"""The part of a System that moves, as a System of its own: what rests is left out, and stands in it as numbers.

    unknowns that rest      numbers behind `dump` in z
    laws of those alone     left out; what they add to rows that are kept, which is constant, is `f_rest`
    outputs                 those of the whole, whose unknowns `spread` finds
    what is entrained       its places and rows are those of its carrier, whose inertia has its own in it
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from fairlead.component.keys import key
from fairlead.flatten.collection import collected_later
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels import layout
from fairlead.system.active.entrained import Entrained
from fairlead.system.active.moving import Moving
from fairlead.system.active.part import Part, hand_over, tie
from fairlead.system.active.rest import Floats, Integers
from fairlead.system.arrays.blocks import Block
from fairlead.system.arrays.portions import portions
from fairlead.system.arrays.recording import Recording, recording
from fairlead.system.compiled.asking import ask, call
from fairlead.system.compiled.build import build
from fairlead.system.compiled.system import Instance, System, begun
from fairlead.system.numbering.tolerances import Weights
from fairlead.system.numbering.unknowns import Numbering


@collected_later
def cut(system: Instance, t: float, y: Floats, moving: Moving) -> Part:
    """The System of what moves at (t, y [n])."""
    whole, n, carried = system.numbering, system.n, moving.carried
    kept, machines, boundary = moving.kept, moving.machines, moving.boundary
    unknowns = np.flatnonzero(kept)
    numbering = _numbering(system, moving)
    z_of, rests = _places(system, numbering, unknowns, moving)
    w_of = np.full(whole.w_dump + 1, numbering.w_dump)
    w_of[unknowns] = np.arange(len(unknowns))
    w_of[n : whole.w_dump] = numbering.n + np.arange(whole.w_dump - n)
    machine_of = np.full(len(system.zones) + 1, -1, dtype=np.int64)
    machine_of[machines] = np.arange(len(machines))
    pieces = _pieces(system, moving)
    blocks = [_part_of(block, piece, numbering.dump, carried, z_of, w_of, machine_of) for _, block, piece in pieces]
    guards = _guards(system, pieces)
    numbering.resting = len(rests)
    names, flat = [system.machine_names[m] for m in machines], _heavier(system.flat, carried)
    part = build(flat, numbering, blocks, system.tables, names, y[unknowns].copy(), whole=False)
    made = begun(part, _weights(system, unknowns, guards), _shown(part, system), part.working.new())
    made.zones[:] = system.zones[machines]
    _tell_of_the_whole(made, system, y, unknowns, machines, z_of, carried)
    hand_over(system, made)
    _say_what_rests(system, made, t, y, moving, rests)
    return Part(made, unknowns, machines, guards, boundary[machines].astype(np.int64), system, carried)


def _weights(system: Instance, unknowns: Integers, guards: Integers) -> Weights:
    """Those of the whole."""
    return Weights(
        system.absolute[unknowns], system.relative[unknowns], system.cap[unknowns], system.guard_tolerance[guards]
    )  # fmt: skip


def _shown(part: System, system: Instance) -> Recording:
    """What is recorded of the whole; of its own the part shows nothing."""
    nothing = recording([], [], part.blocks, part.numbering, part.memory)
    return dataclasses.replace(nothing, recorded=system.recorded)


def _tell_of_the_whole(
    part: Instance, system: Instance, y: Floats, unknowns: Integers, machines: Integers, z_of: Integers,
    carried: Entrained,
) -> None:  # fmt: skip
    """What `spread` must know (the names are explained in layout.py)."""
    count = len(carried.unknowns) // 2
    x, v = carried.unknowns[:count], carried.unknowns[count:]
    a = system.numbering.acceleration + v
    part.memory.update({
        "whole_y": y.copy(), "kept": unknowns, "kept_machines": machines,
        "carried": np.stack([x, v, *(z_of[carried.place[u]] for u in (x, v, a))], axis=1).astype(np.int64),
        "carried_coef": np.stack([carried.ratio[x], carried.offset[x], carried.ratio[v],
                                  carried.ratio[a] * carried.mass, 1 / carried.bond], axis=1),
    })  # fmt: skip
    accelerations = any(key(one).part == "a" for block in system.blocks for one in block.kernel.structure.inputs)
    given = (carried.row[v] >= system.n).any()  # of a carrier whose motion is prescribed the force is a reaction
    part.memory["context"][layout.SLIP_SHOWN] = int(accelerations or given)
    tie(part, system)


def _heavier(flat: FlatModel, carried: Entrained) -> FlatModel:
    """The model with the inertia of what is entrained at its carriers."""
    groups = list(flat.groups)
    for index, mass in carried.masses.items():
        groups[index] = dataclasses.replace(groups[index], mass=groups[index].mass + mass)
    return dataclasses.replace(flat, groups=tuple(groups)) if carried.masses else flat


def _numbering(system: System, moving: Moving) -> Numbering:
    """The numbering of what is kept, in the order of the whole."""
    whole, kept, laws = system.numbering, moving.kept, moving.laws
    new = np.cumsum(kept) - 1
    chosen = {block.instances[i].path for block, some in zip(system.blocks, laws, strict=True)
              for i in np.flatnonzero(some).tolist()}  # fmt: skip
    signals = [output for output in whole.signals if output.instance in chosen]
    unknowns = dict(enumerate(whole.unknowns))
    for group, mass in moving.carried.masses.items():
        if group in whole.rate:
            at = whole.rate[group]
            unknowns[at] = dataclasses.replace(unknowns[at], mass=unknowns[at].mass + mass)
    return Numbering(
        unknowns=[unknowns[i] for i in np.flatnonzero(kept).tolist()],
        position={g: int(new[i]) for g, i in whole.position.items() if kept[i]},
        rate={g: int(new[i]) for g, i in whole.rate.items() if kept[i]},
        balance={g: int(new[i]) for g, i in whole.balance.items() if kept[i]},
        own={key: int(new[i]) for key, i in whole.own.items() if kept[i]},
        circles=[pair for pair in whole.circles if kept[whole.own[pair.path, pair.unknown]]],
        share={g: int(new[i]) for g, i in whole.share.items() if kept[i]},
        ledger={line: int(new[i]) for line, i in whole.ledger.items()},
        pairs=[(int(new[x]), int(new[v])) for x, v in whole.pairs if kept[x] and kept[v]],
        signals={output: k for k, output in enumerate(signals)},
        reactions=dict(whole.reactions),
    )


def _places(
    system: System, numbering: Numbering, unknowns: Integers, moving: Moving
) -> tuple[Integers, Integers]:
    """Where every place of the whole z lies in that of the part; and the places whose numbers stand behind it."""
    whole, n = system.numbering, system.n
    place = np.full(whole.dump + 1, -1, dtype=np.int64)
    place[unknowns] = np.arange(numbering.n)
    for output, k in numbering.signals.items():
        place[n + whole.signals[output]] = numbering.n + k
    reactions = whole.zero - whole.first_reaction
    place[whole.first_reaction : whole.zero] = numbering.first_reaction + np.arange(reactions)
    place[whole.zero], place[whole.time], place[whole.dump] = numbering.zero, numbering.time, numbering.dump
    place[whole.acceleration : whole.acceleration + n] = numbering.zero
    place[whole.acceleration + unknowns] = numbering.acceleration + np.arange(numbering.n)
    read = [b.in_index[p.which].ravel() for _, b, p in _pieces(system, moving)]
    sources = np.unique(moving.carried.place[np.concatenate([*read, np.zeros(0, np.int64)]).astype(np.int64)])
    rests = sources[place[sources] < 0]
    place[rests] = numbering.dump + 1 + np.arange(len(rests))
    place[place < 0] = numbering.dump
    return place, rests


class Piece(NamedTuple):
    """Instances of one block of the whole; whether they act, or only have guards."""

    which: Integers
    acts: bool


def _pieces(system: System, moving: Moving) -> list[tuple[int, Block, Piece]]:
    """The blocks of the part: number of the block of the whole, that block, and which of its instances."""
    return [
        (k, block, Piece(np.flatnonzero(chosen), acts))
        for k, block in enumerate(system.blocks)
        for chosen, acts in ((moving.laws[k], True), (moving.watched[k], False))
        if chosen.any()
    ]


def _part_of(
    block: Block, piece: Piece, dump: int, carried: Entrained, z_of: Integers, w_of: Integers, machine_of: Integers
) -> Block:
    """These instances of a block, with places in the vectors of the part."""
    which = piece.which
    read, coef, goes = block.in_index[which], block.in_coef[which], block.flow_index[which]
    gives = z_of[block.sig_index[which]]
    return dataclasses.replace(
        block,
        instances=[block.instances[i] for i in which], ranks=[block.ranks[i] for i in which],
        parameters=block.parameters if len(which) == block.count else block.parameters[which],  # samples go to both
        in_index=z_of[carried.place[read]], in_coef=coef * carried.ratio[read],
        in_offset=block.in_offset[which] + coef * carried.offset[read],
        machines=machine_of[block.machines[which]], table_base=block.table_base[which],
        sig_index=gives if piece.acts else np.full_like(gives, dump), flow_index=w_of[carried.row[goes]],
        flow_coef=block.flow_coef[which] * carried.share[goes], ledger_index=w_of[block.ledger_index], acts=piece.acts,
    )  # fmt: skip


def _guards(system: System, pieces: Sequence[tuple[int, Block, Piece]]) -> Integers:
    """Which guards of the whole are those of these instances, in order."""
    found, _ = portions(system.blocks)
    of_piece = [
        (found[k].guards + block.kernel.structure.slots * piece.which[:, None]
         + np.arange(block.kernel.structure.slots)).ravel()
        for k, block, piece in pieces
    ]  # fmt: skip
    return np.concatenate([*of_piece, np.zeros(0, np.int64)]).astype(np.int64)


def _say_what_rests(system: Instance, part: Instance, t: float, y: Floats, moving: Moving, rests: Integers) -> None:
    """Write the numbers of the rest into the part: what its laws read, and what laws left out give to its rows.

    Nothing slips where something is entrained; the bonds there give nothing, since the carrier stands for their nodes.
    """
    call(system, "outputs", t, moving.carried.aligned(system, t, y), np.zeros(system.n_outputs))  # all that is read
    part.memory["z"][part.numbering.dump + 1 :] = system.memory["z"][rests]
    given, first, bonds = np.zeros(system.numbering.w_dump + 1), 0, np.array(moving.carried.laws, dtype=np.int64)
    for number, (block, acts) in enumerate(zip(system.blocks, moving.laws, strict=True)):
        out = ~acts
        out[bonds[(bonds >= first) & (bonds < first + block.count)] - first] = False
        for mode in (layout.FLOWS, layout.LEDGER):
            if mode in block.kernel.structure.modes:
                ask(system, number, mode, out, given)
        first += block.count
    rows, rest = moving.carried.added_up(given), part.memory["f_rest"]
    rest[: part.n] = rows[: system.n][moving.kept]
    rest[part.n : -1] = rows[system.n : -1]
