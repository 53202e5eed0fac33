"""How hose and core of a run shared the tension, beside what statics estimates of it.

Statics knows the tension of both together; how they share it is an estimate for an array that comes from rest
(`shares.py`). Two comparisons, in N and with a sign: statics less run, so that above zero the estimate is too high,
which for the compression of a hose is the unsafe side.

    shares    means over the second half of every stretch of steady speed, in the spans between the devices
    lowest    the lowest tension of the hose: over all of the run, and in the table of `fairlead statics`
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from fairlead.analysis.margins.margins import LineMargins
from fairlead.analysis.record.recorded_line import Floats, RecordedLine
from fairlead.analysis.statics.schedule import Stretch
from fairlead.analysis.statics.shares import Shares, shares
from fairlead.analysis.statics.solution import Statics
from fairlead.analysis.statics.states import State

LAYERS = ("hose", "core")
LOOKS = 100  # instants of a stretch at which a run is asked


def mean_along(line: RecordedLine, tensions: Floats, places: Sequence[float], stretch: Stretch) -> Any:
    """Mean over a stretch of tensions (rows, elements) [N] at places of the route; no burst of events weighs."""
    assert line.places is not None
    rows = np.searchsorted(line.result.t, np.linspace(stretch.begin, stretch.end, LOOKS))
    rows = rows.clip(max=len(line.result.t) - 1)
    return np.mean([np.interp(places, line.places[row], tensions[row]) for row in rows], axis=0)


def shares_compared(
    line: RecordedLine, states: Sequence[State], spans: Sequence[tuple[str, float]], stretch: Stretch
) -> Iterator[dict[str, Any]]:
    """Both layers in all spans (name, place) of one stretch; nothing for a line of one layer."""
    found = [shares(one) for one in states]
    if not spans or line.layers is None or len(line.layers) != len(LAYERS) or any(one is None for one in found):
        return
    places = [place for _, place in spans]
    told = {name: mean_along(line, each, places, stretch) for name, each in zip(LAYERS, line.layers, strict=True)}
    wanted = {name: np.mean([_at(*one, name, places) for one in zip(states, found, strict=True)], axis=0)
              for name in LAYERS}  # fmt: skip
    for k, (name, place) in enumerate(spans):
        tensions = {layer: {"run": float(told[layer][k]), "statics": float(wanted[layer][k])} for layer in LAYERS}
        hose = tensions[LAYERS[0]]
        yield {
            **tensions, "too_high": hose["statics"] - hose["run"],
            "where": name, "place": place, "from": stretch.begin, "to": stretch.end,
        }  # fmt: skip


def _at(state: State, found: Shares | None, layer: str, places: Sequence[float]) -> list[float]:
    """Tensions of a layer [N] at places of the route; NaN where the line is not."""
    assert found is not None
    told = [math.nan] * len(places)
    for one, share in zip(state.passages, found.shares, strict=True):
        for k, place in enumerate(places):
            if one.piece.begin <= place <= one.piece.end:
                told[k] = float(np.interp(place, one.places, getattr(share, layer)))
    return told


def lowest_compared(one: Statics, margins: LineMargins, stations: Sequence[Mapping[str, Any]]) -> dict[str, Any] | None:
    """The lowest tension of the hose [N] in a run and by statics; None where either does not tell it."""
    estimates = [found.lowest for each in one.moving if (found := shares(each)) is not None]
    had = margins.whole.hose
    if not estimates or had is None:
        return None
    wanted, bears = min(estimates), margins.ruck_force
    return {
        "run": had.value, "statics": wanted, "too_high": wanted - had.value, "t": had.t, "place": had.place,
        "station": _station(had.place, stations), "ruck_force": bears,
        "run_margin": _margin(bears, had.value), "statics_margin": _margin(bears, wanted),
    }  # fmt: skip


def _margin(bears: float | None, tension: float) -> float | None:
    """The compression that a hose bears over that which it has; None where one of them is not there."""
    return bears / -tension if bears is not None and tension < 0 else None


def _station(place: float | None, stations: Sequence[Mapping[str, Any]]) -> str | None:
    """The station round a place of the route."""
    if place is None:
        return None
    for one in stations:
        begin = -math.inf if one["begin"] is None else one["begin"]
        end = math.inf if one["end"] is None else one["end"]
        if begin <= place <= end:
            return str(one["name"])
    return None
