"""The friction cone of a line that stands: which tensions can be held at each place of its route.

From a known end the tension may rise or fall along every surface by all that friction from rest can hold; a clamp
adds what it can carry. What both ends allow is what can be held; where it lies inside depends on how it came to rest.
Between two drives that hold, the carriage of a tensioner says which tension there is: it stands between its stops, or
at one of them where no such tension can be held.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fairlead.analysis.statics.laid_route import Device, LaidRoute
from fairlead.analysis.statics.pieces import Laid, bearing, pieces, tail
from fairlead.analysis.statics.sliding import Piece, beyond
from fairlead.brief import in_a_line

Range = tuple[float, float]
ANY: Range = (-math.inf, math.inf)


@dataclass(frozen=True)
class HeldPassage:
    """Tensions that can be held in a device [N], at its inboard and its outboard end."""

    __repr__ = in_a_line

    name: str
    device: Device | None
    piece: Piece
    inboard: Range
    outboard: Range


@dataclass(frozen=True)
class Held:
    """The line at rest at the time t, when `way` has been paid out. `holds` is false when nothing can hold it."""

    __repr__ = in_a_line

    route: LaidRoute
    t: float
    way: float
    passages: tuple[HeldPassage, ...]
    loop: str = ""
    """What there is to say of a tensioner that sets the tension; nothing where none does."""

    @property
    def holds(self) -> bool:
        """True when there is a tension that can be held everywhere."""
        return all(low <= high for one in self.passages for low, high in (one.inboard, one.outboard))

    @property
    def missing(self) -> float:
        """How much more than can be held the line is pulled with [N]; 0 when it holds."""
        gaps = [low - high for one in self.passages for low, high in (one.inboard, one.outboard)]
        return max([0.0, *gaps])


def held(route: LaidRoute, t: float, way: float) -> Held:
    """The cone at rest, with the forces of the time `t`."""
    laid = list(pieces(route, t, 0.0, way))
    known_in = route.inboard.tension if route.inboard.tension is not None else -route.pull(route.inboard, t, 0.0, way)
    known_out = tail(route, t, 0.0, way)
    before, beyond = (held(one, t, way).passages if one is not None else () for one in (route.before, route.beyond))
    known = (
        ANY if route.inboard.drives else before[-1].outboard if before else (known_in, known_in),
        ANY if route.outboard.drives else beyond[0].inboard if beyond else (known_out, known_out),
    )
    ends, loop = _ends(route, laid, t, known), ""
    for k, (_, piece, _) in enumerate(laid):
        here = next((one for one in route.devices if one.begin == piece.begin and _sets(route, laid, k, one, t)), None)
        if here is not None:
            kept, loop = _kept(here, t, ends[k][0])
            ends = _ends(route, laid, t, known, (k, kept))
    found = [
        HeldPassage(device.name if device else "", device, piece, *each)
        for (device, piece, _), each in zip(laid, ends, strict=True)
    ]
    return Held(route, t, way, tuple(found), loop)


def _sets(route: LaidRoute, laid: list[Laid], k: int, loop: Device, t: float) -> bool:
    """Whether a device draws out a loop where piece k begins, with a drive that holds the line on either side."""
    holds = [device is not None and device.machine is not None and device.machine.drives for device, _, _ in laid]
    between = (route.inboard.drives or any(holds[:k])) and (route.outboard.drives or any(holds[k:]))
    return between and loop.station.draws(t) is not None


def _kept(loop: Device, t: float, can: Range) -> tuple[Range, str]:
    """What a tensioner keeps of the tensions that can be held where it stands, and how to say so."""
    least, most = float(loop.station.loosest(t)), float(loop.station.draws(t)) / 2
    if can[0] > most:
        return (most, math.inf), f"standing still the carriage of {loop.name} is at its inner stop"
    if can[1] < least:
        return (-math.inf, least), f"standing still the carriage of {loop.name} is at its outer stop"
    text = f"{least:.4g} ... {most:.4g} N" if least != most else f"{most:.4g} N"
    return (least, most), f"standing still is told with the carriage of {loop.name} between its stops, at {text}"


def _ends(
    route: LaidRoute, laid: list[Laid], t: float, known: tuple[Range, Range], kept: tuple[int, Range] = (-1, ANY)
) -> list[tuple[Range, Range]]:
    """What can be held at the inboard and at the outboard end of each piece; `kept` is a range where one begins."""
    least, (here, narrow) = -math.inf if route.pushes else 0.0, kept
    now, outward = known[0], []
    for k, (device, piece, friction) in enumerate(laid):
        entered = _both(now, narrow) if k == here else now
        now = _through(route, device, piece, friction, t, entered, True)
        outward.append((entered, now))
    now, found = known[1], []
    for k, (device, piece, friction) in reversed(list(enumerate(laid))):
        entered, left = now, _through(route, device, piece, friction, t, now, False)
        now = _both(left, narrow) if k == here else left
        found.append((_both(outward[k][0], now, least), _both(outward[k][1], entered, least)))
    return found[::-1]


def _through(
    route: LaidRoute, device: Device | None, piece: Piece, friction: float, t: float, now: Range, outward: bool
) -> Range:
    """The range behind a piece."""
    run = piece.length if outward else -piece.length
    if device is None or device.machine is None:
        ends = [_beyond(piece, now[k], sense * friction, run) for k, sense in ((0, -1), (1, 1))]
        other = [_beyond(piece, now[k], -sense * friction, run) for k, sense in ((0, -1), (1, 1))]
        return min(*ends, *other), max(*ends, *other)
    given = route.pull(device.machine, t, 0.0, 0.0) + piece.load * piece.length
    low, high = (now[0] - given, now[1] - given) if outward else (now[0] + given, now[1] + given)
    widest = math.inf
    if not device.machine.drives:
        widest = max(bearing(device, abs(x)) if math.isfinite(x) else 0.0 for x in now)
    elif device.clamping:
        widest = device.friction(0.0) * piece.counts(piece.pressed) * piece.length
    elif math.isfinite(low) and math.isfinite(high):
        grip = math.exp(device.friction(0.0) * piece.curvature * piece.length)
        return min(low / grip, low * grip), max(high * grip, high / grip)
    return low - widest, high + widest


def _beyond(piece: Piece, tension: float, friction: float, run: float) -> float:
    return beyond(piece, tension, friction, run) if math.isfinite(tension) else tension


def _both(one: Range, two: Range, least: float = -math.inf) -> Range:
    return max(one[0], two[0], least), min(one[1], two[1])
