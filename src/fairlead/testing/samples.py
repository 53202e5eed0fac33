"""Random instances of a component class, within the ranges that it declares."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, cast

import numpy as np

from fairlead.component.base import Declared, Family
from fairlead.component.given import Block, Choice, Count, Parameter, Part, Table, Waveform
from fairlead.component.parameters import make
from fairlead.component.scene import is_head
from fairlead.component.values import Values

# A usual size of a quantity by its unit; anything else is around 1.
USUAL = {
    "m": 0.1, "m/s": 0.1, "N": 10.0, "N/m": 1e3, "N*s/m": 10.0, "kg": 1.0, "kg/m": 2.0, "Pa": 1e6, "m^3/s": 1e-4,
    "V": 10.0, "W": 10.0, "kg*m^2": 0.1, "N*m": 5.0, "rad/s": 1.0, "K": 300.0, "1/K": 1e-3,
    "m^2": 1e-3, "m^3": 1e-3, "m^3/rad": 2e-5, "m^3/s/Pa": 1e-12,
}  # fmt: skip
TRIES = 300  # draws until the class's own `check` finds no contradiction
POINTS = 5  # of a random table


@dataclass(frozen=True)
class PartAsked:
    """A member of a family that is asked in the components that take it, with what is fixed of it."""

    kind: type[Family]
    given: Mapping[str, Any]

    def __str__(self) -> str:
        return self.kind.__name__


class SampleError(ValueError):
    """No parameters were found that the class itself does not call contradictory."""


def families(kind: type[Declared]) -> Iterator[tuple[type[Declared], dict[str, Any]]]:
    """Every class and choice of words and parts that is a law of its own.

    The members of a family each with every member of their parts; then each option of each choice once.
    """
    members = list(kind.members.values()) if is_head(kind) else [kind]
    for member in members:
        declared = member.declaration.parameters
        parts = {name: list(_members(d)) for name, d in declared.items() if isinstance(d, Part)}
        for words in itertools.product(*parts.values()):
            yield member, dict(zip(parts, words, strict=True))
        for name, d in declared.items():
            if isinstance(d, Choice):
                yield from ((member, {name: option}) for option in d.options if option != d.default)
        for name, effect in member.declaration.effects.items():
            yield member, {name: "off" if effect.default == "on" else "on"}


def _members(part: Part) -> dict[str, type[Family]]:
    return cast(type[Family], part.family).members


def sample(kind: type[Declared], rng: np.random.Generator, chosen: Mapping[str, Any], optional: bool) -> Values:
    """A random instance. `chosen` fixes parameters, parts by word or as asked; `optional` gives those that may lack.

    Raises SampleError when every draw contradicts the class's own `check`.
    """
    faults: list[Any] = []
    for _ in range(TRIES):
        values = make(kind, **_draw(kind, rng, chosen, optional))
        faults = list(_contradictions(values))
        if not faults:
            return values
    name, what, _ = faults[0]
    raise SampleError(
        f"{kind.__name__}: no random parameters pass its own check ({name}: {what}); "
        f"fix some: contract({kind.__name__}, {name or 'name'}=...)"
    )


def _draw(kind: type[Declared], rng: np.random.Generator, chosen: Mapping[str, Any], optional: bool) -> dict[str, Any]:
    given: dict[str, Any] = {}
    chosen = {**kind.answers.asked_with, **chosen}
    for name, declared in kind.declaration.parameters.items():
        if name in chosen and not (isinstance(declared, Part) and isinstance(chosen[name], str | PartAsked)):
            given[name] = chosen[name]
            continue
        value = _value(declared, rng, chosen.get(name), optional)
        if value is not None:
            given[name] = value
    return given | {name: word for name, word in chosen.items() if name in kind.declaration.effects}


def _value(declared: Any, rng: np.random.Generator, word: Any, optional: bool) -> Any:
    """A value for one parameter, or None to leave it to its default."""
    if isinstance(declared, Choice | Count):
        return None if getattr(declared, "default", None) is not _REQUIRED else _first(declared)
    if isinstance(declared, Parameter):
        absent = declared.default is None and not optional
        return None if absent else number(declared, rng)
    if isinstance(declared, Part):
        members = _members(declared)
        if isinstance(word, PartAsked):
            return sample(word.kind, rng, word.given, optional)
        return sample(members[word or next(iter(members))], rng, {}, optional)
    if isinstance(declared, Block):
        if declared.default is None:  # no law sees it; it says something in other words
            return None
        return {
            name: value
            for name, d in declared.parameters.items()
            if (value := _value(d, rng, None, optional)) is not None
        }
    if isinstance(declared, Table):
        return _table(declared, rng) if declared.default is _REQUIRED else None
    if isinstance(declared, Waveform):
        return _wave(declared, rng) if declared.default is _REQUIRED or rng.random() < 0.5 else None
    return None


def _first(declared: Choice | Count) -> Any:
    return declared.options[0] if isinstance(declared, Choice) else declared.least


def number(declared: Parameter, rng: np.random.Generator) -> float:
    """A number within the declared range, spread over two decades round its default or its usual size."""
    low = declared.above if declared.above is not None else declared.least
    high = declared.below if declared.below is not None else declared.most
    if low is not None and high is not None:
        return float(rng.uniform(low + 0.05 * (high - low), high - 0.05 * (high - low)))
    usual = abs(declared.default) if isinstance(declared.default, int | float) else 0.0
    size = (usual or USUAL.get(declared.unit, 1.0)) * 10 ** rng.uniform(-1, 1)
    if low is not None:
        return float(low + size)
    return float(high - size) if high is not None else float(size * rng.choice([-1, 1]))


def _table(declared: Table, rng: np.random.Generator) -> list[list[float]]:
    steps = USUAL.get(declared.x, 1.0) * rng.uniform(0.2, 1.0, POINTS - 1)
    x = [0.0, *np.cumsum(steps).tolist()]
    return [[a, float(USUAL.get(declared.y, 1.0) * rng.uniform(0.1, 1.0))] for a in x]


def _wave(declared: Waveform, rng: np.random.Generator) -> dict[str, Any]:
    to = float(USUAL.get(declared.unit, 1.0) * rng.uniform(-1, 1))
    return {"trapezoid": {"to": to, "rise": 1.0, "stay": 1.0, "fall": 1.0}}


def _contradictions(values: Values) -> Iterator[Any]:
    check = values.type.answers.check
    yield from check(values) if check else ()
    for inner in values.given.values():
        if isinstance(inner, Values):
            yield from _contradictions(inner)


_REQUIRED = Parameter("1").default
