"""What acts on a linearised model, and what is looked at.

    acts     a force, torque or flow at a node, named by a part or port there (`block`, `shaft.b`); or a signal input
             that nothing is connected to (`valve.command`)
    seen     any signal that can be recorded (`block.x`, `pad.force`)

A force is added to the balance of its node. Derivatives to a signal, and those of what is looked at, are central
differences with frozen zones: there is no switch between their points.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import Fault, Location, did_you_mean, listing, shown
from fairlead.kernels.layout import OUTPUT
from fairlead.system.compiled.asking import ask, call
from fairlead.system.compiled.opened import FreeInput, free_inputs
from fairlead.system.compiled.system import Instance

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
SMALL = float(np.cbrt(np.finfo(float).eps))
"""Step of a central difference in sizes of what is varied: rounding and curvature leave equal errors."""


@dataclass(frozen=True)
class Acting:
    """Something that acts: its name and unit, the column b of f (all unknowns), and what it adds to what is seen."""

    name: str
    unit: str
    column: Floats
    direct: float


@dataclass(frozen=True)
class Seen:
    """A signal: its name and unit, and its derivatives to all unknowns."""

    name: str
    unit: str
    row: Floats


@dataclass(frozen=True)
class Point:
    """An instant with zones in force, whose equations can be asked beside it."""

    instance: Instance
    t: float
    y: Floats
    zones: Integers
    sizes: Floats
    """[n]: usual sizes of the unknowns."""

    def values(self, name: str, y: Floats, size: int) -> Floats:
        """A callback at y."""
        before, made = self.instance.zones.copy(), np.zeros(size)
        self.instance.zones[:] = self.zones
        try:
            call(self.instance, name, self.t, y, made)
        finally:
            self.instance.zones[:] = before
        return made

    def outputs(self, y: Floats) -> Floats:
        """All that is recorded at y."""
        return self.values("outputs", y, self.instance.n_outputs)


def seen(point: Point, name: str, faults: list[Fault]) -> Seen | None:
    """A signal by name."""
    recorded = {one.name: k for k, one in enumerate(point.instance.recorded)}
    if name not in recorded:
        what = f"no signal has the name {shown(name)}. {did_you_mean(name, recorded)}".rstrip()
        faults.append(Fault(Location("out"), what, f"There are {listing(recorded)}."))
        return None
    column = recorded[name]
    row = np.zeros(point.instance.n)
    for k in range(point.instance.n):
        step = SMALL * max(abs(point.y[k]), point.sizes[k])
        ends = []
        for side in (-1.0, 1.0):
            y = point.y.copy()
            y[k] += side * step
            ends.append(point.outputs(y)[column])
        row[k] = (ends[1] - ends[0]) / (2 * step)
    return Seen(name, point.instance.recorded[column].unit, row)


def of_input(point: Point, name: str, out: Seen | None, faults: list[Fault]) -> Acting | None:
    """A force at a node or a signal input by name. `out` is what is looked at."""
    free = {one_name: one for one in free_inputs(point.instance) for one_name in one.names}
    if name in free:
        return _signal(point, name, free[name], out)
    nodes = dict(_nodes(point.instance))
    if name not in nodes:
        known = [*free, *nodes]
        what = f"nothing can act on {shown(name)}. {did_you_mean(name, known)}".rstrip()
        faults.append(Fault(Location("in"), what, f"There are {listing(known)}."))
        return None
    row, unit, ratio = nodes[name]
    column = np.zeros(point.instance.n)
    column[row] = ratio
    late = out is not None and point.instance.recording([out.name]).late
    return Acting(name, unit, column, ratio * _by_acceleration(point, out, row) if late and out is not None else 0.0)


def _by_acceleration(point: Point, out: Seen, row: int) -> float:
    """What a unit force in a row of f adds at once to a signal that reads accelerations."""
    instance, memory = point.instance, point.instance.memory
    column = [one.name for one in instance.recorded].index(out.name)
    source, at = instance.recorded[column].at, instance.numbering.acceleration + row
    begun = point.outputs(point.y)[column]  # and all accelerations are in z
    if source < 0:
        return 0.0
    z, everything, ends = memory["z"], memory["outputs_all"], []
    before, zones, step = float(z[at]), instance.zones.copy(), SMALL * max(abs(float(z[at])), abs(float(begun)), 1.0)
    instance.zones[:] = point.zones
    try:
        for side in (-1.0, 1.0):
            z[at] = before + side * step
            for number, block in enumerate(instance.blocks):
                ask(instance, number, OUTPUT, np.ones(block.count, dtype=bool), everything)
            ends.append(float(everything[source]))
    finally:
        z[at], instance.zones[:] = before, zones
    return (ends[1] - ends[0]) / (2 * step) * float(memory["inverse_mass"][row])


def _nodes(instance: Instance) -> Iterator[tuple[str, tuple[int, str, float]]]:
    """Ports, and parts of one node, where a force has a balance to go to: row, unit and ratio."""
    of_parts: dict[str, dict[tuple[int, float], str]] = {}
    for port in instance.flat.node_of:
        group, ratio, _ = instance.flat.place(port)
        if group in instance.numbering.balance:
            yield str(port), (instance.numbering.balance[group], _unit(instance, group), ratio)
            of_parts.setdefault(port.instance, {})[group, ratio] = str(port)
    for part, places in of_parts.items():
        if len(places) == 1:
            ((group, ratio),) = places
            yield part, (instance.numbering.balance[group], _unit(instance, group), ratio)


def _unit(instance: Instance, group: int) -> str:
    return instance.flat.groups[group].domain.through[1]


def _signal(point: Point, name: str, one: FreeInput, out: Seen | None) -> Acting:
    """Derivatives to a signal input, set aside and back again."""
    block, i, j = one.place
    offsets = point.instance.blocks[block].in_offset
    begun = float(offsets[i, j])
    step = SMALL * max(abs(begun), 1.0)
    rows, outputs = [], []
    try:
        for side in (-1.0, 1.0):
            offsets[i, j] = begun + side * step
            rows.append(point.values("forces", point.y, point.instance.n))
            outputs.append(point.outputs(point.y))
    finally:
        offsets[i, j] = begun
    recorded = [signal.name for signal in point.instance.recorded]
    direct = 0.0 if out is None else float((outputs[1] - outputs[0])[recorded.index(out.name)] / (2 * step))
    return Acting(name, one.declared.unit, (rows[1] - rows[0]) / (2 * step), direct)
