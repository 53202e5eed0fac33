"""The names by which the blocks `initial` and `nominal` of a netlist speak of unknowns.

A name is that of an unknown, or of a port's variable (`spring.b.x`) or of a mass (`cart.x`) that moves with one.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from fairlead.component.assembly import PortRef
from fairlead.errors import Fault, Location, did_you_mean, listing
from fairlead.flatten.flat_model import FlatModel
from fairlead.system.numbering.unknowns import Numbering


class Named(NamedTuple):
    """What a name stands for:  value = ratio * unknown + offset."""

    unknown: int
    ratio: float
    offset: float
    unit: str


def named_unknowns(flat: FlatModel, numbering: Numbering) -> dict[str, Named]:
    """Every name of an unknown that has a value and a weight of its own."""
    names: dict[str, Named] = {}
    for ref in flat.node_of:
        names |= _of_port(flat, numbering, ref, str(ref))
        if flat.assembly.instances[ref.instance].type.answers.inertia is not None:
            names |= _of_port(flat, numbering, ref, ref.instance)
    for outer, ref in flat.assembly.aliases.items():
        if ref in flat.node_of:
            names |= _of_port(flat, numbering, ref, outer)
    for k, unknown in enumerate(numbering.unknowns):
        if unknown.kind not in ("ledger", "share", "acceleration"):
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


def no_such(flat: FlatModel, names: Mapping[str, Named], block: str, pattern: str, where: Location) -> Fault:
    """A name that no unknown has; that of a prescribed motion is told apart."""
    owner, _, variable = pattern.rpartition(".")
    for group in flat.groups:
        ports = [port for number in group.nodes for port in flat.nodes[number].ports]
        mine = any(owner in (str(port), port.instance) for port in ports)
        if group.prescribed is not None and mine and variable in {name for name, _ in group.domain.across}:
            by = group.prescribed.by.instance
            begins = block == "initial" and group.prescribed.outputs
            way_out = f"Set where {by} begins instead." if begins else "Leave it out."
            return Fault(where, f"{block}.{pattern}: this motion is prescribed by {by}.", way_out)
    here = [name for name in names if name.rpartition(".")[0] == owner]
    near = did_you_mean(variable, [name.rpartition(".")[2] for name in here]).replace("mean ", f"mean {owner}.")
    near = near if here else did_you_mean(pattern, names)
    way_out = f"{owner} has {listing(here)}." if here else f"Unknowns are {listing(names)}."
    what = ": no unknown has this name." if not _is_output(flat, owner, variable) else (
        " is an output, which follows from the unknowns."
    )
    return Fault(where, f"{block}.{pattern}{what} {near}".rstrip(), way_out)


def _is_output(flat: FlatModel, owner: str, variable: str) -> bool:
    ref = flat.assembly.aliases.get(f"{owner}.{variable}", PortRef(owner, variable))
    instance = flat.assembly.instances.get(ref.instance)
    return instance is not None and ref.port in instance.type.declaration.outputs
