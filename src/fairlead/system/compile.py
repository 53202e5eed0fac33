"""Fourth stage: the flat model becomes index arrays, kernels and a plan for the Jacobian.

    system = compile(flat)        kernels -> numbering -> blocks -> program -> context

No symbolic work happens here: kernels are traced once per class (`kernels.py`) and come from a cache.
"""

from __future__ import annotations

import dataclasses

from fairlead.component.effects import switch
from fairlead.component.values import Variant
from fairlead.errors import Fault, ModelError
from fairlead.flatten.collection import collected_later
from fairlead.flatten.flat_model import FlatModel
from fairlead.system.blocks import build_blocks
from fairlead.system.build import HOLD_TIME, build
from fairlead.system.determinacy import undetermined
from fairlead.system.initial import starts
from fairlead.system.kernels import Kernel, kernel
from fairlead.system.narrowing import Narrowing
from fairlead.system.ranks import signal_ranks
from fairlead.system.sizes import nominal_faults
from fairlead.system.start_places import placed, unfit
from fairlead.system.start_speeds import started
from fairlead.system.system import System
from fairlead.system.unknowns import number


@collected_later
def compile(flat: FlatModel) -> System:
    """Compile a flat model. Raises ModelError for laws that cannot be traced, loops of signals and open parts."""
    kernels = _kernels(flat)
    structures = {path: made.structure for path, made in kernels.items()}
    if faults := unfit(flat, structures):
        raise ModelError(faults)
    numbering = number(flat, structures, energy=energy_counted(flat))
    ranks = signal_ranks(flat, kernels)
    blocks, tables, machines = build_blocks(flat, kernels, numbering, ranks, HOLD_TIME)
    begin, initially, faults = starts(flat, numbering)
    faults += nominal_faults(flat, numbering)
    faults += undetermined(flat, numbering, blocks)
    if faults:
        raise ModelError(faults)
    system = build(flat, numbering, blocks, tables, [path for path, _ in machines], begin)
    system = started(placed(system, initially), initially)
    return dataclasses.replace(system, narrows=None if system.kept_positions else Narrowing)


def energy_counted(flat: FlatModel) -> bool:
    """Whether the scene has its ledger of energy."""
    effect = flat.assembly.netlist.effects.get("energy")
    return effect is None or switch(effect.plain()) != "off"


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
