"""Remarks on references that are faster than their drive can go, by the speed without load and with that of statics."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np

from fairlead.analysis.statics.fastest import Motor, motors
from fairlead.analysis.statics.machines import bodies
from fairlead.analysis.statics.schedule import LOOKS
from fairlead.analysis.statics.solution import Statics
from fairlead.analysis.statics.tracing import Traced, trace
from fairlead.component.assembly import Instance, PortRef
from fairlead.component.values import Wave
from fairlead.errors import Fault
from fairlead.flatten.flat_model import FlatModel

ENDLESS = 1e6  # times what is asked for: a speed that nothing limits
WAY_OUT = "Ask for less, or give a larger valve, more pressure or voltage, another motor or another gear."


def slow_drives(flat: FlatModel, solved: Iterable[Statics]) -> Iterator[Fault]:
    """One remark for each controller whose reference its drive cannot reach, and for each drive of a line."""
    loads = [load for found in solved for load in _loads(found)]
    told: set[str] = set()
    for instance in flat.instances:
        follows = instance.type.answers.follows
        if follows is None:
            continue
        reference, measured = (trace(flat, PortRef(instance.path, name)) for name in follows)
        wave = reference.told() if reference is not None else None
        if wave is None or measured is None or measured.senses is None:
            continue
        for motor in motors(flat, bodies(flat, measured.senses)):
            told.add(motor.path)
            yield from _reference(flat, instance, wave, measured, motor, loads)
    for name, ratios, speed, force in loads:
        for motor in motors(flat, ratios):
            if motor.path not in told and (fault := _line(flat, name, motor, speed, force)):
                told.add(motor.path)
                yield fault


def most(flat: FlatModel, wave: Wave) -> float:
    """Largest size of a wave in the time of the run."""
    run = flat.assembly.netlist.run
    corners = [t for t in wave.borders if run.start <= t <= run.stop]
    times = [*np.linspace(run.start, run.stop, LOOKS).tolist(), *corners]
    return max(abs(wave(t)) for t in times)


def _loads(found: Statics) -> Iterator[tuple[str, dict[int, float], float, float]]:
    """(name, bodies that move with it, line speed, force) of the drives in every steady state."""
    route = found.route
    made = {one.name: one.machine for one in route.devices if one.machine is not None}
    made |= {route.winch.name if route.winch else "inboard end": route.inboard, "outboard end": route.outboard}
    for state in found.moving:
        for drive in state.drives:
            at = made[drive.name]
            ratios = {group: ratio / route.lever(at, state.way) for group, ratio in at.ratios.items()}
            name = f"{route.route.path}.{drive.name}" if " " not in drive.name else f"{route.line.path}, {drive.name}"
            yield name, ratios, state.speed, drive.force


def _reference(
    flat: FlatModel, controller: Instance, wave: Wave, measured: Traced, motor: Motor,
    loads: list[tuple[str, dict[int, float], float, float]],
) -> Iterator[Fault]:  # fmt: skip
    """A reference against the speed that the sensor tells when its motor gives all it can."""
    asked, reach = most(flat, wave), abs(measured.factor) * motor.fastest()
    goes, free = f"{controller.path}: its reference goes to {asked:.4g}, and {motor.path} reaches", ""
    if reach < ENDLESS * asked:
        free = f" {reach:.4g} without load,"
    what = f"{goes}{free}".rstrip(",")
    if asked > reach:
        yield Fault(controller.where, f"{what}.", WAY_OUT)
        return
    for name, ratios, speed, force in loads:
        same = next((one for one in motors(flat, ratios) if one.path == motor.path), None)
        if same is not None and force * speed > 0:
            loaded = reach * same.fastest(force) / same.fastest()
            if asked > loaded:
                what = f"{goes}{free} {loaded:.4g} with the {abs(force):.4g} N of {name}."
                yield Fault(controller.where, what, WAY_OUT)
                return


def _line(flat: FlatModel, name: str, motor: Motor, speed: float, force: float) -> Fault | None:
    """A drive that follows the line, such as a winch that keeps a tension."""
    reach = motor.fastest(force if force * speed > 0 else 0.0)
    if abs(speed) <= reach:
        return None
    against = f" against {abs(force):.4g} N" if force * speed > 0 else " without load"
    what = f"{name}: the line runs at {abs(speed):.4g} m/s, and {motor.path} reaches {reach:.4g} m/s{against}."
    where = flat.assembly.instances[motor.path].where
    return Fault(where, what, "Run the line slower, or give a stronger drive or another gear.")
