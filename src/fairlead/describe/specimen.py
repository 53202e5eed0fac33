"""A class variant to look at when there is no netlist: parameters at their defaults, parts left open.

In `specimen(Hold)` the part `curve` stands for any curve: the laws say `curve.coefficient(slip)`.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from typing import Any

from fairlead.component.answers import METHODS
from fairlead.component.base import Declared, Family
from fairlead.component.given import REQUIRED, Choice, Parameter, Part, Table, Waveform
from fairlead.component.piecewise import linear_table
from fairlead.component.scene import is_head
from fairlead.component.trace import Traced, TraceError, Unsaid, trace
from fairlead.component.values import Values, Variant, steady, variant_of


def traced_specimen(kind: type[Declared]) -> Traced:
    """A class traced with its parts open; a law that looks inside a part gets the first of the family."""
    try:
        return trace(specimen(kind, open_parts=True))
    except TraceError:
        return trace(specimen(kind, open_parts=False))


def specimen(kind: type[Declared], *, open_parts: bool) -> Variant:
    """Every word at its default; waveforms and tables are given, optional numbers are not."""
    has = kind.declaration
    given = {name: _usual(name, declared, open_parts) for name, declared in has.parameters.items() if name != "effects"}
    given |= {name: effect.default for name, effect in has.effects.items()}
    prepare = kind.answers.prepare
    return variant_of(Values(kind, prepare(given) if prepare else given))


def _usual(name: str, declared: Any, open_parts: bool) -> Any:
    if isinstance(declared, Part):
        member = _first(declared.family)
        absent = {n: None for n, d in member.declaration.parameters.items() if getattr(d, "default", REQUIRED) is None}
        return Values(_any_member(name, declared.family) if open_parts else member, absent)
    if isinstance(declared, Waveform):
        return steady(0.0)
    if isinstance(declared, Table):
        return linear_table([0.0, 1.0], [0.0, 1.0])
    default = getattr(declared, "default", None)
    if default is not REQUIRED:
        return default
    if isinstance(declared, Choice):
        return declared.options[0]
    return _within(declared) if isinstance(declared, Parameter) else 1


def _within(declared: Parameter) -> float:
    """Some number in the range of a parameter."""
    low = next((b for b in (declared.above, declared.least) if b is not None), None)
    high = next((b for b in (declared.below, declared.most) if b is not None), None)
    if low is not None and high is not None:
        return (low + high) / 2
    return low + 1.0 if low is not None else high - 1.0 if high is not None else 1.0


def _first(family: Any) -> type[Declared]:
    return family.members.get(family.default_word) or next(iter(family.members.values()))


def _any_member(path: str, family: Any) -> type[Declared]:
    """A stand-in whose functions are those that all members have, left unsaid."""
    member = _first(family)
    names = [n for n, f in inspect.getmembers(member, inspect.isfunction) if not n.startswith("_") and n not in METHODS]
    everywhere = [n for n in names if all(n in dict(inspect.getmembers(m)) for m in family.members.values())]
    return type(
        family.__name__,
        (Declared,),
        {"__module__": __name__, **{n: _unsaid(f"{path}.{n}") for n in everywhere}},
    )


def _unsaid(name: str) -> Callable[..., Any]:
    said = type(name, (Unsaid,), {})

    def function(p: Any, *arguments: Any) -> Any:
        return said(*arguments)

    return function


def families_of(kind: type[Declared]) -> list[type[Family]]:
    """Families that a class takes its parts from, nearest first."""
    found: dict[type[Family], None] = {}
    kinds: Iterable[type[Declared]] = kind.members.values() if is_head(kind) else [kind]
    for family in (getattr(d, "family", None) for k in kinds for d in k.declaration.parameters.values()):
        if family is not None and family not in found:
            found |= dict.fromkeys([family, *families_of(family)])
    return list(found)
