"""The `p` of a law with plain numbers in it: parameters of one instance, in SI.

The same attribute names work on the symbolic `p` of `trace.py`, so a law, a derived number and an
inertia are written the same way.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from numbers import Real
from typing import Any

from fairlead.component.base import Declared
from fairlead.component.replies import AnswerError, asked, helper, is_bundled, place_of
from fairlead.component.wave import Wave, polynomial, steady
from fairlead.errors import Fault

__all__ = ["Group", "Values", "Variant", "Wave", "input_given", "number_given", "parameter", "polynomial", "steady",
           "variant_of"]  # fmt: skip


class Values:
    """Attribute access to the parameters of an instance of `type`; derived numbers on demand."""

    def __init__(self, type: type[Declared], given: Mapping[str, Any]) -> None:
        """`given` holds SI floats, words, nested maps, Values of parts, tables and waves, by name."""
        self.type = type
        self.variant: Variant | None = None
        self.effects: dict[str, str] = {}  # what is on and off, also when a limiting model has taken its place
        self.given = {name: Group(value) if isinstance(value, Mapping) else value for name, value in given.items()}

    def __getattr__(self, name: str) -> Any:
        """A parameter, a derived number (computed once) or, for a part, one of its functions."""
        given = object.__getattribute__(self, "given")
        if name in given:
            return given[name]
        declared = object.__getattribute__(self, "type")
        if name in declared.declaration.derived:
            given[name] = _derived(self, declared, name)
            return given[name]
        function = getattr(declared, name, None)
        if callable(function):
            return helper(declared, name, function, self)
        raise AttributeError(f"{declared.__name__} has no parameter {name!r}")

    def path(self, dotted: str) -> Any:
        """A nested value by its path, such as `curve.stiction`."""
        return functools.reduce(getattr, dotted.split("."), self)

    def __repr__(self) -> str:
        """Type and what was given."""
        return f"{self.type.__name__}({', '.join(f'{k}={v!r}' for k, v in self.given.items())})"


def _derived(values: Values, kind: type[Declared], name: str) -> Any:
    """What a method marked as derived gives. Raises AnswerError for one of a user's that gives no number."""
    one = kind.declaration.derived[name]
    if is_bundled(kind):
        return one.function(values)
    said = asked(kind, name, one.function, values)
    if said is not None and not (isinstance(said, Wave) if one.wave else isinstance(said, Real)):
        what = f"{place_of(one.function)}: {kind.__name__}.{name} gives {said!r}."
        wanted = "a quantity in time (a Wave)" if one.wave else "a number"
        raise AnswerError([Fault(None, what, f"What is derived from parameters is {wanted}.")])
    if isinstance(said, Wave) and said.swings and not _given_swings(values):
        what = f"{place_of(one.function)}: {kind.__name__}.{name} gives sines whose amplitudes change."
        raise AnswerError([Fault(None, what, "Make them from a parameter declared as Waveform that has such.")])
    return said


def number_given(values: Values, said: str | float) -> float:
    """A number that a declaration gives itself or by the name of a parameter."""
    return float(getattr(values, said) if isinstance(said, str) else said)


def input_given(values: Values, default: str | float | None) -> float | None:
    """What an input is that nothing is joined to; None where it must be joined."""
    if default is None or (isinstance(default, str) and getattr(values, default) is None):
        return None
    return number_given(values, default)


def parameter(values: Values, key: str) -> float:
    """What a kernel reads under a key: `curve.stiction`, `velocity:omega` (of a sine), `#count` (a discrete start)."""
    if key.startswith("#"):
        return number_given(values, values.type.declaration.discrete[key[1:]].start)
    path, _, of_sine = key.partition(":")
    value = values.path(path)
    return float(getattr(value.sine, of_sine) if of_sine else value)


class Group:
    """A nested map of parameters, read by attribute."""

    def __init__(self, given: Mapping[str, Any]) -> None:
        self.__dict__.update(given)

    def __repr__(self) -> str:
        return repr(self.__dict__)


@dataclass(frozen=True)
class Variant:
    """What decides the code of a kernel: the class, its words, its parts, and what is absent.

    Scene numbers are not in it, so a new netlist of known classes compiles nothing.
    """

    type: type[Declared]
    words: tuple[tuple[str, str], ...]
    parts: tuple[tuple[str, Variant], ...]
    absent: tuple[str, ...]
    swings: tuple[tuple[str, int], ...] = ()
    """Quantities in time with sines whose amplitudes change, and how many of them each has."""

    @property
    def label(self) -> str:
        """Class name with its words and parts, for listings: `Hold[Stribeck]`; a switch says what it is when off."""
        words = [f"{name} off" if word == "off" else word for name, word in self.words if word != "on"]
        inside = words + [part.label for _, part in self.parts]
        return self.type.__name__ + (f"[{', '.join(inside)}]" if inside else "")


def variant_of(values: Values) -> Variant:
    """The variant that an instance with these values belongs to."""
    if values.variant is None:
        values.variant = _variant(values)
    return values.variant


def _variant(values: Values) -> Variant:
    given = values.given
    return Variant(
        values.type,
        tuple((name, value) for name, value in given.items() if isinstance(value, str)),
        tuple((name, variant_of(value)) for name, value in given.items() if isinstance(value, Values)),
        tuple(name for name, value in given.items() if value is None),
        tuple(_swings(values)),
    )


def _swings(values: Values) -> Iterator[tuple[str, int]]:
    """Of what is given in time and swings; what is derived from it may swing as well."""
    if not _given_swings(values):
        return
    for name, one in values.type.declaration.derived.items():
        if one.wave:
            getattr(values, name)
    for name, value in values.given.items():
        if isinstance(value, Wave) and value.swings:
            yield name, len(value.swings)


def _given_swings(values: Values) -> bool:
    """Whether a quantity in time that a user gave has sines whose amplitudes change."""
    names = values.type.declaration.parameters
    return any(isinstance(one := values.given.get(name), Wave) and bool(one.swings) for name in names)
