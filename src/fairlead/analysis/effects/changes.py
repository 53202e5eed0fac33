"""What a switch changes in every output: at the end, as rms and at its peaks, in a window of time.

For an output y of the scene with a switch and r of the scene as it is, on common times, with d = y - r

    rms = sqrt(mean(d^2)) / scale     end = |d(t_end)| / scale     peak = (|max y - max r| or |min y - min r|) / largest

with the scale of `deviation.py`, the range; `largest` is the largest magnitude, since a peak is a design number by
itself. The elements of a line (`line.hose[*].tension`) are one output: means and peaks go over all of them too, since
which of them sticks when is nobody's design. A measure that a run at a tenth of the accuracy changes by half as much
is no change, output by output: one that is sensitive does not hide what happens to the others.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.cost.deviation import OutputError, output_errors
from fairlead.results.signal import family

MEASURES = {"rms": "as rms", "end": "at the end", "peak": "at its peaks"}
SURE = 2.0  # times what a more exact run changes: more is a change
Floors = Mapping[tuple[str, str], float]  # output and measure -> what a more exact run changes


@dataclass(frozen=True)
class Change:
    """How an output changes, each relative; `error` has the same in its unit."""

    error: OutputError
    rms: float
    end: float
    peak: float

    @property
    def name(self) -> str:
        """The output."""
        return self.error.name


@dataclass(frozen=True)
class Worst:
    """The measure that changes most, and in which output."""

    change: Change
    measure: str

    @property
    def value(self) -> float:
        """How much, relative."""
        return float(getattr(self.change, self.measure))


def changes(
    names: Sequence[str], units: Sequence[str], values: NDArray[np.float64], reference: NDArray[np.float64],
    rows: NDArray[np.bool_] | None = None,
) -> list[Change]:  # fmt: skip
    """Every output that varies; `values` and `reference` are (k, m), in SI.

    Changes are those in some `rows` (k,), or in all; they are relative to the range and the magnitude of all rows, so
    that the ripple of what is steady in a window is not taken for its size.
    """
    rows = np.ones(len(values), dtype=bool) if rows is None else rows
    if not rows.any():
        return []
    columns = {name: column for column, name in enumerate(names)}
    found = sorted(output_errors(names, units, values, reference, rows), key=lambda one: _called(one.name))
    told = []
    for name, group in itertools.groupby(found, key=lambda one: _called(one.name)):
        members = list(group)
        places = [columns[one.name] for one in members]
        mine, theirs = values[:, places], reference[:, places]
        most = float(max(np.abs(mine).max(), np.abs(theirs).max()))
        mine, theirs = mine[rows], theirs[rows]
        apart = max(abs(float(mine.max() - theirs.max())), abs(float(mine.min() - theirs.min())))
        error = _together(members[0].name if len(members) == 1 else name, members)
        told.append(Change(error, error.relative, error.end / error.scale, apart / most if most else 0.0))
    return told


def _called(name: str) -> str:
    """The family of an element of a line, or the output itself."""
    key, index = family(name)
    return name if index is None else key


def _together(name: str, members: Sequence[OutputError]) -> OutputError:
    """One error for all elements of a line, in the mean over them."""
    rms, end = (math.sqrt(float(np.mean([getattr(one, key) ** 2 for one in members]))) for key in ("rms", "end"))
    return replace(members[0], name=name, rms=rms, end=end, worst=max(one.worst for one in members))


def floors(of_exact: Sequence[Change]) -> Floors:
    """What the error of the run itself may be, from the changes that a more exact run makes."""
    return {(one.name, measure): getattr(one, measure) for one in of_exact for measure in MEASURES}


def worst_of(found: Sequence[Change], below: Floors) -> Worst | None:
    """The worst of all measures of all outputs that is a change; None when nothing is."""
    said = [
        Worst(one, measure) for one in found for measure in MEASURES
        if getattr(one, measure) > SURE * below.get((one.name, measure), 0.0)
    ]  # fmt: skip
    return max(said, key=lambda one: one.value, default=None)
