"""What a netlist writes, with the declaration of each value: what it is for is declared, not read off its name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from fairlead.component.base import Declared, Family
from fairlead.component.given import Block, Part, Stations
from fairlead.component.registry import known_types
from fairlead.component.scene import is_head
from fairlead.netlist.netlist import Entry, Value

ALONE = re.compile(r"\{\s*([A-Za-z_]\w*)\s*\}")  # an expression that is one scene parameter


def types_of(model: Any) -> Mapping[str, type[Declared]]:
    """The component types that a model may name."""
    return known_types(getattr(model, "libraries", ()))


def components(model: Any) -> Iterator[tuple[Entry, type[Declared]]]:
    """The components of the netlist with their classes; of a family the member that the scene chose."""
    types, scene = types_of(model), model.assembly.scene
    for entry in model.netlist.components.values():
        yield entry, scene.member(types[entry.type], entry.parameters)


def heads(model: Any) -> list[type[Family]]:
    """The families of components that a model may name, such as the contacts."""
    return [kind for kind in types_of(model).values() if is_head(kind)]


def parts(model: Any) -> Iterator[tuple[str, type[Family], Value]]:
    """(path, member, map) of all that a netlist writes for a replaceable part, such as a curve, however deep."""
    for entry, kind in components(model):
        yield from _within(entry.name, kind.declaration.parameters, entry.parameters)
    for head in heads(model):
        members = [member.declaration.parameters for member in head.members.values()]
        declared = {name: one for each in members for name, one in each.items()}
        yield from _within("friction", declared, model.netlist.friction)


def _within(
    path: str, declared: Mapping[str, Any], given: Mapping[str, Value]
) -> Iterator[tuple[str, type[Family], Value]]:
    for name, value in given.items():
        one, here = declared.get(name), f"{path}.{name}"
        if isinstance(one, Block):
            yield from _within(here, one.parameters, value.entries)
        elif isinstance(one, Part):
            for member in _members(one.family, value):
                yield here, member, value
                yield from _within(here, member.declaration.parameters, value.entries)
        elif isinstance(one, Stations) and isinstance(value.content, list):
            for number, item in enumerate(value.content):
                for member in _members(one.family, item):
                    yield from _within(f"{here}.{number}", member.declaration.parameters, item.entries)


def _members(family: Any, value: Value) -> Iterator[type[Family]]:
    """The member that a map names; none for anything else."""
    word = value.entries.get(family.key)
    if word is not None and isinstance(word.content, str) and word.content in family.members:
        yield family.members[word.content]


def scene_parameter(model: Any, value: Value) -> str | None:
    """The scene parameter that a value is as it stands, through others that are only that; None for anything else."""
    name = None
    while found := ALONE.fullmatch(value.written):
        name = found[1]
        value = model.netlist.parameters[name]
    return name
