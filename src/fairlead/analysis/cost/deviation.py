"""How far one run is from another: per output at the end, as rms and at worst; switches and their times apart.

For an output y and its reference r on common times, d = y - r, and relative to the scale of the output

    end = |d(t_end)|        rms = sqrt(mean(d^2))        worst = max |d|

The scale is the range, in the reference or in the run, whichever is larger (friction that is constant in one of them
is wrong by 100 % and not by infinitely much); of the elements of a line (`line.node[*].x`) the largest range of all,
since an element that hardly moves is not to be known better than its neighbours. Statistics serve runs that are
sensitive to everything: the differences of mean and standard deviation over time, relative to the same scale.

A run out of phase is one whose switches come at other times: they are paired by component, zones and order.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.results.signal import family

LEAST_SCALE = 1e-12  # relative to the values themselves: below it an output is constant
NOTHING = 1e-15  # SI: a range that is no motion, force or flow of anything
ROUNDING = 1e-9  # of the largest range in its unit: what varies less, as the slip of a contact that holds, is rounding
Events = Sequence[tuple[float, str, str, str]]


@dataclass(frozen=True)
class OutputError:
    """The error of one output, in its unit; `scale` makes it relative. None of it is signed."""

    name: str
    unit: str
    scale: float
    end: float
    rms: float
    worst: float
    mean: float  # of the means over time
    deviation: float  # of the standard deviations over time

    @property
    def relative(self) -> float:
        """Root mean square error over the scale."""
        return self.rms / self.scale

    @property
    def statistical(self) -> float:
        """The larger of the errors of mean and standard deviation, over the scale."""
        return max(self.mean, self.deviation) / self.scale


@dataclass(frozen=True)
class Switching:
    """How the switches of two runs compare. Times are None when no switch could be paired."""

    mine: int
    theirs: int
    paired: int
    most: float | None  # s; nine of ten switches are nearer
    worst: float | None  # s


def output_errors(
    names: Sequence[str], units: Sequence[str], values: NDArray[np.float64], reference: NDArray[np.float64],
    rows: NDArray[np.bool_] | None = None,
) -> list[OutputError]:  # fmt: skip
    """The error of every output that varies; `values` and `reference` are (k, m), in SI.

    The error is that of some `rows` (k,), or of all; the scale is always that of all.
    Outputs that count or flag (unit 1, whole numbers only) are left to `switching`.
    """
    errors = []
    sizes = np.maximum(scales(names, reference), scales(names, values)).tolist()
    largest: dict[str, float] = defaultdict(float)
    for unit, size in zip(units, sizes, strict=True):
        largest[unit] = max(largest[unit], size)
    for column, (name, unit) in enumerate(zip(names, units, strict=True)):
        mine, theirs, scale = values[:, column], reference[:, column], sizes[column]
        if scale <= ROUNDING * largest[unit] or not (np.all(np.isfinite(mine)) and np.all(np.isfinite(theirs))):
            continue
        if unit == "1" and np.array_equal(theirs, np.round(theirs)):
            continue
        mine, theirs = (mine, theirs) if rows is None else (mine[rows], theirs[rows])
        d = np.abs(mine - theirs)
        errors.append(
            OutputError(
                name, unit, scale, float(d[-1]), float(np.sqrt(np.mean(d**2))), float(d.max()),
                float(abs(mine.mean() - theirs.mean())), float(abs(mine.std() - theirs.std())),
            )
        )  # fmt: skip
    return errors


def scales(names: Sequence[str], values: NDArray[np.float64]) -> list[float]:
    """The range (m,) of each output, or of its family; 0 for what is constant."""
    ranges: dict[str, float] = defaultdict(float)
    size: dict[str, float] = defaultdict(float)
    for column, name in enumerate(names):
        one = values[:, column]
        if np.all(np.isfinite(one)):
            ranges[family(name)[0]] = max(ranges[family(name)[0]], float(np.ptp(one)))
            size[family(name)[0]] = max(size[family(name)[0]], float(np.abs(one).max()))
    kept = {key: value if value > max(LEAST_SCALE * size[key], NOTHING) else 0.0 for key, value in ranges.items()}
    return [kept.get(family(name)[0], 0.0) for name in names]


def worst(errors: Sequence[OutputError], *, statistical: bool = False) -> OutputError | None:
    """The output that is known worst, by its rms or by its statistics."""
    return max(errors, key=lambda e: e.statistical if statistical else e.relative, default=None)


def switching(mine: Events, theirs: Events) -> Switching:
    """Pair the k-th switch of a component between two zones with the k-th of the other run; compare the times."""
    one, other = _by_kind(mine), _by_kind(theirs)
    apart = [abs(a - b) for kind in one.keys() & other.keys() for a, b in zip(one[kind], other[kind], strict=False)]
    most = float(np.quantile(apart, 0.9)) if apart else None
    return Switching(len(mine), len(theirs), len(apart), most, max(apart, default=None))


def _by_kind(events: Events) -> dict[tuple[str, str, str], list[float]]:
    found = defaultdict(list)
    for t, component, before, after in events:
        found[component, before, after].append(t)
    return found
