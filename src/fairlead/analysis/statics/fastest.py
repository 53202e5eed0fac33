"""How fast a drive can go: valve and motor fully open, or a motor at all its voltage, without load and with it.

    hydraulic   w = K sqrt((p_s - p_t - p_load)/2)/D,   p_load = torque/D      (two lands, physics 5.3)
    electric    w = (U - R torque/k)/k

A motor on the shaft says what it is: `fastest`, or `swept` and the valve `metered` that feeds it. A drive that says
neither has no limit that is known.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from fairlead.component.assembly import Instance, PortRef
from fairlead.component.declare import HYDRAULIC
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
    says, values = instance.type.answers, instance.values
    if says.fastest is not None:
        return (*says.fastest(values), False)
    lands = _lands(flat, instance) if says.swept else None
    if lands is None or lands.type.answers.fed is None:
        return None
    inward, back = (_pressure(flat, lands, port) for port in lands.type.answers.fed)
    if inward <= back:
        return None
    swept, flow = values.path(says.swept), lands.values.path(lands.type.answers.metered)
    return flow * math.sqrt((inward - back) / 2) / swept, swept * (inward - back), True


def _lands(flat: FlatModel, motor: Instance) -> Instance | None:
    """The valve that feeds a motor: the motor itself when both are one law, else what its oil comes from."""
    if motor.type.answers.metered:
        return motor
    for name, port in motor.type.declaration.ports.items():
        for ref in flat.nodes[flat.node_of[PortRef(motor.path, name)]].ports if port.domain is HYDRAULIC else ():
            instance = flat.assembly.instances[ref.instance]
            if instance.type.answers.metered and ref.port not in (instance.type.answers.fed or ()):
                return instance
    return None


def _pressure(flat: FlatModel, lands: Instance, port: str) -> float:
    """Pressure at the start, which is that of the power unit without flow [Pa]."""
    group, ratio, offset = flat.place(PortRef(lands.path, port))
    return ratio * flat.groups[group].start[0] + offset
