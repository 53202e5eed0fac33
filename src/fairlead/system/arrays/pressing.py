"""Signals that press contacts: a run watches them, whatever is recorded, as it may have to ask for another `lift`."""

from __future__ import annotations

from typing import NamedTuple

from fairlead.component.assembly import PortRef
from fairlead.flatten.flat_model import FlatModel

LIFT = "lift"
"""The parameter of a contact that says below which normal force it is open."""


class Pressed(NamedTuple):
    """A contact of the netlist that a signal presses, and below which normal force it is open."""

    path: str
    signal: str
    lift: float


def pressed(flat: FlatModel) -> list[Pressed]:
    """Contacts of the netlist that a signal presses, and that have the `lift` that nobody gave."""
    found = []
    for instance in flat.those(lambda kind: kind.answers.pressed_by):
        type_ = instance.type
        by, parameter = type_.answers.pressed_by, type_.declaration.parameters.get(LIFT)
        if not by or parameter is None or instance.path not in flat.assembly.entries:
            continue
        source, lift = flat.sources.get(PortRef(instance.path, by)), getattr(instance.values, LIFT)
        if source is not None and lift == parameter.default:
            found.append(Pressed(instance.path, str(source), lift))
    return found
