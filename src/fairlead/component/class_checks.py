"""What is checked when a class is created: names, signatures, units and targets; its physics is the contract suite's.

A mistake is a DeclarationError with file and line of the class.
"""

from __future__ import annotations

import dis
import inspect
from collections.abc import Callable, Iterable
from typing import Any, ClassVar, Protocol

from fairlead.component.answers import COMPOSITE, EVERYWHERE, Answers
from fairlead.component.declaration import Declaration
from fairlead.component.declare import ROLES, USED_UP, Carries, Discrete, Output, State, ZoneLaw, Zones
from fairlead.component.defaults import misfits, odd_kinds
from fairlead.component.given import Block, Table
from fairlead.component.kinds_of_answers import arguments_of
from fairlead.component.replies import AnswerError, is_bundled
from fairlead.quantities import QuantityError, parse_unit

RESERVED = {"type", "given", "variant", "path", "effects"}  # attributes of `values.Values` that would hide a parameter


class Declaring(Protocol):
    """A class with declarations and answers, which base.py collects."""

    declaration: ClassVar[Declaration]
    answers: ClassVar[Answers]


class DeclarationError(TypeError):
    """A class that contradicts itself; raised when it is created, with its file and line."""


def members_of(cls: type) -> dict[str, Any]:
    """What the bodies of a class and of all its bases hold, by name."""
    members: dict[str, Any] = {}
    for base in reversed(cls.__mro__[:-1]):
        members.update(base.__dict__)
    return members


def source_place(thing: Any) -> str:
    """file:line of a class or function, or its name when there is no source."""
    try:
        thing = inspect.unwrap(thing)
        return f"{inspect.getsourcefile(thing)}:{inspect.findsource(thing)[1] + 1}"  # where its lines end takes long
    except (OSError, TypeError):
        return str(getattr(thing, "__qualname__", thing))


def demand(cls: type, holds: bool, what: str) -> None:
    """Raise DeclarationError with what is wrong with a class unless something holds."""
    if not holds:
        raise DeclarationError(f"{source_place(cls)}: {cls.__name__}: {what}")


def check(cls: type[Declaring], sort: str) -> None:
    """Names, signatures and targets; the physics is the contract suite's business."""
    has = cls.declaration
    _check_units(cls)
    for name, output in has.outputs.items():
        known = output.role in ("", *ROLES)
        demand(cls, known, f"{name!r} has the role {output.role!r}; roles are {', '.join(ROLES)}")
        known = output.of in ("", *has.outputs)
        demand(cls, known, f"{name!r} is of {output.of!r}, which is no output of the class")
        known = output.rounded_by in ("", *has.parameters)
        demand(cls, known, f"{name!r} is rounded by {output.rounded_by!r}, which is no parameter of the class")
        _check_words(cls, name, output)
        clash = name in {**has.ports, **has.states, **has.unknowns, **has.inputs, **has.discrete}
        demand(cls, not clash, f"the output {name!r} has the name of a port, an input or an unknown of the class")
    _check_named_numbers(cls)
    _check_likes(cls)
    _check_limits(cls)
    if sort == COMPOSITE:
        demand(cls, cls.answers.expand is not None, "a Composite needs an expand(p) method")
        return
    if sort == EVERYWHERE:  # a part of laws
        return
    _check_once(cls)
    _check_directions(cls)
    for name in has.zones:
        demand(cls, name in has.laws, f"zone {name!r} has no law")
    if has.carries is not None:
        ports = {has.carries.node, has.carries.by}
        demand(cls, ports <= set(has.ports), f"carries names {sorted(ports)}, and the ports are {sorted(has.ports)}")
        demand(cls, has.carries.zone in has.zones, f"carries names the zone {has.carries.zone!r}, which there is not")
    for expression in has.shared.values():
        _check_arguments(cls, expression.function, has.given)
    for name, law in has.laws.items():
        demand(cls, name in has.zones, f"a law is declared for {name!r}, which is not in zones {has.zones}")
        _check_arguments(cls, law, has.arguments)
    demand(cls, len(has.samples) <= 1, f"several sampled laws: {sorted(has.samples)}; one gives all discrete variables")
    demand(cls, bool(has.samples) or not has.discrete, f"no sampled law gives {sorted(has.discrete)}")
    for name, sample in has.samples.items():
        demand(
            cls, sample.period in has.parameters, f"{name!r} is sampled every {sample.period!r}, which is no parameter"
        )
        _check_arguments(cls, sample.law, has.arguments)
    for name, mark in has.guards.items():
        for zone in (*mark.zones, mark.to):
            demand(cls, zone in has.zones, f"guard {name!r} names {zone!r}, which is not in zones {has.zones}")
        demand(cls, mark.to not in mark.zones, f"guard {name!r} leads from {mark.to!r} to itself")
        _check_arguments(cls, mark.function, has.arguments)
        if not gives_something(mark.function):
            place = source_place(mark.function)
            raise DeclarationError(f"{place}: {cls.__name__}: the guard {name!r} gives nothing; does it lack a return?")


