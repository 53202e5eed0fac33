"""What depends on what in the zones in force: the facts of every kernel (kernels/dependence.py) laid over one System.

A value is a signal of one instance that something reads, what it adds to one row, or its line of the energy ledger. It
depends on a place of z if it does on a sum of inputs that changes when that place does: two ends of a spring that
follow one place as fast as each other do not change their difference. So do the members of guards.

Nothing is evaluated but the sums of coefficients and, of guards that are groups, the members: one that is negative and
depends on nothing keeps its guard from firing.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.component.keys import OWN, key
from fairlead.component.piecewise import DEGREE, FAR, STRIDE, TERMS
from fairlead.kernels import layout
from fairlead.kernels.structure import PIECES, Sum
from fairlead.system.active.entrained import Entrained
from fairlead.system.active.rest import Booleans, Floats, Integers
from fairlead.system.arrays.blocks import Block
from fairlead.system.arrays.portions import portions
from fairlead.system.compiled.asking import ask
from fairlead.system.compiled.system import Instance

NOBODY = -2
"""In the place of a row: an output, which is a signal or nothing."""


class Laws(NamedTuple):
    """The laws of a System, instance after instance of all blocks, and their values.

    value     of the law `law`; it is the signal z[`gives`] or goes to the row w[`row`] (-1: neither)
    law       `restless` ones vary with nothing that they read, `zoned` ones may depend on other places in
              another zone, and some have `unknowns` of their own
    """

    law: Integers
    gives: Integers
    row: Integers
    restless: Booleans
    zoned: Booleans
    unknowns: Booleans


class Dependences(NamedTuple):
    """Pairs (value, z) and (member, z, slope): what stands there moves the value, or the member so much."""

    value: Integers
    value_z: Integers
    member: Integers
    member_z: Integers
    slope: Floats
    members: Members


class Members(NamedTuple):
    """Members of the guards in force: of which guard and law, at which border, what they are now, and how straight.

    At one `border` are guards of one class and zone in the same pieces of the same tables: for all nodes that are on
    one side of a bend, where it begins.
    `straight` is the slope over the one port they read, where they are that and a constant; else 0.
    """

    guard: Integers
    law: Integers
    border: Integers
    now: Floats
    straight: Floats


def laws(system: Instance) -> Laws:
    """All laws of a System."""
    columns = [_values(block, system.numbering.dump) for block in system.blocks]
    counts = [block.count for block in system.blocks]
    starts = np.cumsum([0, *counts])
    structures = [block.kernel.structure for block in system.blocks]
    return Laws(
        np.concatenate([first + law for first, (law, _, _) in zip(starts, columns, strict=False)]),
        np.concatenate([gives for _, gives, _ in columns]), np.concatenate([row for _, _, row in columns]),
        np.repeat([bool(s.period or s.time_tables) for s in structures], counts),
        np.repeat([s.machines > 0 for s in structures], counts),
        np.repeat([any(key(t).kind == OWN for t in s.targets) for s in structures], counts),
    )  # fmt: skip


def _values(block: Block, dump: int) -> tuple[Integers, Integers, Integers]:
    s, count = block.kernel.structure, block.count

    def row_by_row(*columns: NDArray[Any]) -> Integers:
        return np.concatenate(columns, axis=1).ravel().astype(np.int64)

    outputs, targets, ledger = ((count, len(names)) for names in (s.outputs, s.targets, s.ledger))
    signals = np.where(block.sig_index == dump, -1, block.sig_index).reshape(outputs)
    return (
        np.repeat(np.arange(count), len(s.outputs) + len(s.targets) + len(s.ledger)),
        row_by_row(signals, np.full(targets, -1), np.full(ledger, -1)),
        row_by_row(np.full(outputs, NOBODY), block.flow_index.reshape(targets), np.full(ledger, -1)),
    )


def dependences(system: Instance, of: Laws, along: Entrained, guards: Floats) -> Dependences:
    """What depends on what in the zones in force, with what is entrained; `guards` as they are there.

    The bonds of what is entrained depend on nothing: they are what makes it follow.
    """
    found = _Found()
    value = law = borders = 0
    for number, (block, portion) in enumerate(zip(system.blocks, portions(system.blocks)[0], strict=True)):
        s = block.kernel.structure
        width = len(s.outputs) + len(s.targets) + len(s.ledger)
        of_groups, rows = _group_members(system, number), _rows(system, block)
        for which, said in _alike(system, block, rows):
            reach, k, pieces = _Reach(block, which, along), 0, _same(rows[which])
            for j, sums in enumerate(said["values"]):
                found.value(reach, sums, value + which * width + j)
            for slot, members in enumerate(said["guards"]):
                guard, size = portion.guards + which * s.slots + slot, len(members)
                now = [guards[guard]] if size == 1 else list(of_groups[which, k : k + size].T)
                found.guard(reach, members, (guard, law + which, borders + pieces), now)
                borders, k = borders + len(which), k + (size if size > 1 else 0)
        value, law = value + block.count * width, law + block.count
    return found.dependences(of, along)


class _Reach:
    """Some instances of a block that are in the same zone: where their inputs lie and how much of what stands there."""

    def __init__(self, block: Block, which: Integers, along: Entrained) -> None:
        at = block.in_index[which]
        self.place, self.coef = along.place[at], block.in_coef[which] * along.ratio[at]
        self._known: dict[Any, list[tuple[Integers, Integers, Floats]]] = {}

    def along(self, sum_: Sum) -> list[tuple[Integers, Integers, Floats]]:
        """Instance, place, slope: where this sum of inputs changes with a place, and how much."""
        key = tuple(tuple(term) for term in sum_)
        if key not in self._known:
            self._known[key] = list(self._totals(sum_))
        return self._known[key]

    def _totals(self, sum_: Sum) -> Iterator[tuple[Integers, Integers, Floats]]:
        at = [(self.place[:, j], self.coef[:, j] * c) for j, c in sum_]
        for k, (place, _) in enumerate(at):
            total = np.zeros(len(place))
            for other, slope in at:
                total += np.where(other == place, slope, 0.0)
            for before, _ in at[:k]:  # told already
                total[before == place] = 0.0
            does = np.flatnonzero(total)
            yield does, place[does], total[does]


class _Found:
    """What has been found so far, as lists of arrays."""

    def __init__(self) -> None:
        self._values: list[tuple[Integers, Integers]] = []
        self._slopes: list[tuple[Integers, Integers, Floats]] = []
        self._members: list[tuple[NDArray[Any], ...]] = []
        self._count = 0

    def value(self, reach: _Reach, sums: Sequence[Sum], numbers: Integers) -> None:
        """One value of these instances, which has these numbers."""
        self._values += [(numbers[does], place) for sum_ in sums for does, place, _ in reach.along(sum_)]

    def guard(
        self, reach: _Reach, members: Sequence[dict[str, Any]], of: tuple[Integers, ...], now: Sequence[Floats]
    ) -> None:
        """A guard of these instances: number, law, border; its members are `now`. At a table's end it leads nowhere."""
        for member, value in zip(members, now, strict=True):
            leads, numbers = value > -FAR, self._count + np.arange(len(value))
            for does, place, slope in (one for sum_ in member["sums"] for one in reach.along(sum_)):
                some = leads[does]
                self._slopes.append((numbers[does][some], place[some], slope[some]))
            single = len(members) == 1 and member["straight"] and len(member["sums"][0]) == 1
            slope_of_port = member["sums"][0][0][1] if single else 0.0
            self._members.append((*of, value, np.full(len(value), slope_of_port)))
            self._count += len(value)

    def dependences(self, of: Laws, along: Entrained) -> Dependences:
        """All of it, but what the bonds of what is entrained give, and what nobody wants to know."""
        value, value_z = _columns(self._values, np.int64, np.int64)
        told = ((of.gives >= 0) | (of.row != NOBODY))[value] & ~np.isin(of.law[value], along.laws)
        members = Members(*_columns(self._members, *3 * (np.int64,), *2 * (np.float64,)))
        member, member_z, slope = _columns(self._slopes, np.int64, np.int64, np.float64)
        return Dependences(value[told], value_z[told], member, member_z, slope, members)


