"""How fast a drive can go: valve and motor fully open, or a motor at all its voltage, without load and with it.

    hydraulic   w = K sqrt((p_s - p_t - p_load)/2)/D,   p_load = torque/D      (two lands, physics 5.3)
    electric    w = (U - R torque/k)/k

The numbers are read from what is joined with the shaft; a drive that is none of both has no limit that is known.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fairlead.component.instantiate import Instance, PortRef
from fairlead.flatten.flat_model import FlatModel


@dataclass(frozen=True)
class Motor:
    """A motor on a shaft that turns `ratio` times as fast as what is asked about."""

    path: str
    ratio: float
    no_load: float  # rad/s
    stall: float  # N m
    hydraulic: bool

    def fastest(self, effort: float = 0.0) -> float:
        """Largest speed of what is asked about against an effort there [N, N m]; 0 when the motor stalls."""
        share = 1 - abs(effort / self.ratio) / self.stall
        return self.no_load / abs(self.ratio) * max(share, 0.0) ** (0.5 if self.hydraulic else 1.0)


def motors(flat: FlatModel, ratios: dict[int, float]) -> list[Motor]:
    """Motors among bodies that move with something, `ratios` times as fast."""
    found = []
    for group, ratio in ratios.items():
        made = flat.groups[group]
        for node, own in zip(made.nodes, made.ratios, strict=True):
            for ref in flat.nodes[node].ports:
                limits = _limits(flat, flat.assembly.instances[ref.instance])
                if limits is not None and ratio * own:
                    found.append(Motor(ref.instance, ratio * own, *limits))
    return found


def _limits(flat: FlatModel, instance: Instance) -> tuple[float, float, bool] | None:
    """No-load speed [rad/s], stall torque [N m], hydraulic or not; None for what is no motor."""
    has, values = set(instance.type.declaration.parameters), instance.values
    if "displacement" in has:
        lands = _lands(flat, instance)
        if lands is None:
            return None
        drop = _pressure(flat, lands, "supply") - _pressure(flat, lands, "tank")
        if drop <= 0:
            return None
        flow = lands.values.conductance * math.sqrt(drop / 2)
        return flow / values.displacement, values.displacement * drop, True
    if {"most_voltage", "constant"} <= has:
        torque = values.constant * getattr(values, "most_current", math.inf)
        if values.resistance:
            torque = min(torque, values.constant * values.most_voltage / values.resistance)
        return values.most_voltage / values.constant, torque, False
    return None


def _lands(flat: FlatModel, motor: Instance) -> Instance | None:
    """The valve that feeds a motor: the motor itself when both are one law."""
    if "conductance" in motor.type.declaration.derived:
        return motor
    if "a" not in motor.type.declaration.ports:
        return None
    for ref in flat.nodes[flat.node_of[PortRef(motor.path, "a")]].ports:
        instance = flat.assembly.instances[ref.instance]
        if "conductance" in instance.type.declaration.derived and "supply" in instance.type.declaration.ports:
            return instance
    return None


def _pressure(flat: FlatModel, lands: Instance, port: str) -> float:
    """Pressure at the start, which is that of the power unit without flow [Pa]."""
    group, ratio, offset = flat.place(PortRef(lands.path, port))
    return ratio * flat.groups[group].start[0] + offset
