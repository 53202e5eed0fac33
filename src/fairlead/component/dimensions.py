"""Units of a law: terms of a sum are of one kind, and what a law gives is of the kind that was declared.

Every symbol of a traced law has the unit that its class declared for it. Numbers written into a law may carry a unit
that nobody tells (`9.81 * p.mass`), so all but small ones fit anything. So does what plain Python derives, and what is
declared as a plain number, such as a gain or a signal "in SI of both". An angle counts as a number, since a radius
times an angle is a length. What is found is wrong; not all that is wrong is found.

The line is found by running the law once more: it is the first one after which something does not fit.
"""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable, Iterator, Mapping, Set
from dataclasses import dataclass
from fractions import Fraction
from types import FrameType
from typing import Any

import sympy

from fairlead.component.declaration import Declaration
from fairlead.component.given import Parameter, Table, Waveform
from fairlead.component.keys import INPUT, OWN, PARAMETER, PORT, TABLE, TIME, Key, key
from fairlead.component.values import Variant
from fairlead.component.wave import SWING
from fairlead.quantities import KINDS, NONE, QuantityError, parse_unit, unit_text

Dimension = tuple[Any, ...]
PLAIN: Dimension = (0, 0, 0, 0, 0)
BASES = len(PLAIN)  # m, kg, s, A, K; angles are numbers here, and an energy is what it is made of
SMALL = 4
"""Whole numbers, and one over them, up to which a number of a law is a number."""
FREE = ("1", "1/s")
"""Units of plain numbers, and of their rates, which say nothing of what they stand for."""
OF_PORTS = {"x": 0, "v": 1}
RATES = {"a": 2, "A": 2, "U": 2}


class Misfit(Exception):
    """Terms that do not go together, in words."""


def misfit(expression: Any, variant: Variant) -> str:
    """What does not fit within an expression, or ""."""
    try:
        _of(sympy.sympify(expression), variant)
    except Misfit as error:
        return str(error)
    return ""


def misfit_as(expression: sympy.Expr, unit: str, name: str, variant: Variant) -> str:
    """What does not fit within an expression, or between it and the unit that `name` has; or ""."""
    try:
        found = _of(expression, variant)
    except Misfit as error:
        return str(error)
    wanted = _dimension(unit)
    if found in (None, PLAIN, wanted) or unit in FREE:
        return ""
    return f"{name} is in {unit}, and is given {said(expression)}, which is in {_unit(found)}; its unit is not that"


@dataclass(frozen=True)
class Wrong:
    """Something that does not fit, and the function of the class that says it."""

    what: str
    zone: str
    function: Callable[..., Any]
    direction: int = 0  # what a guard with a mirror is given


def misfits(variant: Variant, zones: Mapping[str, Any]) -> Iterator[Wrong]:
    """All that does not fit in the zones (TracedZone) of a class variant."""
    has, answers = variant.type.declaration, variant.type.answers
    for name, zone in zones.items():
        law = has.laws[name]
        units = {port: has.ports[port].domain.through[1] for port in zone.flows}
        units |= {output: has.outputs[output].unit for output in zone.outputs}
        units |= {name: f"{state.unit}/s" for name, state in has.states.items()}
        for term, value in {**zone.flows, **zone.own, **zone.outputs}.items():
            unit, of = units.get(term), _called(term, has)
            if what := misfit(value, variant) if unit is None else misfit_as(value, unit, of, variant):
                yield Wrong(what, name, law)
        for line, value in zone.ledger.items():
            method = getattr(answers, line) or law
            if what := misfit_as(value, "J" if line == "stored" else "W", line, variant):
                yield Wrong(what, name, method)
        for guard in zone.guards:
            if not guard.table and (what := _of_guard(guard, variant)):
                yield Wrong(what, name, has.guards[guard.name].function, has.guards[guard.name].direction)


