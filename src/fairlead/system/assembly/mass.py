"""The mass matrix: a diagonal of inertias, and the rows of held contacts with the coefficients of their slip.

values = mass_static,  then  values[a] += mass_coef * partials[b]  for every (a, b) of mass_program,  then what rows
have in it that hold a node without inertia beside another row (light_holds.py).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fairlead.system.arrays.blocks import Block, Memory
from fairlead.system.arrays.portions import Portion
from fairlead.system.assembly.algebraic_nodes import rows_without_rates
from fairlead.system.assembly.light_holds import (
    Entries,
    held_entries,
    light_parts,
    light_program,
    relations,
    supported_entries,
)  # fmt: skip
from fairlead.system.assembly.program import Pattern
from fairlead.system.numbering.unknowns import Numbering


def mass(blocks: Sequence[Block], portions: Sequence[Portion], numbering: Numbering) -> tuple[Pattern, Memory]:
    """Pattern of M (CSC), and the arrays with which the callbacks fill it."""
    entries, n = held_entries(blocks, portions, numbering), numbering.n
    parts = light_parts(blocks, entries, numbering)
    kept = _kept(entries, blocks, numbering, {row for part in parts for row in part.rows})
    row, column = entries.row[kept], entries.column[kept]
    diagonal = np.array([i for i, u in enumerate(numbering.unknowns) if u.differential], dtype=np.int64)
    related = relations(parts)
    of_light = np.array([j * n + i for i, j in related], dtype=np.int64)
    keys, place = np.unique(np.concatenate([column * n + row, diagonal * (n + 1), of_light]), return_inverse=True)
    static = np.zeros(len(keys))
    static[place[len(row) : len(row) + len(diagonal)]] = [numbering.unknowns[i].mass for i in diagonal]
    starts = np.searchsorted(keys // n, np.arange(n + 1)).astype(np.int64)
    place_of = dict(zip(related, place[len(row) + len(diagonal) :].tolist(), strict=True))
    return Pattern(starts, (keys % n).astype(np.int64)), {
        "mass_static": static,
        "mass_coef": entries.coef[kept].astype(float),
        "mass_program": np.ascontiguousarray(
            np.stack([place[: len(row)], entries.partial[kept]], axis=1).astype(np.int64)
        ),
    } | light_program(parts, entries, supported_entries(blocks, portions, numbering), place_of)


def _kept(entries: Entries, blocks: Sequence[Block], numbering: Numbering, of_light: set[int]) -> NDArray[np.bool_]:
    """Which of these entries are in M as they stand.

    Not of a row in which one has inertia and one has none: that one follows at once, and the slip is zero as it stands.
    Nor of one that holds a node whose speed a row gives at once (algebraic_nodes.py), or that several may hold.
    """
    inert = np.array([not u.differential for u in numbering.unknowns], dtype=bool)
    rows = entries.row
    held, moved = (np.isin(rows, rows[those]) for those in (inert[entries.column], ~inert[entries.column]))
    apart = np.isin(rows, [*rows_without_rates(blocks, numbering).tolist(), *of_light])
    return ~(held & moved | apart)
