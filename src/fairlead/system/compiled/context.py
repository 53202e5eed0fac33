"""The context: sizes, and the addresses of all arrays, in the one vector that every callback gets.

What a run changes (working.py) and what it records (recording.py) has other addresses in every run.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairlead.distinct import distinct
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels import layout
from fairlead.kernels.structure import OF_GUARD
from fairlead.system.arrays.blocks import Block, Floats, Integers, Memory, Tables
from fairlead.system.arrays.following import followers
from fairlead.system.arrays.switching import holds
from fairlead.system.arrays.timing import time_places
from fairlead.system.assembly.program import Program
from fairlead.system.numbering.unknowns import Numbering, part_rows, reaction_masses

# Positions of the context that hold the address of the array of that name, in lower case, in memory; there is one for
# each name in `working.CHANGED` too.
ADDRESSES = (
    "TABLES", "KERNELS", "BLOCKS", "SCHEDULE", "PAIRS", "INVERSE_MASS", "REACTION_MASS", "REACTION_A", "PROGRAM",
    "PROGRAM_COEF", "MASS_STATIC", "MASS_PROGRAM", "MASS_COEF", "LIGHT_PARTS", "LIGHT_ROWS", "LIGHT_ENTRIES",
    "LIGHT_COEF", "LIGHT_PLACES", "LIGHT_SUPPORTS", "LIGHT_SUPPORTS_COEF", "LIGHT_TERMS",
    "HOLDS", "LOOSE", "GUARD_PLACE", "GUARD_TO", "GUARD_MACHINES", "TOLD_GUARDS",
    "TIME_PLACE", "STORED", "SAMPLED", "SAMPLE_PERIOD", "SAMPLE_KERNELS", "CIRCLE_PAIRS", "CIRCLE_COEF",
    "CIRCLE_ZONES", "CIRCLE_BODIES", "CIRCLE_PINS", "TAU", "FIXED", "FIXED_COEF", "MOVING",
    "ACCELERATED", "ACCELERATED_MASS", "PARTS", "PARTS_COEF", "RATED", "RATED_JOINS", "RATED_MEMBERS",
    "RATED_WEIGHTS", "RATED_TERMS", "GIVEN_PLACES", "FOLLOWING", "FOLLOWING_FLOWS",
)  # fmt: skip
# Positions that hold how many rows an array has.
COUNTED = {
    "N_REACTIONS": "reaction_mass", "N_BLOCKS": "kernels", "N_SCHEDULE": "schedule", "N_GUARDS": "guard_machines",
    "N_PAIRS": "pairs", "N_PROGRAM": "program", "N_MASS": "mass_static", "N_MASS_PROGRAM": "mass_program",
    "N_LIGHT_PARTS": "light_parts", "N_LIGHT_TERMS": "light_terms",
    "N_HOLDS": "holds", "N_LOOSE": "loose", "N_TOLD": "told_guards",
    "N_MACHINES": "zones_kept", "N_TIME": "time_place", "N_STORED": "stored", "N_SAMPLED": "sampled",
    "N_CIRCLES": "circle_pairs", "N_CIRCLE_BODIES": "circle_bodies", "N_CIRCLE_NODES": "circle_nodes",
    "N_FIXED": "fixed", "N_MOVING": "moving", "N_ACCELERATED": "accelerated", "N_PARTS": "parts",
    "N_RATED": "rated", "N_RATED_JOINS": "rated_joins", "N_RATED_TERMS": "rated_terms",
    "N_GIVEN_PLACES": "given_places", "N_FOLLOWING": "following", "N_FOLLOWING_FLOWS": "following_flows",
}  # fmt: skip


def working_arrays(
    flat: FlatModel, blocks: Sequence[Block], numbering: Numbering, tables: Tables, machines: int, program: Program
) -> Memory:
    """What the callbacks read and write, beside what belongs to the mass matrix, guards, samples and outputs."""
    reactions, given = reaction_masses(flat, numbering), _given_places(blocks, numbering)
    schedule, parts = _schedule(blocks, numbering), part_rows(flat, numbering)
    return {
        "z": np.zeros(numbering.dump + 1 + numbering.resting), "w": np.zeros(numbering.w_dump + 1),
        "f_rest": np.zeros(numbering.w_dump + 1),
        "zones": np.zeros(machines, dtype=np.int64), "tables": tables.vector(),
        "kernels": np.array([b.kernel.address for b in blocks], dtype=np.int64),
        "counts": _counts(blocks, numbering.dump), "schedule": schedule,
        "pairs": np.array(numbering.pairs, dtype=np.int64).reshape(-1, layout.PAIR),
        "inverse_mass": _inverse_mass(flat, numbering),
        "accelerated": np.array([(numbering.rate[k], a) for k, a in numbering.accelerated.items()],
                                dtype=np.int64).reshape(-1, layout.ACCELERATED_ROW),
        "accelerated_mass": np.array([flat.groups[k].mass for k in numbering.accelerated], dtype=float),
        "parts": np.array([(one.row, one.whole, one.acceleration) for one in parts],
                          dtype=np.int64).reshape(-1, layout.OF_PART),
        "parts_coef": np.array([(one.sign, one.mass) for one in parts], dtype=float).reshape(-1, layout.PART_COEFS),
        "reaction_mass": np.array([mass for _, mass, _ in reactions], dtype=float),
        "reaction_a": np.array([a for _, _, a in reactions], dtype=np.int64),
        "work": np.concatenate([[1.0], np.zeros(program.length - 1)]),
        "program": program.steps, "program_coef": program.coef, "fixed": program.fixed,
        "fixed_coef": program.fixed_coef, "moving": program.moving, "moving_base": np.zeros(len(program.moving)),
        "fixed_done": np.zeros(1, dtype=np.int64),
        "holds": holds(blocks)[0], "time_place": time_places(blocks),
        "given_places": given, "given_mean": np.zeros(len(given)), "mean": np.zeros(5),
    } | followers(blocks, schedule, given, numbering.dump)  # fmt: skip


def context(
    blocks: Sequence[Block], numbering: Numbering, program: Program, memory: Memory, circle_at: int
) -> Integers:
    """The vector itself, in the order of `layout.py`."""
    rated_at = circle_at + len(numbering.circles) + len(numbering.share)
    sizes = {name: len(memory[array]) for name, array in COUNTED.items()} | {
        "N": numbering.n, "N_SIGNALS": len(numbering.signals), "N_JACOBIAN": len(program.rows),
        "N_WORK": program.length, "N_PROGRAM_FORCES": program.forces[0],
        "N_MOVING_FORCES": program.forces[1], "T_AT": numbering.time, "ACCELERATION_AT": numbering.acceleration,
        "REACTION_AT": numbering.first_reaction, "ALWAYS_HELD": holds(blocks)[1], "JACOBIAN_AT": program.jacobian_at,
        "CIRCLE_AT": circle_at, "RATED_AT": rated_at, "LIGHT_AT": rated_at + len(memory["rated_terms"]),
        "REACTIONS_READ": int(bool(len(memory["circle_pairs"])) or any(_reads_reactions(b, numbering) for b in blocks)),
        "N_GIVEN": sum(not later for later, *_ in _calls(blocks, numbering)),
        "GUARDS_READ": int(any(b.kernel.structure.guards_read for b in blocks)),
    }  # fmt: skip
    vector = np.zeros(layout.CONTEXT, dtype=np.int64)
    for name, value in sizes.items():
        vector[getattr(layout, name)] = value
    for name in ADDRESSES:
        vector[getattr(layout, name)] = memory[name.lower()].ctypes.data
    return vector


def _reads_reactions(block: Block, numbering: Numbering) -> bool:
    return bool(((block.in_index >= numbering.first_reaction) & (block.in_index < numbering.zero)).any())


def _inverse_mass(flat: FlatModel, numbering: Numbering) -> Floats:
    """1/M of the rows with mass, else 0."""
    inverse = np.zeros(numbering.n)
    for index, row in numbering.rate.items():
        if flat.groups[index].mass > 0:
            inverse[row] = 1 / flat.groups[index].mass
    return inverse


def _counts(blocks: Sequence[Block], dump: int) -> Integers:
    """How many instances of every block to ask, by mode; none whose kernel has no answer. Outputs: see `shown.py`."""
    counts = np.zeros((layout.MODES, len(blocks)), dtype=np.int64)
    for k, block in enumerate(blocks):
        for mode in block.kernel.structure.modes:
            asked = _read_swings(block, dump) if mode == layout.SWINGS else mode != layout.OUTPUT
            if asked and (block.acts or mode == layout.GUARD):
                counts[mode, k] = block.count
    return counts


def _read_swings(block: Block, dump: int) -> bool:
    """True if a guard, or an output that something reads, has a sine of what swings."""
    s = block.kernel.structure
    return any(name == OF_GUARD or (block.sig_index[:, s.outputs.index(name)] != dump).any() for name in s.swings)


def _schedule(blocks: Sequence[Block], numbering: Numbering) -> Integers:
    """Calls that compute signals: those of given motions, then runs of equal rank inside every block, by rank."""
    return np.array([call[2:] for call in _calls(blocks, numbering)], dtype=np.int64).reshape(-1, layout.CALL)


def _calls(blocks: Sequence[Block], numbering: Numbering) -> list[tuple[int, int, int, int, int]]:
    """Those calls in order: 0 for given motions, which read nothing but time, rank, block, first instance, end."""
    calls = []
    for place, block in enumerate(blocks):
        if not block.sig_index.size or (block.sig_index == numbering.dump).all():
            continue
        ranks, later = np.array(block.ranks), int(not _given(block))
        for rank in distinct(ranks):
            first, end = np.searchsorted(ranks, [rank, rank + 1])
            calls.append((later, int(rank), place, int(first), int(end)))
    return sorted(calls)


def _given(block: Block) -> list[int]:
    """Which outputs of a block are positions and speeds that it gives to its flanges in time; none of most blocks."""
    prescribes = block.instances[0].type.answers.prescribes
    if prescribes is None or not block.sig_index.size or any(block.ranks):
        return []
    names = [name for given in prescribes().values() if given is not None and len(given) == 3 for name in given[:2]]
    return [block.kernel.structure.outputs.index(name) for name in names]


def _given_places(blocks: Sequence[Block], numbering: Numbering) -> Integers:
    """Where in z the positions and speeds lie that are given in time, those that something reads."""
    found = [block.sig_index[:, columns].ravel() for block in blocks if (columns := _given(block))]
    places = np.concatenate([*found, np.zeros(0, dtype=np.int64)]).astype(np.int64)
    return places[places != numbering.dump]