def _of_guard(guard: Any, variant: Variant) -> str:
    """What does not fit within a guard, or between it and its unit; one of several values must have that."""
    if inner := next(filter(None, (misfit(value, variant) for value in guard.values)), ""):
        return inner
    outer = [misfit_as(value, guard.unit, f"the guard {guard.name}", variant) for value in guard.values]
    return outer[0] if all(outer) else ""


def _called(term: str, has: Declaration) -> str:
    return f"the rate of {term}" if term in has.states else f"what {term} takes in" if term in has.ports else term


def line_of(function: Callable[..., Any], arguments: dict[str, Any], variant: Variant, files: Set[str]) -> str:
    """file:line of a law, or of a function in one of `files` that it calls, after which something does not fit.

    The first line of the law when none is to blame.
    """
    code, seen, found = function.__code__, set[int](), list[str]()
    last = place = f"{code.co_filename}:{code.co_firstlineno}"

    def watch(frame: FrameType, event: str, value: Any) -> Any:
        nonlocal last
        if frame.f_code is not code and frame.f_code.co_filename not in files:
            return None
        for one in [*frame.f_locals.values(), *(_members(value) if event == "return" else ())]:
            if isinstance(one, sympy.Expr) and id(one) not in seen and not found:
                seen.add(id(one))
                if misfit(one, variant):
                    found.append(last)
        last = f"{frame.f_code.co_filename}:{frame.f_lineno}"
        return watch

    before = sys.gettrace()
    sys.settrace(watch)
    try:
        function(**arguments)
    except Exception:  # noqa: BLE001 - it has been run before, and what it raises is told elsewhere
        return place
    finally:
        sys.settrace(before)
    return found[0] if found else place


def _members(value: Any) -> Iterator[Any]:
    terms = getattr(value, "terms", None)
    yield from terms.values() if isinstance(terms, dict) else value if isinstance(value, tuple) else (value,)


def _of(value: sympy.Expr, variant: Variant) -> Dimension | None:
    """The dimension of an expression; None where it may be anything. Raises Misfit."""
    if value.is_Symbol:
        return _symbol(key(value.name), variant)
    if value.is_Number or value.is_NumberSymbol:
        return PLAIN if _is_plain(value) else None
    inner = [_of(one, variant) for one in value.args]
    if value.is_Add or isinstance(value, sympy.Max | sympy.Min):
        return _alike(value.args, inner)
    if value.is_Mul:
        return None if None in inner else tuple(map(sum, zip(*inner, strict=True)))
    if value.is_Pow:
        exponent = value.args[1]
        if not exponent.is_Rational or inner[0] is None:
            return PLAIN if inner[0] == PLAIN else None
        return tuple(one * Fraction(int(exponent.p), int(exponent.q)) for one in inner[0])
    if isinstance(value, sympy.Abs):
        return inner[0]
    if isinstance(value, sympy.exp | sympy.log | sympy.sin | sympy.cos | sympy.tan | sympy.tanh | sympy.atan):
        if inner[0] not in (None, PLAIN):
            what = f"{said(value.args[0])} is in {_unit(inner[0])}, and {type(value).__name__} takes a plain number"
            raise Misfit(what)
        return PLAIN
    return PLAIN if isinstance(value, sympy.sign) else None


def _alike(terms: tuple[sympy.Expr, ...], dimensions: list[Dimension | None]) -> Dimension | None:
    """The dimension that all terms of a sum have."""
    known = [
        (term, one) for term, one in zip(terms, dimensions, strict=True) if one is not None and not term.is_Number
    ]
    for term, one in known[1:]:
        first, dimension = known[0]
        if one != dimension:
            what = f"{said(first)} [{_unit(dimension)}] and {said(term)} [{_unit(one)}] are added"
            raise Misfit(f"{what}; terms of a sum have one unit")
    return known[0][1] if known else PLAIN if PLAIN in dimensions and None not in dimensions else None


