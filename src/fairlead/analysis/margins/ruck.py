"""The verdict on every line that is watched for rucking: where and when it rucks first, or how far it is from that."""

from __future__ import annotations

import math
from typing import Any

from fairlead.analysis.margins.ruck_cause import cause, recorded_time
from fairlead.analysis.margins.ruck_places import ruck_places
from fairlead.analysis.margins.ruck_words import figure, moment
from fairlead.results import Result
from fairlead.results.run_file import RUN_FILE
from fairlead.results.run_schema import routes

BEYOND = ("beyond", "rucking")
"""Zones of elements that are compressed beyond the limit."""


def verdicts(result: Result) -> list[dict[str, Any]]:
    """A verdict for each line with a `ruck_force`: `rucks`, `t` [s], `element`, `along` [m], `station`, `margin`.

    `cause` is what the bend at its place does there (`ruck_cause.py`), None where that cannot be told.
    `margin` is what it bears over the most it had; None where tensions were not recorded, infinity (null in run.json)
    where it was never compressed. Of a line that rucks, `most` has `t`, `element` and place of the greatest
    compression, where tensions were recorded, and `places` are all at which elements ruck (`ruck_places.py`). None of
    a run that ended before its first row. Raises DamagedResultsError.
    """
    if not len(result.t):
        return []
    found = routes(result.named(RUN_FILE), result.run)
    return [_verdict(result, record) for record in found if record["ruck_force"] is not None]


def _verdict(result: Result, record: dict[str, Any]) -> dict[str, Any]:
    line, layer, bears = record["line"], record["layers"][0], record["ruck_force"]
    made = {"line": line, "ruck_force": bears, "rucks": False, "t": None, "element": None, "margin": None,
            "compressed": None}  # fmt: skip
    lowest = _lowest(result, f"{line}.{layer}", record["nodes"] - 1)
    if lowest is not None:
        least, made["t"], made["element"] = lowest
        made["compressed"] = max(-least, 0.0)
        made["margin"] = bears / -least if least < 0 else math.inf
    begins = [one for one in result.events if one.zone_to in BEYOND and one.component.startswith(f"{line}.{layer}[")]
    if begins:
        first, made["places"] = begins[0], ruck_places(result, record, begins)
        if lowest is not None:
            made["most"] = {"t": lowest[1], "element": lowest[2], **_place(result, record, lowest[2], lowest[1])}
        made |= {"rucks": True, "t": first.t, "element": int(first.component.rpartition("[")[2].rstrip("]"))}
    if made["element"] is not None:
        made |= _place(result, record, made["element"], made["t"])
        made["cause"] = cause(result, record, made)
    return made


def _lowest(result: Result, layer: str, count: int) -> tuple[float, float, int] | None:
    """Lowest tension of any element, when, and which; None unless all were recorded."""
    names = [f"{layer}[{k}].tension" for k in range(count)]
    if count > len(result) or not all(name in result for name in names):
        return None
    found = [result.extremes(name) for name in names]
    k = min(range(count), key=lambda k: found[k].lowest)
    return found[k].lowest, found[k].t_lowest, k


def _place(result: Result, record: dict[str, Any], element: int, t: float) -> dict[str, Any]:
    """Where an element is: along the line, and, when positions were recorded, in which station."""
    places = record["places"]
    along = (places[element] + places[element + 1]) / 2 if element + 1 < len(places) else None
    nodes = [f"{record['line']}.{record['outer']}[{k}].x" for k in (element, element + 1)]
    if not all(name in result for name in nodes):
        return {"along": along, "place": None, "station": ""}
    place = sum(result.at(name, recorded_time(result, t)) for name in nodes) / 2
    ends = ((one, one["begin"], one["end"]) for one in record["stations"] if one["type"] != "Straight")
    inside = [one["name"] for one, begin, end in ends
              if (begin is None or begin <= place) and (end is None or place <= end)]  # fmt: skip
    return {"along": along, "place": place, "station": inside[0] if inside else ""}


def sentence(found: dict[str, Any]) -> str:
    """One verdict in words."""
    line, limit = found["line"], figure(found["ruck_force"])
    if found["rucks"]:
        most = f"; up to {figure(found['compressed'])} N, {_margin(found)}" if found["margin"] else ""
        return f"{line} rucks: beyond {limit} N first at t = {moment(found['t'])} s, {_where(found)}{most}"
    if found["compressed"] is None:
        return f"{line} does not ruck: no element was compressed by {limit} N"
    if not found["compressed"]:
        return f"{line} does not ruck: it was never compressed"
    most = f"compressed by at most {figure(found['compressed'])} N, at t = {moment(found['t'])} s, {_where(found)}"
    if found["margin"] < 1:
        return f"{line} does not ruck: {most}, with its damping, but without that by no more than {limit} N"
    return f"{line} does not ruck: {_margin(found)}; {most}; an element rucks beyond {limit} N"


def _margin(found: dict[str, Any]) -> str:
    """The margin, and what it comes from."""
    return f"margin {figure(found['ruck_force'])}/{figure(found['compressed'])} = {found['margin']:.2g}"


def _where(found: dict[str, Any]) -> str:
    route = f", {figure(found['place'])} m on the route" if found.get("place") is not None else ""
    along = f" ({figure(found['along'])} m along the line{route})" if found.get("along") is not None else ""
    station = f" in {found['station']}" if found.get("station") else ""
    return f"element {found['element']}{along}{station}"
