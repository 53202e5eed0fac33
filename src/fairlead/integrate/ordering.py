"""Where the entries of W live, and in which order its unknowns are eliminated.

placeholder
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fairlead.integrate.protocol import Integers, Pattern

DENSE_LIMIT = 30
"""Up to this many unknowns a full matrix with partial pivoting is faster than any pattern."""


@dataclass(frozen=True, eq=False)
class Plan:
    """Layout of `matrix` and, when sparse, the pivot order and the patterns of the factors."""

    dense: bool
    size: int
    """Length of `matrix`."""
    jacobian_place: Integers
    mass_place: Integers
    """Where each entry of the Jacobian and mass pattern goes in `matrix`."""
    arrays: dict[str, Integers]
    """Arrays of the sparse plan by their name in memory.py; empty when dense."""


def columns_of(pattern: Pattern) -> Integers:
    """The column of each entry."""
    return np.repeat(np.arange(len(pattern.starts) - 1), np.diff(pattern.starts)).astype(np.int64)


def dense_plan(pattern: Pattern, mass_pattern: Pattern) -> Plan:
    """A full matrix by rows."""
    n = len(pattern.starts) - 1
    return Plan(
        dense=True,
        size=n * n,
        jacobian_place=pattern.rows * n + columns_of(pattern),
        mass_place=mass_pattern.rows * n + columns_of(mass_pattern),
        arrays={},
    )


def plan(problem) -> Plan:
    return dense_plan(problem.pattern, problem.mass_pattern)
