"""Where the unknowns begin: the values of the components, replaced by what the netlist's `initial` says.

    initial: {block.x: 20 mm, "line.core_node[*].v": -0.3 m/s, pad.force: 2 N}

A name is that of an unknown, or of a port's variable (`spring.b.x`) or of a mass (`cart.x`) that moves with one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.component.instantiate import PortRef
from fairlead.errors import Fault, Location, did_you_mean, listing, shown
from fairlead.flatten.flat_model import FlatModel
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.patterns import picked
from fairlead.quantities import QuantityError, si
from fairlead.system.unknowns import Numbering


class Named(NamedTuple):
    """What a name stands for:  value = ratio * unknown + offset."""

    unknown: int
    ratio: float
    offset: float
    unit: str


def starts(flat: FlatModel, numbering: Numbering) -> tuple[NDArray[np.float64], set[int], list[Fault]]:
    """The unknowns at the start, shape (n,), those that `initial` names, and what is wrong with that block."""
    begin = np.array([unknown.start for unknown in numbering.unknowns])
    given = flat.assembly.netlist.initial
    if not given:
        return begin, set(), []
    names, faults = _names(flat, numbering), list[Fault]()
    said: dict[int, tuple[str, float]] = {}
    for pattern, value in given.items():
        if len(faults) > MOST_FAULTS:
            break
        chosen = picked(names, pattern)
        if not chosen:
            faults.append(_no_such(flat, names, pattern, value.named_at))
            continue
        try:
            numbers = {name: si(value.plain(), names[name].unit) for name in chosen}
        except QuantityError as error:
            faults.append(Fault(value.where, f"initial.{pattern} = {error.what}.", error.allowed))
            continue
        for name, number in numbers.items():
            at = names[name]
            start = (number - at.offset) / at.ratio
            other, before = said.get(at.unknown, (pattern, start))
            if not math.isclose(before, start, rel_tol=1e-9, abs_tol=1e-12):
                what = f"initial.{pattern} = {shown(value.plain())} contradicts initial.{other}: both move as one."
                faults.append(Fault(value.where, what, "Give one of them."))
            said[at.unknown] = pattern, start
    for unknown, (_, start) in said.items():
        begin[unknown] = start
    return begin, set(said), faults


def _names(flat: FlatModel, numbering: Numbering) -> dict[str, Named]:
    """Every name an initial value may be given to."""
    names: dict[str, Named] = {}
    for ref in flat.node_of:
        names |= _of_port(flat, numbering, ref, str(ref))
        if flat.assembly.instances[ref.instance].type.answers.inertia is not None:
            names |= _of_port(flat, numbering, ref, ref.instance)
    for outer, ref in flat.assembly.aliases.items():
        if ref in flat.node_of:
            names |= _of_port(flat, numbering, ref, outer)
    for k, unknown in enumerate(numbering.unknowns):
        if unknown.kind not in ("ledger", "share"):
            names[unknown.name] = Named(k, 1.0, 0.0, unknown.unit)
    return names


def _of_port(flat: FlatModel, numbering: Numbering, ref: PortRef, prefix: str) -> dict[str, Named]:
    index, ratio, offset = flat.place(ref)
    found = {}
    if index in numbering.position:
        (x, unit), *rate = flat.nodes[flat.node_of[ref]].domain.across
        found[f"{prefix}.{x}"] = Named(numbering.position[index], ratio, offset, unit)
        if index in numbering.rate:
            found[f"{prefix}.{rate[0][0]}"] = Named(numbering.rate[index], ratio, 0.0, rate[0][1])
    return found


def _no_such(flat: FlatModel, names: dict[str, Named], pattern: str, where: Location) -> Fault:
    """A name that no unknown has; that of a prescribed motion is told apart."""
    owner, _, variable = pattern.rpartition(".")
    for group in flat.groups:
        ports = [port for number in group.nodes for port in flat.nodes[number].ports]
        mine = any(owner in (str(port), port.instance) for port in ports)
        if group.prescribed is not None and mine and variable in {name for name, _ in group.domain.across}:
            by = group.prescribed.by.instance
            way_out = f"Set where {by} begins instead." if group.prescribed.outputs else "Leave it out."
            return Fault(where, f"initial.{pattern}: this motion is prescribed by {by}.", way_out)
    here = [name for name in names if name.rpartition(".")[0] == owner]
    near = did_you_mean(variable, [name.rpartition(".")[2] for name in here]).replace("mean ", f"mean {owner}.")
    near = near if here else did_you_mean(pattern, names)
    way_out = f"{owner} has {listing(here)}." if here else f"Unknowns are {listing(names)}."
    return Fault(where, f"initial.{pattern}: no unknown has this name. {near}".rstrip(), way_out)
