"""Two expressions that differ at a random place are not the same; only the others need to be written out to be told.

    differs(a, b)           True only if they are certain to differ: their values do, by more than rounding
    varies(e, together)     True only if the value of e changes where all these symbols grow by the same

Values come with a *size*, the sum of what they are summed of regardless of signs: rounding is small beside it.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Collection, Mapping
from typing import Any

import sympy

CLEAR = 1e-6
"""A difference of values, relative to their sizes, that rounding does not make."""
STEP = 0.37
"""How far symbols are moved together."""
_KNOWN: dict[Any, Any] = {
    sympy.exp: math.exp, sympy.log: math.log, sympy.tanh: math.tanh, sympy.atan: math.atan, sympy.sin: math.sin,
    sympy.cos: math.cos, sympy.tan: math.tan, sympy.Abs: abs, sympy.Min: min, sympy.Max: max,
}  # fmt: skip

Sized = tuple[float, float]


def differs(one: sympy.Expr, other: sympy.Expr) -> bool:
    """True if two expressions have different values somewhere; False says nothing."""
    return _clear(_valued(one, {}), _valued(other, {}))


def varies(expression: sympy.Expr, together: Collection[sympy.Symbol]) -> bool:
    """True if a value changes where all of these symbols grow by the same; False says nothing."""
    moved = {s: (value + STEP, size + STEP) for s in together for value, size in [_drawn(s)]}
    return _clear(_valued(expression, {}), _valued(expression, moved))


def _clear(one: Sized | None, other: Sized | None) -> bool:
    if one is None or other is None:
        return False
    return abs(one[0] - other[0]) > CLEAR * max(one[1], other[1])


def _drawn(s: sympy.Symbol) -> Sized:
    """A number of its own for every symbol, always the same."""
    value = 0.5 + zlib.crc32(s.name.encode()) / 2**32
    return value, value


def _valued(expression: sympy.Expr, given: Mapping[sympy.Symbol, Sized]) -> Sized | None:
    """Value and size, or None where there is no finite one, or one that is not real: the root of what is below zero."""
    try:
        value, size = _value(expression, dict(given))
    except (ValueError, OverflowError, ZeroDivisionError, TypeError, KeyError):
        return None
    if isinstance(value, complex) or isinstance(size, complex):
        return None
    return (value, size) if math.isfinite(value) and math.isfinite(size) else None


def _value(expression: sympy.Expr, known: dict[Any, Sized]) -> Sized:
    """Value and size of an expression, each part of it once; raises KeyError for a function that is not known here."""
    found = known.get(expression)
    if found is not None:
        return found
    kind = type(expression)
    if expression.is_Symbol:
        found = _drawn(expression)
    elif not expression.args:
        found = (float(expression), abs(float(expression)))
    else:
        parts = [_value(part, known) for part in expression.args]
        values = [value for value, _ in parts]
        if kind is sympy.Add:
            found = (math.fsum(values), sum(size for _, size in parts))
        elif kind is sympy.Mul:
            found = (math.prod(values), math.prod(size for _, size in parts))
        elif kind is sympy.Pow:
            found = _power(*parts)
        else:
            value = float(_KNOWN[kind](*values))
            found = (value, (1.0 + abs(value)) * (1.0 + sum(size for _, size in parts)))
    known[expression] = found
    return found


def _power(base: Sized, power: Sized) -> Sized:
    value = base[0] ** power[0]
    grown = base[1] / abs(base[0])  # how much of the base may be rounding
    return value, abs(value) * grown ** max(1.0, abs(power[0]))