def _columns(rows: Sequence[tuple[NDArray[Any], ...]], *types: Any) -> list[NDArray[Any]]:
    return [np.concatenate([np.zeros(0, kind), *(row[k] for row in rows)]) for k, kind in enumerate(types)]


def _alike(system: Instance, block: Block, rows: Integers) -> Iterator[tuple[Integers, dict[str, Any]]]:
    """Instances of a block that are in the same zone and pieces of the same kinds; and what is true of them."""
    s, kinds = block.kernel.structure, _kinds(system.memory["tables"], rows)
    zone = system.zones[block.machines[:, 0]] if len(s.zones) > 1 else np.zeros(block.count, dtype=np.int64)
    label = _same(np.column_stack([zone, kinds]))
    for k in np.unique(label).tolist():
        known = s.reads[s.zones[zone[k]]]
        letters = "".join(PIECES[kind] for kind in kinds[k].tolist())
        yield np.flatnonzero(label == k), known.get(letters, known["v" * len(letters)])


def _same(rows: Integers) -> Integers:
    """By row: the first row that is the same."""
    if not rows.shape[1]:
        return np.zeros(len(rows), dtype=np.int64)
    _, first, which = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return first[which.ravel()]


def _rows(system: Instance, block: Block) -> Integers:
    """Where the pieces in force begin of the tables that are read at a place; shape (instance, table)."""
    s = block.kernel.structure
    numbers = np.array([s.tables.index(path) for path in s.place_tables], dtype=np.int64)
    machines = block.machines[:, s.machines - len(s.tables) + numbers]
    return block.table_base[:, numbers] + STRIDE * system.zones[machines]


def _kinds(tables: Floats, rows: Integers) -> Integers:
    """Of what kind every piece is, as a position in PIECES."""
    terms = tables[rows[..., None] + TERMS + np.arange(DEGREE + 1)]
    level = (terms[..., 1:] == 0).all(axis=-1)
    kinds = [level & (terms[..., 0] == 0), level & (terms[..., 0] == 1), level]
    return np.select(kinds, [0, 1, 2], 3)


def _group_members(system: Instance, number: int) -> Floats:
    """Values (count, members) of the members of guards that are groups, of one block, for what stands in z."""
    block = system.blocks[number]
    made = np.zeros((block.count, block.kernel.structure.members))
    if made.size:
        ask(system, number, layout.MEMBERS, np.ones(block.count, dtype=bool), made)
    return made
