"""A line on its route as statics sees it: where what touches it, what moves it, and what pulls at its ends.

Read from the flat model, which knows all numbers; nothing is compiled.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from fairlead.analysis.statics.machines import Machine, machine
from fairlead.analysis.statics.off_the_drum import line_speed
from fairlead.analysis.statics.schedule import Schedule
from fairlead.analysis.statics.tracing import trace
from fairlead.brief import in_a_line
from fairlead.component.along import OfLine, OfRoute
from fairlead.component.assembly import Line, PortRef
from fairlead.component.declare import ROTATIONAL
from fairlead.component.effects import switch
from fairlead.component.piecewise import PiecewisePolynomial
from fairlead.component.values import Wave, steady
from fairlead.flatten.flat_model import FlatModel

AMBIENT = 293.15  # K, of a contact that nothing warms


@dataclass(frozen=True)
class Device:
    """A station with a surface, a slope or a drive, between `begin` and `end` [m]; `machine` moves its surface.

    `clamps` add up to the load of each belt of a deployer [N/m]; None where a signal adds what cannot be told.
    """

    __repr__ = in_a_line

    name: str
    begin: float
    end: float
    station: Any
    curve: Any = None  # of its friction on the line
    machine: Machine | None = None
    clamps: tuple[Wave, ...] | None = ()

    def squeeze(self, t: float) -> float:
        """Load with which it presses on the line all round [N/m], as far as it can be told."""
        return float(self.station.squeeze()) + 2 * sum(wave(t) for wave in self.clamps or ())

    @property
    def clamping(self) -> bool:
        """True for belts that clamp the line, also where nobody can tell how hard."""
        return self.clamps != ()

    @property
    def curvature(self) -> float:
        """1/m."""
        radius = self.station.bend_radius()
        return 1 / radius if radius else 0.0

    @property
    def touches(self) -> bool:
        """False for what the line only passes by."""
        return self.curve is not None

    def friction(self, slip: float) -> float:
        """Coefficient at a slip speed [m/s] of the line, outboard positive; 0: that from rest."""
        return 0.0 if self.curve is None else coefficient(self.curve, slip)


def coefficient(curve: Any, slip: float) -> float:
    """Coefficient of a curve at a slip speed and at the temperature of the surroundings; 0: that from rest."""
    backward = slip < 0 and curve.backward is not None
    if curve.velocity_shift is not None:
        slip *= math.exp(-curve.velocity_shift * (AMBIENT - curve.reference_temperature))
    if slip == 0:
        plain = float(curve.breakaway())
    else:
        plain = float(curve.backward(-slip) if backward else curve.coefficient(abs(slip)))
    cold = curve.softening is None
    return plain if cold else plain * math.exp(-curve.softening * (AMBIENT - curve.reference_temperature))


@dataclass(frozen=True)
class LaidRoute:
    """One line on one route. `inboard` acts at `first`, where the line leaves the drum or begins."""

    __repr__ = in_a_line

    flat: FlatModel
    line: Line
    route: Line
    devices: tuple[Device, ...]
    inboard: Machine
    outboard: Machine
    winch: Device | None
    seas: tuple[Device, ...]
    before: LaidRoute | None = None
    """A line that pulls at its inboard end; `beyond`: at its outboard end (joined.py)."""
    beyond: LaidRoute | None = None
    moved_by: LaidRoute | None = None
    """A line joined to it, of which a reference tells the speed of both."""

    @property
    def says(self) -> OfLine:
        """What the line says of itself."""
        said: OfLine = self.line.line
        return said

    def power(self, curve: Any) -> tuple[float, float]:
        """How friction grows with the load on a metre of line: the exponent, and the load that a curve holds for [N/m].

        (1, 1) where it grows in proportion.
        """
        effect = self.flat.assembly.scene.effects.get("load_dependence")
        if curve is None or curve.load_exponent is None or (effect is not None and switch(effect.plain()) == "off"):
            return 1.0, 1.0
        return float(curve.load_exponent), float(curve.load_reference)

    @property
    def mass(self) -> float:
        """Mass per length [kg/m]."""
        return self.says.mass

    @property
    def layers(self) -> tuple[float, float]:
        """EA of hose and core [N]; of a line of one layer its own and none."""
        each = self.says.stiffnesses
        return (each[0], each[1]) if self.says.slips else (self.stiffness, 0.0)

    @property
    def stiffness(self) -> float:
        """EA of all layers [N]."""
        return float(sum(self.says.stiffnesses))

    @property
    def pushes(self) -> bool:
        """True when the line can carry compression."""
        return self.says.pushes

    def ends(self, way: float) -> tuple[float, float]:
        """Where the line lies on the route [m] after `way` was paid out: from the drum, or its inboard end."""
        begin, end = self.says.start + way, self.says.start + self.says.length + way
        return (max(begin, self.winch.end), end) if self.winch is not None else (begin, end)

    def connectors(self, way: float) -> list[float]:
        """Places of the end connectors on the route [m]."""
        mesh = self.says.mesh
        return [self.says.start + way + mesh.places[node] for node in sorted(mesh.connectors)]

    def stored(self, way: float) -> float:
        """Line on the drum [m]."""
        return max(self.ends(way)[0] - self.says.start - way, 0.0)

    def radius(self, way: float) -> float:
        """Radius at which the line leaves the drum [m]; 1 when there is none."""
        if self.winch is None:
            return 1.0
        return float(self.winch.station.leaves_at(self.stored(way), self.says.diameter))

    def layer(self, way: float) -> int | None:
        """The layer of the drum that the line leaves, from 1; None of a drum without layers."""
        if self.winch is None:
            return None
        layer: int | None = self.winch.station.layer_at(self.stored(way), self.says.diameter)
        return layer

    def drivers(self) -> Iterator[tuple[str, Machine]]:
        """All that takes whatever force its motion needs, inboard first."""
        if self.inboard.drives:
            yield self.winch.name if self.winch else "inboard end", self.inboard
        for one in self.devices:
            if one.machine is not None and one.machine.drives:
                yield one.name, one.machine
        if self.outboard.drives:
            yield "outboard end", self.outboard

    def schedule(self) -> Schedule | None:
        """Speed of the line in time, as the outmost drive that is given one gives it."""
        run = self.flat.assembly.netlist.run
        for _, drive in reversed(list(self.drivers())):
            if drive.speed is not None:
                return self._scheduled(drive, drive.speed, run.start, run.stop)
        return self.moved_by.schedule() if self.moved_by is not None else None

    def _scheduled(self, drive: Machine, speed: Wave, begin: float, end: float) -> Schedule:
        """The speed of the line in a time that a machine gives with its own."""
        radius = self._radius_over_angle if self._on_shaft(drive) else None
        if radius is None:
            return Schedule(speed.scaled(self.lever(drive, 0.0)), begin, end, drive.by)
        return Schedule(line_speed(speed, radius, begin, end), begin, end, drive.by, speed)

    @property
    def _radius_over_angle(self) -> PiecewisePolynomial | None:
        """Radius of a drum with layers over the angle paid out; None of another one."""
        layers = self.winch and self.flat.assembly.instances.get(f"{self.route.path}.{self.winch.name}.layers")
        return layers.values.radius if layers else None

    def pull(self, drive: Machine, t: float, speed: float, way: float) -> float:
        """Force outboard [N] that a machine gives to the line."""
        lever = self.lever(drive, way)
        return drive.effort(t, speed / lever) / lever

    def inertia(self, drive: Machine, way: float) -> float:
        """Mass of a machine at the line [kg]."""
        return drive.inertia / self.lever(drive, way) ** 2

    def lever(self, drive: Machine, way: float) -> float:
        """Way of the line over that of the machine's port: the radius [m] where that is the shaft of a drum, else 1."""
        return self.radius(way) if self._on_shaft(drive) else 1.0

    def _on_shaft(self, drive: Machine) -> bool:
        """True for a machine at the shaft of the drum."""
        if self.winch is None or drive is not self.inboard:
            return False
        ports = self.flat.assembly.instances[drive.port.instance].type.declaration.ports
        return ports[drive.port.port].domain is ROTATIONAL

    def signal(self, device: Device, t: float) -> float:
        """Speed of the ship at a sea [m/s]."""
        wave: Wave = device.station.flow() or steady(0.0)
        return wave(t)


