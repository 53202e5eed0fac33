"""What a scene adds to the numbers of a contact: the force that presses it, and the lever arm that makes it a torque.

    in_scene(model.flat, contacts)      {"clutch.contact": InScene(normal=140.0, arm=0.1)}, pressed by a constant force
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

from fairlead.component.assembly import Instance, PortRef
from fairlead.component.terms import terms_of
from fairlead.flatten.flat_model import FlatModel

TORQUE = "N*m"
SHARED = "share"  # the role of an output that friction is told by


class InScene(NamedTuple):
    """Of a contact in a scene."""

    normal: float | None
    """What presses it [N]; None where it is no number, but a signal that varies."""
    arm: float | None
    """Torque over friction [m], where a part tells friction as a torque."""


def in_scene(flat: FlatModel, contacts: Iterable[Instance]) -> dict[str, InScene]:
    """By path of a contact its normal force and its lever arm, where the scene has them as numbers."""
    by_path = {one.path: one for one in flat.instances}
    fed: dict[str, list[tuple[PortRef, PortRef]]] = {}
    for target, source in flat.sources.items():
        fed.setdefault(source.instance, []).append((target, source))
    return {
        one.path: InScene(
            _input(flat, by_path, one, one.type.answers.pressed_by), _arm(by_path, one, fed.get(one.path, []))
        )
        for one in contacts
    }


def _input(flat: FlatModel, by_path: dict[str, Instance], one: Instance, name: str) -> float | None:
    """The value of an input that is a number: what stands for it, or what a law makes of such numbers alone."""
    source = flat.sources.get(PortRef(one.path, name))
    if source is None:
        stands = one.type.declaration.inputs[name].default
        value = one.values.path(stands) if isinstance(stands, str) else stands
        return None if value is None else float(value)
    before = by_path.get(source.instance)
    return None if before is None or not _is_formula(before) else _output(flat, by_path, before, source.port)


def _output(flat: FlatModel, by_path: dict[str, Instance], one: Instance, name: str) -> float | None:
    given = {each: _input(flat, by_path, one, each) for each in _arguments(one) if each != "p"}
    if any(value is None for value in given.values()):
        return None
    return _told(one, given, name)


def _arm(by_path: dict[str, Instance], contact: Instance, fed: list[tuple[PortRef, PortRef]]) -> float | None:
    """What a part that is fed with the friction makes of one newton, if that is a torque."""
    tells = {name for name, output in contact.type.declaration.outputs.items() if output.role == SHARED}
    for target, source in fed:
        lever = by_path.get(target.instance)
        if source.port not in tells or lever is None or not _is_formula(lever):
            continue
        torques = [name for name, output in lever.type.declaration.outputs.items() if output.unit == TORQUE]
        if torques and _arguments(lever) <= {"p", target.port}:
            return _told(lever, {target.port: 1.0}, torques[0])
    return None


def _is_formula(one: Instance) -> bool:
    """Whether its outputs follow from its parameters and inputs by one law."""
    has = one.type.declaration
    memory = (has.ports, has.states, has.unknowns, has.discrete, has.samples)
    return not any(memory) and len(has.laws) == 1 and _arguments(one) <= {"p", *has.inputs}


def _arguments(one: Instance) -> set[str]:
    (law,) = one.type.declaration.laws.values()
    return set(law.__code__.co_varnames[: law.__code__.co_argcount])


def _told(one: Instance, given: dict[str, Any], name: str) -> float | None:
    (law,) = one.type.declaration.laws.values()
    with_values = {"p": one.values, **given}
    said = terms_of(one.type, law(**{each: with_values[each] for each in _arguments(one)}))
    return float(said[name]) if name in said else None
