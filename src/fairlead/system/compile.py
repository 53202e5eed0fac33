"""Fourth stage: the flat model becomes index arrays, kernels and a plan for the Jacobian.

    system = compile(flat)        kernels -> numbering -> blocks -> program -> context

No symbolic work happens here: kernels are traced once per class (`kernel.py`) and come from a cache.
"""

from __future__ import annotations

import dataclasses
from typing import Any

from fairlead.component.assembly import PortRef
from fairlead.component.effects import switch
from fairlead.component.keys import rate_of
from fairlead.component.values import Variant
from fairlead.errors import Fault, ModelError
from fairlead.flatten.collection import collected_later
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels.kernel import Kernel, kernel
from fairlead.system.arrays.blocks import build_blocks
from fairlead.system.assembly.algebraic_nodes import (
    geared_groups,
    rated_groups,
    rates_read,
    still_supports,
    touching,
    unfit_nodes,
)
from fairlead.system.assembly.determinacy import undetermined
from fairlead.system.assembly.light_holds import rows_eliminated
from fairlead.system.compiled.build import HOLD_TIME, build
from fairlead.system.compiled.system import System
from fairlead.system.numbering.initial import starts
from fairlead.system.numbering.loops import without_loops
from fairlead.system.numbering.parts_of_bodies import rings
from fairlead.system.numbering.ranks import followed, signal_ranks
from fairlead.system.numbering.sizes import nominal_faults
from fairlead.system.numbering.unknowns import groups_with_rate_forces, number
from fairlead.system.start.driven import overridden
from fairlead.system.start.places import placed, unfit
from fairlead.system.start.speeds import started


@collected_later
def compile(flat: FlatModel) -> System:
    """Compile a flat model. Raises ModelError for laws that cannot be traced, loops of signals and open parts."""
    whole, kernels = flat, _kernels(flat)
    links = followed(flat, kernels)
    flat, kernels = without_loops(flat, kernels, links)
    structures = {path: made.structure for path, made in kernels.items()}
    if faults := unfit(flat, structures):
        raise ModelError(faults)
    if faults := rings(flat):
        raise ModelError(faults)
    rated, rates, faults = _rate(flat, kernels)
    if faults:
        raise ModelError(faults)
    geared = geared_groups(flat, structures) - rated - groups_with_rate_forces(flat, structures)
    numbering = number(flat, structures, energy=energy_counted(flat), rated=rated, geared=geared, rates=rates)
    ranks = signal_ranks(flat, kernels, links if flat is whole and not rated else followed(flat, kernels))
    blocks, tables, machines = build_blocks(flat, kernels, numbering, ranks, HOLD_TIME)
    still_supports(blocks, numbering, rows_eliminated(blocks, numbering))
    begin, initially, faults = starts(flat, numbering)
    faults += nominal_faults(flat, numbering)
    left_open, numbering.open_first = undetermined(flat, numbering, blocks)
    faults += left_open
    if faults:
        raise ModelError(faults)
    system = build(flat, numbering, blocks, tables, [path for path, _ in machines], begin)
    if faults := overridden(system):
        raise ModelError(faults)
    system = started(placed(system, initially), initially)
    whole_only = len(system.moves) or rated or numbering.parts
    return dataclasses.replace(system, subsystem_of=None if whole_only else _subsystem)


def _subsystem(system: Any) -> Any:
    """What of a system moves; few systems are large enough for that to be asked."""
    from fairlead.system.active.subsystem import Subsystem

    return Subsystem(system)


def _rate(flat: FlatModel, kernels: dict[str, Kernel]) -> tuple[set[int], list[PortRef], list[Fault]]:
    """Groups whose balances have their rates beside them, signals they need for it, and what cannot be.

    Puts kernels that know rates in place of those that do not.
    """
    rated = rated_groups(flat, {path: made.structure for path, made in kernels.items()})
    while rated:
        told, signals = _told(flat, touching(flat, rated))
        structures = {path: made.structure for path, made in (kernels | told).items()}
        dropped, faults = unfit_nodes(flat, structures, rated)
        if not dropped or faults:
            kernels |= told
            return rated, signals, faults
        rated -= dropped
    return set(), [], []


def _told(flat: FlatModel, paths: set[str]) -> tuple[dict[str, Kernel], list[PortRef]]:
    """Kernels with rates of these instances, and of those whose signals they read; the rates that are signals."""
    instances = flat.assembly.instances
    told = {path: kernel(instances[path].variant, 1) for path in sorted(paths)}
    waiting = [source for path, made in told.items() for source in rates_read(flat, instances[path], made.structure)]
    signals: dict[PortRef, None] = {}
    while waiting:
        source = waiting.pop()
        path = source.instance
        told[path] = kernel(instances[path].variant, 2)
        s, name = told[path].structure, rate_of(source.port)
        if name in s.outputs and PortRef(path, name) not in signals:
            signals[PortRef(path, name)] = None
            waiting += rates_read(flat, instances[path], s, name)
    return told, list(signals)


def energy_counted(flat: FlatModel) -> bool:
    """Whether the scene has its ledger of energy."""
    effect = flat.assembly.netlist.effects.get("energy")
    return effect is None or switch(effect.plain()) != "off"


def untraceable(flat: FlatModel) -> list[Fault]:
    """Laws that cannot be traced, one fault a class; each names the author's file and line."""
    faults: dict[Variant, Fault] = {}
    for instance in {id(instance.variant): instance for instance in reversed(flat.instances)}.values():
        variant = instance.variant
        try:
            kernel(variant)
        except (TypeError, ModelError) as error:  # TraceError, and what an author's law may raise when it is run
            first = next(one for one in flat.instances if one.variant == variant)
            faults[variant] = Fault(first.where, f"{first.path}: {error}")
    return list(faults.values())


def _kernels(flat: FlatModel) -> dict[str, Kernel]:
    faults = untraceable(flat)
    if faults:
        raise ModelError(faults)
    made: dict[int, Kernel] = {}
    for instance in flat.instances:  # a variant is asked once: to compare two of them takes long
        if id(instance.variant) not in made:
            made[id(instance.variant)] = kernel(instance.variant)
    return {instance.path: made[id(instance.variant)] for instance in flat.instances}
