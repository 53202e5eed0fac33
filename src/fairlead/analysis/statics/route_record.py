"""What a run keeps of its lines and routes in `run.json`, so that its margins can be told without the netlist."""

from __future__ import annotations

import math
from typing import Any

from fairlead.analysis.statics.laid_route import LaidRoute, coefficient, laid_routes
from fairlead.flatten.flat_model import FlatModel

SLIDING = 0.1
"""Slip speed at which a sliding coefficient is told [m/s]: above the Stribeck velocities of lines in use."""


def route_records(flat: FlatModel) -> list[dict[str, Any]]:
    """One record for each line on a route: its layers and nodes, what it bears, and the stations in their places."""
    return [_record(laid) for laid in laid_routes(flat)]


def _record(laid: LaidRoute) -> dict[str, Any]:
    line = laid.says
    contacts = {
        one.name: f"outer_{surface.name}" if surface.name else "outer"
        for surface in laid.route.line.surfaces
        for one, _ in surface.devices
    }
    rubs = {one.name: one.curve for one in laid.devices if one.curve is not None}
    rigid_from = min((line.rigid_from(one.begin, one.station) for one in laid.seas), default=math.inf)
    stations = [
        {
            "name": one.name, "type": one.station.type.word, "begin": one.begin, "end": min(one.end, rigid_from),
            "curvature": one.curvature, "contact": contacts.get(one.name),
            "moves": one.name in laid.route.line.machinery and one.name in contacts,
            "friction": _friction(rubs.get(one.name)), "squeeze": float(one.station.squeeze()),
        }
        for one in sorted(laid.route.line.placed, key=lambda one: (one.begin, one.end))
    ]  # fmt: skip
    return {
        "line": laid.line.path, "route": laid.route.path, "layers": list(line.layers), "outer": line.outer,
        "nodes": line.mesh.elements + 1, "ruck_force": line.ruck_force, "side_wall": line.side_wall,
        "places": list(line.mesh.places), "stations": stations, "stiffnesses": list(line.stiffnesses),
        "inner_friction": _friction(line.inner_curve),
        "rigid_from": rigid_from if math.isfinite(rigid_from) else None,
    }  # fmt: skip


def _friction(curve: Any) -> list[float] | None:
    """Coefficients of a curve: from rest, and sliding."""
    return None if curve is None else [coefficient(curve, 0.0), coefficient(curve, SLIDING)]
