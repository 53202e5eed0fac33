"""The mass matrix: a diagonal of inertias, and the rows of held contacts with the coefficients of their slip.

values = mass_static,  then  values[a] += mass_coef * partials[b]  for every (a, b) of mass_program
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairlead.system.arrays.blocks import Block, Floats, Integers, Memory
from fairlead.system.arrays.shares import Share
from fairlead.system.assembly.algebraic_nodes import rows_without_rates
from fairlead.system.assembly.program import Pattern
from fairlead.system.numbering.unknowns import Numbering


def mass(blocks: Sequence[Block], shares: Sequence[Share], numbering: Numbering) -> tuple[Pattern, Memory]:
    """Pattern of M (CSC), and the arrays with which the callbacks fill it."""
    row, column, partial, coef = _held(blocks, shares, numbering)
    n = numbering.n
    diagonal = np.array([i for i, u in enumerate(numbering.unknowns) if u.differential], dtype=np.int64)
    keys, place = np.unique(np.concatenate([column * n + row, diagonal * (n + 1)]), return_inverse=True)
    static = np.zeros(len(keys))
    static[place[len(row) :]] = [numbering.unknowns[i].mass for i in diagonal]
    starts = np.searchsorted(keys // n, np.arange(n + 1)).astype(np.int64)
    return Pattern(starts, (keys % n).astype(np.int64)), {
        "mass_static": static,
        "mass_coef": coef,
        "mass_program": np.ascontiguousarray(np.stack([place[: len(row)], partial], axis=1).astype(np.int64)),
    }


def _held(
    blocks: Sequence[Block], shares: Sequence[Share], numbering: Numbering
) -> tuple[Integers, Integers, Integers, Floats]:
    """Row, column, partial and coefficient of every unknown speed in a hold row.

    Not of a row in which one has inertia and one has none: that one follows at once, and the slip is zero as it stands.
    Nor of one that holds a node whose speed a row gives at once (algebraic_nodes.py).
    """
    row, column, partial, coef = ([np.zeros(0, np.int64)] for _ in range(4))
    inert = np.array([not u.differential for u in numbering.unknowns], dtype=bool)
    for block, share in zip(blocks, shares, strict=True):
        s, count = block.kernel.structure, np.arange(block.count)
        for e, (unknown, j) in enumerate(s.mass):
            own, used = block.flow_index[:, s.targets.index(f"own:{unknown}")], block.in_index[:, j] < numbering.n
            row.append(own[used])
            column.append(block.in_index[used, j])
            partial.append((share.mass + count * len(s.mass) + e)[used])
            coef.append(block.in_coef[used, j])
    rows, columns = np.concatenate(row), np.concatenate(column)
    held, moved = (np.isin(rows, rows[those]) for those in (inert[columns], ~inert[columns]))
    kept = ~(held & moved | np.isin(rows, rows_without_rates(blocks, numbering)))
    return rows[kept], columns[kept], np.concatenate(partial)[kept], np.concatenate(coef).astype(float)[kept]
