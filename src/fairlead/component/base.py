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
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

from fairlead.component.answers import (
    COMPONENT,
    COMPOSITE,
    CONTROLLER,
    EVERYWHERE,
    Answers,
    answers_of,
    arguments_of,
    method,
    misspelt,
    unfit,
)
from fairlead.component.declaration import Declaration
from fairlead.component.declare import (
    ROLES,
    Carries,
    Derived,
    Discrete,
    Guard,
    Input,
    Law,
    Output,
    Port,
    Sampled,
    Shared,
    State,
    Unknown,
    ZoneLaw,
    Zones,
)  # fmt: skip
from fairlead.component.defaults import misfits, odd_kinds
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
from fairlead.component.holding import HoldPosition
from fairlead.component.replies import AnswerError, held_to, is_bundled
from fairlead.errors import did_you_mean
from fairlead.quantities import QuantityError, parse_unit

PARAMETER_KINDS = (
    Parameter, Choice, Count, Name, File, Entries, Text, Matrix, Part, Block, Table, Waveform, Stations
)  # fmt: skip
CONTROLLERS = "fairlead.component.controller"
LEDGER = ("dissipated", "supplied", "stored")
RESERVED = {"type", "given", "variant", "path", "effects"}  # attributes of `values.Values` that would hide a parameter


class DeclarationError(TypeError):
    """A class that contradicts itself; raised when it is created, with its file and line."""


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
            members = _members(cls)
            cls.declaration = _collect(members)
            _check_answers(cls, members)
            cls.answers = held_to(answers_of(members, _sort(cls)), cls)
            _check(cls)
            _check_fixed(cls)


class Family(Declared, abstract=True):
    """Kinds that can stand in one place, told apart by one word in the netlist.

    The head of a family is abstract and names the word: `key = "curve"`. A member is known by its
    `word` (its class name in lower_snake unless it says so), and becomes available by being imported; one of a library
    is in view while a model with that library is read, see `members.py`.
    `bare` names the parameter that a value without a map stands for, in the member `bare_word`.
    """

    key: ClassVar[str] = ""
    word: ClassVar[str] = ""
    default_word: ClassVar[str] = ""
    offered: ClassVar[tuple[str, ...]] = ()  # words that messages name first
    bare: ClassVar[tuple[str, str] | None] = None  # (word, parameter)
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
                _demand(cls, callable(function), f"a {cls.key or 'member'} needs a method {said}")
                asks = said.partition("(")[2].partition(")")[0].split(", ")
                wrong = method(*asks).wrong(function, cls.declaration)
                _demand(cls, not wrong, f"{name} {wrong}")
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

    children: dict[str, Any]
    connections: list[tuple[str, ...]]
    ports: dict[str, str]
    outputs: dict[str, str] = field(default_factory=dict)
    line: Any = None  # of a composite with a path: an `OfLine` or an `OfRoute`, see along.py


def _members(cls: type) -> dict[str, Any]:
    """What the bodies of a class and of all its bases hold, by name."""
    members: dict[str, Any] = {}
    for base in reversed(cls.__mro__[:-1]):
        members.update(base.__dict__)
    return members


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
        _demand(cls, False, what)


def slips_of(cls: type[Declared]) -> Iterator[str]:
    """What is misspelt in a class."""
    return misspelt((base.__dict__ for base in reversed(cls.__mro__[:-1])), _sort(cls))


def _check(cls: type[Declared]) -> None:
    """Names, signatures and targets; the physics is the contract suite's business."""
    has = cls.declaration
    _check_units(cls)
    for name, output in has.outputs.items():
        known = output.role in ("", *ROLES)
        _demand(cls, known, f"{name!r} has the role {output.role!r}; roles are {', '.join(ROLES)}")
        clash = name in {**has.ports, **has.states, **has.unknowns, **has.inputs, **has.discrete}
        _demand(cls, not clash, f"the output {name!r} has the name of a port, an input or an unknown of the class")
    _check_named_numbers(cls)
    _check_limits(cls)
    if issubclass(cls, Composite):
        _demand(cls, cls.answers.expand is not None, "a Composite needs an expand(p) method")
        return
    if not issubclass(cls, Component):
        return
    _check_directions(cls)
    for name in has.zones:
        _demand(cls, name in has.laws, f"zone {name!r} has no law")
    if has.carries is not None:
        ports = {has.carries.node, has.carries.by}
        _demand(cls, ports <= set(has.ports), f"carries names {sorted(ports)}, and the ports are {sorted(has.ports)}")
        _demand(cls, has.carries.zone in has.zones, f"carries names the zone {has.carries.zone!r}, which there is not")
    for expression in has.shared.values():
        _check_arguments(cls, expression.function, has.given)
    for name, law in has.laws.items():
        _demand(cls, name in has.zones, f"a law is declared for {name!r}, which is not in zones {has.zones}")
        _check_arguments(cls, law, has.arguments)
    _demand(
        cls, len(has.samples) <= 1, f"several sampled laws: {sorted(has.samples)}; one gives all discrete variables"
    )
    _demand(cls, bool(has.samples) or not has.discrete, f"no sampled law gives {sorted(has.discrete)}")
    for name, sample in has.samples.items():
        _demand(
            cls, sample.period in has.parameters, f"{name!r} is sampled every {sample.period!r}, which is no parameter"
        )
        _check_arguments(cls, sample.law, has.arguments)
    for name, mark in has.guards.items():
        for zone in (*mark.zones, mark.to):
            _demand(cls, zone in has.zones, f"guard {name!r} names {zone!r}, which is not in zones {has.zones}")
        _demand(cls, mark.to not in mark.zones, f"guard {name!r} leads from {mark.to!r} to itself")
        _check_arguments(cls, mark.function, has.arguments)


