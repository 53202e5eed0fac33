"""A run against statics: tensions in the stretches of steady speed, by two computations that share no law.

Compared are means over the second half of every stretch, in the spans between the devices: single elements stick and
slip as they pass a device, which a mean over some elements' way leaves out. How hose and core share the tension is an
estimate of statics, and is compared apart (`hose_against_statics.py`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from fairlead.analysis.margins.hose_against_statics import lowest_compared, mean_along, shares_compared
from fairlead.analysis.margins.margins import margins
from fairlead.analysis.margins.settled import drift
from fairlead.analysis.record.recorded_line import RecordedLine
from fairlead.analysis.statics.schedule import STILL, Schedule, Stretch
from fairlead.analysis.statics.solution import Statics, state, statics
from fairlead.analysis.statics.states import State
from fairlead.flatten.flat_model import FlatModel
from fairlead.results import Result

SETTLED = 0.5  # of a stretch is left out
STATES = 5  # instants of a stretch at which statics is asked
FEWEST = 2  # elements that must pass in what is left
LEAST = 0.05  # of the largest tension: a difference counts relative to at least this


def against_statics(flat: FlatModel, result: Result) -> dict[str, Any]:
    """The largest difference, for `run.json`: relative, with both tensions [N], place, time; or a `reason` for none.

    Of an array also `shares`, the largest difference in hose or core, and `lowest`, that of the lowest hose tension.
    `drift` is what still changes at constant speed (`settled.py`), of the line and stretch where that is most.
    """
    lines = {record["line"]: RecordedLine(result, record) for record in result.run.get("routes") or ()}
    solved = statics(flat)
    total: list[dict[str, Any]] = []
    layers: list[dict[str, Any]] = []
    reasons: list[str] = []
    for one in solved:
        line = lines.get(one.route.line.path)
        reason = _cannot(one, line)
        if reason or line is None or one.schedule is None:
            reasons.append(reason)
            continue
        here = list(_stretches(one, one.schedule, result))
        for stretch in here:
            states, spans = _asked(one, stretch)
            total += _compared(line, states, spans, stretch)
            layers += shares_compared(line, states, spans, stretch)
        reasons += [] if here else ["no stretch of steady speed is long enough for some elements to pass"]
    found: dict[str, Any] = max(total, key=lambda each: each["difference"], default={"difference": None})
    if not total:
        found["reason"] = "; ".join(dict.fromkeys(reasons)) or "there is no line on a route"
    lowest = list(_lowest(solved, result))
    if layers:
        found["shares"] = max(layers, key=lambda each: abs(each["too_high"]))
    if lowest:
        found["lowest"] = max(lowest, key=lambda each: each["too_high"])
    if drifts := list(_drifts(solved, lines, result)):
        found["drift"] = max(drifts, key=lambda each: each["change"])
    return found


def _drifts(solved: list[Statics], lines: dict[str, RecordedLine], result: Result) -> Iterator[dict[str, Any]]:
    """What changes at constant speed, also where statics cannot be compared."""
    for one in solved:
        line = lines.get(one.route.line.path)
        if line is not None and one.schedule is not None:
            yield from filter(None, (drift(line, stretch) for stretch in _stretches(one, one.schedule, result)))


def _lowest(solved: list[Statics], result: Result) -> Iterator[dict[str, Any]]:
    """The lowest tension of every hose, also where nothing else can be compared."""
    records = {record["line"]: record for record in result.run.get("routes") or ()}
    judged = {each.line: each for each in margins(result)} if records else {}
    for one in solved:
        path = one.route.line.path
        if path in judged and (found := lowest_compared(one, judged[path], records[path]["stations"])) is not None:
            yield found


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


def _asked(one: Statics, stretch: Stretch) -> tuple[list[State], list[tuple[str, float]]]:
    """Statics at some instants of a stretch, and the spans (name, place) in which the line lies all the time."""
    assert one.schedule is not None
    way, times = one.schedule.way, np.linspace(stretch.begin, stretch.end, STATES)
    states = [state(one.route, float(t), stretch.speed, way(float(t))) for t in times]
    element = max(one.route.says.mesh.lengths)
    return states, [(name, place) for name, place in _spans(states[0], element) if _laid(states, place)]


def _compared(
    line: RecordedLine, states: list[State], spans: list[tuple[str, float]], stretch: Stretch
) -> Iterator[dict[str, Any]]:
    """Differences in all spans of one stretch."""
    if not spans:
        return
    assert line.total is not None
    places = [place for _, place in spans]
    expected = np.mean([[each.tension(place) for place in places] for each in states], axis=0)
    told = mean_along(line, line.total, places, stretch)
    least = LEAST * max(abs(each.tension).max() for each in states[0].passages)
    for (name, place), wanted, had in zip(spans, expected, told, strict=True):
        yield {
            "difference": abs(had - wanted) / max(abs(wanted), least), "run": float(had), "statics": float(wanted),
            "where": name, "place": place, "from": stretch.begin, "to": stretch.end,
        }  # fmt: skip


def _spans(found: State, element: float) -> Iterator[tuple[str, float]]:
    """The middle of every span in which nothing acts on the line, and what it is called."""
    before = f"outboard of {found.route.winch.name}" if found.route.winch else "at the inboard end"
    for one in found.passages:
        free = one.device is None or not (one.device.touches or one.device.station.slope)
        if free and not one.piece.load and one.piece.length >= element:
            yield before, (one.piece.begin + one.piece.end) / 2
        elif one.device is not None:
            before = f"outboard of {one.device.name}"


def _laid(states: list[State], place: float) -> bool:
    """True when the line lies there all the time."""
    return all(not np.isnan(each.tension(place)) for each in states)
