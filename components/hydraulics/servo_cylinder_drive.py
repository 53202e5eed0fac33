"""A linear electrohydraulic drive: servo valve and cylinder."""

from fairlead.components.hydraulics.chamber import RigidChamber
from fairlead.components.hydraulics.cylinder import CYLINDER, Cylinder, air_on_rod, mechanics, seals_make_sense
from fairlead.components.hydraulics.fluid import Fluid
from fairlead.components.hydraulics.leak import Leak
from fairlead.components.hydraulics.servo_motor_drive import undetermined
from fairlead.components.hydraulics.servo_valve import OF_SPOOL, VALVE, lands_of, spool_of
from fairlead.components.hydraulics.throttled_drive import ThrottledCylinder

from fairlead.component import (
    Block,
    Composite,
    Effect,
    Expansion,
    Hydraulic,
    Input,
    Output,
    Parameter,
    Part,
    Translational,
    derived,
    pi,
)  # fmt: skip


class ServoCylinderDrive(Composite):
    """A servo valve drives a cylinder: command -1 to 1 in, a rod out; positive pushes it out. See `Cylinder`.

    valve_dynamics     off: the opening is the command
    compressibility    off: the chambers are rigid. Without leakage the pressures follow from the speed in closed form,
                       and are no unknowns; with leakage they are algebraic, which needs leakage of the valve
    leakage            off: valve and piston are tight
    cavitation         off: a pressure may fall below zero
    seal_friction      off: the rod slides freely

    m dv/dt = A_a p_a - A_b p_b - (A_a - A_b) air - seal friction - load,  with the pressures of docs/physics.md, 5.4.

    Source: docs/physics.md, 5.2 and 5.4. Limits: those of `ServoValve` and `Cylinder`; the supply is that of the ports.
    """

    supply, tank = Hydraulic("pressure line"), Hydraulic("return line")
    body, rod = Translational("the barrel"), Translational("the rod")
    command = Input("1", "Opening asked for, -1 to 1.")
    valve = Block(VALVE, "The servo valve.")
    cylinder = Block(CYLINDER, "The cylinder.")
    pressure_a = Parameter("Pa", "Pressure at the cap side at the start; 1 bar when not given.", default=None, least=0,
                           physics=False)  # fmt: skip
    pressure_b = Parameter("Pa", "Pressure at the rod side at the start; 1 bar when not given.", default=None, least=0,
                           physics=False)  # fmt: skip
    fluid = Part(Fluid, "What fills it.", default="oil")
    valve_dynamics = Effect("The spool lags behind its command and hits stops.")
    compressibility = Effect("Oil in the cylinder is compressed.")
    leakage = Effect("Valve and piston leak.")
    cavitation = Effect("Pressure does not fall below zero; a void opens and closes.")
    seal_friction = Effect("The seals stick and slide.")
    opening = Output("1", "Opening of the valve.")
    level_a = Output("Pa", "Pressure at the cap side.", name="pressure_a")
    level_b = Output("Pa", "Pressure at the rod side.", name="pressure_b")
    travel = Output("m", "rod.x - body.x, 0 when retracted.")
    void_a = Output("m^3", "Volume without oil at the cap side; none is told without compressibility.")
    void_b = Output("m^3", "Volume without oil at the rod side; none is told without compressibility.")

    @derived
    def cap_area(p):
        """Area of the piston [m^2]."""
        return pi * p.cylinder.bore_diameter**2 / 4

    @derived
    def rod_area(p):
        """Area of the piston less that of the rod [m^2]."""
        return pi * (p.cylinder.bore_diameter**2 - p.cylinder.rod_diameter**2) / 4

    def check(p):
        """The rod is thinner than the piston; algebraic pressures are determined."""
        if p.rod_area <= 0:
            yield "cylinder.rod_diameter", "the rod is as thick as the piston", "Lower rod_diameter."
        yield from seals_make_sense(p.cylinder, "cylinder.")
        if p.compressibility == "off" and p.leakage == "on":
            yield from undetermined(p.valve.leakage_conductance)

    def expand(p, scene):
        """Spool, lands, and a cylinder that is compressed, rigid, or joined with the lands into one law."""
        children = {"spool": spool_of(scene, p.valve, p.valve_dynamics)}
        shown = {"command": "spool.command", "opening": "spool.opening"}
        if p.compressibility == "off" and p.leakage == "off":
            return throttled_expansion(p, scene, children, shown)
        children["lands"] = lands_of(scene, p.valve, p.leakage)
        ports = {"supply": "lands.supply", "tank": "lands.tank"}
        joins = [("spool.opening", "lands.opening")]
        if p.compressibility == "off":
            return rigid_expansion(p, scene, children, shown, ports, joins)
        size = {name: getattr(p.cylinder, name) for name in CYLINDER}
        starts = {"pressure_a": p.pressure_a, "pressure_b": p.pressure_b}
        switches = {"cavitation": p.cavitation, "leakage": p.leakage, "seal_friction": p.seal_friction}
        children["cylinder"] = scene.make(Cylinder, fluid=p.fluid, **size, **starts, **switches)
        joins += [("lands.a", "cylinder.a"), ("lands.b", "cylinder.b")]
        shown |= {name: f"cylinder.{name}" for name in ("pressure_a", "pressure_b", "travel", "void_a", "void_b")}
        return Expansion(children, joins, {**ports, "body": "cylinder.body", "rod": "cylinder.rod"}, shown)


def throttled_expansion(p, scene, children, shown):
    """Lands and cylinder in one law, without a pressure as unknown."""
    names = [name for name in VALVE if name not in (*OF_SPOOL, "leakage_conductance")]
    valve = {name: getattr(p.valve, name) for name in names}
    children["oil"] = scene.make(ThrottledCylinder, cap_area=p.cap_area, rod_area=p.rod_area, fluid=p.fluid,
                                 bore=p.cylinder.port_diameter, **valve)  # fmt: skip
    joins = [("spool.opening", "oil.opening")]
    bodies, rods = ["oil.body"], ["oil.rod"]
    air_on_rod(p.cylinder, scene, children, bodies, rods)
    mechanics(p.cylinder, p.seal_friction, scene, children, joins, bodies, rods, "oil.loose")
    ports = {name: f"oil.{name}" for name in ("supply", "tank", "body", "rod")}
    return Expansion(children, joins, ports, {**shown, "pressure_a": "oil.pressure_a", "pressure_b": "oil.pressure_b",
                                              "travel": "stops.travel"})  # fmt: skip


def rigid_expansion(p, scene, children, shown, ports, joins):
    """Rigid chambers: the pressures are algebraic."""
    children["cap"] = scene.make(RigidChamber, side="cap", area=p.cap_area)
    children["rod_side"] = scene.make(RigidChamber, side="rod", area=p.rod_area)
    children["leak"] = scene.make(Leak, conductance=p.cylinder.internal_leakage)
    joins += [("lands.a", "cap.port", "leak.a"), ("lands.b", "rod_side.port", "leak.b")]
    bodies, rods = ["cap.body", "rod_side.body"], ["cap.rod", "rod_side.rod"]
    air_on_rod(p.cylinder, scene, children, bodies, rods)
    mechanics(p.cylinder, p.seal_friction, scene, children, joins, bodies, rods)
    return Expansion(children, joins, {**ports, "body": "cap.body", "rod": "cap.rod"}, {
        **shown, "pressure_a": "cap.pressure", "pressure_b": "rod_side.pressure",
        "travel": "stops.travel"})  # fmt: skip
