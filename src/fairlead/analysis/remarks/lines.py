"""Remarks on lines on routes: what statics finds of clamps, curves and drums, and rigid holds."""

from __future__ import annotations

from collections.abc import Iterator

from fairlead.analysis.remarks.rigid_seas import rigid_seas
from fairlead.analysis.statics.on_the_drum import off_the_drum
from fairlead.analysis.statics.solution import WANTED, Statics
from fairlead.analysis.statics.states import State
from fairlead.analysis.statics.station_place import where
from fairlead.errors import Fault


def on_lines(solved: list[Statics]) -> list[Fault]:
    """Weak clamps, tight curves, winches without line, rigid seas that are not."""
    found: list[Fault] = []
    for one in solved:
        found += [*weak_clamps(one), *side_walls(one), *off_the_drum(one.route), *rigid_seas(one.route)]
    return found


def weak_clamps(found: Statics) -> Iterator[Fault]:
    """Deployers whose belts hold less than `WANTED` times the force they must give."""
    for device in found.route.devices:
        needs = [
            (abs(drive.force), drive.capacity, state)
            for state in (*found.moving, *found.starts)
            for drive in state.drives
            if drive.name == device.name and drive.capacity is not None
        ]
        if not needs:
            continue
        worst, holds, state = max(needs, key=lambda need: need[0] / need[1] if need[1] else need[0] * 1e30)
        steady = max((force for force, _, state in needs if not state.acceleration), default=0.0)
        if worst <= 0 or holds >= WANTED * worst:
            continue
        name = f"{found.route.route.path}.{device.name}"
        what = (
            f"{name}: its belts hold {holds:.4g} N (2 mu q length), {_needed(worst, steady, state)}: a factor of "
            f"{holds / worst:.2g}, {WANTED:g} is wanted."
        )
        grip = 2 * device.friction(0.0) * (device.end - device.begin)  # force per load of each belt
        cure = f"A clamp of {WANTED * worst / grip:.3g} N/m for each belt would do." if grip else "Give them friction."
        yield Fault(where(found.route, device.name), what, f"{'They will slip. ' if holds < worst else ''}{cure}")


def _needed(worst: float, steady: float, state: State) -> str:
    """What the belts must give, steadily and while the speed changes."""
    if not state.acceleration:
        return f"and {'paying out' if state.speed > 0 else 'hauling'} takes {worst:.4g} N"
    change = f"a change of speed of {abs(state.acceleration):.3g} m/s^2 at {state.t:.4g} s"
    return f"steady motion takes up to {steady:.4g} N and {change} {worst:.4g} N"


def side_walls(found: Statics) -> Iterator[Fault]:
    """Curves in which the line is pressed harder than it bears."""
    most = found.route.says.side_wall
    if most is None:
        return
    worst: dict[str, tuple[float, State]] = {}
    for state in (*found.moving, *found.starts):
        for one in state.passages:
            if one.device is not None and one.side_wall > max(most, worst.get(one.name, (0.0, state))[0]):
                worst[one.name] = one.side_wall, state
    for name, (load, state) in worst.items():
        device = f"{found.route.route.path}.{name}"
        when = f"hauled at {-state.speed:.3g}" if state.speed < 0 else f"paid out at {state.speed:.3g}"
        when = f"{when} m/s" if not state.acceleration else f"changing its speed at {state.t:.4g} s"
        what = f"{device}: {when} the line is pressed with {load:.4g} N/m (tension over radius), "
        bears = f"more than {found.route.line.path} bears, {most:.4g} N/m."
        yield Fault(where(found.route, name), what + bears, "Use a larger radius, or a line that bears more.")