def _check_once(cls: type[Declaring]) -> None:
    """What can be there once only is not there twice: the last would count, and nobody be told."""
    members = members_of(cls)
    for kind in (Zones, Carries):
        twice = [name for name, one in members.items() if isinstance(one, kind)]
        demand(cls, len(twice) < 2, f"{' and '.join(twice)} are {kind.__name__} both, and a class has one")
    zones = cls.declaration.zones
    same = sorted({name for name in zones if zones.count(name) > 1})
    demand(cls, not same, f"there are two zones {', '.join(map(repr, same))}; each zone has a name of its own")
    laws: dict[str, str] = {}
    for name, law in members.items():
        for zone in law.zones if isinstance(law, ZoneLaw) else ():
            other = laws.setdefault(zone, name)
            said = f"zone {zone!r} has two laws, {other} and {name}; to replace one of a base class, name it {other}"
            demand(cls, other == name, said)
    nearest = next((base for base in cls.__mro__ if "law" in vars(base) or _has_zones(base)), cls)  # may replace others
    said = "there are zones, and `law` is for a class without zones; mark it with @zone, or leave it out"
    demand(cls, not (inspect.isfunction(vars(nearest).get("law")) and any(map(_has_zones, cls.__mro__))), said)


def _has_zones(cls: type) -> bool:
    return any(isinstance(one, Zones) for one in vars(cls).values())


def gives_something(function: Callable[..., Any]) -> bool:
    """False for a function that can only end without a `return VALUE`."""
    before: dis.Instruction | None = None
    for step in dis.get_instructions(inspect.unwrap(function)):
        if step.opname == "RETURN_CONST" and step.argval is not None:
            return True
        nothing = before is not None and before.opname == "LOAD_CONST" and before.argval is None
        if step.opname == "RETURN_VALUE" and not nothing:
            return True
        before = step
    return False


def _check_directions(cls: type[Declaring]) -> None:
    """Zones that mirror one another are told in pairs, wherever a law or a guard asks for the direction."""
    zones = cls.declaration.zones
    for name in (*zones.forward, *zones.backward, *zones.latched):
        demand(cls, name in zones, f"zones tell the direction of {name!r}, which is none of them")
    pairs = f"forward={list(zones.forward)}, backward={list(zones.backward)}"
    demand(cls, len(zones.forward) == len(zones.backward), f"{pairs} are not pairs of zones that mirror one another")
    asking = [(function, name) for name, function in cls.declaration.laws.items()]
    one_sided = [mark for mark in cls.declaration.guards.values() if not mark.direction]
    asking += [(mark.function, name) for mark in one_sided for name in mark.zones]
    for function, name in asking if "direction" not in cls.declaration.inputs else ():
        told = zones.direction(name) != 0 or "direction" not in arguments_of(function)
        demand(cls, told, f"{function.__name__} asks for the direction of {name!r}, which the zones do not tell")
    _check_mirrors(cls)


def _check_mirrors(cls: type[Declaring]) -> None:
    """A guard told to be mirrored has a mirror that differs from it, under a name of its own."""
    zones, members = cls.declaration.zones, members_of(cls)
    for name, mark in cls.declaration.guards.items():
        if mark.direction != +1:
            continue
        pairs = 'Pair them: Zones(..., forward=["ahead"], backward=["astern"])'
        moved = (zones.mirrored(mark.to), *map(zones.mirrored, mark.zones)) != (mark.to, *mark.zones)
        demand(cls, moved, f"guard {name!r} is mirrored, and its zones are their own mirror images. {pairs}")
        taken = mark.mirrored in members
        demand(cls, not taken, f"guard {name!r} makes its mirror {mark.mirrored!r}, a name the class has already")
        known = "direction" not in cls.declaration.inputs
        demand(cls, known, f"guard {name!r} is mirrored by `direction`, which is an input here; rename the input")
        asks = "direction" in arguments_of(mark.function)
        more = f"def {name}(p, ..., direction), +1 as written and -1 in its mirror"
        demand(cls, asks, f"guard {name!r} is mirrored, and does not ask for the direction: {more}")


