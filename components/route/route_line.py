"""What a line must know of a route: the surfaces it may touch, and what else acts on it where."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

from fairlead.components.friction.coulomb import Coulomb
from fairlead.components.route.placing import Placed
from fairlead.components.route.station import Machinery, Station
from fairlead.components.route.window import Window

from fairlead.component.alike import Parts, agree
from fairlead.component.along import OfRoute
from fairlead.component.scene import Scene

STANDING = "surface.flange"  # below the route: what does not move


@dataclass(frozen=True)
class Surface:
    """A surface that a node may touch: one contact per node, for all devices that share it.

    `flange` is what moves with it, below the route. The grip of a device is its friction over that of the surface:
    devices with constant friction share one contact, their loads counted by their grip.
    """

    name: str  # of the contact: "" for the first of the standing surfaces
    flange: str
    friction: Any
    all_round: bool
    devices: tuple[tuple[Placed, float], ...]  # with their grip

    def curved(self) -> list[Window]:
        """Curvature times grip along the route [1/m]."""
        return self._curved

    @functools.cached_property
    def _curved(self) -> list[Window]:
        return [one.window(one.curvature * grip) for one, grip in self.devices if one.curvature]

    def pressed(self, weight: float) -> list[Window]:
        """What presses besides tension, times grip [N/m]: weight on guides, squeezing tubes."""
        return [window for one, grip in self.devices if (window := resting(one, weight, grip)) is not None]


def resting(one: Placed, weight: float, grip: float) -> Window | None:
    """Load of a device that does not come from tension [N/m]; None when there is none."""
    load = one.station.squeeze() + (weight * math.cos(one.station.slope) if one.station.bears_weight() else 0.0)
    return one.window(abs(load) * grip) if load else None


@dataclass(frozen=True)
class RouteLine(OfRoute):
    """Devices of a route in their places, and the machinery of those that move."""

    placed: list[Placed]
    scene: Scene
    machinery: dict[str, Machinery] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Make the bodies of devices that move."""
        for one in self.placed:
            made = one.station.machinery(self.scene)
            if made is not None:
                self.machinery[one.name] = made

    @functools.cached_property
    def surfaces(self) -> list[Surface]:
        """Standing devices with alike friction share a surface; each moving one has its own."""
        made: list[Surface] = []
        for one in self.placed:
            curve = one.station.rubs()
            if curve is None:
                continue
            mover = self.machinery.get(one.name)
            if mover is not None:
                made.append(Surface(one.name, f"{one.name}.{mover.surface}", curve, False, ((one, 1.0),)))
                continue
            for k, surface in enumerate(made):
                grip = relative_grip(surface, one)
                if grip is not None:
                    made[k] = replace(surface, devices=(*surface.devices, (one, grip)))
                    break
            else:
                first = not any(surface.flange == STANDING for surface in made)
                made.append(
                    Surface("" if first else one.name, STANDING, curve, one.station.all_round(), ((one, 1.0),))
                )
        return made

    def handed_on(self, now: RouteLine) -> Parts | None:
        """Curves of which laying is to know nothing, and what stands in their place in `now`; None if more differs."""
        parts: Parts = {}
        if len(self.placed) != len(now.placed) or self._said() != now._said():
            return None
        pairs = zip(self.placed, now.placed, strict=True)
        if not all(agree(one.station, other.station, parts) for one, other in pairs):
            return None
        curves = ((one.friction, other.friction) for one, other in zip(self.surfaces, now.surfaces, strict=True))
        handed = all(id(one) in parts and parts[id(one)].now is other for one, other in curves)
        return parts if handed else None  # a station may work out a curve of its own

    def _said(self) -> list[Any]:
        """What laying is to know beside the parameters of the stations."""
        places = [(one.name, one.number, one.begin, one.end) for one in self.placed]
        movers = [(name, list(m.children), m.joins, m.ports, m.outputs, m.surface, m.clamp, m.total)
                  for name, m in self.machinery.items()]  # fmt: skip
        touched = [(one.name, one.flange, one.all_round, [(at.number, grip) for at, grip in one.devices])
                   for one in self.surfaces]  # fmt: skip
        return [places, movers, touched]

    def squeezing(self) -> Iterator[tuple[Placed, str]]:
        """Devices whose clamps press on the line, and the output that says how much."""
        for one in self.placed:
            made = self.machinery.get(one.name)
            if made is not None and made.clamp:
                yield one, f"{one.name}.{made.clamp}"

    def of_type(self, kind: type[Station]) -> list[Placed]:
        """Devices of a type, or of one that builds on it."""
        return [one for one in self.placed if issubclass(one.station.type, kind)]


def alike(one: Any, other: Any) -> bool:
    """True for curves of one type with the same parameters."""
    names = one.type.declaration.parameters
    return one.type is other.type and all(repr(one.given[n]) == repr(other.given[n]) for n in names)


def relative_grip(surface: Surface, one: Placed) -> float | None:
    """Friction of a device over that of a surface; None if one contact cannot do for both."""
    if surface.flange != STANDING or surface.all_round != one.station.all_round():
        return None
    mine, theirs = one.station.rubs(), surface.friction
    if alike(mine, theirs):
        return 1.0
    if mine.type is not Coulomb or theirs.type is not Coulomb or theirs.coulomb == 0 or mine.coulomb == 0:
        return None
    grip = float(mine.coulomb / theirs.coulomb)
    return grip if abs(mine.breakaway() - grip * theirs.breakaway()) < 1e-12 else None
