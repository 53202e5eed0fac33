"""Start values on bodies whose motion is given: they must be those with which the motion begins.

A body that is driven is where its drive has it, and as fast. What a part of it says of its start would be dropped;
where it says other than the drive, that is a contradiction. A motion given by its velocity alone begins where the body
is (`starts_at`).
"""

from __future__ import annotations

import math

import numpy as np

from fairlead.component.assembly import Instance, PortRef
from fairlead.component.replies import AnswerError
from fairlead.errors import Fault
from fairlead.flatten.flat_model import FlatModel, Group
from fairlead.system.compiled.asking import call
from fairlead.system.compiled.system import Floats, System

AGREES = 1e-9
"""Relative difference of two numbers that are one: what a netlist says is rounded."""
ROUNDED = 1e-12
"""The same in m, or m/s, where one of them is zero."""


def overridden(system: System) -> list[Fault]:
    """Start values that a given motion overrides by others, with both ends and both values."""
    flat = system.flat
    driven = {k: one for k, one in enumerate(flat.groups) if one.prescribed is not None and one.prescribed.outputs}
    telling = flat.those(lambda kind: kind.answers.start is not None) if driven else []
    said = [one for instance in telling for one in _said(flat, instance, driven)]
    if not said:
        return []
    signals = _signals(system)
    moves = {index: _motion(system, driven[index], signals) for _, _, index, _ in said}
    return [fault for one in said for fault in _faults(flat, *one, moves[one[2]])]


def _said(flat: FlatModel, instance: Instance, driven: dict[int, Group]
          ) -> list[tuple[Instance, PortRef, int, tuple[float | None, float | None]]]:  # fmt: skip
    """What an instance says of the start of driven bodies."""
    says = instance.type.answers.start
    try:
        values = says(instance.values) if says is not None else {}
    except AnswerError:
        return []  # told before
    found = []
    for port, value in values.items():
        ref = PortRef(instance.path, port)
        index = flat.place(ref)[0]
        if index in driven and isinstance(value, tuple):
            found.append((instance, ref, index, value))
    return found


def _signals(system: System) -> Floats:
    """What all signals are at the start."""
    here = system.instance()
    call(here, "rhs", here.start, here.initial, np.zeros(here.n))
    return np.array(here.memory["z"])


def _motion(system: System, group: Group, signals: Floats) -> tuple[float, float]:
    """Place and speed of a driven body at the start."""
    assert group.prescribed is not None
    assert group.prescribed.outputs is not None
    by, numbering = group.prescribed.by, system.numbering
    _, ratio, offset = system.flat.place(by)
    place, speed = (float(signals[numbering.n + numbering.signals[PortRef(by.instance, name)]])
                    for name in group.prescribed.outputs[:2])  # fmt: skip
    return (place - offset) / ratio, speed / ratio


def _faults(flat: FlatModel, instance: Instance, ref: PortRef, index: int, said: tuple[float | None, float | None],
            moves: tuple[float, float]) -> list[Fault]:  # fmt: skip
    _, ratio, offset = flat.place(ref)
    drive = flat.groups[index].prescribed
    assert drive is not None
    faults = []
    for value, moved, (variable, unit) in zip(
        said, (ratio * moves[0] + offset, ratio * moves[1]),
        instance.type.declaration.ports[ref.port].domain.across, strict=True,
    ):  # fmt: skip
        if value is not None and not math.isclose(value, moved, rel_tol=AGREES, abs_tol=ROUNDED):
            what = (
                f"{flat.assembly.named(ref)}.{variable} starts at {value:g} {unit}; {flat.assembly.named(drive.by)} is "
                f"given a motion in which it starts at {moved:g} {unit}."
            )
            way_out = "Leave that start value out, or give one that agrees, or let the motion begin there."
            faults.append(Fault(instance.where, what, way_out))
    return faults
