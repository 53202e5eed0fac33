"""What belongs at a node whose pressure, voltage or temperature the equations leave open, and how a user calls it."""

from __future__ import annotations

from typing import NamedTuple

from fairlead.flatten.flat_model import FlatModel, Node
from fairlead.system.numbering.unknowns import Numbering

MOST_NAMED = 6  # ports of a node in one message


class Words(NamedTuple):
    """Words about a node that nothing determines, in one domain."""

    quantity: str
    why: str
    way_out: str
    hangs: str
    anchor: str
    level: str


WORDS = {
    "hydraulic": Words(
        "pressure",
        "Nothing gives way there: what flows in has to flow out at once, whatever the pressure is",
        "Add a Volume there, which is oil that gives way, or a Leak or an Orifice to a place whose pressure is known.",
        "are joined without a Volume, and to no place whose pressure is known",
        "Join one of them to a Tank or a PressureSource, or add a Volume.",
        "Add a Volume there, which is oil that gives way.",
    ),
    "electrical": Words(
        "voltage",
        "No current there depends on it",
        "Join the circuit to an Earth, or add a Resistor or a Capacitor from there to a place whose voltage is known.",
        "are joined without a Capacitor, and to no place whose voltage is known",
        "Join one of them to an Earth.",
        "Join one of them to an Earth; by a Resistor of some kiloohm, if no current is to flow there.",
    ),
    "thermal": Words(
        "temperature",
        "No heat flow there depends on it, and nothing there takes up heat",
        "Add a HeatCapacity there, or a HeatConductor to a FixedTemperature.",
        "are joined without a HeatCapacity, and to no place whose temperature is known",
        "Join one of them to a FixedTemperature, or add a HeatCapacity.",
        "Add a HeatCapacity there, or a HeatConductor to a FixedTemperature.",
    ),
}
"""By domain, for those that are not of motion."""


def as_written(flat: FlatModel, node: Node) -> list[str]:
    """Ports of a node by the names that a netlist has for them, without the innards of composites where others are."""
    names = list(dict.fromkeys(map(flat.assembly.named, node.ports)))
    outer = [name for name in names if name.rpartition(".")[0] in flat.assembly.entries]
    return outer or names


def left_open(flat: FlatModel, numbering: Numbering, unknown: str) -> str:
    """What to say of an unknown that the equations of a run leave open; "" where it is none of these quantities."""
    for index, at in numbering.position.items():
        group = flat.groups[index]
        if numbering.unknowns[at].name == unknown and group.domain.name in WORDS:
            said = WORDS[group.domain.name]
            names = [name for number in group.nodes for name in as_written(flat, flat.nodes[number])]
            shown = ", ".join(names[:MOST_NAMED]) + (", ..." if len(names) > MOST_NAMED else "")
            return f"the equations do not determine the {said.quantity} at {shown}. {said.why}. {said.way_out}"
    return ""
