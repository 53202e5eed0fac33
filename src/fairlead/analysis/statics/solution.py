"""Quasi-static solution of a line on its route: hauled steadily either way, and standing still.

    found = statics(flat)          one Statics for every line that lies on a route

Algebra only: from the ends whose tension is known (winch, tail, a force) the tension is followed through every device
(`sliding.py`) to the drive, which takes the difference. It shares no code with the laws and the engines, so it is an
independent check of a run, and gives its design numbers in milliseconds. Physics section 4, closed forms 9, 14, 26,
27, 34 of section 8.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.statics.cone import Held, held
from fairlead.analysis.statics.joined import joined
from fairlead.analysis.statics.laid_route import Device, LaidRoute, laid_routes
from fairlead.analysis.statics.pieces import Laid, bearing, pieces, tail
from fairlead.analysis.statics.schedule import STILL, Schedule, Stretch
from fairlead.analysis.statics.shares import shares
from fairlead.analysis.statics.sliding import Piece, along, beyond
from fairlead.analysis.statics.states import Drive, Passage, State
from fairlead.brief import in_a_line
from fairlead.distinct import distinct
from fairlead.flatten.flat_model import FlatModel

POINTS = 33  # along a piece, beside the connectors in it
LOOKS = 201  # instants at which forces in time are looked at
CHANGES = 1e-3  # share of a pull below which it is said to be steady
WANTED = 1.5  # clamp capacity over the force needed (physics 4.5), as chosen in docs/routes.md


@dataclass(frozen=True)
class Statics:
    """All states of one line: those its references imply.

    `remarks` are what makes it differ from a run, `notes` what a reader should know besides.
    """

    __repr__ = in_a_line

    route: LaidRoute
    schedule: Schedule | None
    moving: tuple[State, ...]
    standing: Held
    starts: tuple[State, ...] = ()
    remarks: tuple[str, ...] = field(default=())
    notes: tuple[str, ...] = field(default=())


def statics(flat: FlatModel, speed: float | None = None) -> list[Statics]:
    """Statics of every line on a route; `speed` [m/s] replaces what the references say, and is taken both ways."""
    return [_of(route, speed) for route in joined(laid_routes(flat))]


def _of(route: LaidRoute, speed: float | None) -> Statics:
    schedule = route.schedule()
    remarks, notes = list(_not_counted(route)), list[str]()
    moving, rest = [], (route.flat.assembly.netlist.run.start, 0.0)
    if speed is not None:
        if not list(route.drivers()):
            remarks.append("nothing drives the line; at its outboard end is told what would have to pull there")
        moving = [state(route, rest[0], way * speed, 0.0) for way in (1, -1)]
    elif schedule is not None:
        for sign in (1, -1):
            for stretch, found in _told(route, schedule, sign):
                if found.t != schedule.most_out(sign, stretch):
                    notes.append(f"what pulls at its ends changes while it moves; it is hardest at {found.t:.4g} s")
                moving.append(found)
        t = schedule.furthest(0)
        rest = (t, schedule.way(t)) if t is not None else rest
    else:
        rest = (_hardest(route), 0.0)
        remarks.append("no reference tells a speed of the line, so only standing still is told; --speed gives one")
    starts = tuple(starting(route, schedule)) if schedule is not None and speed is None else ()
    standing = held(route, *rest)
    notes += [*([standing.loop] if standing.loop else []), *_neighbours(route)]
    return Statics(route, schedule, tuple(moving), standing, starts, tuple(remarks), tuple(notes))


def _told(route: LaidRoute, schedule: Schedule, sign: int) -> list[tuple[Stretch, State]]:
    """The states that stand for a direction: its fastest, and layers of a drum in which something is larger than there.

    The radius of a drum with layers makes the speed and the torque, the way paid out most of the pull, so that the
    layer in which one is largest need not be that of another.
    """
    fastest = schedule.steady(sign)
    if fastest is None:
        return []
    found = [(fastest, _steady(route, schedule, fastest, sign))]
    others = [(one, _steady(route, schedule, one, sign)) for one in schedule.layers(sign) if one != fastest]
    for measure in (_most_force, _most_torque, _most_tension, _most_pressed):
        worst = max([*found, *others], key=lambda one: measure(one[1]))
        if measure(worst[1]) > (1 + CHANGES) * max(measure(one) for _, one in found):
            found.append(worst)
    return found


def _most_force(one: State) -> float:
    return max((abs(drive.force) for drive in one.drives), default=0.0)


def _most_torque(one: State) -> float:
    return max((abs(drive.torque or 0.0) for drive in one.drives), default=0.0)


def _most_tension(one: State) -> float:
    return max([0.0, *(float(each.tension.max()) for each in one.passages)])


def _most_pressed(one: State) -> float:
    """Compression of the line, of an array that of its hose [N]."""
    layers = shares(one)
    lowest = [layers.lowest] if layers is not None else [float(each.tension.min()) for each in one.passages]
    return max(-min(lowest, default=0.0), 0.0)


def _steady(route: LaidRoute, schedule: Schedule, stretch: Stretch, sign: int) -> State:
    """The state in a time of steady speed: with most line out, or when the ends are pulled hardest."""
    t = _hardest_while(route, schedule, stretch, schedule.most_out(sign, stretch))
    return state(route, t, stretch.speed, schedule.way(t))


def _hardest(route: LaidRoute) -> float:
    """When the ends of a line that nothing moves are pulled hardest."""
    run = route.flat.assembly.netlist.run
    return max(_looks(route, run.start, run.stop), key=lambda t: _pulled(route, t, 0.0, 0.0))


def _hardest_while(route: LaidRoute, schedule: Schedule, stretch: Stretch, otherwise: float) -> float:
    """When the ends are pulled hardest while the line moves steadily; the time `otherwise` if that does not change."""
    if stretch.end <= stretch.begin:
        return otherwise
    way = schedule.way(otherwise)
    pulls = {t: _pulled(route, t, stretch.speed, way) for t in _looks(route, stretch.begin, stretch.end)}
    most = max(pulls, key=pulls.__getitem__)
    return most if pulls[most] - min(pulls.values()) > CHANGES * pulls[most] else otherwise


def _looks(route: LaidRoute, begin: float, end: float) -> list[float]:
    """Instants in a time, with those at which what acts at the ends changes its course."""
    corners = (t for t in (*route.inboard.corners(), *route.outboard.corners()) if begin <= t <= end)
    return [*map(float, np.linspace(begin, end, LOOKS)), *corners]


def _pulled(route: LaidRoute, t: float, speed: float, way: float) -> float:
    """How hard both ends are pulled [N]."""
    return abs(outboard_tension(route, t, speed, way)) + abs(route.pull(route.inboard, t, speed, way))


def starting(route: LaidRoute, schedule: Schedule) -> Iterator[State]:
    """The moments at which a change of speed asks most of the drives, one for each direction of the acceleration.

    The friction is that of sliding with the speed of that moment.
    """
    for sign in (1, -1):
        found = [one for one in schedule.accelerations() if sign * one[2] > STILL]
        if found:
            made = [
                state(route, t, speed, schedule.way(t), acceleration)
                for t, speed, acceleration in found
            ]
            yield max(made, key=lambda one: max((abs(drive.force) for drive in one.drives), default=0.0))


def state(route: LaidRoute, t: float, speed: float, way: float, acceleration: float = 0.0) -> State:
    """Steady sliding with `speed` [m/s] when `way` [m] has been paid out, with the forces of the time `t`."""
    laid = list(pieces(route, t, speed, way, acceleration))
    drivers = [k for k, (device, _, _) in enumerate(laid) if _drives(device)]
    left_known, right_known = not route.inboard.drives, not route.outboard.drives
    remarks: list[str] = []
    found: dict[int, NDArray[np.float64]] = {}
    begin, end = 0, len(laid)
    places = [_places(route, piece, way) for _, piece, _ in laid]
    march = _March(route, laid, places, t, speed, way, acceleration, found)
    if left_known:
        tension = inboard_tension(route, t, speed, way, acceleration)
        begin = march.outward(tension, range(len(laid)))
    if right_known and (drivers or not left_known):
        tension = outboard_tension(route, t, speed, way, acceleration)
        tension -= route.inertia(route.outboard, way) * acceleration
        end = march.inward(tension, range(len(laid) - 1, -1, -1))
    between = [k for k in range(begin, end) if k not in found and not _drives(laid[k][0])]
    if between:
        loops = [one for one in route.devices if one.station.draws(t) is not None]
        loop = next((one for one in loops if _holds(laid, between, one)), None)
        here = between[0] if loop is None else next(k for k in between if laid[k][1].begin == loop.begin)
        tension = route.says.tension if loop is None else float(loop.station.draws(t)) / 2
        remarks += [_undetermined(laid, between, tension)] if loop is None else []
        march.outward(tension, [k for k in between if k >= here])
        march.inward(tension, [k for k in reversed(between) if k < here])
    return _assembled(march, tuple(remarks))


def _holds(laid: list[Laid], between: list[int], loop: Device) -> bool:
    """True when a tensioner stands between two drives: its loop, which begins drawn in, sets the tension there."""
    return any(laid[k][1].begin == loop.begin for k in between)


def _places(route: LaidRoute, piece: Piece, way: float) -> NDArray[np.float64]:
    """Where a piece is looked at: equal distances, and the connectors of the line."""
    inside = [place for place in route.connectors(way) if piece.begin < place < piece.end]
    return distinct(np.concatenate([np.linspace(piece.begin, piece.end, POINTS), inside]))


def outboard_tension(route: LaidRoute, t: float, speed: float, way: float, acceleration: float = 0.0) -> float:
    """Tension [N] at the outboard end: what pulls there, or the line that is joined to it."""
    if route.beyond is None:
        return tail(route, t, speed, way)
    passages = state(route.beyond, t, speed, way, acceleration).passages
    return passages[0].inboard if passages else 0.0


def inboard_tension(route: LaidRoute, t: float, speed: float, way: float, acceleration: float = 0.0) -> float:
    """Tension [N] at the inboard end: what the winch keeps or pulls with, and what the drum takes to be sped up."""
    made = route.inboard
    if route.before is not None:
        passages = state(route.before, t, speed, way, acceleration).passages
        return passages[-1].outboard if passages else 0.0
    kept = made.tension if made.tension is not None else -route.pull(made, t, speed, way)
    heavy = 0.0 if made.paced else route.inertia(made, way) + route.mass * route.stored(way)
    return kept + heavy * acceleration


@dataclass(frozen=True)
class _March:
    """Follows the tension from piece to piece until a drive takes what it needs."""

    route: LaidRoute
    laid: list[Laid]
    places: list[NDArray[np.float64]]
    t: float
    speed: float
    way: float
    acceleration: float
    found: dict[int, NDArray[np.float64]]

    def outward(self, tension: float, order: Iterable[int]) -> int:
        """From the inboard end of the first piece; returns the number of the drive it comes to."""
        for k in order:
            if _drives(self.laid[k][0]):
                return k
            self.found[k] = self._passed(k, tension, outward=True)
            tension = float(self.found[k][-1])
        return len(self.laid)

    def inward(self, tension: float, order: Iterable[int]) -> int:
        """From the outboard end of the first of them; returns the number after the drive it comes to."""
        for k in order:
            if _drives(self.laid[k][0]):
                return k + 1
            self.found[k] = self._passed(k, tension, outward=False)
            tension = float(self.found[k][0])
        return 0

    def _passed(self, k: int, tension: float, *, outward: bool) -> NDArray[np.float64]:
        """Tensions along a piece that is entered with `tension`."""
        device, piece, friction = self.laid[k]
        if device is None or device.machine is None:
            return along(piece, tension, friction, self.places[k], begin=outward)
        rise = moved(self.route, device, self.t, self.speed, tension) - piece.load * piece.length
        rise += device.machine.inertia * self.acceleration
        return self.between(k, tension, tension + rise) if outward else self.between(k, tension - rise, tension)

    def between(self, k: int, before: float, after: float) -> NDArray[np.float64]:
        """A straight line over a piece."""
        piece = self.laid[k][1]
        return np.interp(self.places[k], (piece.begin, piece.end), (before, after))


def moved(route: LaidRoute, device: Device, t: float, speed: float, tension: float) -> float:
    """Rise of the tension over a device that moves with the line [N], outboard less inboard.

    A wheel resists with its bearing; belts and wheels give what pulls at them, and nothing when they are free.
    """
    assert device.machine is not None
    return bearing(device, tension) * math.copysign(1, speed) - route.pull(device.machine, t, speed, 0.0)


def _drives(device: Device | None) -> bool:
    return device is not None and device.machine is not None and device.machine.drives


def _undetermined(laid: list[Laid], between: list[int], tension: float) -> str:
    beside = [laid[k][0] if 0 <= k < len(laid) else None for k in (between[0] - 1, between[-1] + 1)]
    who = [one.name if one is not None else end for one, end in zip(beside, ("its inboard end", "its outboard end"))]
    return (
        f"two drives hold the line, at {who[0]} and at {who[1]}: the tension between them is that of the start, "
        f"{tension:g} N, or what they make of it"
    )


def _assembled(march: _March, remarks: tuple[str, ...]) -> State:
    """Passages in order, those of drives from the tensions on both sides; and what the drives give."""
    route, found, passages, drives = march.route, march.found, [], []
    for k, (device, piece, friction) in enumerate(march.laid):
        if k not in found:
            before = float(found[k - 1][-1]) if k - 1 in found else _end_tension(march, inboard=True)
            after = float(found[k + 1][0]) if k + 1 in found else _end_tension(march, inboard=False)
            found[k] = march.between(k, before, after)
        passages.append(Passage(device.name if device else "", device, piece, friction, march.places[k], found[k]))
        if device is not None and device.machine is not None and (_drives(device) or device.machine.efforts):
            given = float(found[k][0] - found[k][-1]) - piece.load * piece.length
            own = device.machine.inertia * march.acceleration if device.machine.drives else 0.0
            drives.append(Drive(device.name, given, march.speed, capacity(device, piece), lever(device), own))
    remarks = (*remarks, *filter(None, map(_slips, passages)))
    state = State(route, march.t, march.speed, march.way, tuple(passages), (), march.acceleration, remarks)
    return replace(state, drives=(*_end_drives(state), *drives))


def _slips(one: Passage) -> str:
    """What there is to say of a wheel on which the line slips, for what pulls on its two sides."""
    device, piece = one.device, one.piece
    if device is None or device.machine is None or device.clamps or not piece.curvature or not device.touches:
        return ""
    low, high = sorted((one.inboard, one.outboard))
    most = beyond(piece, max(low, 0.0), device.friction(0.0), piece.length) if math.isfinite(low) else math.inf
    if high <= most * (1 + 1e-9):
        return ""
    return f"{device.name}: {high:.4g} N on one side and {low:.4g} N on the other are more than it grips, {most:.4g} N"


def _end_drives(state: State) -> Iterator[Drive]:
    """What acts at the ends of the line: the winch, a hand."""
    route, passages = state.route, state.passages
    if not passages:
        return
    winch = route.winch is not None
    ends = [
        (route.winch.name if route.winch else "inboard end", route.inboard, -passages[0].inboard),
        ("outboard end", route.outboard, passages[-1].outboard),
    ]
    for name, made, force in ends:
        if made.drives or made.efforts or made.tension is not None:
            arm = route.radius(state.way) if made is route.inboard and winch else None
            stored = route.stored(state.way) if made is route.inboard else 0.0
            heavy = route.inertia(made, state.way) + route.mass * stored
            yield Drive(name, force, state.speed, None, arm, heavy * state.acceleration)


def _end_tension(march: _March, *, inboard: bool) -> float:
    """Tension beside a drive that is the first or the last of all."""
    route = march.route
    if inboard and not route.inboard.drives:
        return inboard_tension(route, march.t, march.speed, march.way, march.acceleration)
    if not inboard and not route.outboard.drives:
        return outboard_tension(route, march.t, march.speed, march.way, march.acceleration)
    return route.says.tension


def capacity(device: Device, piece: Piece) -> float | None:
    """Largest force of belts on the line, 2 mu q length [N]; None for what is not clamped, or nobody knows how."""
    return device.friction(0.0) * piece.counts(piece.pressed) * piece.length if device.clamps else None


def lever(device: Device) -> float | None:
    """Radius from the surface of a device to its shaft [m]."""
    radius = device.station.lever()
    return None if radius is None else float(radius)


def _not_counted(route: LaidRoute) -> Iterator[str]:
    """What acts on the line's movers and is no part of the statics."""
    movers = [("inboard end", route.inboard), ("outboard end", route.outboard)]
    movers += [(one.name, one.machine) for one in route.devices if one.machine is not None]
    for name, made in movers:
        if made.left_out and not made.drives and made.tension is None:
            who = dict.fromkeys(_line_or_part(route, path) for path in made.left_out)
            counted = "acts there, and is" if len(who) == 1 else "act there, and are"
            yield f"{name}: {', '.join(who)} {counted} not counted"
        if made.unknown and made.by not in route.flat.assembly.lines:
            yield f"{name}: what {made.by} gives cannot be told; it is taken to hold whatever comes"


def _neighbours(route: LaidRoute) -> Iterator[str]:
    """The lines that are joined to this one, and what is taken of them."""
    for end, made, other in (("inboard", route.inboard, route.before), ("outboard", route.outboard, route.beyond)):
        if other is not None:
            yield f"{end} end: {other.line.path} is joined to it, and pulls with what its own statics says"
        elif made.unknown and made.by in route.flat.assembly.lines:
            yield f"{end} end: {made.by} is joined to it, and gives whatever force its motion takes"


def _line_or_part(route: LaidRoute, path: str) -> str:
    """The line that has this part, or the part itself."""
    return next((line for line in route.flat.assembly.lines if path.startswith(f"{line}.")), path)
