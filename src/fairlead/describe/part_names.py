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
    "AccelerationActuator": "shaking table",
    "Accumulator": "hydraulic accumulator, bladder, isothermal or adiabatic gas",
    "AngleActuator": "angle of a signal, ideal rotary positioning",
    "ArmPin": "lever at large angles, pin of a boom",
    "ArmStrut": "cylinder on a boom, strut of an arm",
    "ArrayModule": "towed array, line of hose and core",
    "Backlash": "backlash, play of teeth, lost motion of a shaft, spline",
    "Bearing": "plain bearing, collar bearing, journal",
    "BeltDrive": "belt drive, V-belt, flat belt, conveyor belt that slips",
    "Brake": "disc brake, drum brake, holding brake",
    "Cable": "rope, wire, cable in many elements",
    "Cam": "cam and follower",
    "Capacitor": "capacitor, condenser, DC link, smoothing",
    "ChainDrive": "chain drive, toothed belt, timing belt",
    "CheckValve": "check valve, non-return valve",
    "Clutch": "friction clutch, slip clutch, torque limiter",
    "Contact": "dry friction, guide, pad, block on a belt, stick-slip",
    "CounterbalanceValve": "counterbalance valve, overcentre valve, load-holding valve",
    "Crank": "crank, crank-slider, connecting rod, eccentric press",
    "Cylinder": "hydraulic cylinder (double-acting, differential), ram, seals that stick",
    "Damper": "dashpot, viscous damper, shock absorber",
    "DcDrive": "servo drive of a DC motor, converter, four-quadrant drive",
    "DcMotor": "DC motor, brushed motor",
    "DeadBand": "band with hysteresis, beyond which a signal is heard whole",
    "DeadBandPid": "controller with a dead band, control that rests",
    "DeadZone": "dead band, dead zone",
    "Differential": "differential gear, axle differential",
    "Diode": "diode, rectifier, freewheeling diode",
    "DogClutch": "dog clutch, claw clutch, synchroniser",
    "Drag": "air or water resistance, quadratic damping",
    "Earth": "earth, electrical ground, zero volts",
    "ElasticGap": "bumper, gap, elastic contact",
    "ElectricSwitch": "relay contact, transistor",
    "EndStop": "end stop, buffer, hard stop that gives",
    "FilteredDerivative": "derivative, D term",
    "FixedPoint": "fixed point, wall at a position",
    "FixedPump": "fixed pump, constant flow",
    "FixedTemperature": "ambient temperature, heat sink",
    "FlowActuator": "flow of a signal, ideal variable pump",
    "FlowControlValve": "flow control valve, pressure-compensated throttle",
    "FlowSource": "ideal pump, constant flow, flow in time",
    "Fmu": "co-simulation unit",
    "ForceActuator": "linear motor, ideal actuator",
    "ForceSensor": "load cell, force gauge",
    "ForceSource": "force, weight, load",
    "FrictionHeat": "friction heat, warm pad, flash temperature of a contact",
    "FrictionLoss": "friction heat shared by two bodies, clutch that warms",
    "Gear": "ideal gear, reduction",
    "Gearbox": "gearbox with efficiency and play, reducer",
    "Ground": "wall, frame, foundation",
    "HeatActuator": "heat of a signal, heater, loss of a motor or valve",
    "HeatCapacity": "thermal mass, body that warms",
    "HeatConductor": "thermal resistance, wall",
    "HeatConvection": "cooling by air or water",
    "HeaveCompensator": "heave compensator, gas-loaded cylinder",
    "Housing": "fixed shaft, frame of a machine",
    "HydraulicLine": "pipe, hose, pressure waves, water hammer",
    "HydraulicMotor": "hydraulic motor, winch motor",
    "Idler": "guide roller, idler",
    "Inductor": "inductor, coil, choke, winding",
    "Inertia": "flywheel, rotor, disc",
    "Integrator": "integrator, integral with limits, anti-windup, reset",
    "LeadScrew": "lead screw, ball screw, feed axis, spindle, jack",
    "Leak": "leakage, laminar throttle",
    "Lever": "lever, rocker",
    "Limiter": "saturation, clamp, limits of a signal",
    "LoadSensingPump": "load-sensing pump",
    "LoadedFriction": "friction of a gear train, drive-train loss",
    "LogicGate": "logic gate: and, or, xor, not, nand",
    "LossyGear": "gear with efficiency both ways, self-locking gear",
    "Mass": "body, block, slide, carriage",
    "MassOnSlope": "incline, rolling resistance, sledge, car on a slope, vehicle",
    "MassWithStops": "slide between stops, spool, hammer",
    "MotionSensor": "position or speed sensor of a slide",
    "MotionSource": "given motion, driven belt, shaker, support that moves",
    "MovingSheave": "moving sheave, compensator sheave, block and tackle",
    "MovingTail": "rope from a moving roller, ship in heave",
    "NipRoller": "nip, pinch roller, driven roller",
    "OneWayClutch": "freewheel, sprag clutch, backstop, ratchet",
    "Orifice": "throttle, nozzle, orifice",
    "OrificeLoss": "throttling loss, oil that warms",
    "OverTensionTrip": "overload trip",
    "Pendulum": "pendulum, crane load",
    "PiController": "speed controller, PI controller",
    "Pid": "position controller, PID controller",
    "PilotCheckValve": "piloted check valve, lock-up valve",
    "Planetary": "planetary gear, epicyclic gear: sun, ring, carrier",
    "Play": "play of a pin in its hole, clearance, lost motion along a line",
    "PmDrive": "servo drive of a permanent-magnet motor",
    "PmMotor": "permanent-magnet motor, brushless motor, synchronous servo",
    "PositionActuator": "position of a signal, ideal linear positioning",
    "PositionServo": "hobby servo, positioning actuator",
    "PowerSensor": "power along a line, wattmeter",
    "PowerUnit": "hydraulic power unit, pump with relief valve and accumulator",
    "PressureActuator": "pressure of a signal, ideal pressure control",
    "PressurePump": "pressure-compensated pump",
    "PressureSource": "ideal pressure supply",
    "Rack": "rack and pinion, wheel on a road, rope on a drum",
    "ReferenceShaper": "slew-rate limiter, ramp of a reference, trajectory, jerk limit",
    "RelativeMotionSensor": "distance sensor, stroke, relative position and speed",
    "RelativeRotationSensor": "angle sensor between two shafts, twist, slip of a clutch",
    "Relay": "comparator, two-point controller, thermostat, hysteresis, Schmitt trigger",
    "ReliefValve": "relief valve, pressure limiter",
    "Resistor": "resistor, brake resistor, resistance of a wire",
    "RigidChamber": "chamber of incompressible oil, cylinder side without compressibility",
    "RigidLink": "rigid rod, coupling of two slides",
    "RigidStop": "hard stop, impact, restitution",
    "RodOnGuides": "rod in guides",
    "RopeTail": "end of a rope, rope fastened to a load",
    "RotaryDancer": "dancer roller",
    "RotationSensor": "encoder, tachometer",
    "RotationalDamper": "rotary damper, viscous coupling",
    "RotationalPowerSensor": "power of a shaft, wattmeter",
    "RotationalStop": "end stop of a shaft, flap, gripper",
    "Route": "bends, pulleys, sheaves, winches, tensioners, deployers along a line",
    "RuckTrip": "ruck protection, compression trip, stop at a jam",
    "SampleHold": "sampler, zero-order hold",
    "SampledSensor": "sampled sensor with noise, quantiser, ADC (analogue-digital converter), encoder",
    "SecondOrder": "second-order lag, PT2, low-pass filter, resonance",
    "ServoCylinderDrive": "servo cylinder, hydraulic axis",
    "ServoMotorDrive": "hydraulic servo motor drive, winch drive",
    "ServoValve": "servo valve, proportional valve, directional valve",
    "ShaftFriction": "bearing friction, seal of a shaft, bit on rock (torque over speed)",
    "ShaftLoad": "fan, pump, propeller load",
    "SignalChirp": "sine sweep",
    "SignalDelay": "delay, dead time, transport delay, dead time of a bus",
    "SignalEdge": "edge, rising edge, falling edge, counter",
    "SignalFunction": "formula",
    "SignalGain": "gain, proportional, amplification, scaling, offset",
    "SignalInput": "input from another program, set value from outside",
    "SignalLag": "first-order lag, filter of a sensor",
    "SignalMark": "event, zero crossing, place where a step ends",
    "SignalProduct": "multiplier, product, modulation",
    "SignalQuotient": "divider, quotient, ratio of two signals",
    "SignalSelect": "minimum, maximum, smaller or larger of two signals",
    "SignalSize": "absolute value, size, rectified signal",
    "SignalSource": "set value in time, pulse, step, ramp, sine, data file, CSV, time series",
    "SignalSwitch": "switch between two signals, changeover, multiplexer",
    "SignalTable": "characteristic, look-up table",
    "SignalTable2": "map in two dimensions, characteristic map, look-up table of two signals",
    "SignalTimer": "timer, on-delay, elapsed time",
    "SingleActingCylinder": "single-acting cylinder, plunger, jack with a return spring",
    "SlideFriction": "friction of a slide, guide or seal (force over speed)",
    "SpeedActuator": "speed of a signal, ideal speed drive",
    "SpeedSource": "ideal motor, diesel at constant speed",
    "Spool": "spool, pilot stage, valve dynamics",
    "Spring": "spring",
    "SpringDamper": "spring and damper, rubber mount, elastic coupling",
    "StateMachine": "sequence, PLC logic",
    "StateSpace": "state space, matrices A B C D, linear system",
    "Stopper": "rope stopper, chain stopper",
    "StorageDrum": "storage drum of a traction winch",
    "Sum": "sum, difference, adder, subtraction, error of a control",
    "SupportedGear": "gear whose housing turns, reaction torque",
    "TableSpring": "progressive spring, spring by a table",
    "Tank": "tank, reservoir",
    "TaperTension": "taper of a winder, tension that falls with the radius",
    "TemperatureSensor": "thermometer, thermocouple",
    "TemperatureSource": "given temperature, temperature in time",
    "TensionTorque": "torque mode of a winch, tension control without a sensor",
    "TensionTrim": "tension control about a speed control, trim of a speed",
    "Tether": "rope that goes slack, strop",
    "TorqueActuator": "torque of a signal, ideal torque motor",
    "TorqueSensor": "torque meter",
    "TorqueSource": "torque, ideal drive",
    "TorsionSpring": "elastic shaft, drill pipe, torsion bar, elastic coupling",
    "TractionWinch": "traction winch, capstan winch",
    "TransferFunction": "transfer function, filter",
    "Unwinder": "unwinding roll",
    "ValveLands": "control edges, metering edges, orifices of a spool valve",
    "VariableOrifice": "proportional throttle",
    "VariablePump": "variable pump, axial piston pump, hydrostatic drive",
    "VelocityActuator": "velocity of a signal, ideal linear drive",
    "VoltageActuator": "amplifier, converter, power stage, voltage of a signal",
    "VoltageSource": "voltage source, battery, supply",
    "Volume": "volume of oil, hose that gives way",
    "WebAccumulator": "web accumulator, festoon",
    "WebSpan": "web, paper, foil, strip between rollers, web break",
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
