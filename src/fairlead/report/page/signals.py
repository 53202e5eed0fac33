"""The signals of a run for the page: packed by family, and which of them a reader sees first."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from fairlead.report.page.packing import MOST_BYTES, packed, packed_times
from fairlead.results.plateau import first_of
from fairlead.results.signal import family

if TYPE_CHECKING:
    from fairlead.results import Result, Signal

MOST_PANELS = 4
MOST_DRAWN = 4
"""Families in a panel that nobody asked for."""
FARTHER = 20.0
"""How many times as far one family may go as another in such a panel."""
MOST_BUCKET = 2**20


def families(result: Result) -> dict[str, list[Signal]]:
    """Signals by family, elements in the order of their numbers."""
    found: dict[str, list[Signal]] = {}
    for signal in result.signals:
        found.setdefault(family(signal.name)[0], []).append(signal)
    return {name: sorted(each, key=lambda one: family(one.name)[1] or 0) for name, each in found.items()}


def signal_data(result: Result, share: float = 1.0) -> dict[str, Any]:
    """Times and packed families of a run, within `share` of the bytes that a page has for signals."""
    grouped, k = families(result), 1
    while True:
        chunks = {name: packed(result.columns([one.name for one in each]), k) for name, each in grouped.items()}
        size = sum(len(chunk.data) for chunk in chunks.values())
        if size <= share * MOST_BYTES or k >= len(result.t):
            break
        k = min(MOST_BUCKET, max(2 * k, math.ceil(3 * k * size / (share * MOST_BYTES))))
    return {
        "t": packed_times(result.t[::k]), "rows": math.ceil(len(result.t) / k), "bucket": k,
        "end": float(result.t[-1]) if len(result.t) else 0.0,
        "families": [_family(result, name, each, chunks[name].plain()) for name, each in grouped.items()],
    }  # fmt: skip


def _family(result: Result, name: str, members: list[Signal], chunk: Mapping[str, Any]) -> dict[str, Any]:
    found = [result.extremes(one.name) for one in members]
    return {
        "name": name, "unit": members[0].unit, "doc": members[0].description,
        "elements": [family(one.name)[1] for one in members], **chunk,
        "min": _least([one.lowest for one in found]), "max": _least([-one.highest for one in found], -1.0),
    }  # fmt: skip


def _least(values: list[float], sign: float = 1.0) -> float | None:
    known = [value for value in values if math.isfinite(value)]
    return sign * min(known) if known else None


def first_panels(result: Result) -> list[dict[str, Any]]:
    """What is drawn when the page opens: the plots of the netlist, else one panel for each of the first units."""
    known = families(result)
    of = {signal.name: name for name, each in known.items() for signal in each}
    panels = []
    for plot in (result.run.get("scene") or {}).get("plots") or ():
        names = [of[name] for pattern in plot["signals"] for name in result.match(pattern)]
        units = {known[name][0].unit for name in names}
        if names and len(units) == 1:
            panels.append({"title": plot["title"], "families": list(dict.fromkeys(names))})
    return (panels or _by_unit(result, known))[:MOST_PANELS]


def _by_unit(result: Result, known: Mapping[str, list[Signal]]) -> list[dict[str, Any]]:
    units: dict[str, list[str]] = {}
    for name, each in known.items():
        if not name.startswith("energy."):
            units.setdefault(each[0].unit, []).append(name)
    sizes = {name: _size(result, each) for name, each in known.items()}
    drawn = [(_alike(names, sizes)[:MOST_DRAWN], len(names)) for names in units.values()]
    return [{"title": _title(names, of), "families": names} for names, of in drawn]


def _alike(names: list[str], sizes: Mapping[str, float]) -> list[str]:
    """Those that a panel can show together, so that none is drawn flat beside another: the largest such group."""
    seen = [name for name in names if sizes[name] > 0] or names
    groups = [[name for name in seen if sizes[one] <= sizes[name] <= FARTHER * sizes[one]] for one in seen]
    return max(groups, key=lambda group: min(len(group), MOST_DRAWN))


def _size(result: Result, members: list[Signal]) -> float:
    """How far a family goes from its lowest to its highest value; 0 where nothing moves."""
    found = [result.extremes(one.name) for one in members]
    values = [v for one in found for v in (one.lowest, one.highest) if math.isfinite(v)]
    return max(values) - min(values) if values else 0.0


def _title(names: list[str], of: int) -> str:
    said = ", ".join(dict.fromkeys(name.rpartition(".")[2].replace("_", " ") for name in names))
    return f"{said} ({len(names)} of {of}; add others above)" if len(names) < of else said


def worst_rows(result: Result) -> list[dict[str, Any]]:
    """For the table: each family with its lowest and highest value, and when."""
    rows = []
    for name, members in families(result).items():
        found = [(one.name, result.extremes(one.name)) for one in members]
        found = [(one, each) for one, each in found if np.isfinite(each.lowest)]
        if found:
            low = found[first_of([one.lowest for _, one in found], least=True)]
            high = found[first_of([one.highest for _, one in found], least=False)]
            rows.append({
                "name": name, "count": len(members), "unit": members[0].unit, "doc": members[0].description,
                "low": low[1].lowest, "t_low": low[1].t_lowest, "who_low": low[0],
                "high": high[1].highest, "t_high": high[1].t_highest, "who_high": high[0],
            })  # fmt: skip
    return rows