def _check_directions(cls: type[Declared]) -> None:
    """Zones that mirror one another are told in pairs, wherever a law or a guard asks for the direction."""
    zones = cls.declaration.zones
    for name in (*zones.forward, *zones.backward, *zones.latched):
        _demand(cls, name in zones, f"zones tell the direction of {name!r}, which is none of them")
    pairs = f"forward={list(zones.forward)}, backward={list(zones.backward)}"
    _demand(cls, len(zones.forward) == len(zones.backward), f"{pairs} are not pairs of zones that mirror one another")
    asking = [(function, name) for name, function in cls.declaration.laws.items()]
    one_sided = [mark for mark in cls.declaration.guards.values() if not mark.direction]
    asking += [(mark.function, name) for mark in one_sided for name in mark.zones]
    for function, name in asking if "direction" not in cls.declaration.inputs else ():
        told = zones.direction(name) != 0 or "direction" not in arguments_of(function)
        _demand(cls, told, f"{function.__name__} asks for the direction of {name!r}, which the zones do not tell")
    _check_mirrors(cls)


def _check_mirrors(cls: type[Declared]) -> None:
    """A guard told to be mirrored has a mirror that differs from it, under a name of its own."""
    zones, members = cls.declaration.zones, _members(cls)
    for name, mark in cls.declaration.guards.items():
        if mark.direction != +1:
            continue
        pairs = 'Pair them: Zones(..., forward=["ahead"], backward=["astern"])'
        moved = (zones.mirrored(mark.to), *map(zones.mirrored, mark.zones)) != (mark.to, *mark.zones)
        _demand(cls, moved, f"guard {name!r} is mirrored, and its zones are their own mirror images. {pairs}")
        taken = mark.mirrored in members
        _demand(cls, not taken, f"guard {name!r} makes its mirror {mark.mirrored!r}, a name the class has already")
        known = "direction" not in cls.declaration.inputs
        _demand(cls, known, f"guard {name!r} is mirrored by `direction`, which is an input here; rename the input")
        asks = "direction" in arguments_of(mark.function)
        more = f"def {name}(p, ..., direction), +1 as written and -1 in its mirror"
        _demand(cls, asks, f"guard {name!r} is mirrored, and does not ask for the direction: {more}")


def _check_units(cls: type[Declared]) -> None:
    """Every unit means something."""
    has = cls.declaration
    for what in odd_kinds(has):
        _demand(cls, False, what)
    for name, mark in has.guards.items():
        _check_unit(cls, f"guard {name!r}", mark.unit)
    kinds = (has.parameters, has.inputs, has.outputs, has.states, has.unknowns, has.discrete)
    declared = [pair for kind in kinds for pair in kind.items()]
    declared += [pair for _, one in declared if isinstance(one, Block) for pair in one.parameters.items()]
    for name, one in declared:
        units = (one.x, one.y) if isinstance(one, Table) else (getattr(one, "unit", "1"),)
        for unit in units:
            _check_unit(cls, repr(name), unit)


def _check_unit(cls: type[Declared], name: str, unit: str) -> None:
    try:
        parse_unit(unit)
    except QuantityError as error:
        _demand(cls, False, f"{name}: {error.what}. {error.allowed} Units are written as N/m, kg*m^2 or 1/s")


def _check_named_numbers(cls: type[Declared]) -> None:
    """Names of parameters; and starts and defaults that are given by such a name."""
    has = cls.declaration
    known = {*has.parameters, *has.derived, *has.effects} - ({"effects"} if has.effects else set())
    for name in RESERVED & known:
        _demand(cls, False, f"a parameter cannot be called {name!r}; p.{name} has a meaning of its own")
    starting: dict[str, State | Discrete] = {**has.states, **has.discrete}
    for name, one in starting.items():
        named = not isinstance(one.start, str) or one.start in known
        _demand(cls, named, f"{name!r} starts at {one.start!r}, which is no parameter")
    for name, state in has.states.items():
        named = not isinstance(state.nominal, str) or state.nominal in known
        _demand(cls, named, f"{name!r} has the size {state.nominal!r}, which is no parameter")
    for name, read in has.inputs.items():
        named = not isinstance(read.default, str) or read.default in known
        _demand(cls, named, f"{name!r} is {read.default!r} when nothing is connected, which is no parameter")


