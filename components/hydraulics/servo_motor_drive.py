"""A rotary electrohydraulic drive: servo valve, volumes, motor."""

from fairlead.components.hydraulics.fluid import Fluid
from fairlead.components.hydraulics.motor import HydraulicMotor
from fairlead.components.hydraulics.servo_valve import OF_SPOOL, VALVE, lands_of, spool_of
from fairlead.components.hydraulics.throttled_drive import ThrottledMotor
from fairlead.components.hydraulics.volume import Volume
from fairlead.components.rotation.housing import Housing
from fairlead.components.rotation.inertia import Inertia
from fairlead.components.rotation.rotational_damper import RotationalDamper
from fairlead.components.rotation.rubbing import Brake

from fairlead.component import (
    Block,
    Component,
    Composite,
    Effect,
    Expansion,
    Hydraulic,
    Input,
    Law,
    Output,
    Parameter,
    Part,
    Rotational,
)  # fmt: skip

MOTOR = {
    "displacement": Parameter("m^3/rad", "Oil per angle, such as 125 cm^3/rev.", above=0),
    "inertia": Parameter("kg*m^2", "Moment of inertia of the rotor.", above=0),
    "internal_leakage": Parameter("m^3/s/Pa", "Leakage from side to side.", default=0.0, least=0),
    "external_leakage": Parameter("m^3/s/Pa", "Leakage of each side to the housing.", default=0.0, least=0),
    "viscous": Parameter("N*m*s/rad", "Viscous friction of the shaft.", default=0.0, least=0),
    "dry": Parameter("N*m", "Dry friction of the shaft.", default=0.0, least=0),
    "efficiency": Parameter("1", "Share of the torque of the oil that arrives, besides.", default=1.0, above=0, most=1),
}


class MotorFriction(Component):
    """Dry friction torque of a motor:  dry + (1 - efficiency) * |torque of the oil|, signal in and out.

    None while a closed valve holds the shaft: two things that hold cannot be told apart.
    """

    exempt = {"units": "A torque is handed to a contact at a radius of 1 m, as the force there (docs/drives.md)."}
    dry = Parameter("N*m", "Without load.", default=0.0, least=0)
    efficiency = Parameter("1", "Share of the torque of the oil that arrives.", default=1.0, above=0, most=1)
    loaded = Input("N*m", "Torque of the oil, without sign.")
    loose = Input("1", "0 while a closed valve holds the shaft.", default=1.0)
    friction = Output("N", "Friction at a radius of 1 m.")

    def law(p, loaded, loose):
        """Grows with the load."""
        return Law(friction=loose * (p.dry + (1 - p.efficiency) * loaded))


