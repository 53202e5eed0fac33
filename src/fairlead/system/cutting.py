"""The part of a System that moves, as a System of its own: what rests is left out, and stands in it as numbers.

    unknowns that rest      numbers behind `dump` in z
    laws of those alone     left out; what they add to forces on prescribed nodes and to the ledger is `f_rest`
    what they record        `recorded_rest`
"""

from __future__ import annotations

import ctypes
import dataclasses
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from fairlead.system.blocks import Block
from fairlead.system.build import build
from fairlead.system.rest import Booleans, Floats, Integers
from fairlead.system.shares import shares
from fairlead.system.system import System
from fairlead.system.tolerances import Weights
from fairlead.system.unknowns import Numbering

AGREE = 1e-6
"""Share of its own terms by which an equation of the part may differ from that of the whole."""
CALL = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p)


class Moving(NamedTuple):
    """What moves and a margin around it."""

    kept: Booleans
    """By unknown."""
    laws: list[Booleans]
    """By block: its instances that have to do with what is kept."""
    machines: Integers
    """Theirs."""
    rim: Booleans
    """By machine of the whole: its change may set in motion what is not kept."""


class Part(NamedTuple):
    """What moves, and where it lies in the whole."""

    problem: System
    unknowns: Integers
    machines: Integers
    guards: Integers
    rim: Integers
    """By machine of the part: 1 if its change ends what is true of the part."""


def cut(system: System, t: float, y: Floats, moving: Moving) -> Part | None:
    """The System of what moves at (t, y [n]); None if its equations differ from those of the whole there."""
    whole, n = system.numbering, system.n
    kept, laws, machines, rim = moving.kept, moving.laws, moving.machines, moving.rim
    unknowns = np.flatnonzero(kept)
    numbering = _numbering(system, kept, laws)
    z_of, rests = _places(system, numbering, unknowns, laws)
    w_of = np.full(whole.w_dump + 1, numbering.w_dump)
    w_of[unknowns] = np.arange(len(unknowns))
    w_of[n : whole.w_dump] = numbering.n + np.arange(whole.w_dump - n)
    machine_of = np.full(len(system.zones) + 1, -1, dtype=np.int64)
    machine_of[machines] = np.arange(len(machines))
    blocks = [
        _part_of(block, chosen, z_of, w_of, machine_of)
        for block, chosen in zip(system.blocks, laws, strict=True)
        if chosen.any()
    ]
    weights = Weights(system.absolute[unknowns], system.relative[unknowns], system.cap[unknowns])
    numbering.resting = len(rests)
    names = [system.machine_names[m] for m in machines]
    made = build(system.flat, numbering, blocks, system.tables, names, y[unknowns].copy(), weights, named=False)
    made.zones[:] = system.zones[machines]
    made.recorded = system.recorded
    guards = _guards(system, laws)
    made.guard_tolerance = system.guard_tolerance[guards]
    if not _say_what_rests(system, made, t, y, unknowns, laws, rests):
        return None
    return Part(made, unknowns, machines, guards, rim[machines].astype(np.int64))


def _numbering(system: System, kept: Booleans, laws: Sequence[Booleans]) -> Numbering:
    """The numbering of what is kept, in the order of the whole."""
    whole = system.numbering
    new = np.cumsum(kept) - 1
    chosen = {i.path for block, some in zip(system.blocks, laws, strict=True)
              for i, one in zip(block.instances, some.tolist(), strict=True) if one}  # fmt: skip
    signals = [output for output in whole.signals if output.instance in chosen]
    return Numbering(
        unknowns=[whole.unknowns[i] for i in np.flatnonzero(kept)],
        position={g: int(new[i]) for g, i in whole.position.items() if kept[i]},
        rate={g: int(new[i]) for g, i in whole.rate.items() if kept[i]},
        balance={g: int(new[i]) for g, i in whole.balance.items() if kept[i]},
        own={key: int(new[i]) for key, i in whole.own.items() if kept[i]},
        ledger={line: int(new[i]) for line, i in whole.ledger.items()},
        pairs=[(int(new[x]), int(new[v])) for x, v in whole.pairs if kept[x] and kept[v]],
        signals={output: k for k, output in enumerate(signals)},
        reactions=dict(whole.reactions),
    )


