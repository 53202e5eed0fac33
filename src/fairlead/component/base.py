"""Component and its kin: declarations collected by name and checked when the class is created.

A subclass of `Component` answers one question: given the motion of my ports, what do I take in?

    class Spring(Component):
        a, b = Translational(), Translational()
        stiffness = Parameter("N/m", above=0)

        def law(p, a, b):
            tension = p.stiffness * (b.x - a.x)
            return -tension, +tension

Arguments are passed by name: `p` holds the parameters, every other argument is a port, an input, a
state, an unknown or `t`. A law without zones is called `law`; with zones, each `@zone` marks one.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from fairlead.brief import in_a_line
from fairlead.component.answers import (
    COMPONENT,
    COMPOSITE,
    CONTROLLER,
    EVERYWHERE,
    Answers,
    answers_of,
    unfit,
)
from fairlead.component.class_checks import DeclarationError, check, check_fixed, demand, members_of
from fairlead.component.declaration import Declaration
from fairlead.component.declare import (
    Carries,
    Derived,
    Discrete,
    Guard,
    Input,
    Output,
    Port,
    Sampled,
    Shared,
    State,
    Unknown,
    ZoneLaw,
    Zones,
)  # fmt: skip
from fairlead.component.given import (
    Block,
    Choice,
    Count,
    Effect,
    Entries,
    File,
    Matrix,
    Name,
    Parameter,
    Part,
    Stations,
    Table,
    Text,
    Waveform,
)  # fmt: skip
from fairlead.component.in_si import not_in_si, parameters_in_si
from fairlead.component.kinds_of_answers import method
from fairlead.component.replies import held_to, is_bundled
from fairlead.component.slips import misspelt

PARAMETER_KINDS = (
    Parameter, Choice, Count, Name, File, Entries, Text, Matrix, Part, Block, Table, Waveform, Stations
)  # fmt: skip
CONTROLLERS = "fairlead.component.controller"


class Declared:
    """What Component, Composite and parts of laws share: declarations collected at class creation."""

    declaration: ClassVar[Declaration] = Declaration()
    answers: ClassVar[Answers] = Answers()

    def __init_subclass__(cls, *, abstract: bool = False, **keywords: Any) -> None:
        """Collect what the body declares on top of what its half-models declare."""
        super().__init_subclass__(**keywords)
        if cls.__module__.split(".")[0] == "components":
            raise DeclarationError(
                f"{cls.__name__} was imported as {cls.__module__}; import it as fairlead.{cls.__module__}"
            )
        if not abstract:  # a half-model is collected through the leaves that build on it
            members = members_of(cls)
            cls.declaration = _collect(members)
            _check_answers(cls, members)
            cls.answers = held_to(answers_of(members, _sort(cls)), cls)
            written = cls.declaration.parameters
            if not is_bundled(cls):  # the tests ask those
                cls.declaration = replace(cls.declaration, parameters=parameters_in_si(written))
                check_declared(cls)
                for what in not_in_si(written, cls.declaration):
                    demand(cls, False, what)
            elif _sort(cls) == CONTROLLER:  # which changes its declaration after this (controller.py)
                check_declared(cls)
            check_fixed(cls)


class Family(Declared, abstract=True):
    """Kinds that can stand in one place, told apart by one word in the netlist.

    The head of a family is abstract and names the word: `key = "curve"`. A member is known by its
    `word` (its class name in lower_snake unless it says so), and becomes available by being imported; one of a library
    is in view while a model with that library is read, see `members.py`.
    `bare` says what a value without a map stands for: a parameter of one member.
    """

    key: ClassVar[str] = ""
    word: ClassVar[str] = ""
    default_word: ClassVar[str] = ""
    offered: ClassVar[tuple[str, ...]] = ()  # words that messages name first
    bare: ClassVar[tuple[str, str] | None] = None  # (word of the member, parameter)
    members: ClassVar[dict[str, type[Family]]]
    everyone: ClassVar[list[type[Family]]] = []  # members of all families, in the order in which they joined
    shown: ClassVar[tuple[int, ...]] = ()  # numbers of the libraries whose members are in view
    needs: ClassVar[dict[str, str]] = {}  # methods that every member has: how it is called, with what it gives
    gives: ClassVar[dict[str, str]] = {}  # methods that give a number: which, in words; it may end with None

    def __init_subclass__(cls, *, abstract: bool = False, **keywords: Any) -> None:
        """Collect declarations, and join the family."""
        super().__init_subclass__(abstract=abstract, **keywords)
        if abstract and "key" in cls.__dict__:
            cls.members = {}
        elif not abstract:
            for name, said in cls.needs.items():
                function = getattr(cls, name, None)
                demand(cls, callable(function), f"a {cls.key or 'member'} needs a method {said}")
                asks = said.partition("(")[2].partition(")")[0].split(", ")
                wrong = method(*asks).wrong(function, cls.declaration)
                demand(cls, not wrong, f"{name} {wrong}")
            cls.word = cls.__dict__.get("word") or _snake(cls.__name__)
            cls.members[cls.word] = cls
            Family.everyone.append(cls)


def _snake(name: str) -> str:
    return "".join("_" + c.lower() if c.isupper() and i else c.lower() for i, c in enumerate(name))


class Component(Declared, abstract=True):
    """A leaf of the model: ports, parameters and pure laws."""


class Composite(Declared, abstract=True):
    """A component made of others: `expand(p, scene)` returns an Expansion of children and connections."""


@dataclass(frozen=True)
class Expansion:
    """What a composite turns into. Connections join paths such as ("hose[0].b", "node[1].flange").

    `children` holds the Values of each child, as `scene.make(Type, ...)` returns them. `ports` maps
    each outer port to an inner one; `outputs` gives inner outputs an outer name.
    """

    __repr__ = in_a_line

    children: dict[str, Any]
    connections: list[tuple[str, ...]]
    ports: dict[str, str]
    outputs: dict[str, str] = field(default_factory=dict)
    line: Any = None  # of a composite with a path: an `OfLine` or an `OfRoute`, see along.py


def _sort(cls: type) -> str:
    """What sort of class it is, which decides what it may be asked."""
    if any(base.__name__ == "Controller" and base.__module__ == CONTROLLERS for base in cls.__mro__):
        return CONTROLLER
    return COMPONENT if issubclass(cls, Component) else COMPOSITE if issubclass(cls, Composite) else EVERYWHERE


def _collect(members: dict[str, Any]) -> Declaration:
    """Merge the declarations of all bases, nearest last, into one record."""

    def of(kind: Any) -> dict[str, Any]:
        return {name: value for name, value in members.items() if isinstance(value, kind)}

    zones = next((value for value in reversed(list(members.values())) if isinstance(value, Zones)), None)
    guards: dict[str, Guard] = {}
    for name, mark in of(Guard).items():
        guards |= _everywhere(mark, zones or ()).pair(name, zones or Zones())
    laws: dict[str, Callable[..., Any]] = {}
    for marked in of(ZoneLaw).values():
        laws.update(dict.fromkeys(marked.zones, marked.law))
    if inspect.isfunction(members.get("law")) and zones is None:
        laws["always"] = members["law"]
    outputs = {output.name or name: output for name, output in of(Output).items()}
    effects = of(Effect)
    parameters = {name: one for name, one in of(PARAMETER_KINDS).items() if name not in effects}
    if effects:  # written as a map of their own
        parameters["effects"] = Block(effects, "What to leave out.")
    return Declaration(
        effects=effects, ports=of(Port), parameters=parameters, inputs=of(Input), outputs=outputs, states=of(State),
        unknowns=of(Unknown), discrete=of(Discrete), samples=of(Sampled), derived=of(Derived),
        shared=of(Shared), zones=zones or Zones("always"), laws=laws, guards=guards,
        carries=next(iter(of(Carries).values()), None),
    )  # fmt: skip


def _everywhere(mark: Guard, zones: tuple[str, ...]) -> Guard:
    """The guard with its zones by name where it says `*`: all but the one it leads to."""
    return replace(mark, zones=tuple(zone for zone in zones if zone != mark.to)) if mark.zones == ("*",) else mark


def _check_answers(cls: type[Declared], members: dict[str, Any]) -> None:
    """What is asked is answered as it is asked, and spelt as it is."""
    slips = () if is_bundled(cls) else slips_of(cls)  # the tests ask those
    for what in (*slips, *unfit(members, _sort(cls), cls.declaration)):
        demand(cls, False, what)


def check_declared(cls: type[Declared]) -> None:
    """Names, signatures, units and targets of a class, as they are checked when one of a user's is created."""
    check(cls, _sort(cls))


def slips_of(cls: type[Declared]) -> Iterator[str]:
    """What is misspelt in a class."""
    return misspelt((base.__dict__ for base in reversed(cls.__mro__[:-1])), _sort(cls))
