"""What an engineer calls the bundled parts: the page docs/howto/parts.md lists them, by family."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from fairlead.component.base import Declared
from fairlead.describe.catalogue import innards, sentence

BUNDLED = "fairlead.components."
FAMILIES = {
    "mechanics": "Along a line",
    "rotation": "Shafts, gears, brakes",
    "friction": "Friction",
    "hydraulics": "Oil",
    "electric": "Electric motors and circuits",
    "sources": "What moves, loads or sets",
    "control": "Controllers",
    "signals": "Signals",
    "sensors": "Sensors",
    "line": "Lines: rope, hose, cable, rod",
    "route": "Routes that lines run on",
    "web": "Web, and rope on drums",
    "thermal": "Heat",
}
"""Folder of components -> heading, in the order of the page."""
NAMES = {
    "Accumulator": "hydraulic accumulator, bladder",
    "AccelerationActuator": "shaking table",
    "ArmPin": "lever at large angles, pin of a boom",
    "ArmStrut": "cylinder on a boom, strut of an arm",
    "ArrayModule": "towed array, line of hose and core",
    "Backlash": "backlash, play of teeth, lost motion of a shaft, spline",
    "Bearing": "plain bearing, collar bearing, journal",
    "BeltDrive": "belt drive, V-belt, flat belt, conveyor belt that slips",
    "Brake": "disc brake, drum brake, holding brake",
    "Cable": "rope, wire, cable in many elements",
    "Cam": "cam and follower",
    "ChainDrive": "chain drive, toothed belt, timing belt",
    "CheckValve": "check valve, non-return valve",
    "Clutch": "friction clutch, slip clutch, torque limiter",
    "Contact": "dry friction, guide, pad, block on a belt, stick-slip",
    "CounterbalanceValve": "counterbalance valve, overcentre valve, load-holding valve",
    "Crank": "crank, crank-slider, connecting rod, eccentric press",
    "Cylinder": "hydraulic cylinder (double-acting, differential), ram, seals that stick",
    "Damper": "dashpot, viscous damper, shock absorber",
    "DcDrive": "servo drive of a DC motor",
    "DcMotor": "DC motor, brushed motor",
    "DeadBand": "band with hysteresis, beyond which a signal is heard whole",
    "DeadBandPid": "controller with a dead band, control that rests",
    "DeadZone": "dead band, dead zone",
    "Differential": "differential gear, axle differential",
    "DogClutch": "dog clutch, claw clutch, synchroniser",
    "Drag": "air or water resistance, quadratic damping",
    "ElasticGap": "bumper, gap, elastic contact",
    "ElectricSwitch": "relay contact, transistor",
    "EndStop": "end stop, buffer, hard stop that gives",
    "FilteredDerivative": "derivative, D term",
    "FixedPump": "fixed pump, constant flow",
    "FixedTemperature": "ambient temperature, heat sink",
    "FlowControlValve": "flow control valve, pressure-compensated throttle",
    "Fmu": "co-simulation unit",
    "ForceActuator": "linear motor, ideal actuator",
    "ForceSensor": "load cell, force gauge",
    "ForceSource": "force, weight, load",
    "Gear": "ideal gear, reduction",
    "Gearbox": "gearbox with efficiency and play, reducer",
    "Ground": "wall, frame, foundation",
    "HeatCapacity": "thermal mass, body that warms",
    "HeatConductor": "thermal resistance, wall",
    "HeatConvection": "cooling by air or water",
    "HeaveCompensator": "heave compensator, gas-loaded cylinder",
    "Housing": "fixed shaft, frame of a machine",
    "HydraulicLine": "pipe, hose, pressure waves, water hammer",
    "HydraulicMotor": "hydraulic motor, winch motor",
    "Idler": "guide roller, idler",
    "Inertia": "flywheel, rotor, disc",
    "LeadScrew": "lead screw, ball screw, feed axis, spindle, jack",
    "Leak": "leakage, laminar throttle",
    "Lever": "lever, rocker",
    "Limiter": "saturation",
    "LoadSensingPump": "load-sensing pump",
    "LoadedFriction": "friction of a gear train, drive-train loss",
    "LossyGear": "gear with efficiency both ways, self-locking gear",
    "Mass": "body, block, slide, carriage",
    "MassOnSlope": "sledge, car on a slope, vehicle",
    "MassWithStops": "slide between stops, spool, hammer",
    "MotionSource": "given motion, driven belt, shaker, support that moves",
    "MotionSensor": "position or speed sensor of a slide",
    "NipRoller": "nip, pinch roller, driven roller",
    "OneWayClutch": "freewheel, sprag clutch, backstop, ratchet",
    "Orifice": "throttle, nozzle, orifice",
    "OverTensionTrip": "overload trip",
    "Pendulum": "pendulum, crane load",
    "PiController": "speed controller, PI controller",
    "Pid": "position controller, PID controller",
    "PilotCheckValve": "piloted check valve, lock-up valve",
    "Planetary": "planetary gear, epicyclic gear: sun, ring, carrier",
    "Play": "play of a pin in its hole, clearance, lost motion along a line",
    "PmDrive": "servo drive of a permanent-magnet motor",
    "PmMotor": "permanent-magnet motor, brushless motor, synchronous servo",
    "PositionServo": "hobby servo, positioning actuator",
    "PowerUnit": "hydraulic power unit, pump with relief valve and accumulator",
    "PressurePump": "pressure-compensated pump",
    "PressureSource": "ideal pressure supply",
    "Rack": "rack and pinion, wheel on a road, rope on a drum",
    "ReferenceShaper": "ramp of a reference, trajectory",
    "Relay": "two-point controller, thermostat, hysteresis",
    "ReliefValve": "relief valve, pressure limiter",
    "RigidLink": "rigid rod, coupling of two slides",
    "RigidStop": "hard stop, impact, restitution",
    "RodOnGuides": "rod in guides",
    "RotaryDancer": "dancer roller",
    "RotationSensor": "encoder, tachometer",
    "RotationalDamper": "rotary damper, viscous coupling",
    "RotationalStop": "end stop of a shaft, flap, gripper",
    "Route": "bends, pulleys, sheaves, winches, tensioners, deployers along a line",
    "SampleHold": "sampler, zero-order hold",
    "ServoCylinderDrive": "servo cylinder, hydraulic axis",
    "ServoMotorDrive": "hydraulic servo motor drive, winch drive",
    "ServoValve": "servo valve, proportional valve, directional valve",
    "ShaftFriction": "bearing friction, seal of a shaft, bit on rock (torque over speed)",
    "ShaftLoad": "fan, pump, propeller load",
    "SignalChirp": "sine sweep",
    "SignalDelay": "dead time of a bus",
    "SignalFunction": "formula",
    "SignalLag": "first-order lag, filter of a sensor",
    "SignalMark": "event, zero crossing, place where a step ends",
    "SignalTable": "characteristic, look-up table",
    "SingleActingCylinder": "single-acting cylinder, plunger, jack with a return spring",
    "SlideFriction": "friction of a slide, guide or seal (force over speed)",
    "SpeedSource": "ideal motor, diesel at constant speed",
    "Spring": "spring",
    "SpringDamper": "spring and damper, rubber mount, elastic coupling",
    "StateMachine": "sequence, PLC logic",
    "Stopper": "rope stopper, chain stopper",
    "StorageDrum": "storage drum of a traction winch",
    "SupportedGear": "gear whose housing turns, reaction torque",
    "TableSpring": "progressive spring, spring by a table",
    "Tank": "tank, reservoir",
    "Tether": "rope that goes slack, strop",
    "TorqueSensor": "torque meter",
    "TorqueSource": "torque, ideal drive",
    "TorsionSpring": "elastic shaft, drill pipe, torsion bar, elastic coupling",
    "TractionWinch": "traction winch, capstan winch",
    "TransferFunction": "transfer function, filter",
    "Unwinder": "unwinding roll",
    "VariableOrifice": "proportional throttle",
    "VariablePump": "variable pump, axial piston pump, hydrostatic drive",
    "Volume": "volume of oil, hose that gives way",
    "WebAccumulator": "web accumulator, festoon",
    "WebSpan": "web, paper, foil, strip between rollers",
    "Winder": "winding roll",
    "Worm": "worm gear, worm and wheel, self-locking hoist",
    "ZeroTensionHold": "slack-rope stop",
}
"""Type -> what it is called, the usual word first; a type without a line goes by its own words."""
COMBINED = {
    "hydrostatic transmission": "`VariablePump`, `HydraulicMotor`, a `Volume` on either side, a `CheckValve` each for "
    "the charge and a `ReliefValve` each: `fairlead run machines/hydrostatic_drive`",
    "feed axis": "`LeadScrew`, a `Mass` at its nut, a `SpringDamper` to the table, a `Contact` for its guide",
    "drill string": "`Inertia` and `TorsionSpring` in turn, a `ShaftFriction` with a falling curve at the bit",
    "hoist": "`Worm` or `LossyGear`, an `Inertia` for the drum, a `Rack` for its rope, a `Mass` and a `ForceSource`",
    "bend, pulley, winch on a line": "a line (`Cable`, `ArrayModule`) and a `Route` with these devices",
}
"""What takes more than one part -> which."""


def shown_types(types: Mapping[str, type[Declared]]) -> dict[str, list[str]]:
    """Folder -> bundled types that a netlist names, in the order of the page."""
    hidden = innards(types)
    found: dict[str, list[str]] = {folder: [] for folder in FAMILIES}
    for name, kind in sorted(types.items()):
        if name not in hidden and kind.__module__.startswith(BUNDLED):
            found.setdefault(kind.__module__.removeprefix(BUNDLED).partition(".")[0], []).append(name)
    return found


def called(name: str) -> str:
    """What an engineer calls a type."""
    return NAMES.get(name) or re.sub(r"(?<=[a-z])(?=[A-Z0-9])", " ", name).lower()


def page(types: Mapping[str, type[Declared]], note: str) -> Iterator[str]:
    """Lines of docs/howto/parts.md; `note` says where they come from."""
    yield from ("# Which part do I take?", "", note, "")
    yield from ("Look in the first column for the word that you use. The second column has the type to write in a",
                "netlist. Its link leads to ports, parameters, equations and an example, as does",
                "`fairlead describe TYPE`.", "",
                "If no part fits, see [several parts together](#several-parts-together), or",
                "[write a part of your own](../tutorial/parts.md).", "")  # fmt: skip
    yield from ("## Several parts together", "", "| what you call it | take |", "|---|---|")
    yield from (f"| {name} | {parts} |" for name, parts in sorted(COMBINED.items()))
    for folder, names in shown_types(types).items():
        yield from ("", f"## {FAMILIES.get(folder, folder)}", "")
        yield from ("| what you call it | type | what it does |", "|---|---|---|")
        for name in sorted(names, key=called):
            said = sentence(types[name]).replace("|", "\\|")
            yield f"| {called(name)} | [{name}](../generated/components/{name}.md) | {said} |"
    yield ""
