"""Whether a line may move as one body in a sea (`form: rigid`): where its hose slips far, and where waves count."""

from __future__ import annotations

import math
from collections.abc import Iterator

from fairlead.analysis.statics.laid_route import Device, LaidRoute
from fairlead.analysis.statics.schedule import Schedule
from fairlead.analysis.statics.station_place import where
from fairlead.errors import Fault


def rigid_seas(route: LaidRoute) -> Iterator[Fault]:
    """Margins shorter than a module in which a hose slips; speeds that change faster than a wave comes back."""
    for sea in route.seas:
        if sea.station.moves_as_one():
            yield from _short_margin(route, sea)
            yield from _fast_change(route, sea)


def _short_margin(route: LaidRoute, sea: Device) -> Iterator[Fault]:
    margin, module = sea.station.keeps_apart(), route.says.slips_over()
    if margin is None or margin >= module:
        return
    what = (
        f"{route.route.path}.{sea.name}.margin = {margin:.4g} m is shorter than a module of {route.line.path}, "
        f"{module:.4g} m: the hose is held to the core there, and not by the next connector."
    )
    cure = "De-registration and compression of the hose will be too small; leave out the margin if they count."
    yield Fault(where(route, sea.name), what, cure)


def _fast_change(route: LaidRoute, sea: Device) -> Iterator[Fault]:
    """The change of speed that is over soonest, for the time in which a wave runs out to the end and back."""
    schedule, worst = route.schedule(), None
    for begin, end, change in changes(schedule) if schedule is not None else ():
        assert schedule is not None
        beyond = route.ends(schedule.way(begin))[1] - route.says.rigid_from(sea.begin, sea.station)
        back = 2 * beyond / math.sqrt(route.stiffness / route.mass)
        if end - begin < back and (worst is None or back - (end - begin) > worst[0]):
            worst = back - (end - begin), begin, end - begin, change, beyond, back
    if worst is None:
        return
    _, begin, takes, change, beyond, back = worst
    what = (
        f"{route.route.path}.{sea.name}: at {begin:.4g} s the speed changes by {change:.3g} m/s in {takes:.3g} s, and "
        f"a wave needs {back:.2g} s to the end of the {beyond:.4g} m that move as one, and back."
    )
    more = route.mass * beyond * abs(change) / takes
    cure = f"Their inertia adds {more:.4g} N to the tension, more than with waves; form: distributed has them."
    yield Fault(where(route, sea.name), what, cure)


def changes(schedule: Schedule) -> Iterator[tuple[float, float, float]]:
    """(begin, end, change) of every rise and fall of a speed; what goes on in the same sense is one."""
    rates = list(schedule.accelerations())
    begin = end = change = 0.0
    for (t0, v0, _), (t1, v1, _) in zip(rates[::2], rates[1::2], strict=True):
        if change and t0 == end and change * (v1 - v0) > 0:
            end, change = t1, change + v1 - v0
            continue
        if change:
            yield begin, end, change
        begin, end, change = t0, t1, v1 - v0
    if change:
        yield begin, end, change
