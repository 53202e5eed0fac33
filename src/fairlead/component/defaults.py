"""What a class declares for when nothing is given must be what a netlist might have given.

A default of the wrong kind would be told as a mistake of the netlist, in which it does not stand.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from numbers import Real
from typing import Any

from fairlead.component.declaration import Declaration
from fairlead.component.declare import Discrete, State
from fairlead.component.given import (
    REQUIRED,
    Block,
    Choice,
    Count,
    Effect,
    Name,
    Parameter,
    Part,
    Stations,
    Table,
    Waveform,
)  # fmt: skip
from fairlead.errors import did_you_mean
from fairlead.quantities import QuantityError, article, si

NEVER_PASSED = ("p", "t", "zone", "direction")
"""What a law may ask for by these names is something else."""


def odd_kinds(has: Declaration) -> Iterator[str]:
    """Declarations made of something else than what they take, before anybody looks into them."""
    kinds = (has.parameters, has.inputs, has.outputs, has.states, has.unknowns, has.discrete)
    for name, one in (pair for kind in kinds for pair in kind.items()):
        units = (one.x, one.y) if isinstance(one, Table) else (getattr(one, "unit", "1"),)
        if not all(isinstance(unit, str) for unit in units):
            yield f"{name!r} has the unit {units[0]!r}; a unit is a text such as 'N/m'"
        if isinstance(one, Choice) and not _words(one.options):
            yield f"{name!r} has the options {one.options!r}; they are a tuple of texts such as ('on', 'off')"
        if isinstance(one, Part | Stations) and not hasattr(one.family, "members"):
            yield f"{name!r} is a part of {one.family!r}, which is no family such as Curve"
        if isinstance(one, Block) and not isinstance(one.parameters, Mapping):
            yield f"{name!r} is a block of {one.parameters!r}; it is a map of names to Parameter(...)"
    for name, effect in has.effects.items():
        if effect.off is not None and not hasattr(effect.off, "declaration"):
            yield f"{name!r} off is {effect.off!r}; it is a class with the same ports"


def _words(options: Any) -> bool:
    return isinstance(options, tuple) and bool(options) and all(isinstance(one, str) for one in options)


def misfits(has: Declaration) -> Iterator[str]:
    """Defaults of the wrong kind, ranges that hold nothing, and names that mean something else."""
    yield from _of(has.parameters)
    for kind, named in (("port", has.ports), ("input", has.inputs), ("state", has.states), ("unknown", has.unknowns),
                        ("discrete variable", has.discrete), ("shared expression", has.shared),
                        ("parameter", has.parameters)):  # fmt: skip
        for name in NEVER_PASSED[: 2 if kind == "parameter" else None]:
            if name in named:
                meant = {"p": "the parameters", "t": "time", "zone": "the zone", "direction": "that of the zone"}[name]
                yield f"{article(kind)} cannot be called {name!r}; in a law that is {meant}"
    for name, one in has.inputs.items():
        if not isinstance(one.default, str | None) and not _number(one.default):
            yield f"{name!r} is {one.default!r} when nothing is connected; write a number, or the name of a parameter"
    starting: dict[str, State | Discrete] = {**has.states, **has.discrete}
    for name, kept in has.states.items():
        if isinstance(kept.nominal, int | float) and not kept.nominal > 0:
            yield f"{name!r} has the size {kept.nominal:g}; a size is above zero"
        if isinstance(kept.least, int | float) and isinstance(kept.start, int | float) and kept.start < kept.least:
            yield f"{name!r} starts at {kept.start:g}, below its least, {kept.least:g}"
    for name, state in starting.items():
        if not isinstance(state.start, str) and not _number(state.start):
            yield f"{name!r} starts at {state.start!r}; write a number, or the name of a parameter"


def _of(parameters: Mapping[str, Any]) -> Iterator[str]:
    for name, one in parameters.items():
        if isinstance(one, Block):
            yield from _of(one.parameters)
        default = getattr(one, "default", REQUIRED)
        if isinstance(one, Parameter):
            yield from _range(name, one)
        if default is not REQUIRED and default is not None and (wrong := _wrong(one, default)):
            yield f"the default of {name!r} is {default!r}; {wrong}"


def _range(name: str, one: Parameter) -> Iterator[str]:
    bounds = {word: getattr(one, word) for word in ("above", "least", "below", "most")}
    for word, bound in bounds.items():
        if bound is not None and not _number(bound):
            yield f"{name!r}: {word} is {bound!r}; a bound is a number in SI"
            return
    low = max((b for b in (one.above, one.least) if b is not None), default=None)
    high = min((b for b in (one.below, one.most) if b is not None), default=None)
    if low is not None and high is not None and low > high:
        yield f"{name!r} is to be above {low:g} and below {high:g}, which no number is"


def _wrong(one: Any, default: Any) -> str:
    if isinstance(one, Parameter):
        return _wrong_number(one, default)
    if isinstance(one, Effect | Choice):
        words = ", ".join(one.options)
        near = did_you_mean(str(default), one.options)
        return "" if default in one.options else f"the options are {words}. {near}".rstrip(" .")
    if isinstance(one, Count):
        fits = isinstance(default, int) and not isinstance(default, bool) and one.least <= default <= one.most
        return "" if fits else f"a count is a whole number from {one.least} to {one.most}"
    if isinstance(one, Name):
        return "" if isinstance(default, str) else "a name is a text"
    if isinstance(one, Waveform) and not isinstance(default, Mapping):
        return _wrong_number(Parameter(one.unit), default)
    if isinstance(one, Table):
        return "" if isinstance(default, Mapping | list | tuple) else "a table is a list of [x, y] pairs, or a map"
    return ""


def _wrong_number(one: Parameter, default: Any) -> str:
    try:
        value = si(default, one.unit)
    except QuantityError as error:
        return f"{error.what}. {error.allowed}".rstrip(" .")
    outside = (
        (one.above is not None and value <= one.above) or (one.least is not None and value < one.least)
        or (one.below is not None and value >= one.below) or (one.most is not None and value > one.most)
    )  # fmt: skip
    words = {"above": one.above, "at least": one.least, "below": one.below, "at most": one.most}
    allowed = " and ".join(f"{word} {bound:g}" for word, bound in words.items() if bound is not None)
    return f"that is outside of its own range, {allowed}" if outside else ""


def _number(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)
