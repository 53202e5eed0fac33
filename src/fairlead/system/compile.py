"""Fourth stage: the flat model becomes index arrays, kernels and a plan for the Jacobian.

    system = compile(flat)        kernels -> numbering -> blocks -> program -> context

No symbolic work happens here: kernels are traced once per class (`kernels.py`) and come from a cache.
"""

from __future__ import annotations

import numpy as np

from fairlead.component.values import Variant
from fairlead.errors import Fault, ModelError
from fairlead.flatten.collection import collected_later
from fairlead.flatten.flat_model import FlatModel
from fairlead.system.blocks import Block, Floats, Tables, build_blocks
from fairlead.system.context import context, working_arrays
from fairlead.system.determinacy import undetermined
from fairlead.system.driver import callbacks
from fairlead.system.initial import starts
from fairlead.system.jacobian import jacobian
from fairlead.system.kernels import Kernel, kernel
from fairlead.system.mass import mass
from fairlead.system.outputs import signals, stored
from fairlead.system.plain_python import called_controllers
from fairlead.system.ranks import signal_ranks
from fairlead.system.shares import rows, shares
from fairlead.system.sharing import guard_inertias, sharing
from fairlead.system.switching import guards, holders, kinks, limits, machine_owners, machine_zones
from fairlead.system.system import Pattern, System
from fairlead.system.timing import samplers, start_pieces
from fairlead.system.tolerances import Weights, guard_tolerances, weights
from fairlead.system.unknowns import Numbering, number

HOLD_TIME = 1e-3  # s; a held contact loses a slip left over from rounding with this time constant


@collected_later
def compile(flat: FlatModel, accuracy: float = 1e-4) -> System:
    """Compile a flat model. Raises ModelError for laws that cannot be traced, loops of signals and open parts."""
    kernels = _kernels(flat)
    structures = {path: made.structure for path, made in kernels.items()}
    effect = flat.assembly.netlist.effects.get("energy")
    numbering = number(flat, structures, energy=effect is None or effect.plain() != "off")
    ranks = signal_ranks(flat, kernels)
    blocks, tables, machines = build_blocks(flat, kernels, numbering, ranks, HOLD_TIME)
    begin, faults = starts(flat, numbering)
    faults += undetermined(flat, numbering, blocks)
    if faults:
        raise ModelError(faults)
    chosen = weights(flat, numbering, accuracy)
    system = _system(flat, numbering, (blocks, tables, machines), begin, chosen)
    start_pieces(blocks, system.zones, flat.assembly.netlist.run.start)
    system.record(["*"])
    return system


def _is_linear(block: Block, numbering: Numbering) -> bool:
    """True if flows, and outputs that something reads, are linear in the unknowns as long as the zones are frozen."""
    read = (block.sig_index != numbering.dump).any(axis=0)
    return block.kernel.structure.linear and not any(read[k] for k in block.kernel.structure.curved)


def untraceable(flat: FlatModel) -> list[Fault]:
    """Laws that cannot be traced, one fault a class; each names the author's file and line."""
    faults: dict[Variant, Fault] = {}
    for variant, instance in {instance.variant: instance for instance in reversed(flat.instances)}.items():
        try:
            kernel(variant)
        except TypeError as error:  # TraceError, and what an author's law may raise when it is run
            faults[variant] = Fault(instance.where, f"{instance.path}: {error}")
    return list(faults.values())


def _kernels(flat: FlatModel) -> dict[str, Kernel]:
    faults = untraceable(flat)
    if faults:
        raise ModelError(faults)
    return {instance.path: kernel(instance.variant) for instance in flat.instances}


def _system(
    flat: FlatModel,
    numbering: Numbering,
    built: tuple[list[Block], Tables, list[tuple[str, int]]],
    begin: Floats,
    chosen: Weights,
) -> System:
    """Plans and arrays of a model whose blocks are built."""
    blocks, tables, machines = built
    shared, end = shares(blocks)
    program = jacobian(flat, blocks, shared, numbering, end.mass)
    mass_pattern, memory = mass(blocks, shared, numbering)
    named, switches = guards(blocks)
    start = flat.assembly.netlist.run.start
    memory |= switches | rows(blocks, shared, end) | samplers(blocks, start) | {"stored": stored(blocks, shared)}
    memory |= working_arrays(flat, blocks, numbering, tables, len(machines), program)
    memory |= sharing(flat, blocks, shared, numbering, end.mass) | {"tau": np.array([HOLD_TIME])}
    memory["guard_inertia"] = guard_inertias(flat, blocks, shared, len(named))
    controllers = called_controllers(blocks, numbering, memory)
    memory["context"] = context(blocks, numbering, program, memory, end.mass)
    unknowns = numbering.unknowns
    return System(
        flat=flat,
        numbering=numbering,
        blocks=blocks,
        callbacks=callbacks().address,
        context=memory["context"].ctypes.data,
        initial=begin,
        pattern=Pattern(program.starts, program.rows),
        mass_pattern=mass_pattern,
        zones=memory["zones"],
        differential=np.array([u.differential for u in unknowns], dtype=bool),
        quadrature=np.array([u.kind == "ledger" for u in unknowns], dtype=bool),
        stiff=np.array([u.kind == "state" for u in unknowns], dtype=bool),
        absolute=chosen.absolute,
        relative=chosen.relative,
        cap=chosen.cap,
        guard_tolerance=guard_tolerances([unit for _, unit in named], chosen.cap),
        guard_machine=memory["guard_machines"],
        guard_inertia=memory["guard_inertia"],
        holder=holders(blocks, numbering.n),
        limit_guard=limits(blocks),
        kink_guard=kinks(blocks),
        linear=all(_is_linear(block, numbering) for block in blocks),
        machine_names=[path for path, _ in machines],
        guard_names=[name for name, _ in named],
        machine_zones=machine_zones(blocks, len(machines)),
        machine_guards=machine_owners(blocks, len(machines)),
        signals=signals(flat, blocks, shared, numbering),
        memory=memory,
        controllers=controllers,
    )
