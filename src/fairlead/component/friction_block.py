"""The scene-wide friction block: what is wrong with it is told once, at its place, not once a contact."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from fairlead.component.base import Component, Declared, Family
from fairlead.component.bundled import Bundled
from fairlead.component.mistakes import elsewhere
from fairlead.component.parameters import fits_alone, read
from fairlead.component.scene import Scene, is_head
from fairlead.errors import Fault, did_you_mean, listing, shown
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.netlist.netlist import Netlist, Value


def sound(netlist: Netlist, types: Mapping[str, type[Declared]]) -> tuple[Scene, list[Fault]]:
    """The scene with those of its friction settings that can be used, and what is wrong with the others."""
    heads = _heads(types) if netlist.friction else []
    known = {name for head in heads for m in head.members.values() for name in (*m.declaration.parameters, m.key)}
    kept: dict[str, Value] = {}
    faults: list[Fault] = []
    for name, value in netlist.friction.items():
        if len(faults) > MOST_FAULTS:
            break
        wrong = _unknown(name, value, known) if heads else []
        for head in heads:
            wrong += _wrong_word(head, value) if name == head.key else _wrong_value(netlist, head, name, value)
        faults += wrong
        if not wrong:
            kept[name] = value
    return Scene(kept, netlist.effects, netlist.path.parent, foreign_code=netlist.foreign_code), list(
        dict.fromkeys(faults)
    )


def _heads(types: Mapping[str, type[Declared]]) -> list[type[Family]]:
    """The families of components; the bundled library knows them without importing the rest."""
    return types.heads() if isinstance(types, Bundled) else [kind for kind in types.values() if is_head(kind)]


def unheard(netlist: Netlist, kinds: Iterable[type[Declared]]) -> list[Fault]:
    """Settings that no component of the scene takes, where nobody chose the treatment they were meant for.

    Beside a `method`, be it of the scene or of one contact, they may stay, so that one word changes the treatment
    and back.
    """
    kinds, friction = set(kinds), netlist.friction
    chosen = {*friction, *(name for entry in netlist.components.values() for name in entry.parameters)}
    contacts = [kind for kind in kinds if issubclass(kind, Component) and issubclass(kind, Family) and kind.key]
    faults = []
    for kind in contacts if not any(kind.key in chosen for kind in contacts) else ():
        for name, value in friction.items():
            words = elsewhere(kind, name)
            if value.content is None or not words or any(name in other.declaration.parameters for other in kinds):
                continue
            what = f"friction.{name}: no contact of the scene takes it; it belongs to {kind.key} {listing(words)}."
            way_out = f"Write friction: {{{kind.key}: {words[0]}, {name}: ...}}, or leave {name} out: where no "
            way_out += f"{kind.key} is written it is {kind.default_word}."
            faults.append(Fault(value.named_at, what, way_out))
    return list(dict.fromkeys(faults))


def _unknown(name: str, value: Value, known: set[str]) -> list[Fault]:
    if name in known:
        return []
    what = f"friction.{name}: no friction method has such a setting. {did_you_mean(name, known)}"
    return [Fault(value.named_at, what.rstrip(), f"They have {listing(sorted(known))}.")]


def _wrong_word(head: type[Family], value: Value) -> list[Fault]:
    word = value.plain()
    if isinstance(word, str) and word in head.members:
        return []
    what = f"friction.{head.key}: there is no {head.key} {shown(word)}. {did_you_mean(str(word), head.members)}"
    return [Fault(value.where, what.rstrip(), f"There are {listing(head.members)}.")]


def _wrong_value(netlist: Netlist, head: type[Family], name: str, value: Value) -> list[Fault]:
    """What the treatment in use, or else one that has the setting, says of the value by itself."""
    chosen = Scene({n: v for n, v in netlist.friction.items() if n == head.key}).member(head, {})
    members = [m for m in (chosen, *head.members.values()) if name in m.declaration.parameters]
    if not members or fits_alone(members[0], name, value, netlist.path.parent):
        return []
    _, found = read(members[0], {name: value}, "friction", value.where, netlist.path.parent)
    return [fault for fault in found if fault.what.startswith(f"friction.{name}")]
