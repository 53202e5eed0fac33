"""Recorded signals that stay below their own error weight during a run: motion smaller than its tolerance.

The engine keeps the error of an unknown below its weight (`system/numbering/tolerances.py`), so the course of one
that never gets as large as that is not resolved. Judged are outputs that are a position, a speed or another unknown,
or a sum of such of one unit. Of positions the way counts, of all else the largest size. Signals of one family
(`line.core[*].v`) are judged together, by the one that is largest: where some nodes of a line move, the others may
rest. What is zero but for rounding is at rest. At a contact that creeps while it sticks, so slow a motion is its
creep, which every run tells by itself (`creep.py`); nodes of such contacts are left out.
"""

from __future__ import annotations

import math
import weakref
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.results.signal import family
from fairlead.system.arrays.portions import portions
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.compiled.system import System

AT_REST = 1e-6  # of the weight; what is smaller is taken for rounding
WANTED = 100.0  # sizes of a signal in its weight with the accuracy that is proposed
FINEST = 1e-12  # of run.accuracy
MOST_NAMED = 3
Floats = NDArray[np.float64]


@dataclass
class BelowWeight:
    """Watches m recorded signals, in columns `columns` of the rows of a run."""

    names: Sequence[str]
    units: Sequence[str]
    columns: NDArray[np.int64]
    weights: Floats
    """[m]: the error weight of the unknown behind a signal, the largest where there are several."""
    moves: NDArray[np.bool_]
    """[m]: whether the way counts, not the size."""
    accuracy: float
    least: Floats = field(init=False)
    most: Floats = field(init=False)

    def __post_init__(self) -> None:
        """Nothing seen yet."""
        self.least, self.most = np.full(len(self.names), np.inf), np.full(len(self.names), -np.inf)

    @classmethod
    def of(cls, system: System, chosen: Sequence[OutputSignal], accuracy: float) -> BelowWeight:
        """Those among the signals asked for, which are the first columns."""
        found = dict(_weights(system, accuracy)) if chosen else {}
        mine = [(k, one, *found[one.at]) for k, one in enumerate(chosen) if one.at in found and not one.role]
        return cls(
            [one.name for _, one, *_ in mine], [one.unit for _, one, *_ in mine],
            np.array([k for k, *_ in mine], dtype=np.int64), np.array([weight for *_, weight, _ in mine]),
            np.array([moves for *_, moves in mine], dtype=bool), accuracy,
        )  # fmt: skip

    def watch(self, rows: Floats) -> None:
        """Take recorded rows, shape (k, recorded)."""
        if not len(rows) or not len(self.names):
            return
        mine = rows[:, self.columns]
        self.least = np.fmin(self.least, np.fmin.reduce(mine, axis=0))
        self.most = np.fmax(self.most, np.fmax.reduce(mine, axis=0))

    def summary(self) -> list[dict[str, Any]]:
        """For run.json, by family: `signal` pattern, `size` and `weight` in `unit`, whether it `moves`."""
        size = np.where(self.moves, self.most - self.least, np.maximum(np.abs(self.most), np.abs(self.least)))
        largest: dict[str, int] = {}
        for k, name in enumerate(self.names):
            one = family(name)[0]
            if np.isfinite(size[k]) and (
                one not in largest or size[k] * self.weights[largest[one]] > size[largest[one]] * self.weights[k]
            ):
                largest[one] = k
        return [
            {"signal": one, "size": float(size[k]), "weight": float(self.weights[k]), "unit": self.units[k],
             "moves": bool(self.moves[k])}
            for one, k in largest.items()
            if AT_REST * self.weights[k] < size[k] < self.weights[k]
        ]  # fmt: skip

    def remarks(self) -> list[str]:
        """A sentence on them and the way out; none where all is larger or at rest."""
        found = self.summary()
        if not found:
            return []
        named = "; ".join(_told(one) for one in found[:MOST_NAMED])
        more = f"; and {len(found) - MOST_NAMED} more" if len(found) > MOST_NAMED else ""
        what = f"{named}{more}. The error may be as large as the signal."
        finer = self.accuracy * min(one["size"] / one["weight"] for one in found) / WANTED
        finer = 10.0 ** math.floor(math.log10(finer) + 1e-9)
        if finer < FINEST:
            return [f"{what} No accuracy is fine enough; take it for rest."]
        way_out = f"ask for run.accuracy: {finer:.0e} (it was {self.accuracy:g}), or tell its size under `nominal`"
        return [f"{what} If it matters, {way_out}."]


