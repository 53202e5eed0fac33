"""Derivatives and symbols of traced expressions, remembered part by part.

    derivative(e, s)    what sympy.diff(e, s) gives, to the same form
    symbols_in(e)       what e.free_symbols gives

A class has many values that are made of the same parts, and asks for the same derivative several times. SymPy looks
through all of an expression for its symbols at each of its parts, which takes most of the time of a derivative.
"""

from __future__ import annotations

import functools
from typing import Any

import sympy

KEPT = 1 << 15
"""Parts that are remembered; the largest class has some thousand."""
_PLAIN = (sympy.Add, sympy.Mul, sympy.Pow)


@functools.lru_cache(maxsize=KEPT)
def symbols_in(expression: sympy.Expr) -> frozenset[Any]:
    """The symbols that an expression reads."""
    if type(expression) in _PLAIN:
        return frozenset().union(*map(symbols_in, expression.args))
    return frozenset(expression.free_symbols)


@functools.lru_cache(maxsize=KEPT)
def derivative(expression: sympy.Expr, by: sympy.Symbol) -> sympy.Expr:
    """The first derivative of an expression by a symbol."""
    kind, args = type(expression), expression.args
    if by not in symbols_in(expression):
        return sympy.S.Zero
    if expression == by:
        return sympy.S.One
    if kind is sympy.Add:
        return sympy.Add(*(derivative(part, by) for part in args))
    if kind is sympy.Mul:
        slopes = [derivative(part, by) for part in args]
        return sympy.Add(*(sympy.Mul(*args[:k], slope, *args[k + 1 :]) for k, slope in enumerate(slopes) if slope != 0))
    if kind is sympy.Pow:
        base, power = args
        by_base, by_power = derivative(base, by), derivative(power, by)
        return expression * (by_power * sympy.log(base) + by_base * power / base)
    if len(args) == 1 and kind._eval_derivative is sympy.Function._eval_derivative:
        return expression.fdiff(1) * derivative(args[0], by)
    return sympy.diff(expression, by)
