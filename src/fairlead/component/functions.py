"""Mathematical functions for laws: numbers give numbers, traced expressions give expressions.

A law written with these runs twice: once with symbols, to be differentiated and compiled, and with
plain numbers wherever a value is wanted (derived parameters, tests, curves drawn by the tools).
"""

from __future__ import annotations

import math
from typing import Any

pi = math.pi


def _choose(name: str, arguments: tuple[Any, ...]) -> Any:
    if all(isinstance(x, int | float) for x in arguments):
        return {"Min": min, "Max": max}[name](arguments)
    import sympy

    return getattr(sympy, name)(*arguments, evaluate=False)  # as it stands: comparing expressions takes SymPy seconds


def least(*values: Any) -> Any:
    """The smallest; has corners, so for sampled laws, guards and outputs that are recorded only."""
    return _choose("Min", values)


def greatest(*values: Any) -> Any:
    """The largest; see `least`."""
    return _choose("Max", values)


def clip(x: Any, low: Any, high: Any) -> Any:
    """x, but not below `low` nor above `high`; see `least`."""
    return greatest(low, least(x, high))


def exceeds(x: Any, limit: Any) -> Any:
    """1 where x is above the limit, else 0; see `least`."""
    if isinstance(x, int | float) and isinstance(limit, int | float):
        return 1 if x > limit else 0
    import sympy

    return greatest(sympy.sign(x - limit), 0)


def _apply(name: str, x: Any) -> Any:
    if isinstance(x, int | float):
        return getattr(math, name)(x)
    if isinstance(x, complex):  # complex-step derivatives in the contract suite
        import cmath

        return getattr(cmath, name)(x)
    import sympy

    return getattr(sympy, name)(x)


def exp(x: Any) -> Any:
    """Exponential."""
    return _apply("exp", x)


def log(x: Any) -> Any:
    """Natural logarithm."""
    return _apply("log", x)


def sqrt(x: Any) -> Any:
    """Square root; its slope at zero is infinite, so keep its argument away from zero."""
    return _apply("sqrt", x)


def sin(x: Any) -> Any:
    """Sine."""
    return _apply("sin", x)


def cos(x: Any) -> Any:
    """Cosine."""
    return _apply("cos", x)


def tanh(x: Any) -> Any:
    """Hyperbolic tangent."""
    return _apply("tanh", x)


def atan(x: Any) -> Any:
    """Inverse tangent."""
    return _apply("atan", x)