def rows_of_table(found: Sequence[Mapping[str, Any]] | None) -> list[tuple[str, str]]:
    """(what, value) for the closing table of a run; nothing where none is."""
    return [("below its weight", _told(one)) for one in (found or ())[:MOST_NAMED]]


def _told(one: Mapping[str, Any]) -> str:
    """A signal with its size and its weight."""
    says = "moves by" if one["moves"] else "is at most"
    return f"{one['signal']} {says} {one['size']:.2g} {one['unit']}, its error weight is {one['weight']:.2g}"


class _Sums(NamedTuple):
    """Outputs of one block that are sums of unknowns of one unit."""

    places: list[int]
    """[m]: among all outputs."""
    sizes: Floats
    """[m, terms]: sizes of the factors of the unknowns, 0 where there is none."""
    unknowns: NDArray[np.int64]
    """[m, terms]"""
    moves: NDArray[np.bool_]
    """[m]: whether all of them are positions."""


_SUMS: weakref.WeakKeyDictionary[System, list[_Sums]] = weakref.WeakKeyDictionary()


def _weights(system: System, accuracy: float) -> list[tuple[int, tuple[float, bool]]]:
    """Place among all outputs -> weight, and whether it is a sum of positions, of those that are sums of unknowns."""
    assert system.scales is not None, "a part has the weights of the whole"
    given = system.scales.weights(accuracy)
    weight = np.minimum(given.absolute, given.cap)
    found = list[tuple[int, tuple[float, bool]]]()
    for one in _sums(system):
        sizes = np.max(np.where(one.sizes > 0.0, weight[one.unknowns] * one.sizes, 0.0), axis=1)
        found += zip(one.places, zip(sizes.tolist(), one.moves.tolist(), strict=True), strict=True)
    return found


def _sums(system: System) -> list[_Sums]:
    """What of that is the same in every run of a system."""
    if (known := _SUMS.get(system)) is None:
        known = _SUMS[system] = list(_sums_of(system))
    return known


def _sums_of(system: System) -> Iterator[_Sums]:
    assert system.scales is not None, "a part has the weights of the whole"
    creeping = np.isfinite(system.scales.creep)
    creeping[[x for x, v in system.numbering.pairs if creeping[v]]] = True
    units = np.array([unknown.unit for unknown in system.numbering.unknowns])
    position = np.array([unknown.kind == "position" for unknown in system.numbering.unknowns])
    for block, portion in zip(system.blocks, portions(system.blocks)[0], strict=True):
        s, declared = block.kernel.structure, block.kernel.variant.type.declaration.outputs
        fixed = set(s.fixed_signals)
        for k, name in enumerate(s.outputs):
            mine = [(place, j) for place, (output, j) in enumerate(s.d_signals) if output == k]
            if name not in declared or not mine or k in s.curved or any(place not in fixed for place, _ in mine):
                continue
            inputs = [j for _, j in mine]
            ratio = np.abs(block.in_coef[:, inputs])
            counts = (ratio > 0.0) & (block.in_index[:, inputs] < system.n)
            at = np.where(counts, block.in_index[:, inputs], 0)
            other = creeping[at] | np.not_equal(units[at], declared[name].unit)
            judged = np.flatnonzero(counts.any(axis=1) & ~(counts & other).any(axis=1))
            moves = np.all(position[at] | ~counts, axis=1)
            places = portion.outputs + k + judged * len(s.all_outputs)
            yield _Sums(places.tolist(), np.where(counts, ratio, 0.0)[judged], at[judged], moves[judged])
