"""Levels with a unit: what a signal part, which takes plain numbers, is given in the unit of the signal joined to it.

A relay may watch a force or an angle, so its levels are plain numbers in SI. A netlist may give one its unit, as in
`upper: 20 N`. The signal must then be a force: its output says so, or passes on, `like` one of its inputs, what is.
"""

from __future__ import annotations

from collections.abc import Iterator

from fairlead.component.assembly import PortRef
from fairlead.component.levels import dimensions_of_levels
from fairlead.errors import Fault, shown
from fairlead.flatten.flat_model import FlatModel
from fairlead.quantities import article, fits, kind, parse_unit, unit_text


def unlike(flat: FlatModel) -> Iterator[Fault]:
    """Those that measure something else than the signal that is joined."""
    for name, values in flat.assembly.entries.items():
        entry = flat.assembly.netlist.components.get(name)
        found = dimensions_of_levels(values.type, entry.parameters) if entry is not None else {}
        for parameter, dimension in found.items():
            read = values.type.declaration.parameters[parameter].like
            source = flat.sources.get(flat.assembly.aliases.get(f"{name}.{read}", PortRef(name, read)))
            if entry is None or source is None:  # what is joined to nothing is told elsewhere
                continue
            unit = unit_of(flat, source)
            if fits(dimension, parse_unit(unit).dimension):
                continue
            value, signal = entry.parameters[parameter], flat.assembly.named(source)
            is_one = f"{name}.{parameter} = {shown(value.plain())} is {article(kind(unit_text(dimension)))}"
            what = f"{is_one}, and {signal}, which is joined to {name}.{read}, is {article(kind(unit))}."
            way_out = "Write it without unit, in SI." if unit == "1" else f"Write it in {unit}, or join another signal."
            yield Fault(value.where, what, way_out)


def unit_of(flat: FlatModel, output: PortRef) -> str:
    """The unit of an output; of one that passes on what comes in, that of what is joined there."""
    seen: set[PortRef] = set()
    while output not in seen:
        seen.add(output)
        declared = flat.assembly.instances[output.instance].type.declaration.outputs[output.port]
        source = flat.sources.get(PortRef(output.instance, declared.like)) if declared.like else None
        if source is None:
            return declared.unit
        output = source
    return "1"  # a circle of signals
