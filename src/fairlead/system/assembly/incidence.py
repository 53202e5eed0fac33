"""Which equation may contain which unknown, by the structure of the laws alone.

At a point with its zones frozen the rates of differential unknowns and the values of algebraic ones are to be found.
So for an unknown j the rows that count are

    differential     row i    M_ij may be non-zero in the zones in force
    algebraic        row i    df_i/dy_j may be non-zero in them
"""

from __future__ import annotations

import functools

import numpy as np
from numpy.typing import NDArray

from fairlead.flatten.flat_model import FlatModel
from fairlead.system.arrays.blocks import Block
from fairlead.system.arrays.portions import portions
from fairlead.system.assembly.algebraic_nodes import rows_without_rates
from fairlead.system.assembly.light_holds import held_entries, light_parts, relations
from fairlead.system.numbering.unknowns import Numbering, part_rows


def incidence(flat: FlatModel, numbering: Numbering, blocks: list[Block], *, start: bool) -> list[set[int]]:
    """Per unknown the rows that may contain it, in the zones of the `start` or in any."""
    rows_of: list[set[int]] = [{j} if u.differential else set() for j, u in enumerate(numbering.unknowns)]
    algebraic = np.array([not u.differential for u in numbering.unknowns])
    rated = {numbering.rate[index] for index in numbering.rated}
    for x, v in numbering.pairs:
        if algebraic[v]:
            rows_of[v] |= {x, v} if v in rated else {x}
    for index, a in numbering.accelerated.items():
        rows_of[a] |= {a, numbering.rate[index]}
    balances = part_rows(flat, numbering)
    for part in balances:
        if part.acceleration < numbering.n and part.mass > 0:
            rows_of[part.acceleration].add(part.row)
    to_whole = {part.row: part.whole for part in balances if part.whole < numbering.n}
    signals = _Signals(numbering, blocks, algebraic)
    for block in blocks:
        s = block.kernel.structure
        for zone in s.zones[:1] if start else s.zones:
            for k, target in enumerate(s.targets):
                for one in s.flow_inputs[zone].get(target, ()):
                    _enter(rows_of, block, k, s.inputs.index(one), signals, to_whole)
    _enter_rates(rows_of, numbering, blocks, algebraic, start=start)
    for pair in numbering.circles:
        force = numbering.own[pair.path, pair.unknown]
        sharing = {force, *(numbering.share[index] for index, _ in pair.ends if index in numbering.share)}
        for at in sharing:
            rows_of[at] |= sharing
    return rows_of


def _enter_rates(
    rows_of: list[set[int]], numbering: Numbering, blocks: list[Block], algebraic: NDArray[np.bool_], *, start: bool
) -> None:
    """Rows that hold contain the rates of the speeds they hold, also those they hold through nodes without inertia."""
    without, held = rows_without_rates(blocks, numbering), set[int]()
    for block in blocks:
        s = block.kernel.structure
        for unknown, j in s.mass:
            if s.zones[0] in s.holds[unknown] or not start:
                row, column = block.flow_index[:, s.targets.index(f"own:{unknown}")], block.in_index[:, j]
                held.update(row.tolist())
                in_mass = (column < numbering.n) & ~np.isin(row, without)
                for r, c in zip(row[in_mass].tolist(), column[in_mass].tolist(), strict=True):
                    if not algebraic[c]:
                        rows_of[c].add(r)
    for r, c in relations(light_parts(blocks, held_entries(blocks, portions(blocks)[0], numbering), numbering)):
        if r in held:
            rows_of[c].add(r)


def _enter(rows_of: list[set[int]], block: Block, k: int, j: int, signals: _Signals, to_whole: dict[int, int]) -> None:
    """Target k of every instance contains input j; with the balance of a part, that of its body too."""
    n, algebraic = signals.n, signals.algebraic
    for row, z in zip(block.flow_index[:, k].tolist(), block.in_index[:, j].tolist(), strict=True):
        if row < n:
            for column in (z,) if z < n else signals.columns(z - n):
                if algebraic[column]:
                    rows_of[column] |= {row, to_whole.get(row, row)}


class _Signals:
    """Which algebraic unknowns the value of a signal depends on, through other signals too."""

    def __init__(self, numbering: Numbering, blocks: list[Block], algebraic: NDArray[np.bool_]) -> None:
        self.n, self.dump, self.algebraic = numbering.n, numbering.dump, algebraic
        self.blocks = blocks
        self.known: dict[int, set[int]] = {}

    @functools.cached_property
    def inputs(self) -> dict[int, list[int]]:
        """Per signal, the places in z that it reads."""
        found: dict[int, list[int]] = {}
        for block in self.blocks:
            for k, j in block.kernel.structure.d_signals:
                for signal, z in zip(block.sig_index[:, k].tolist(), block.in_index[:, j].tolist(), strict=True):
                    if signal != self.dump:
                        found.setdefault(signal - self.n, []).append(z)
        return found

    def columns(self, signal: int) -> set[int]:
        """The unknowns a signal depends on; empty for reactions, zero and time."""
        if signal not in self.known:
            self.known[signal] = set()
            for z in self.inputs.get(signal, ()):
                self.known[signal] |= ({z} if self.algebraic[z] else set()) if z < self.n else self.columns(z - self.n)
        return self.known[signal]
