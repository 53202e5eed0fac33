"""What a whole scene says to its components: friction treatment, effects, and how to make children."""

from __future__ import annotations

import pathlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypeGuard

from pydantic import ValidationError

from fairlead.component.base import Declared, Family
from fairlead.component.effects import switch
from fairlead.component.given import SWITCH
from fairlead.component.mistakes import explain
from fairlead.component.parameters import make
from fairlead.component.values import Values
from fairlead.errors import Fault, Location, ModelError, listing, shown
from fairlead.netlist.netlist import Value

NOWHERE = Location("")
FRAMEWORK_EFFECTS = ("energy",)
MOST_PARTS = 200_000
"""Parts that a scene may be made of; some minutes of work and a gigabyte of memory. More is a slip of a count."""


class TooManyParts(ModelError):
    """What a netlist repeats (elements, blocks, sections) makes more parts than a scene may have."""

    def __init__(self, where: Location | None = None, path: str = "") -> None:
        what = f"{path}{': ' if path else ''}the scene has more than {MOST_PARTS} parts{' with it' if path else ''}."
        super().__init__([Fault(where, what, "Make fewer of what is repeated: elements, blocks, sections, modules.")])


@dataclass
class Tally:
    """How many parts have been made for a scene, counted before they take any room."""

    parts: int = 0

    def add(self) -> None:
        """Count one. Raises TooManyParts."""
        self.parts += 1
        if self.full():
            raise TooManyParts

    def full(self, placed: int = 0) -> bool:
        """Whether there is no room for more, of those made or of those `placed`, which may share their numbers."""
        return max(self.parts, placed) > MOST_PARTS


@dataclass(frozen=True)
class Scene:
    """Scene-wide settings, as written in the netlist."""

    friction: Mapping[str, Value] = field(default_factory=dict)
    effects: Mapping[str, Value] = field(default_factory=dict)
    folder: pathlib.Path = field(default_factory=pathlib.Path)
    tally: Tally = field(default_factory=Tally)
    foreign_code: bool = False
    """Whether FMUs may run; who loads the netlist says so, never the netlist."""

    def make(self, kind: type[Declared], /, **given: Any) -> Values:
        """Values of a child, numbers in SI. A family head stands for the member the scene chose.

        Raises ModelError when settings of the scene contradict each other, and TooManyParts.
        """
        if not (isinstance(kind, type) and issubclass(kind, Declared)):
            what = f"scene.make takes a class such as Spring, and was given {kind!r}."
            raise ModelError([Fault(None, what, "Import the class and give that, without quotes and brackets.")])
        self.tally.add()
        plain = {name: value.plain() for name, value in self.defaults(kind, given).items()}
        plain |= {name: value.plain() for name, value in self.switched(kind, given).items() if name not in given}
        if is_head(member := self.member(kind, given)):
            what = f"scene.make({kind.__name__}): there is no {member.key} {shown(given.get(member.key))}."
            raise ModelError([Fault(None, what, f"There are {listing(member.members)}.")])
        made = _made(member, {**plain, **{n: v for n, v in given.items() if n != _key(kind)}})
        faults = []
        for name, what, way_out in made.type.answers.check(made) if made.type.answers.check is not None else ():
            where = next((given.where for key, given in self.friction.items() if key == name or key in what), None)
            faults.append(Fault(where, f"friction.{name}: {what.removesuffix('.')}.", way_out))
        if faults:  # settings of the scene that contradict each other in the member chosen
            raise ModelError(faults)
        return made

    def member(self, kind: type[Declared], given: Mapping[str, Any]) -> type[Declared]:
        """The class itself, or for the head of a family the member named by the word in `given` or the scene."""
        if not is_head(kind):
            return kind
        chosen = given.get(_key(kind), self.friction.get(_key(kind)))
        word = chosen.plain() if isinstance(chosen, Value) else chosen
        if isinstance(word, dict | list):  # what cannot be a word names no member
            return kind
        return kind.members.get(word or kind.default_word, kind)

    def defaults(self, kind: type[Declared], given: Mapping[str, Any]) -> dict[str, Value]:
        """Scene-wide settings that an instance of `kind` takes because it does not give them itself."""
        declared = self.member(kind, given).declaration.parameters
        wanted = {name: value for name, value in self.friction.items() if _is_family(kind) and name in declared}
        return {name: value for name, value in wanted.items() if name not in given}

    def complete(self, kind: type[Declared], given: Mapping[str, Value]) -> dict[str, Value]:
        """What a netlist gives to a component, and what the scene says of it besides."""
        whole = {**self.defaults(kind, given), **self._taken(kind, given)}
        switched, own = self.switched(kind, given), given.get("effects")
        if switched and (own is None or isinstance(own.content, dict)):
            where = own or next(iter(switched.values()))
            entries = {**switched, **(own.entries if own else {})}
            whole["effects"] = Value(entries, where.where, where.key_where)
        return whole

    def _taken(self, kind: type[Declared], given: Mapping[str, Value]) -> dict[str, Value]:
        """What is given, less the nulls that belong to other members of the family.

        With them, who changes the method of a contact takes away what it says of its former one.
        """
        members = kind.members.values() if is_head(kind) else ()
        others = {name for member in members for name in member.declaration.parameters}
        others -= set(self.member(kind, given).declaration.parameters)
        return {name: value for name, value in given.items() if value.content is not None or name not in others}

    def switched(self, kind: type[Declared], given: Mapping[str, Any]) -> dict[str, Value]:
        """Effects of `kind` that the scene switches; what is no switch is told elsewhere."""
        declared = self.member(kind, given).declaration.effects
        return {name: v for name, v in self.effects.items() if name in declared and switch(v.plain()) in SWITCH}


def _made(kind: type[Declared], given: dict[str, Any]) -> Values:
    """Values of a child. Raises ModelError for those that its class does not allow."""
    try:
        return make(kind, **given)
    except ValidationError as error:
        tree = Value({name: _written(value) for name, value in given.items()}, NOWHERE)
        faults = explain(kind, error.errors(include_url=False), tree, f"scene.make({kind.__name__}), ")
        raise ModelError(
            Fault(None, fault.what.replace("), .", "), ", 1), fault.way_out) for fault in faults
        ) from error


def _written(value: Any) -> Value:
    """A value of Python in the form in which one of a netlist is explained."""
    if isinstance(value, Mapping):
        return Value({str(name): _written(inner) for name, inner in value.items()}, NOWHERE)
    if isinstance(value, list | tuple):
        return Value([_written(inner) for inner in value], NOWHERE)
    return Value(value, NOWHERE)


def is_head(kind: type[Declared]) -> TypeGuard[type[Family]]:
    """True for the abstract head of a family, such as `Contact`."""
    return issubclass(kind, Family) and "members" in kind.__dict__


def _is_family(kind: type[Declared]) -> bool:
    return issubclass(kind, Family) and bool(kind.key)


def _key(kind: type[Declared]) -> str:
    return kind.key if issubclass(kind, Family) else ""
