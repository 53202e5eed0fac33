"""Plans and arrays of a model whose blocks are laid out: the whole of it, or the part of it that moves.

Nothing here knows how the blocks came about; see `compile.py` and `subsystem.py`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels import layout
from fairlead.system.arrays.blocks import Block, Floats, Tables
from fairlead.system.arrays.outputs import signals, stored
from fairlead.system.arrays.portions import portions, rows
from fairlead.system.arrays.read_forces import pressing
from fairlead.system.arrays.switching import (
    asked_of_blows,
    guards,
    holders,
    kinks,
    latches,
    least,
    limits,
    machine_kinds,
    machine_owners,
    machine_zones,
    met,
    stops,
    takes_impulse,
    told,
)
from fairlead.system.arrays.timing import first_pieces, samplers
from fairlead.system.arrays.working import set_apart
from fairlead.system.assembly.algebraic_nodes import rated_rows
from fairlead.system.assembly.jacobian import jacobian
from fairlead.system.assembly.mass import mass
from fairlead.system.assembly.program import Pattern
from fairlead.system.assembly.redundancy import circle_arrays, guard_inertias
from fairlead.system.callbacks.table import SPREAD, callbacks
from fairlead.system.compiled.context import context, working_arrays
from fairlead.system.compiled.opened import nothing_set
from fairlead.system.compiled.system import System
from fairlead.system.numbering.tolerances import roundings, scales
from fairlead.system.numbering.unknowns import Numbering

HOLD_TIME = 1e-3  # s; a held contact loses a slip left over from rounding with this time constant


def build(
    flat: FlatModel,
    numbering: Numbering,
    blocks: list[Block],
    tables: Tables,
    machines: Sequence[str],
    begin: Floats,
    *,
    whole: bool = True,
) -> System:
    """The System of these blocks; `machines` says whose every position in `zones` is, `begin` [n] the start.

    A part of a model (not `whole`) has its weights and its samples from the whole, and no outputs of its own.
    """
    laid, end = portions(blocks)
    rated = rated_rows(flat, numbering, blocks)
    mass_pattern, memory = mass(blocks, laid, numbering)
    program = jacobian(flat, blocks, laid, numbering, memory | rated, end.mass)
    slots, switches = guards(blocks)
    on_given_motion, loose = stops(flat, blocks)
    memory |= loose | switches | rows(blocks, laid, end) | samplers(blocks) | {"stored": stored(blocks, laid)}
    memory |= working_arrays(flat, blocks, numbering, tables, len(machines), program)
    memory |= circle_arrays(flat, blocks, laid, numbering, end.mass) | {"tau": np.array([HOLD_TIME])} | rated
    memory |= nothing_set() | told(blocks, len(machines))
    more = len(rated["rated_terms"]) + len(memory["light_terms"])
    memory["partials"] = np.concatenate([memory["partials"], np.zeros(more)])
    memory["guard_inertia"] = guard_inertias(flat, blocks, laid, len(slots))
    memory["context"] = context(blocks, numbering, program, memory, end.mass)
    timed = first_pieces(blocks, memory["zones"], numbering.open_first)
    working = set_apart(memory, blocks, samples=whole)
    unknowns, run = numbering.unknowns, flat.assembly.netlist.run
    return System(
        flat=flat,
        numbering=numbering,
        blocks=blocks,
        tables=tables,
        callbacks={name: at for name, at in callbacks().address.items() if name != SPREAD},
        initial=begin,
        pattern=Pattern(program.starts, program.rows),
        timed=program.timed,
        mass_pattern=mass_pattern,
        zones=memory["zones"],
        differential=np.array([u.differential for u in unknowns], dtype=bool),
        quadrature=np.array([u.kind == "ledger" for u in unknowns], dtype=bool),
        stiff=np.array([u.kind == "state" for u in unknowns], dtype=bool),
        accuracy=run.accuracy,
        start=run.start,
        scales=scales(flat, numbering, roundings([unit for _, unit in slots])) if whole else None,
        guard_machine=memory["guard_machines"],
        guard_inertia=memory["guard_inertia"],
        holder=holders(blocks, numbering.n),
        takes_impulse=takes_impulse(blocks, numbering.n),
        pressing=pressing(blocks, numbering),
        met_guard=met(blocks),
        limit_guard=limits(blocks),
        blow_guard=asked_of_blows(blocks),
        latch_guard=latches(blocks),
        least_guard=least(blocks),
        kink_guard=kinks(blocks),
        linear=all(_is_linear(block, numbering) for block in blocks),
        machine_names=list(machines),
        on_given_motion=on_given_motion,
        machine_kind=machine_kinds(blocks, len(machines)),
        n_swings=end.swings if memory["counts"][layout.SWINGS].any() else 0,
        guard_names=[name for name, _ in slots],
        machine_zones=machine_zones(blocks, len(machines)),
        machine_owners=machine_owners(blocks, len(machines)),
        signals=signals(flat, blocks, laid, numbering) if whole else [],
        memory=memory,
        working=working,
        timed_tables=timed,
    )


def _is_linear(block: Block, numbering: Numbering) -> bool:
    """True if flows, and outputs that something reads, are linear in the unknowns as long as the zones are frozen."""
    read = (block.sig_index != numbering.dump).any(axis=0)
    return block.kernel.structure.linear and not any(read[k] for k in block.kernel.structure.curved)
