"""Where a layer rucks: the devices and the lengths between them in which elements begin to, and when each is first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fairlead.analysis.margins.ruck_words import called, figure, moment
from fairlead.analysis.record.recorded_line import RecordedLine
from fairlead.results import Event, Result


def ruck_places(result: Result, record: dict[str, Any], begins: Sequence[Event]) -> list[dict[str, Any]]:
    """By place, in the order of time: `where` in words, first time `t` [s], number of `elements`, `low`, `high` [m].

    `begins` are the changes with which elements begin to ruck. An element that lies on a device with a part of it is on
    that device. Places [m] are those on the route at the recorded row before; empty where they were not recorded.
    """
    nodes = RecordedLine(result, record).nodes
    if nodes is None or not begins:
        return []
    rows = (np.searchsorted(result.t, [one.t for one in begins], side="right") - 1).clip(min=0)
    found: dict[str, dict[str, Any]] = {}
    for one, row in zip(begins, rows, strict=True):
        element = int(one.component.rpartition("[")[2].rstrip("]"))
        low, high = map(float, nodes[row][element : element + 2])
        where = _where(record["stations"], low, high)
        here = found.setdefault(where, {"where": where, "t": one.t, "who": set(), "low": low, "high": high})
        here["who"].add(element)
        here |= {"low": min(here["low"], low), "high": max(here["high"], high)}
    return [{key: value for key, value in one.items() if key != "who"} | {"elements": len(one["who"])}
            for one in found.values()]  # fmt: skip


def _where(stations: Sequence[Mapping[str, Any]], low: float, high: float) -> str:
    """`on the bend`, `between near and far`, `outboard of far`."""
    devices = [one for one in stations if one["type"] != "Straight"]
    for one in devices:
        if (one["begin"] is None or one["begin"] <= high) and (one["end"] is None or low <= one["end"]):
            return f"on {called(one)}"
    inboard = [one for one in devices if one["end"] is not None and one["end"] < low]
    outboard = [one for one in devices if one["begin"] is not None and one["begin"] > high]
    before, after = max(inboard, key=_end, default=None), min(outboard, key=_begin, default=None)
    if before and after:
        return f"between {called(before)} and {called(after)}"
    if before or after:
        return f"outboard of {called(before)}" if before else f"inboard of {called(after or {})}"
    return "along the line"


def _begin(station: Mapping[str, Any]) -> float:
    return float(station["begin"])


def _end(station: Mapping[str, Any]) -> float:
    return float(station["end"])


def sentences(places: Sequence[Mapping[str, Any]]) -> str:
    """All places in words; empty where none is known."""
    told = [f"{one['where']} from t = {moment(one['t'])} s ({_elements(one['elements'])}, {_reach(one)} on the route)"
            for one in places]  # fmt: skip
    text = "; ".join(told)
    return f"{text[:1].upper()}{text[1:]}." if text else ""


def _elements(count: int) -> str:
    return f"{count} element{'s' * (count > 1)}"


def _reach(one: Mapping[str, Any]) -> str:
    low, high = figure(one['low']), figure(one['high'])
    return f"{low} m" if low == high else f"{low} to {high} m"
