"""The route cut into pieces on which nothing changes, for one state of the line; and what pulls at its end."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

from fairlead.analysis.statics.laid_route import Device, LaidRoute
from fairlead.analysis.statics.sliding import Piece

Laid = tuple[Device | None, Piece, float]
"""A device (None between devices), its piece of line, and d mu: friction with the sign of the sliding."""


def pieces(route: LaidRoute, t: float, speed: float, way: float, acceleration: float = 0.0) -> Iterator[Laid]:
    """From the drum, or the inboard end of the line, to its outboard end; `speed` 0 gives the friction from rest."""
    first, last = route.ends(way)
    if last <= first:  # all of the line is on the drum
        return
    inertia = route.mass * acceleration
    borders = {first, last}
    for one in (*route.devices, *route.seas):
        borders |= {place for place in (one.begin, one.end) if first < place < last}
    for begin, end in itertools.pairwise(sorted(borders)):
        middle = (begin + end) / 2
        device = next((one for one in route.devices if one.begin < middle < one.end), None)
        flow = sum(drag(route, sea, t, speed) for sea in route.seas if sea.begin < middle)
        load = flow - inertia
        if device is None:
            yield None, Piece(begin, end, load=load), 0.0
            continue
        p, weight = device.station, route.says.weight
        pressed = device.squeeze(t) + (weight * math.cos(p.slope) if p.bears_weight() else 0.0)
        load += weight * math.sin(p.slope)
        lightened = route.mass * speed**2 if route.says.lightened else 0.0
        power = route.power(device.curve)
        piece = Piece(begin, end, device.curvature, abs(pressed), load, p.all_round(), lightened, *power)
        slid = 0.0 if device.machine is not None else device.friction(speed)
        yield device, piece, math.copysign(slid, speed)


def drag(route: LaidRoute, sea: Device, t: float, speed: float) -> float:
    """Drag per length [N/m] in a sea whose drag acts along the line, which may move as one body; outboard positive."""
    flow = route.signal(sea, t) - speed
    return float(sea.station.drags(route.says.diameter) * abs(flow) * flow)


def tail(route: LaidRoute, t: float, speed: float, way: float) -> float:
    """Tension at the outboard end [N]: what pulls there, tail and drogue, and drag that is lumped there."""
    total = route.pull(route.outboard, t, speed, way)
    for sea in route.seas:
        flow = route.signal(sea, t) - speed
        steady, area = sea.station.tows(route.says.diameter, sea.begin, route.says.start + route.says.length, way)
        total += float(steady) + area * abs(flow) * flow
    return total


def bearing(device: Device, tension: float) -> float:
    """What the bearing of a wheel takes of the tension [N]."""
    share = float(device.station.taken_by_bearing())
    return abs(tension) * share if share else 0.0
