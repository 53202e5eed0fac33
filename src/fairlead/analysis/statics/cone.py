"""The friction cone of a line that stands: which tensions can be held at each place of its route.

From a known end the tension may rise or fall along every surface by all that friction from rest can hold; a clamp
adds what it can carry. What both ends allow is what can be held; where it lies inside depends on how it came to rest.
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
    from_left = _spread(route, laid, t, ANY if route.inboard.drives else (known_in, known_in), outward=True)
    from_right = _spread(route, laid, t, ANY if route.outboard.drives else (known_out, known_out), outward=False)
    least = -math.inf if route.pushes else 0.0
    found = []
    for (device, piece, _), left, right in zip(laid, from_left, reversed(from_right), strict=True):
        ends = [_both(one, two, least) for one, two in zip(left, reversed(right), strict=True)]
        found.append(HeldPassage(device.name if device else "", device, piece, *ends))
    return Held(route, t, way, tuple(found))


def _spread(route: LaidRoute, laid: list[Laid], t: float, begin: Range, *, outward: bool) -> list[tuple[Range, Range]]:
    """Ranges where each piece is entered and left, in the order of the march."""
    found, now = [], begin
    for device, piece, friction in laid if outward else reversed(laid):
        entered, now = now, _through(route, device, piece, friction, t, now, outward)
        found.append((entered, now))
    return found


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


def _both(one: Range, two: Range, least: float) -> Range:
    return max(one[0], two[0], least), min(one[1], two[1])
