"""All partial derivatives of the kernels, gathered as rows of the plan that makes them into df/dy.

Rows of the plan are signals by rank, reactions, then the n equations; see `program.py`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from fairlead.flatten.flat_model import FlatModel
from fairlead.system.arrays.blocks import Block, Floats, Integers, Memory
from fairlead.system.arrays.portions import Portion
from fairlead.system.assembly.algebraic_nodes import add_rated_entries
from fairlead.system.assembly.light_holds import add_light_entries
from fairlead.system.assembly.program import Entries, Program, plan
from fairlead.system.assembly.redundancy import circle_entries
from fairlead.system.numbering.unknowns import LEDGER, Numbering, part_rows, reaction_masses


def jacobian(
    flat: FlatModel, blocks: Sequence[Block], portions: Sequence[Portion], numbering: Numbering, rows: Memory, more: int
) -> Program:
    """Plan of the assembly of df/dy and df/dt, signals eliminated.

    At `more` follow the partials of the circles, then those in `rows`: of nodes without inertia whose balances have
    rates (algebraic_nodes.py), and of rows that hold such nodes beside others (light_holds.py).
    """
    m = numbering.zero - numbering.n
    entries = circle_entries(numbering, m, more)
    partials = more + len(numbering.circles) + len(numbering.share)
    add_rated_entries(entries, rows, m, partials)
    light = partials + len(rows["rated_terms"])
    add_light_entries(entries, rows, m, light)
    to_whole = {one.row: (one.whole, one.sign) for one in part_rows(flat, numbering)}
    for block, portion in zip(blocks, portions, strict=True):
        if block.acts:
            _entries(block, portion, numbering, entries, m, to_whole)
    _fixed_entries(flat, numbering, entries, m)
    level, fixed = _levels(blocks, numbering, m), _fixed(blocks, portions, light + len(rows["light_terms"]))
    return plan(entries, numbering.n, m, level, fixed, list(numbering.ledger.values()))


def _fixed(blocks: Sequence[Block], portions: Sequence[Portion], count: int) -> NDArray[np.bool_]:
    """Which partial derivatives never change: those the kernels say, and the constant 1."""
    fixed = np.zeros(count, dtype=bool)
    fixed[0] = True
    for block, portion in zip(blocks, portions, strict=True):
        s = block.kernel.structure
        parts = (
            (portion.signals, s.d_signals, s.fixed_signals),
            (portion.flows, s.d_flows, s.fixed_flows),
            (portion.ledger, s.d_ledger, s.fixed_ledger),
        )
        for first, pairs, which in parts:
            for e in which:
                fixed[first + len(pairs) * np.arange(block.count) + e] = True
    return fixed


def _levels(blocks: Sequence[Block], numbering: Numbering, m: int) -> Integers:
    """Level of every row: signals by rank, then the reactions, then the equations."""
    level = np.zeros(m + numbering.n, dtype=np.int64)
    top = 1 + max((rank for block in blocks for rank in block.ranks), default=0)
    level[len(numbering.signals) : m], level[m:] = top, top + 1
    for block in blocks:
        for k in range(len(block.kernel.structure.outputs)):
            given = block.sig_index[:, k] != numbering.dump
            level[block.sig_index[given, k] - numbering.n] = np.array(block.ranks)[given]
    return level


def _entries(block: Block, portion: Portion, numbering: Numbering, entries: Entries, m: int,
             to_whole: Mapping[int, tuple[int, float]]) -> None:  # fmt: skip
    """What one block adds; in balances of parts also to those of their bodies."""
    s, count = block.kernel.structure, np.arange(block.count)
    kinds = (
        (s.d_signals, portion.signals, "signal"),
        (s.d_flows, portion.flows, "flow"),
        (s.d_ledger, portion.ledger, "ledger"),
    )
    for pairs, first, kind in kinds:
        for e, (k, j) in enumerate(pairs):
            row, coef = _row(block, numbering, kind, k, m)
            used = row >= 0
            partial = first + count * len(pairs) + e
            entries.add(row[used], block.in_index[used, j], partial[used], (coef * block.in_coef[:, j])[used])
            if kind == "flow" and to_whole:
                whole, sign = _wholes(block.flow_index[:, k], to_whole)
                used = whole >= 0
                row = np.where(whole < numbering.n, whole + m, whole - numbering.n + len(numbering.signals))
                entries.add(row[used], block.in_index[used, j], partial[used],
                            (sign * coef * block.in_coef[:, j])[used])  # fmt: skip


def _wholes(rows: Integers, to_whole: Mapping[int, tuple[int, float]]) -> tuple[Integers, Floats]:
    """Rows of w of the bodies of these parts, and how often these count there; -1 where a row is of no part."""
    found = [to_whole.get(row, (-1, 0.0)) for row in rows.tolist()]
    return np.array([whole for whole, _ in found], dtype=np.int64), np.array([sign for _, sign in found])


def _row(block: Block, numbering: Numbering, kind: str, k: int, m: int) -> tuple[Integers, Floats]:
    """Rows of the plan that value k of every instance goes to (-1: nowhere), and its coefficient."""
    one = np.ones(block.count)
    if kind == "signal":
        z = block.sig_index[:, k]
        return np.where(z == numbering.dump, -1, z - numbering.n), one
    if kind == "ledger":
        lines = [line for line in LEDGER if line in block.kernel.structure.ledger]
        place = numbering.ledger.get(lines[k], -1)
        return np.full(block.count, place + m if place >= 0 else -1), one
    w = block.flow_index[:, k]
    row = np.where(w < numbering.n, w + m, w - numbering.n + len(numbering.signals))
    return np.where(w == numbering.w_dump, -1, row), block.flow_coef[:, k]


def _fixed_entries(flat: FlatModel, numbering: Numbering, entries: Entries, m: int) -> None:
    """Rows x' = v, and the inertia at prescribed nodes; their partial derivative is the constant 1."""
    pairs = np.array(numbering.pairs, dtype=np.int64).reshape(-1, 2)
    entries.add(pairs[:, 0] + m, pairs[:, 1], _zeros(len(pairs)), np.ones(len(pairs)))
    for index, a in numbering.accelerated.items():  # m v' = m a, 0 = forces - m a; (v, v): its speed is no position
        v, inertia = numbering.rate[index], flat.groups[index].mass
        entries.add(np.array([v, a, v]) + m, np.array([a, a, v]), _zeros(3), np.array([inertia, -inertia, 0.0]))
    for one in part_rows(flat, numbering):
        entries.add(np.array([one.row + m]), np.array([one.acceleration]), _zeros(1), np.array([-one.mass]))
    for row, mass, a in reaction_masses(flat, numbering):
        entries.add(np.array([len(numbering.signals) + row]), np.array([a]), _zeros(1), np.array([mass]))


def _zeros(count: int) -> NDArray[np.int64]:
    """Position 0 among the partial derivatives, where the constant 1 is."""
    return np.zeros(count, dtype=np.int64)