class ServoMotorDrive(Composite):
    """A servo valve drives a motor: command -1 to 1 in, a shaft out.

        (V/bulk_modulus) dp_a/dt = Q_a - D w - C_i (p_a - p_b) - C_e p_a        the other side alike
        J dw/dt = D (p_a - p_b) - viscous w - dry friction - load

    With the valve closed it oscillates at  D sqrt(2 bulk_modulus/(V J)). Its steady speed is
    w = C_d A x sqrt((p_s - p_t - p_load)/rho)/D, its stall torque D (p_s - p_t).

    valve_dynamics     off: the opening is the command
    compressibility    off: no volumes. Without leakage the pressures follow from the speed in closed form, and are no
                       unknowns; with leakage they are algebraic, which needs some leakage from both sides to the tank
    leakage            off: valve and motor are tight
    cavitation         off: a pressure may fall below zero
    air                on: entrained air makes the oil soft at low pressure
    motor_friction     off: the shaft turns freely

    Source: docs/physics.md, 5.2 and 5.3. Limits: those of `ServoValve` and `HydraulicMotor`; the two lines have the
    same volume.
    """

    supply, tank = Hydraulic("pressure line"), Hydraulic("return line")
    shaft = Rotational("the shaft")
    command = Input("1", "Opening asked for, -1 to 1.")
    valve = Block(VALVE, "The servo valve.")
    motor = Block(MOTOR, "The motor.")
    volume = Parameter("m^3", "Oil between valve and motor, each side.", default=1e-3, above=0)
    pressure = Parameter("Pa", "Pressure of both sides at the start; 1 bar when not given.", default=None, above=0,
                         physics=False)  # fmt: skip
    fluid = Part(Fluid, "What fills it.", default="oil")
    valve_dynamics = Effect("The spool lags behind its command and hits stops.")
    compressibility = Effect("Oil between valve and motor is compressed.")
    leakage = Effect("Valve and motor leak.")
    cavitation = Effect("Pressure does not fall below zero; a void opens and closes.")
    air = Effect("Entrained air makes the oil soft at low pressure.", "off")
    motor_friction = Effect("The shaft sticks and slides, and drags.")
    opening = Output("1", "Opening of the valve.")
    speed = Output("rad/s", "Speed of the shaft.")
    torque = Output("N*m", "Torque of the oil on the shaft.")
    load_pressure = Output("Pa", "Pressure of a over b.")
    pressure_a = Output("Pa", "Pressure at a.")
    pressure_b = Output("Pa", "Pressure at b.")
    void_a = Output("m^3", "Volume without oil at a; none is told without compressibility.")
    void_b = Output("m^3", "Volume without oil at b; none is told without compressibility.")

    def check(p):
        """Algebraic pressures need leakage that determines them while the valve is closed."""
        if p.compressibility == "off" and p.leakage == "on":
            yield from undetermined(p.motor.external_leakage, p.valve.leakage_conductance)

    def expand(p, scene):
        """Valve and motor, what is between them, and the rotor."""
        children = {"spool": spool_of(scene, p.valve, p.valve_dynamics)}
        oil, joins, ports = hydraulics(p, scene, children)
        children["rotor"] = scene.make(Inertia, moment=p.motor.inertia)
        turning = [f"{oil}.shaft", "rotor.shaft"]
        if p.motor_friction == "on":
            children["housing"] = scene.make(Housing)
            children["drag"] = scene.make(RotationalDamper, damping=p.motor.viscous)
            rubs = p.motor.dry > 0 or p.motor.efficiency < 1
            children["load"] = scene.make(MotorFriction, dry=p.motor.dry, efficiency=p.motor.efficiency)
            children["rubbing"] = scene.make(Brake, radius=1.0, curve=1.0 if rubs else 0.0)
            turning += ["drag.b", "rubbing.shaft"]
            joins += [("housing.shaft", "drag.a"), (f"{oil}.loaded", "load.loaded")]
            joins.append(("load.friction", "rubbing.normal"))
            joins += [(f"{oil}.loose", "load.loose")] if children[oil].type is ThrottledMotor else []
        told = ("torque", "load_pressure", "pressure_a", "pressure_b")
        shown = {"command": "spool.command", "opening": "spool.opening", "speed": "rotor.speed"}
        shown |= {name: f"{oil}.{name}" for name in told}
        if p.compressibility == "on":
            shown |= {"void_a": "volume_a.void", "void_b": "volume_b.void"}
        return Expansion(children, [*joins, tuple(turning)], {**ports, "shaft": "rotor.shaft"}, shown)


def undetermined(*conductances):
    """The fault of algebraic pressures that nothing determines."""
    if not any(conductances):
        what = "without compressibility the leakage must lead from both sides to the tank, and there is none"
        yield "", what, "Switch leakage off too, or give external_leakage or leakage_conductance."


def hydraulics(p, scene, children):
    """Adds what is between the supply and the shaft; returns the child that drives it, connections and outer ports."""
    if p.compressibility == "off" and p.leakage == "off":
        names = [name for name in VALVE if name not in (*OF_SPOOL, "leakage_conductance")]
        valve = {name: getattr(p.valve, name) for name in names}
        children["oil"] = scene.make(ThrottledMotor, displacement=p.motor.displacement, **valve)
        return "oil", [("spool.opening", "oil.opening")], {"supply": "oil.supply", "tank": "oil.tank"}
    children["lands"] = lands_of(scene, p.valve, p.leakage)
    size = {name: getattr(p.motor, name) for name in ("displacement", "internal_leakage", "external_leakage")}
    children["oil"] = scene.make(HydraulicMotor, leakage=p.leakage, **size)
    joins = [("spool.opening", "lands.opening")]
    for side in "ab":
        node = [f"lands.{side}", f"oil.{side}"]
        if p.compressibility == "on":
            children[f"volume_{side}"] = scene.make(
                Volume, volume=p.volume, pressure=p.pressure, fluid=p.fluid, cavitation=p.cavitation, air=p.air
            )
            node.append(f"volume_{side}.port")
        joins.append(tuple(node))
    return "oil", joins, {"supply": "lands.supply", "tank": "lands.tank"}
