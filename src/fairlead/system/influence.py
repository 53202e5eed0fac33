"""What the laws of a System answer to: which of their values move when what they read does, at given points.

A value is a signal of one instance that something reads, what it adds to one row, or its line of the energy ledger.
Whether it answers is said by the partial derivatives at those points, not by what it may depend on in some zone: a
contact that is apart from everything answers to nothing, nor does the load of a bend on a node that is not in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.system.blocks import Block
from fairlead.system.rest import Booleans, Floats, Integers
from fairlead.system.shares import Share, shares
from fairlead.system.system import System

NOBODY = -2
"""In the place of a row: an output, which is a signal or nothing."""
ANSWERS = 1e-9
"""Share of its terms that a sum of partial derivatives must have not to be a rounding error."""


class Influence(NamedTuple):
    """Entries (value, z, partial, coef), and what every value belongs to and is.

    entry     value number `value` reads z[`z`] with the coefficient `coef`; its derivative is partials[`partial`]
    value     of the law `law`; it is the signal z[`gives`] or goes to the row w[`row`] (-1: neither)
    law       instance after instance of all blocks; `restless` ones change without anything that they read,
              `zoned` ones may answer otherwise in another zone
    """

    value: Integers
    z: Integers
    partial: Integers
    coef: Floats
    law: Integers
    gives: Integers
    row: Integers
    restless: Booleans
    zoned: Booleans


def influence(system: System) -> Influence:
    """All entries of a System."""
    entries, values, restless, zoned = [], [], [], []
    laws = count = 0
    for block, share in zip(system.blocks, shares(system.blocks)[0], strict=True):
        entries += _entries(block, share, count)
        values.append(_values(block, laws, system.numbering.dump))
        s = block.kernel.structure
        restless.append(np.full(block.count, bool(s.period or s.time_tables)))
        zoned.append(np.full(block.count, s.machines > 0))
        laws, count = laws + block.count, count + len(values[-1][0])
    value, z, partial, coef = (np.concatenate(column) for column in zip(*entries, strict=True))
    law, gives, row = (np.concatenate(column) for column in zip(*values, strict=True))
    counts = (gives >= 0) | (row != NOBODY)
    used = counts[value]
    value, z, partial, coef = value[used], z[used], partial[used], coef[used]
    return Influence(value, z, partial, coef, law, gives, row, np.concatenate(restless), np.concatenate(zoned))


def _entries(block: Block, share: Share, first: int) -> list[tuple[NDArray, ...]]:
    s, instance = block.kernel.structure, np.arange(block.count)
    width = len(s.outputs) + len(s.targets) + len(s.ledger)
    kinds = (
        (s.d_signals, share.signals, 0),
        (s.d_flows, share.flows, len(s.outputs)),
        (s.d_ledger, share.ledger, len(s.outputs) + len(s.targets)),
    )
    return [
        (first + instance * width + before + k, block.in_index[:, j], at + instance * len(pairs) + e,
         block.in_coef[:, j])
        for pairs, at, before in kinds
        for e, (k, j) in enumerate(pairs)
    ]  # fmt: skip


def _values(block: Block, first: int, dump: int) -> tuple[Integers, Integers, Integers]:
    s, count = block.kernel.structure, block.count

    def row_by_row(*columns: NDArray) -> Integers:
        return np.concatenate(columns, axis=1).ravel().astype(np.int64)

    outputs, targets, ledger = ((count, len(names)) for names in (s.outputs, s.targets, s.ledger))
    signals = np.where(block.sig_index == dump, -1, block.sig_index).reshape(outputs)
    return (
        np.repeat(first + np.arange(count), len(s.outputs) + len(s.targets) + len(s.ledger)),
        row_by_row(signals, np.full(targets, -1), np.full(ledger, -1)),
        row_by_row(np.full(outputs, NOBODY), block.flow_index.reshape(targets), np.full(ledger, -1)),
    )


class Answers(NamedTuple):
    """Pairs (value, place in z): the value moves with what stands there."""

    value: Integers
    z: Integers


class Paths(NamedTuple):
    """Entries with the places that stand for theirs, of which several may be one: see `answers`."""

    value: Integers
    z: Integers
    pair: Integers
    """By entry: its pair of `value` and `z`."""
    coef: Floats
    partial: Integers


def paths(found: Influence, follow: Integers, ratio: Floats) -> Paths:
    """The entries where places follow others, `ratio` times as far, and so count as those."""
    reach = len(follow)
    key, pair = np.unique(found.value * reach + follow[found.z], return_inverse=True)
    return Paths(key // reach, key % reach, pair, found.coef * ratio[found.z], found.partial)


def answers(along: Paths, partials: Sequence[Floats]) -> Answers:
    """Who answers to what at the points where these partial derivatives hold.

    What moves along with all that it touches answers to nothing.
    """
    does = np.zeros(len(along.value), dtype=bool)
    for partial in partials:
        term = partial[along.partial] * along.coef
        total, size = (np.bincount(along.pair, weights=part, minlength=len(does)) for part in (term, np.abs(term)))
        does |= ~(np.abs(total) <= ANSWERS * size)
    return Answers(along.value[does], along.z[does])


def spread(
    found: Influence, which: Answers, moves: Booleans, may_rest: Booleans, varies: Booleans
) -> tuple[Booleans, Booleans]:
    """From the places in z that move, all that do; and by law: whether it has a value that moves.

    `may_rest` tells of the unknowns that rest unless their own row moves, `varies` of laws taken to move in any case.
    """
    moves, laws, always = moves.copy(), np.zeros(len(found.restless), dtype=bool), found.restless | varies
    while True:
        value = (always | (laws & found.zoned))[found.law]
        value[which.value[moves[which.z]]] = True
        more = moves.copy()
        more[found.gives[value & (found.gives >= 0)]] = True
        row = found.row[value & (found.row >= 0) & (found.row < len(may_rest))]
        more[row[may_rest[row]]] = True
        now = np.zeros(len(laws), dtype=bool)
        now[found.law[value]] = True
        if (more == moves).all() and (now == laws).all():
            return moves, laws
        moves, laws = more, now
