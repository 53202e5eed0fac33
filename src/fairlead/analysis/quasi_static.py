"""A run against statics: tensions in the stretches of steady speed, by two computations that share no law.

Compared are means over the second half of every stretch, in the spans between the devices: single elements stick and
slip as they pass a device, which a mean over some elements' way leaves out.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from fairlead.analysis.recorded_line import RecordedLine
from fairlead.analysis.schedule import STILL, Schedule, Stretch
from fairlead.analysis.states import State
from fairlead.analysis.statics import Statics, state, statics
from fairlead.flatten.flat_model import FlatModel
from fairlead.results import Result

SETTLED = 0.5  # of a stretch is left out
LOOKS, STATES = 100, 5  # instants of a stretch at which the run, and statics, are asked
FEWEST = 2  # elements that must pass in what is left
LEAST = 0.05  # of the largest tension: a difference counts relative to at least this


def against_statics(flat: FlatModel, result: Result) -> dict[str, Any]:
    """The largest difference, for `run.json`: relative, with both tensions [N], place, time; or a `reason` for none."""
    solved = statics(flat)
    lines = {record["line"]: RecordedLine(result, record) for record in result.run.get("routes") or ()}
    found, reasons = [], []
    for one in solved:
        line = lines.get(one.route.line.path)
        reason = _cannot(one, line)
        if reason or line is None or one.schedule is None:
            reasons.append(reason)
            continue
        here = [each for stretch in _stretches(one, one.schedule, result) for each in _compared(one, line, stretch)]
        found += here
        reasons += [] if here else ["no stretch of steady speed is long enough for some elements to pass"]
    if found:
        return max(found, key=lambda each: each["difference"])
    return {"difference": None, "reason": "; ".join(dict.fromkeys(reasons)) or "there is no line on a route"}


def _cannot(one: Statics, line: RecordedLine | None) -> str:
    """Why a line cannot be compared; nothing if it can."""
    if one.schedule is None:
        return "no reference tells the speed of the line"
    if one.route.outboard.drives:
        return "the outboard end is moved, so that statics does not know what pulls there"
    if any(each.remarks for each in one.moving) or one.remarks:
        return (one.remarks + tuple(text for each in one.moving for text in each.remarks))[0]
    if line is None or line.nodes is None:
        return f"record {one.route.line.path}.{one.route.says.outer}[*].x to tell where the elements are"
    if line.total is None:
        layers = " and ".join(f"{one.route.line.path}.{layer}[*].tension" for layer in line.record["layers"])
        return f"record {layers}"
    return ""


def _stretches(one: Statics, schedule: Schedule, result: Result) -> Iterator[Stretch]:
    """What is left of every stretch of steady motion that the run reached."""
    reached = float(result.t[-1]) if len(result.t) else schedule.begin
    element = max(one.route.says.mesh.lengths)
    for stretch in schedule.stretches():
        end = min(stretch.end, reached)
        begin = stretch.begin + SETTLED * (end - stretch.begin)
        if abs(stretch.speed) > STILL and abs(stretch.speed) * (end - begin) >= FEWEST * element:
            yield Stretch(begin, end, stretch.speed)


def _compared(one: Statics, line: RecordedLine, stretch: Stretch) -> Iterator[dict[str, Any]]:
    """Differences in all spans of one stretch."""
    assert one.schedule is not None
    way, times = one.schedule.way, np.linspace(stretch.begin, stretch.end, STATES)
    states = [state(one.route, float(t), stretch.speed, way(float(t))) for t in times]
    element = max(one.route.says.mesh.lengths)
    spans = [(name, place) for name, place in _spans(states[0], element) if _laid(states, place)]
    if not spans:
        return
    places = [place for _, place in spans]
    expected = np.mean([[each.tension(place) for place in places] for each in states], axis=0)
    told = _mean(line, places, stretch)
    least = LEAST * max(abs(each.tension).max() for each in states[0].passages)
    for (name, place), wanted, had in zip(spans, expected, told, strict=True):
        yield {
            "difference": abs(had - wanted) / max(abs(wanted), least), "run": float(had), "statics": float(wanted),
            "where": name, "place": place, "from": stretch.begin, "to": stretch.end,
        }  # fmt: skip


def _spans(found: State, element: float) -> Iterator[tuple[str, float]]:
    """The middle of every span in which nothing acts on the line, and what it is called."""
    before = found.route.winch.name if found.route.winch else "the inboard end"
    for one in found.passages:
        free = one.device is None or not (one.device.touches or one.device.station.slope)
        if free and not one.piece.load and one.piece.length >= element:
            yield f"outboard of {before}", (one.piece.begin + one.piece.end) / 2
        elif one.device is not None:
            before = one.device.name


def _laid(states: list[State], place: float) -> bool:
    """True when the line lies there all the time."""
    return all(not np.isnan(each.tension(place)) for each in states)


def _mean(line: RecordedLine, places: list[float], stretch: Stretch) -> Any:
    """Mean tension of the run [N] at places of the route; at equal spans of time, so that no burst of events weighs."""
    assert line.total is not None
    assert line.places is not None
    rows = np.searchsorted(line.result.t, np.linspace(stretch.begin, stretch.end, LOOKS))
    rows = rows.clip(max=len(line.result.t) - 1)
    return np.mean([np.interp(places, line.places[row], line.total[row]) for row in rows], axis=0)
