"""Whether a winch has the line it is to haul: told when that begins outboard, stays on it, comes off or is too long."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from fairlead.analysis.statics.laid_route import LaidRoute
from fairlead.analysis.statics.schedule import LOOKS, Schedule
from fairlead.errors import Fault, Location

TOUCHES = 1e-6  # m


def off_the_drum(route: LaidRoute) -> Iterator[Fault]:
    """A line that begins outboard of a winch; one that stays on it; one of which more is paid out than is stored."""
    p, name = route.says, route.line.path
    listed = [one for one in route.route.line.placed if one.station.stores()]
    for one in listed if route.winch is None else ():
        what = (
            f"{name} begins at {p.start:g} m, and what lies inboard of {one.end:g} m is on "
            f"{route.route.path}.{one.name}: {p.start - one.end:.3g} m are missing, so the winch does not hold it."
        )
        yield Fault(_start(route), what, f"Let it start below {one.end:g} m, or leave out the winch.")
    if route.winch is None:
        return
    schedule = route.schedule()
    way, t = most_paid_out(schedule) if schedule is not None else (0.0, 0.0)
    stored, inside = route.stored(0.0), route.winch.end - p.start - p.length
    if inside > max(way, TOUCHES):
        what = (
            f"{name} lies on {route.route.path}.{route.winch.name} with all its length, from {p.start:g} to "
            f"{p.start + p.length:g} m: {inside:.4g} m must be paid out before it comes off, and {way:.4g} m are."
        )
        yield Fault(_start(route), what, f"Let it start above {route.winch.end - p.length:g} m.")
    if way > stored * (1 + 1e-9):
        what = (
            f"{route.route.path}.{route.winch.name}: {way:.4g} m are paid out by {t:.4g} s, and {stored:.4g} m lie on "
            f"the drum; the inboard end of {name} comes off it."
        )
        yield Fault(_start(route), what, f"Let {name} start at {route.winch.end - way:.4g} m or further inboard.")
    yield from _over_the_flanges(route, schedule)


def _over_the_flanges(route: LaidRoute, schedule: Schedule | None) -> Iterator[Fault]:
    """A drum on which more is wound than its flanges take; all of the line may be, where nothing tells how much."""
    assert route.winch is not None
    most = route.winch.station.takes(route.says.diameter)
    if schedule is None:
        wound, when = route.says.length, "if all of it is hauled in"
    else:
        times = np.linspace(schedule.begin, schedule.end, LOOKS)
        ways = np.array([schedule.way(float(t)) for t in times])
        wound = route.stored(0.0) - float(ways.min())
        when = f"by {times[int(ways.argmin())]:.4g} s"
    wound = min(wound, route.says.length)
    if wound > most * (1 + 1e-9):
        drum = f"{route.route.path}.{route.winch.name}"
        what = f"{drum}: {wound:.4g} m of {route.line.path} lie on it {when}, and its flanges take {most:.4g} m."
        yield Fault(_start(route), what, "Give a wider drum, higher flanges or a larger radius.")


def most_paid_out(schedule: Schedule) -> tuple[float, float]:
    """The most that is paid out [m], and when first."""
    times = np.unique([*np.linspace(schedule.begin, schedule.end, LOOKS), *(one.end for one in schedule.stretches())])
    ways = [schedule.way(float(t)) for t in times]
    return max(ways), float(times[int(np.argmax(ways))])


def _start(route: LaidRoute) -> Location:
    """Where the netlist says where the line begins."""
    entry = route.flat.assembly.netlist.components.get(route.line.path)
    start = entry.parameters.get(route.says.start_from) if entry is not None else None
    return start.where if start is not None else route.line.where