def _places(
    system: System, numbering: Numbering, unknowns: Integers, laws: Sequence[Booleans]
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
    read = [b.in_index[chosen].ravel() for b, chosen in zip(system.blocks, laws, strict=True)]
    sources = np.unique(np.concatenate([*read, np.zeros(0, np.int64)]).astype(np.int64))
    rests = sources[place[sources] < 0]
    place[rests] = numbering.dump + 1 + np.arange(len(rests))
    place[place < 0] = numbering.dump
    return place, rests


def _part_of(block: Block, chosen: Booleans, z_of: Integers, w_of: Integers, machine_of: Integers) -> Block:
    """The chosen instances of a block, with places in the vectors of the part."""
    which = np.flatnonzero(chosen)
    return dataclasses.replace(
        block,
        instances=[block.instances[i] for i in which], ranks=[block.ranks[i] for i in which],
        parameters=block.parameters[which], in_index=z_of[block.in_index[which]],
        in_coef=block.in_coef[which], in_offset=block.in_offset[which],
        machines=machine_of[block.machines[which]], table_base=block.table_base[which],
        sig_index=z_of[block.sig_index[which]], flow_index=w_of[block.flow_index[which]],
        flow_coef=block.flow_coef[which], ledger_index=w_of[block.ledger_index],
    )  # fmt: skip


def _guards(system: System, laws: Sequence[Booleans]) -> Integers:
    """Which guards of the whole are those of these instances, in order."""
    found, _ = shares(system.blocks)
    of_block = [
        (share.guards + block.kernel.structure.slots * np.flatnonzero(chosen)[:, None]
         + np.arange(block.kernel.structure.slots)).ravel()
        for block, share, chosen in zip(system.blocks, found, laws, strict=True)
    ]  # fmt: skip
    return np.concatenate([*of_block, np.zeros(0, np.int64)]).astype(np.int64)


def _say_what_rests(
    system: System, part: System, t: float, y: Floats, unknowns: Integers, laws: Sequence[Booleans], rests: Integers
) -> bool:
    """Write the numbers of the rest into the part; False if the equations of the part are not those of the whole."""
    f, of_part, out = np.zeros(system.n), np.zeros(part.n), np.zeros(system.n_outputs)
    call(system, "outputs", t, y, out)
    call(system, "rhs", t, y, f)
    z, w = part.memory["z"], part.memory["w"]
    z[part.numbering.dump + 1 :] = system.memory["z"][rests]
    call(part, "rhs", t, y[unknowns].copy(), of_part)
    meters = part.quadrature
    missing = f[unknowns] - of_part
    size = np.abs(f[unknowns]) + np.abs(of_part) + np.abs(part.absolute)
    if (np.abs(missing) > AGREE * size)[~meters].any():
        return False
    rest = part.memory["f_rest"]
    rest[: part.n][meters] = missing[meters]
    rest[part.n : -1] = system.memory["w"][system.n : -1] - w[part.n : -1]
    _say_what_is_recorded(system, part, out, laws)
    return True


def _say_what_is_recorded(system: System, part: System, out: Floats, laws: Sequence[Booleans]) -> None:
    """Outputs of what is left out stay as they are; those of the part are evaluated."""
    source = np.full(len(system.memory["outputs_all"]), -1, dtype=np.int64)
    of_whole, of_part = shares(system.blocks)[0], iter(shares(part.blocks)[0])
    for block, share, chosen in zip(system.blocks, of_whole, laws, strict=True):
        if chosen.any():
            width, which = len(block.kernel.structure.all_outputs), np.flatnonzero(chosen)
            first = next(of_part).outputs
            source[(share.outputs + width * which[:, None] + np.arange(width)).ravel()] = first + np.arange(
                width * len(which)
            )
    at = np.array([s.at for s in system.recorded], dtype=np.int64)
    new = np.full(len(at), -1, dtype=np.int64)
    new[at >= 0] = source[at[at >= 0]]
    keeps = (at < 0) | (new >= 0)
    meters = zip(system.numbering.ledger.values(), part.numbering.ledger.values(), strict=True)
    ledger = {-1 - of_whole: -1 - of_part for of_whole, of_part in meters}
    new[at < 0] = [ledger[place] for place in at[at < 0].tolist()]
    rows = np.stack([np.flatnonzero(keeps), new[keeps]], axis=1)
    rest = out.copy()
    stored = system.memory["stored"]
    rest[-1] = system.memory["outputs_all"][stored[source[stored] < 0]].sum()
    part.select(rows, rest)


def call(system: System, name: str, t: float, y: Floats, out: Floats) -> None:
    """Call one of the callbacks that fill a vector at (t, y)."""
    y = np.ascontiguousarray(y)
    CALL(system.callbacks[name])(system.context, t, y.ctypes.data, out.ctypes.data)
