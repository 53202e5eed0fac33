"""Mathematical functions for laws: numbers give numbers, traced expressions give expressions.

A law written with these runs twice: once with symbols, to be differentiated and compiled, and with
plain numbers wherever a value is wanted (derived parameters, tests, curves drawn by the tools).
"""

from __future__ import annotations

import math
from typing import Any

pi = math.pi


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
