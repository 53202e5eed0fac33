"""Statics as plain numbers: what the table of `fairlead statics` shows and its JSON holds."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from fairlead.analysis.remarks.lines import side_walls, weak_clamps
from fairlead.analysis.statics.cone import Held
from fairlead.analysis.statics.shares import shares
from fairlead.analysis.statics.solution import Statics
from fairlead.analysis.statics.states import State

MOVES = 1e-9  # N; a span in which the tension changes by less is not told


def record(found: Statics) -> dict[str, Any]:
    """One line on its route: its states, the cone at rest, the drives."""
    says = found.route.says
    return {
        "line": found.route.line.path, "route": found.route.route.path,
        "limits": {"side_wall": says.side_wall, "ruck_force": says.ruck_force},
        "states": [state_record(state) for state in found.moving],
        "standing": _standing(found.standing),
        "drives": [row for state in (*found.moving, *found.starts) for row in _drives(state)],
        "remarks": list(dict.fromkeys(_remarks(found))),
    }  # fmt: skip


def _remarks(found: Statics) -> Iterator[str]:
    """What is open or not counted, and what `check` would warn of."""
    yield from found.remarks
    yield from found.notes
    for state in found.moving:
        yield from state.remarks
    if len(found.route.says.layers) > 1 or not found.route.pushes:
        yield from _slack(found)
    for fault in (*weak_clamps(found), *side_walls(found)):
        yield f"{fault.what} {fault.way_out}".rstrip(".")


def _slack(found: Statics) -> Iterator[str]:
    """States in which a line that cannot push would have to."""
    for state in (each for each in (*found.moving, *found.starts) if each.passages):
        one = min(state.passages, key=lambda each: float(each.tension.min()))
        k = int(one.tension.argmin())
        if one.tension[k] < -MOVES:
            missing = f"{-one.tension[k]:.4g} N are missing there"
            yield f"{name(state)}: the line goes slack at {one.places[k]:.4g} m, {missing}"


def state_record(state: State) -> dict[str, Any]:
    """One state of steady motion. Tensions in N, places in m along the route."""
    layers = shares(state)
    return {
        "state": name(state), "layer": layer(state), "speed": state.speed, "t": state.t,
        "paid_out": state.way, "in_sea": state.in_sea,
        "stations": list(_stations(state)), "registration": layers.registration if layers else None,
        "estimated": ["core", "hose", "ruck_margin", "registration"] if layers else [],
    }  # fmt: skip


def name(state: State) -> str:
    """Paying out, hauling, or changing its speed; on a drum with layers with the one that the line leaves."""
    on = f", layer {layer(state)}" if layer(state) is not None else ""
    if state.acceleration:
        return f"{state.acceleration:+.3g} m/s^2 at {state.t:g} s{on}"
    return f"{'paying out' if state.speed > 0 else 'hauling'}{on}"


def layer(state: State) -> int | None:
    """The layer of the drum that the line leaves."""
    return state.route.layer(state.way)


def _stations(state: State) -> Iterator[dict[str, Any]]:
    """Ends and devices in the order of the route, inboard first; spans that change nothing are left out."""
    layers, says = shares(state), state.route.says
    ruck, wall = says.ruck_force, says.side_wall
    if not state.passages:
        return
    first, last = state.passages[0], state.passages[-1]
    start = state.route.winch.name if state.route.winch else "inboard end"
    yield {"station": start, "from": first.piece.begin, "to": first.piece.begin, "outboard": first.inboard}
    for k, one in enumerate(state.passages):
        level = abs(one.outboard - one.inboard) < MOVES and not one.piece.curvature
        if level and (one.device is None or not one.device.touches):
            continue
        row: dict[str, Any] = {
            "station": one.name or _in_sea(state, one.piece.begin), "from": one.piece.begin, "to": one.piece.end,
            "inboard": one.inboard, "outboard": one.outboard, "side_wall": one.side_wall or None,
            "side_wall_margin": wall / one.side_wall if wall and one.side_wall else None,
        }  # fmt: skip
        if layers is not None:
            share = layers.shares[k]
            row |= {"core": float(share.core.min()), "hose": float(share.hose.min()), "bulkheads_slip": share.slips}
        lowest = row.get("hose", min(one.inboard, one.outboard))
        row["ruck_margin"] = (ruck / -lowest if lowest < 0 else math.inf) if ruck else None
        yield row
    yield {"station": "tail" if state.route.seas else "outboard end", "from": last.piece.end, "to": last.piece.end,
           "inboard": last.outboard}  # fmt: skip


def _in_sea(state: State, place: float) -> str:
    return next((sea.name for sea in state.route.seas if place >= sea.begin - 1e-9), "span")


def _standing(held: Held) -> dict[str, Any]:
    rows = [
        {"station": one.name, "from": one.piece.begin, "to": one.piece.end,
         "inboard": one.inboard, "outboard": one.outboard}
        for one in held.passages
        if one.device is not None and one.device.touches
    ]  # fmt: skip
    return {"t": held.t, "paid_out": held.way, "holds": held.holds, "missing": held.missing, "stations": rows}


def _drives(state: State) -> Iterator[dict[str, Any]]:
    for one in state.drives:
        yield {"drive": one.name, "state": name(state), "force": one.force, "torque": one.torque,
               "power": None if state.acceleration else one.power, "clamp": one.capacity,
               "factor": one.factor}  # fmt: skip