def _check_words(cls: type[Declaring], name: str, output: Output) -> None:
    """What an output says where nothing is left, and what it is before the first sample."""
    fits = output.gone is None or output.role == USED_UP
    demand(cls, fits, f"{name!r} has `gone`, which an output of role {USED_UP} says")
    begins = isinstance(output.start, int | float) or output.start in cls.declaration.parameters
    demand(cls, begins, f"{name!r} starts with {output.start!r}: neither a number nor a parameter of the class")
    sampled = output.start == 0.0 or cls.answers.sample is not None
    demand(cls, sampled, f"{name!r} has a start; its law gives it from the start on, so only a Controller has one")


def _check_units(cls: type[Declaring]) -> None:
    """Every unit means something."""
    has = cls.declaration
    for what in odd_kinds(has):
        demand(cls, False, what)
    for name, mark in has.guards.items():
        _check_unit(cls, f"guard {name!r}", mark.unit)
    kinds = (has.parameters, has.inputs, has.outputs, has.states, has.unknowns, has.discrete)
    declared = [pair for kind in kinds for pair in kind.items()]
    declared += [pair for _, one in declared if isinstance(one, Block) for pair in one.parameters.items()]
    for name, one in declared:
        units = (one.x, one.y) if isinstance(one, Table) else (getattr(one, "unit", "1"),)
        for unit in units:
            _check_unit(cls, repr(name), unit)


def _check_unit(cls: type[Declaring], name: str, unit: str) -> None:
    try:
        parse_unit(unit)
    except QuantityError as error:
        demand(cls, False, f"{name}: {error.what}. {error.allowed} Units are written as N/m, kg*m^2 or 1/s")


def _check_named_numbers(cls: type[Declaring]) -> None:
    """Names of parameters; and starts and defaults that are given by such a name."""
    has = cls.declaration
    known = {*has.parameters, *has.derived, *has.effects} - ({"effects"} if has.effects else set())
    for name in RESERVED & known:
        demand(cls, False, f"a parameter cannot be called {name!r}; p.{name} has a meaning of its own")
    starting: dict[str, State | Discrete] = {**has.states, **has.discrete}
    for name, one in starting.items():
        named = not isinstance(one.start, str) or one.start in known
        demand(cls, named, f"{name!r} starts at {one.start!r}, which is no parameter")
    for name, state in has.states.items():
        named = not isinstance(state.nominal, str) or state.nominal in known
        demand(cls, named, f"{name!r} has the size {state.nominal!r}, which is no parameter")
    for name, read in has.inputs.items():
        named = not isinstance(read.default, str) or read.default in known
        demand(cls, named, f"{name!r} is {read.default!r} when nothing is connected, which is no parameter")


def _check_likes(cls: type[Declaring]) -> None:
    """What is like an input names one, and is a plain number as that is."""
    has = cls.declaration
    for name, one in {**has.parameters, **has.outputs}.items():
        if like := getattr(one, "like", ""):
            known = has.inputs.get(like)
            demand(cls, known is not None, f"{name!r} is like {like!r}, which is no input of the class")
            plain = known is not None and known.unit == one.unit == "1"
            demand(cls, plain, f"{name!r} is like {like!r}, and both must be declared as plain numbers, in 1")


def check_fixed(cls: type[Declaring]) -> None:
    """What a class of a user's says once and for all: its defaults, and which motions it gives."""
    if is_bundled(cls):
        return  # the tests ask those
    for what in misfits(cls.declaration):
        demand(cls, False, what)
    if cls.answers.prescribes is not None:
        try:
            cls.answers.prescribes()
        except AnswerError as error:
            raise DeclarationError(" ".join(f"{fault.what} {fault.way_out}" for fault in error.faults)) from error


def _check_limits(cls: type[Declaring]) -> None:
    """A limiting model can stand where the class stands, with what the class was given."""
    has = cls.declaration
    for name, effect in has.effects.items():
        if effect.off is None:
            continue
        other: Declaration = effect.off.declaration  # type: ignore[attr-defined]
        for kind in ("ports", "inputs", "outputs"):
            mine, its = set(getattr(has, kind)), set(getattr(other, kind))
            what = f"{name!r} off is {effect.off.__name__}, whose {kind} differ: {sorted(mine ^ its)}"
            demand(cls, mine == its, what)
        more = {*other.parameters, *other.effects} - {*has.parameters, *has.effects}
        demand(cls, not more, f"{name!r} off is {effect.off.__name__}, which wants {sorted(more)} besides")


def _check_arguments(cls: type, function: Callable[..., Any], allowed: Iterable[str]) -> None:
    for argument in arguments_of(function):
        demand(cls, argument in allowed, f"{function.__name__} asks for {argument!r}; known: {sorted(allowed)}")
