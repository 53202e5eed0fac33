"""What an answer of a class must be: the kinds of answers, each with what is wrong with one that is not of it."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from fairlead.component.declaration import Declaration
from fairlead.component.given import Choice, Waveform

DECLARED_IN = ("fairlead.component.declare", "fairlead.component.given")
STARS = inspect.CO_VARARGS | inspect.CO_VARKEYWORDS
BUDGETS = ("max_steps", "max_events")


@dataclass(frozen=True)
class Kind:
    """What an answer must be."""

    said: str
    """As docs/components.md has it; of a method its arguments."""
    wrong: Callable[[Any, Declaration], str]
    """Given an answer and what its class declares: what is wrong with it, "" for nothing."""
    method: bool = False


def arguments_of(function: Callable[..., Any]) -> tuple[str, ...]:
    """Names of what a function takes; `inspect.signature` is asked where its code does not say so outright."""
    plain = _plain_arguments(function)
    return tuple(inspect.signature(function).parameters) if plain is None else plain


def _plain_arguments(function: Callable[..., Any]) -> tuple[str, ...] | None:
    """The arguments of a function without stars, without arguments by keyword alone, and without a wrapper."""
    code = getattr(function, "__code__", None)
    if code is None or code.co_flags & STARS or code.co_kwonlyargcount or inspect.ismethod(function):
        return None
    if hasattr(function, "__wrapped__") or hasattr(function, "__signature__"):
        return None
    return tuple(code.co_varnames[: code.co_argcount])


def method(*arguments: str) -> Kind:
    """A method that is called with these arguments, in their order."""
    takes = f"({', '.join(arguments)})"

    def wrong(value: Any, has: Declaration) -> str:
        if not inspect.isfunction(value):
            return f"is {as_shown(value)}, and a method {takes} is asked for"
        if len(_plain_arguments(value) or ()) == len(arguments) and not value.__defaults__:
            return ""
        try:
            inspect.signature(value).bind(*arguments)
        except TypeError:
            return f"takes {inspect.signature(value)}, and is called with {takes}"
        return ""

    return Kind(takes, wrong, method=True)


def _law(value: Any, has: Declaration) -> str:
    if not inspect.isfunction(value):
        return f"is {as_shown(value)}, and a law is asked for"
    unknown = sorted(set(arguments_of(value)) - has.arguments)
    return f"asks for {', '.join(map(repr, unknown))}; known: {sorted(has.arguments)}" if unknown else ""


def _sample(value: Any, has: Declaration) -> str:
    return "" if inspect.isfunction(value) else f"is {as_shown(value)}, and a method is asked for"


def _yes_or_no(value: Any, has: Declaration) -> str:
    return "" if isinstance(value, bool) else f"is {as_shown(value)}; it is True or False"


def _sentence(value: Any, has: Declaration) -> str:
    return "" if isinstance(value, str) else f"is {as_shown(value)}; it is a sentence"


def _input(value: Any, has: Declaration) -> str:
    return "" if value in has.inputs else f"is {as_shown(value)}; the inputs are {sorted(has.inputs)}"


def _parameter(value: Any, has: Declaration) -> str:
    known = {*has.parameters, *has.derived}
    return "" if value in known or value == "" else f"is {as_shown(value)}; the parameters are {sorted(known)}"


def _unknown(value: Any, has: Declaration) -> str:
    return "" if value in has.unknowns else f"is {as_shown(value)}; the unknowns are {sorted(has.unknowns)}"


def _wave(value: Any, has: Declaration) -> str:
    waves = {name for name, one in has.parameters.items() if isinstance(one, Waveform)}
    waves |= {name for name, one in has.derived.items() if one.wave}
    return "" if value in waves or value == "" else f"is {as_shown(value)}; the quantities in time are {sorted(waves)}"


def _two_inputs(value: Any, has: Declaration) -> str:
    if not isinstance(value, tuple) or len(value) != 2:
        return f"is {as_shown(value)}; it names two inputs"
    return next((said for each in value if (said := _input(each, has))), "")


def _two_ports(value: Any, has: Declaration) -> str:
    fits = isinstance(value, tuple) and len(value) == 2 and set(value) <= set(has.ports)
    return "" if fits else f"is {as_shown(value)}; it names two ports of {sorted(has.ports)}"


def _parameters(value: Any, has: Declaration) -> str:
    fits = isinstance(value, tuple) and set(value) <= {*has.parameters}
    return "" if fits else f"is {as_shown(value)}; it names parameters of {sorted(has.parameters)}"


def _zones(value: Any, has: Declaration) -> str:
    fits = isinstance(value, tuple) and set(value) <= set(has.zones)
    return "" if fits else f"is {as_shown(value)}; it names zones of {sorted(has.zones)}"


def _saturation(value: Any, has: Declaration) -> str:
    if not isinstance(value, dict):
        return _zones(value, has)
    if not set(value) <= set(has.inputs):
        return f"is {as_shown(value)}; it names inputs of {sorted(has.inputs)}"
    return next((said for zones in value.values() if (said := _zones(zones, has))), "")


def _budget(value: Any, has: Declaration) -> str:
    fits = isinstance(value, dict) and all(key in BUDGETS and isinstance(n, int) for key, n in value.items())
    return "" if fits else f"is {value!r}; it gives whole numbers for {' and '.join(BUDGETS)}"


def _share(value: Any, has: Declaration) -> str:
    fits = isinstance(value, int | float) and not isinstance(value, bool) and 0 < value <= 1
    return "" if fits else f"is {as_shown(value)}; it is a number above 0 and at most 1"


def _options(value: Any, has: Declaration) -> str:
    choice = has.parameters.get(value[0]) if isinstance(value, tuple) and len(value) == 3 else None
    fits = isinstance(choice, Choice) and {*value[1:]} <= {*choice.options}
    return "" if fits else f"is {as_shown(value)}; it names a choice and two of its options"


def _map(value: Any, has: Declaration) -> str:
    fits = isinstance(value, dict) and all(isinstance(key, str) for key in value)
    return "" if fits else f"is {as_shown(value)}; it is a map with names"


def _given(value: Any, has: Declaration) -> str:
    if wrong := _map(value, has):
        return wrong
    known = {*has.parameters, *has.effects}
    strange = [name for name in value if name not in known]
    return f"gives {strange[0]!r}; the parameters are {sorted(known)}" if strange else ""


LAW = Kind("as a law", _law, method=True)
SAMPLE = Kind("with self, t and what it reads", _sample, method=True)
YES_OR_NO, SENTENCE, MAP = Kind("True or False", _yes_or_no), Kind("a sentence", _sentence), Kind("a map", _map)
GIVEN = Kind("a map", _given)
INPUT, TWO_INPUTS = Kind("an input", _input), Kind("two inputs", _two_inputs)
UNKNOWN = Kind("an unknown", _unknown)
WAVE = Kind("a parameter", _wave)
TWO_PORTS = Kind("two ports", _two_ports)
PARAMETERS = Kind("parameters", _parameters)
SATURATION = Kind("zones, or a map of zones by input", _saturation)
PARAMETER, BUDGET = Kind("a parameter", _parameter), Kind("a map of numbers", _budget)
SHARE = Kind("a share", _share)
TWO_OPTIONS = Kind("a choice and two of its options", _options)


def is_plain(value: Any) -> bool:
    """True but for declarations, which say themselves what they are, so that a parameter may be called `start`."""
    return type(value).__module__ not in DECLARED_IN


def as_shown(value: Any) -> str:
    """A value as messages have it."""
    if inspect.isfunction(value):
        return "a method"
    return repr(value) if is_plain(value) else f"a {type(value).__name__}"
