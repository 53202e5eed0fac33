"""Symbols of a traced law, by their keys (`keys.py`), and what is raised where a law cannot be traced."""

from __future__ import annotations

import functools

import sympy

from fairlead.component.quantity import Quantity


class TraceError(TypeError):
    """A law that cannot be traced; the text names the author's file and line."""


@functools.cache
def symbol(text: str) -> sympy.Symbol:
    """The real symbol of a key (`keys.py`)."""
    return Quantity(text, real=True)


def sine(path: str, part: str) -> str:
    """The key of the amplitude, omega or phase of what a quantity in time swings with."""
    return f"p:{path}:{part}"


def inverse_mass(port: str) -> str:
    """The key of one over the mass of the body at a port."""
    return f"p:{port}.inverse_mass"