@functools.lru_cache(maxsize=1000)  # to find the ratio of a decimal takes long, and laws have the same few
def _is_plain(value: sympy.Expr) -> bool:
    if value.is_NumberSymbol:
        return True
    number = sympy.nsimplify(value, rational=True) if value.is_Float else value
    return bool(number.is_Rational and abs(number.p) <= SMALL and number.q <= SMALL)


def _symbol(one: Key, variant: Variant) -> Dimension | None:
    """The dimension of what a symbol stands for."""
    has = variant.type.declaration
    if one.kind == TIME:
        return _dimension("s")
    if one.kind == PORT and one.name in has.ports:
        domain = has.ports[one.name].domain
        if one.part == "R":
            return _dimension(domain.through[1])
        if one.part in RATES and domain.mechanical:
            return _over(_dimension(domain.across[1][1]), "s", 1)
        at = OF_PORTS.get(one.part, len(domain.across))
        return _dimension(domain.across[at][1]) if at < len(domain.across) else None
    if one.kind == OWN or (one.kind == INPUT and not one.part):
        declared: Any = {**has.states, **has.unknowns, **has.inputs}.get(one.name)
        return _told(declared.unit) if declared is not None else None
    if one.kind == PARAMETER and one.name.startswith("#"):
        discrete = has.discrete.get(one.name[1:])
        return _told(discrete.unit) if discrete is not None else None
    if one.kind == PARAMETER:
        parameter = _declared(one.name, variant)
        if isinstance(parameter, Waveform):
            return _told(parameter.unit) if one.part == "amplitude" and f".{SWING}" not in one.name else None
        return _told(parameter.unit) if isinstance(parameter, Parameter) else None
    return _of_table(one, _declared(one.name, variant)) if one.kind == TABLE else None


def _of_table(one: Key, table: Any) -> Dimension | None:
    """Where a piece begins is in the unit of x, its coefficient number k in that of y over that of x to the k."""
    if not isinstance(table, Table | Waveform) or not one.part.isdigit():
        return None
    x, y = (table.x, table.y) if isinstance(table, Table) else ("s", table.unit)
    return _told(x) if one.part == "0" else _over(_told(y), x, int(one.part) - 1)


def _declared(path: str, variant: Variant) -> Any:
    """The declaration of a parameter, also of a part."""
    *parts, name = path.split(".")
    if parts and name.startswith(SWING):
        name = parts.pop()
    for part in parts:
        inner = dict(variant.parts).get(part)
        if inner is None:
            return None
        variant = inner
    has: Declaration = variant.type.declaration
    return has.parameters.get(name)


def _over(dimension: Dimension | None, unit: str, times: int) -> Dimension | None:
    below = _dimension(unit)
    if dimension is None or below is None:
        return None
    return tuple(one - times * other for one, other in zip(dimension, below, strict=True))


def _told(unit: str) -> Dimension | None:
    """The dimension of what is declared in a unit; None for a plain number, which may stand for anything."""
    return None if unit in FREE else _dimension(unit)


def _dimension(unit: str) -> Dimension:
    return tuple(parse_unit(unit).dimension[:BASES])


def _unit(dimension: Dimension | None) -> str:
    """The usual unit of a dimension."""
    for unit in KINDS:
        if _dimension(unit) == dimension and "rad" not in unit:
            return unit
    try:
        return unit_text((*(dimension or PLAIN), *NONE[BASES:]))
    except QuantityError:
        return "no usual unit"


def said(expression: sympy.Expr) -> str:
    """An expression in the words of its author: `stiffness*(b.x - a.x)`."""
    words = {s: sympy.Symbol(_word(key(s.name))) for s in expression.free_symbols}
    return str(expression.xreplace(words))


def _word(one: Key) -> str:
    if one.kind == TABLE:
        return f"{one.name}(..)"
    return f"{one.name}.{one.part}" if one.part else one.name.removeprefix("#") or one.kind


