"""Nodes without inertia that more rows hold than they have speeds: which entries those rows have in M then.

A row that holds such nodes, with the speeds v of what has inertia and u of what has none, says  A v + B u = 0. A single
one gives the speed of its node at once, without a rate, and is not in M. What holds more is a relation of v alone: by
elimination of u, row by row,

    row i  -  (its entry at u_k / that of the row which gives u_k) (that row)      for all u_k given so far

leaves an entry at some u_k, the largest of which it gives, or nothing there: then  a v = 0  is left, whose rate a is a
row of M. Without it the equations have index 2. Which rows hold is known when M is asked for, so this is done there
(`hold_light` in callbacks/light_rows.py). What always holds, as a sensor or a gear, comes first.

Example: a node between two masses, held to both:  v1 - u = 0 gives u,  u - v2 = 0 becomes  v1 - v2 = 0.

Speeds that are given have a column, too: not of M, but of the rates on the right, where the accelerations of supports
stand. A row that gives a speed has none of them; what is left of them in the others is that of their relation
(`support_light`). Example: a gear, of which one shaft turns as given and one is braked.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from fairlead.component.keys import PORT, key
from fairlead.flatten.graph import connected_parts, of_paths
from fairlead.kernels import layout
from fairlead.kernels.structure import Structure
from fairlead.system.arrays.blocks import Block, Floats, Integers, Memory
from fairlead.system.arrays.portions import Portion, portions
from fairlead.system.assembly.program import Entries as PlanEntries
from fairlead.system.numbering.unknowns import Numbering


class Entries(NamedTuple):
    """Unknown speeds in rows that hold: row, column, partial derivative and what it counts there."""

    row: Integers
    column: Integers
    partial: Integers
    coef: Floats


class Supported(NamedTuple):
    """Accelerations of supports in rows that hold: row, place in z, partial derivative and what it counts there."""

    row: Integers
    z: Integers
    partial: Integers
    coef: Floats


class Part(NamedTuple):
    """Nodes that rows join: the rows, those that always hold first, their entries, and the columns of both kinds."""

    rows: list[int]
    entries: list[list[int]]
    light: list[int]
    heavy: list[int]


def held_entries(blocks: Sequence[Block], laid: Sequence[Portion], numbering: Numbering) -> Entries:
    """Every unknown speed in a row that holds."""
    every = _read(blocks, laid, "")
    known = every.z < numbering.n
    return Entries(every.row[known], every.z[known], every.partial[known], every.coef[known])


def supported_entries(blocks: Sequence[Block], laid: Sequence[Portion], numbering: Numbering) -> Supported:
    """Every acceleration of a support that a row that holds reads."""
    every = _read(blocks, laid, "A")
    given = every.z != numbering.zero
    return Supported(every.row[given], every.z[given], every.partial[given], every.coef[given])


def _read(blocks: Sequence[Block], laid: Sequence[Portion], part: str) -> Supported:
    """What rows that hold read of the ports whose speeds they hold: the speed, or with "A" its given acceleration."""
    row, z, partial = ([np.zeros(0, np.int64)] for _ in range(3))
    coef = [np.zeros(0)]
    for block, portion in zip(blocks, laid, strict=True):
        s, count = block.kernel.structure, np.arange(block.count)
        for e, (unknown, speed) in enumerate(s.mass):
            read = f"{PORT}:{key(s.inputs[speed]).name}:{part}" if part else s.inputs[speed]
            if read not in s.inputs:
                continue
            j = s.inputs.index(read)
            row.append(block.flow_index[:, s.targets.index(f"own:{unknown}")])
            z.append(block.in_index[:, j])
            partial.append(portion.mass + count * len(s.mass) + e)
            coef.append(block.in_coef[:, j])
    return Supported(np.concatenate(row), np.concatenate(z), np.concatenate(partial), np.concatenate(coef))


def light_parts(blocks: Sequence[Block], entries: Entries, numbering: Numbering) -> list[Part]:
    """The parts in which rows may hold more than the nodes without inertia, and something with inertia."""
    inert = np.array([not u.differential for u in numbering.unknowns], dtype=bool)
    if not inert[entries.column].any() or inert[entries.column].all():
        return []
    always = _always_held(blocks)
    of_row: dict[int, list[int]] = {}
    for e, row in enumerate(entries.row.tolist()):
        of_row.setdefault(row, []).append(e)
    nodes = {row: {int(entries.column[e]) for e in those if inert[entries.column[e]]} for row, those in of_row.items()}
    found = []
    for light in connected_parts(of_paths(sorted(set().union(*nodes.values())), map(sorted, nodes.values()))):
        rows = sorted((row for row in of_row if nodes[row] & set(light)), key=lambda row: (row not in always, row))
        those = [of_row[row] for row in rows]
        heavy = {int(entries.column[e]) for some in those for e in some} - set(light)
        if heavy and len(rows) > len(light):
            found.append(Part(rows, those, sorted(light), sorted(heavy)))
    return found


def rows_eliminated(blocks: Sequence[Block], numbering: Numbering) -> set[int]:
    """The rows of these parts."""
    parts = light_parts(blocks, held_entries(blocks, portions(blocks)[0], numbering), numbering)
    return {row for part in parts for row in part.rows}


def relations(parts: Sequence[Part]) -> list[tuple[int, int]]:
    """Row and column of every entry of M that a row of these may have."""
    return [(row, column) for part in parts for row in part.rows for column in part.heavy]


def light_program(
    parts: Sequence[Part], entries: Entries, supported: Supported, place_of: dict[tuple[int, int], int]
) -> Memory:
    """What the callbacks read (the names are explained in layout.py); `place_of` (row, column) is where M has it."""
    spans, rows, slots = list[tuple[int, ...]](), list[tuple[int, ...]](), list[tuple[int, int]]()
    coefs, places, longest = list[float](), list[int](), 0
    supports, ratios, terms = list[tuple[int, int]](), list[float](), list[tuple[int, int]]()
    for part in parts:
        slot = {column: k for k, column in enumerate([*part.light, *part.heavy])}
        first, mine = len(supports), np.flatnonzero(np.isin(supported.row, part.rows))
        supports += [(part.rows.index(int(supported.row[e])), int(supported.partial[e])) for e in mine]
        ratios += supported.coef[mine].tolist()
        span = (len(rows), len(rows) + len(part.rows), len(part.light), len(slot), first, len(supports), len(terms))
        spans.append(span)
        terms += [(row, int(supported.z[e])) for row in part.rows for e in mine]
        longest = max(longest, len(part.rows) * (len(slot) + len(mine)))
        for row, those in zip(part.rows, part.entries, strict=True):
            rows.append((len(slots), len(slots) + len(those), len(places)))
            slots += [(slot[int(entries.column[e])], int(entries.partial[e])) for e in those]
            coefs += [float(entries.coef[e]) for e in those]
            places += [place_of[row, column] for column in part.heavy]
    return {
        "light_parts": np.array(spans, dtype=np.int64).reshape(-1, layout.LIGHT_PART),
        "light_rows": np.array(rows, dtype=np.int64).reshape(-1, layout.LIGHT_ROW),
        "light_entries": np.array(slots, dtype=np.int64).reshape(-1, layout.LIGHT_ENTRY),
        "light_coef": np.array(coefs, dtype=float),
        "light_places": np.array(places, dtype=np.int64),
        "light_supports": np.array(supports, dtype=np.int64).reshape(-1, layout.SUPPORT),
        "light_supports_coef": np.array(ratios, dtype=float),
        "light_terms": np.array(terms, dtype=np.int64).reshape(-1, layout.LIGHT_TERM),
        "light_work": np.zeros(longest),
        "light_given": np.zeros(max((len(part.rows) for part in parts), default=0), dtype=np.int64),
    }


def add_light_entries(entries: PlanEntries, memory: Memory, m: int, first: int) -> None:
    """Add what f has of accelerations of supports; at `first` among the partials begins how much."""
    terms = memory["light_terms"]
    entries.add(
        terms[:, layout.TERM_ROW] + m, terms[:, layout.TERM_Z], first + np.arange(len(terms)), np.ones(len(terms))
    )


def _always_held(blocks: Sequence[Block]) -> set[int]:
    found: set[int] = set()
    for block in blocks:
        s = block.kernel.structure
        for unknown, zones in s.holds.items():
            if len(zones) == len(s.zones):
                found.update(_rows_of(block, s, unknown).tolist())
    return found


def _rows_of(block: Block, s: Structure, unknown: str) -> Integers:
    return np.asarray(block.flow_index[:, s.targets.index(f"own:{unknown}")])
