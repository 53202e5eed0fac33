"""The value of a figure in a result that reached its end."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.cases.figures import Figure
from fairlead.errors import FairleadError, shown
from fairlead.patterns import matcher, picked
from fairlead.result import Result
from fairlead.results.curves import INSIDE
from fairlead.results.events import lasting

POINTS = {1: 3, 2: 5}
"""Of Gauss and Legendre's rule, by the power of the signal: exact for the dense output, which has degree 4."""


def value_of(figure: Figure, result: Result) -> float:
    """The figure, in its unit; NaN for what did not happen.

    Raises what a function of the user raises, and FairleadError where it returns no number.
    """
    if figure.function is None:
        return float(_TOLD[figure.kind](figure, result))
    found = figure.function(result)
    try:
        return float(found)
    except (TypeError, ValueError, OverflowError):
        raise FairleadError(f"{figure.name}: its function returns {shown(found)}, which is no number.") from None


def mean_of(result: Result, name: str, span: tuple[float, ...], power: int = 1) -> float:
    """Mean over time of a signal to a power, along the curves of the steps; nothing goes across a switch."""
    begin, end = span or (float(result.t[0]), float(result.t[-1]))
    edges = np.unique(np.clip(result.t[result.side != INSIDE], begin, end))
    half = np.diff(edges) / 2
    nodes, weights = np.polynomial.legendre.leggauss(POINTS[power])
    times = edges[:-1, None] + half[:, None] * (1 + nodes)
    values: NDArray[np.float64] = result.at(name, times.ravel()).reshape(times.shape)
    return float((values**power @ weights * half).sum() / (end - begin))


def extremes_of(result: Result, pattern: str) -> tuple[float, float]:
    """The lowest and the highest value of the signals of a pattern, as the run found them; NaN where there is none.

    No row of them need have been kept.
    """
    known: Mapping[str, Sequence[float]] = result.run["extremes"]
    found = [known[name] for name in picked(known, pattern)]
    return min((one[0] for one in found), default=math.nan), max((one[2] for one in found), default=math.nan)


def _end(figure: Figure, result: Result) -> float:
    return float(result[result.chosen(figure.signals)[0]][-1])


def _at(figure: Figure, result: Result) -> float:
    return float(result.at(result.chosen(figure.signals)[0], figure.arguments[0]))


def _mean(figure: Figure, result: Result) -> float:
    return mean_of(result, result.chosen(figure.signals)[0], figure.arguments)


def _rms(figure: Figure, result: Result) -> float:
    return math.sqrt(max(mean_of(result, result.chosen(figure.signals)[0], figure.arguments, power=2), 0.0))


def _peak(figure: Figure, result: Result) -> float:
    return extremes_of(result, figure.signals[0])[1]


def _lowest(figure: Figure, result: Result) -> float:
    return extremes_of(result, figure.signals[0])[0]


def _largest(figure: Figure, result: Result) -> float:
    return max(_peak(figure, result), -_lowest(figure, result))


def _time(figure: Figure, result: Result) -> float:
    times, count = _times(figure, result), figure.arguments[2]
    return times[count - 1] if len(times) >= count else math.nan


def _times(figure: Figure, result: Result) -> list[float]:
    component, zone, _ = figure.arguments
    fits = matcher(component)
    chosen = (one for one in result.events if fits(one.component))
    span = float(result.t[-1] - result.t[0]) if len(result.t) else 0.0
    return [one.t for one in lasting(chosen, span) if not zone or one.zone_to == zone]


def _period(figure: Figure, result: Result) -> float:
    times, count = _times(figure, result), figure.arguments[2]
    first = count - 1 if count else len(times) - 2
    return times[first + 1] - times[first] if 0 <= first < len(times) - 1 else math.nan


def _switches(figure: Figure, result: Result) -> float:
    (pattern,) = figure.arguments
    if pattern == "*":
        return len(result.events)
    fits = matcher(pattern)
    return sum(fits(one.component) for one in result.events)


def _margin(figure: Figure, result: Result) -> float:
    """The smallest of all lines; of slip, the farthest that one node slid in a station [m]."""
    from fairlead.analysis.margins.margins import margins

    (word,) = figure.arguments
    lines = margins(result)
    if word == "ruck":
        found = [line.ruck_margin(line.whole) for line in lines]
    elif word == "side_wall":
        found = [line.side_wall_margin(line.whole) for line in lines]
    elif word == "slack":
        found = [None if line.whole.lowest is None else line.whole.lowest.value for line in lines]
    else:
        slid = [line.whole.scuffed.value for line in lines if line.whole.scuffed is not None]
        return max(slid, default=0.0)
    return min((one for one in found if one is not None), default=math.nan)


def _energy(figure: Figure, result: Result) -> float:
    (word,) = figure.arguments
    found = (result.run.get("energy") or {}).get("stored_change" if word == "stored" else word)
    return math.nan if found is None else float(found)


def _broken(figure: Figure, result: Result) -> float:
    return len(result.run.get("limits_broken") or ())


_TOLD: dict[str, Callable[[Figure, Any], float]] = {
    "end": _end, "at": _at, "mean": _mean, "rms": _rms, "peak": _peak, "lowest": _lowest, "largest": _largest,
    "time": _time, "period": _period, "switches": _switches, "margin": _margin, "energy": _energy, "broken": _broken,
}  # fmt: skip