def laid_routes(flat: FlatModel) -> list[LaidRoute]:
    """Every line of a model that lies on a route."""
    lines = flat.assembly.lines
    found = []
    for one, two, _ in flat.assembly.routings:
        ends = sorted((lines[path] for path in (one, two)), key=lambda end: not isinstance(end.line, OfLine))
        if isinstance(ends[0].line, OfLine) and isinstance(ends[1].line, OfRoute):
            found.append(_laid(flat, *ends))
    return found


def _laid(flat: FlatModel, line: Line, route: Line) -> LaidRoute:
    ends, devices = (line.path, route.path), []
    for one in sorted(route.line.placed, key=lambda one: (one.begin, one.end)):
        made, path = route.line.machinery.get(one.name), f"{route.path}.{one.name}"
        moved = made is not None and made.surface and not one.station.stores()
        mover = machine(flat, _port(f"{path}.{made.surface}"), *ends) if moved else None
        clamps = _clamps(flat, path, made) if made is not None and made.clamp else ()
        if clamps and not float(one.station.squeeze()) and all(map(_is_zero, clamps)):
            mover, clamps = None, ()  # belts that are open all the time: the line passes between them
        curve = one.station.rubs() if line.line.rubs else None
        devices.append(Device(one.name, one.begin, one.end, one.station, curve, mover, clamps))
    aliases = flat.assembly.aliases
    winch = next((one for one in devices if one.station.stores() and line.line.start < one.end), None)
    inboard = aliases[f"{line.path}.inboard"]
    if winch is not None:
        inboard = _port(f"{route.path}.{winch.name}.{route.line.machinery[winch.name].surface}")
    return LaidRoute(
        flat, line, route,
        tuple(one for one in devices if not (one.station.stores() or one.station.immerses())),
        machine(flat, inboard, *ends), machine(flat, aliases[f"{line.path}.outboard"], *ends), winch,
        tuple(one for one in devices if one.station.immerses()),
    )  # fmt: skip


def _clamps(flat: FlatModel, path: str, made: Any) -> tuple[Wave, ...] | None:
    """What presses each belt: as given, and what a signal adds."""
    added = trace(flat, _port(f"{path}.{made.added}")) if made.added else None
    told = added.told() if added is not None else None
    return None if told is None or made.load is None else (made.load, told)


def _is_zero(wave: Wave) -> bool:
    """Whether a quantity in time is always zero."""
    return not (wave.is_swinging or wave.polynomial.rows[:, 3:].any())


def _port(path: str) -> PortRef:
    instance, _, port = path.rpartition(".")
    return PortRef(instance, port)