def _check_fixed(cls: type[Declared]) -> None:
    """What a class of a user's says once and for all: its defaults, and which motions it gives."""
    if is_bundled(cls):
        return  # the tests ask those
    for what in misfits(cls.declaration):
        _demand(cls, False, what)
    if cls.answers.prescribes is not None:
        try:
            cls.answers.prescribes()
        except AnswerError as error:
            raise DeclarationError(" ".join(f"{fault.what} {fault.way_out}" for fault in error.faults)) from error


def _check_limits(cls: type[Declared]) -> None:
    """A limiting model can stand where the class stands, with what the class was given."""
    has = cls.declaration
    for name, effect in has.effects.items():
        if effect.off is None:
            continue
        other: Declaration = effect.off.declaration  # type: ignore[attr-defined]
        for kind in ("ports", "inputs", "outputs"):
            mine, its = set(getattr(has, kind)), set(getattr(other, kind))
            what = f"{name!r} off is {effect.off.__name__}, whose {kind} differ: {sorted(mine ^ its)}"
            _demand(cls, mine == its, what)
        more = {*other.parameters, *other.effects} - {*has.parameters, *has.effects}
        _demand(cls, not more, f"{name!r} off is {effect.off.__name__}, which wants {sorted(more)} besides")


def _check_arguments(cls: type, function: Callable[..., Any], allowed: Iterable[str]) -> None:
    for argument in arguments_of(function):
        _demand(cls, argument in allowed, f"{function.__name__} asks for {argument!r}; known: {sorted(allowed)}")


def _demand(cls: type, holds: bool, what: str) -> None:
    if not holds:
        raise DeclarationError(f"{source_place(cls)}: {cls.__name__}: {what}")


def source_place(thing: Any) -> str:
    """file:line of a class or function, or its name when there is no source."""
    try:
        thing = inspect.unwrap(thing)
        return f"{inspect.getsourcefile(thing)}:{inspect.getsourcelines(thing)[1]}"
    except (OSError, TypeError):
        return str(getattr(thing, "__qualname__", thing))


def terms_of(cls: type[Declared], said: Any) -> dict[str, Any]:
    """A law's answer by name; a bare value or tuple gives the flows of the ports in their order."""
    if isinstance(said, Law):
        terms = dict(said.terms)
    else:
        flows = said if isinstance(said, tuple) else (said,)
        ports = list(cls.declaration.ports)
        if said is None or isinstance(said, list | Mapping | str):
            gave = "None" if said is None else f"a {type(said).__name__}"
            by_name = ", ".join(f"{port}=..." for port in ports)
            what = f"the law returns {gave}; it returns what {', '.join(ports) or 'its ports'} take in"
            raise DeclarationError(f"{what}, in a tuple or as Law({by_name})")
        if len(flows) != len(ports):
            raise DeclarationError(f"the law returns {len(flows)} flows for {len(ports)} ports {ports}")
        terms = dict(zip(ports, flows, strict=True))
    has = cls.declaration
    known = {*has.ports, *has.states, *has.unknowns, *has.outputs, *LEDGER}
    unknown = set(terms) - known
    missing = {*has.ports, *has.states, *has.unknowns} - set(terms) - _passive(cls)
    if any(isinstance(term, HoldPosition) for term in terms.values()):  # it puts its force on its ports itself
        missing -= set(has.ports)
    if unknown:
        near = " ".join(filter(None, (did_you_mean(name, known) for name in sorted(unknown))))
        left = f" and leaves out {sorted(missing)}" if missing else ""
        raise DeclarationError(f"the law gives {sorted(unknown)} unasked{left}. {near}".rstrip())
    if missing:
        raise DeclarationError(f"the law leaves out {', '.join(_wanted(has, name) for name in sorted(missing))}")
    return terms


def _wanted(has: Declaration, name: str) -> str:
    """What a law has to give for a name, as it is written."""
    if name in has.states:
        return f"the rate of the state {name}: Law(..., {name}=...) in {has.states[name].unit}/s"
    if name in has.unknowns:
        return f"what must be zero for the unknown {name}: Law(..., {name}=...)"
    return f"what the port {name} takes in: Law(..., {name}=...)"


def _passive(cls: type[Declared]) -> set[str]:
    """Ports whose flow is settled elsewhere: prescribed motion takes whatever comes, ties pass it on.

    A controller in plain Python only looks at its ports.
    """
    answers, has = cls.answers, cls.declaration
    settled = set(answers.prescribes()) if answers.prescribes is not None else set()
    return settled | (set(has.ports) if answers.ties is not None or has.python else set())
