"""A double-acting hydraulic cylinder."""

from fairlead.components.friction.frictionless import contact_of
from fairlead.components.hydraulics.chamber import Chamber
from fairlead.components.hydraulics.fluid import Fluid
from fairlead.components.hydraulics.leak import Leak
from fairlead.components.hydraulics.return_spring import ReturnSpring
from fairlead.components.mechanics.damper import Damper
from fairlead.components.mechanics.end_stop import EndStop

from fairlead.component import (
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
    Translational,
    derived,
    pi,
)  # fmt: skip

CYLINDER = {
    "bore_diameter": Parameter("m", "Diameter of the piston.", above=0),
    "rod_diameter": Parameter("m", "Diameter of the rod.", default=0.0, least=0),
    "stroke": Parameter("m", "Travel from stop to stop.", above=0),
    "air": Parameter("Pa", "Pressure of the air on the rod.", default=1e5, least=0),
    "cap_dead_volume": Parameter("m^3", "Volume at a that the piston does not sweep.", default=1e-4, above=0),
    "rod_dead_volume": Parameter("m^3", "Volume at b that the piston does not sweep.", default=1e-4, above=0),
    "port_diameter": Parameter("m", "Diameter of the bores that fill the chambers.", default=0.02, above=0),
    "internal_leakage": Parameter("m^3/s/Pa", "Leakage across the piston.", default=0.0, least=0),
    "seal_force": Parameter("N", "Sliding friction of the seals.", default=0.0, least=0),
    "seal_breakaway": Parameter("N", "Force to begin; that of sliding when not given.", default=None, least=0),
    "seal_speed": Parameter("m/s", "Speed over which breakaway falls to sliding.", default=None, above=0),
    "seal_viscous": Parameter("N*s/m", "Seal friction that grows with speed.", default=None, least=0),
    "stop_stiffness": Parameter("N/m", "Stiffness of the end stops.", default=1e8, above=0),
    "stop_damping": Parameter("s/m", "Share of their force that is added per speed.", default=5.0, least=0),
}


class Cylinder(Composite):
    """Pressure at a pushes the rod out, pressure at b pulls it in; the travel rod.x - body.x ends at stops.

        m dv/dt = A_a p_a - A_b p_b - (A_a - A_b) air - seal friction - load
        seal friction = seal_force + (seal_breakaway - seal_force) exp(-(v/seal_speed)^2) + seal_viscous v    for v > 0

    The same holds backward. Pressures are absolute, so the air presses on the rod; `air` of 0 leaves it out. The mass
    is that of the bodies at `rod` and `body`. With the valve closed, small oscillations have

        w^2 = bulk_modulus (A_a^2/V_a + A_b^2/V_b)/m

    Where a rod is pulled faster than oil follows, the pressure of a chamber falls to zero and a void opens in it,
    `void_a` or `void_b`. Oil is drawn to it through the bore, so a Volume at the port stays full.

    Without `seal_speed` the seal friction falls at once. At rest the seals hold up to seal_breakaway, by the friction
    method of the scene. With a `seal_force` of 0, the default, or `seal_friction` off the rod slides freely.

    Source: Jelali, Kroll, Hydraulic Servo-systems, 2003 (Stribeck curve of a cylinder).

    Limits: seal friction does not depend on pressure; put a Contact beside the cylinder for that.
    """

    a, b = Hydraulic("cap side"), Hydraulic("rod side")
    body, rod = Translational("the barrel"), Translational("the rod")
    bore_diameter, rod_diameter = CYLINDER["bore_diameter"], CYLINDER["rod_diameter"]
    stroke, air = CYLINDER["stroke"], CYLINDER["air"]
    cap_dead_volume, rod_dead_volume = CYLINDER["cap_dead_volume"], CYLINDER["rod_dead_volume"]
    port_diameter, internal_leakage = CYLINDER["port_diameter"], CYLINDER["internal_leakage"]
    seal_force, seal_breakaway = CYLINDER["seal_force"], CYLINDER["seal_breakaway"]
    seal_speed, seal_viscous = CYLINDER["seal_speed"], CYLINDER["seal_viscous"]
    stop_stiffness, stop_damping = CYLINDER["stop_stiffness"], CYLINDER["stop_damping"]
    pressure_a = Parameter("Pa", "Pressure at the cap side at the start; 1 bar when not given.", default=None, least=0,
                           physics=False)  # fmt: skip
    pressure_b = Parameter("Pa", "Pressure at the rod side at the start; 1 bar when not given.", default=None, least=0,
                           physics=False)  # fmt: skip
    fluid = Part(Fluid, "What fills it.", default="oil")
    cavitation = Effect("Pressure does not fall below zero; a void opens and closes.")
    leakage = Effect("Oil leaks across the piston.")
    seal_friction = Effect("The seals stick and slide.")
    level_a = Output("Pa", "Pressure at the cap side.", name="pressure_a")
    level_b = Output("Pa", "Pressure at the rod side.", name="pressure_b")
    travel = Output("m", "rod.x - body.x, 0 when retracted.")
    friction = Output("N", "Dry friction of the seals, positive when it holds back a rod that goes out.")
    void_a = Output("m^3", "Volume without oil at the cap side.")
    void_b = Output("m^3", "Volume without oil at the rod side.")

    @derived
    def cap_area(p):
        """Area of the piston [m^2]."""
        return pi * p.bore_diameter**2 / 4

    @derived
    def rod_area(p):
        """Area of the piston less that of the rod [m^2]."""
        return pi * (p.bore_diameter**2 - p.rod_diameter**2) / 4

    def check(p):
        """The rod is thinner than the piston, and seals do not begin below sliding."""
        yield from seals_make_sense(p)
        if p.rod_diameter >= p.bore_diameter:
            what = f"rod_diameter {p.rod_diameter:g} m is not below bore_diameter {p.bore_diameter:g} m"
            yield "rod_diameter", what, "Lower it."

    def expand(p, scene):
        """Two chambers, the air and a pair of stops; seals and leakage where wanted."""
        common = {"stroke": p.stroke, "bore": p.port_diameter, "fluid": p.fluid, "cavitation": p.cavitation}
        children = {
            "cap": scene.make(Chamber, side="cap", area=p.cap_area, dead_volume=p.cap_dead_volume,
                              pressure=p.pressure_a, **common),
            "rod_side": scene.make(Chamber, side="rod", area=p.rod_area, dead_volume=p.rod_dead_volume,
                                   pressure=p.pressure_b, **common),
        }  # fmt: skip
        joins = []
        bodies, rods = ["cap.body", "rod_side.body"], ["cap.rod", "rod_side.rod"]
        air_on_rod(p, scene, children, bodies, rods)
        mechanics(p, p.seal_friction, scene, children, joins, bodies, rods)
        if p.leakage == "on":
            children["leak"] = scene.make(Leak, conductance=p.internal_leakage)
            joins += [("cap.port", "leak.a"), ("rod_side.port", "leak.b")]
        ports = {"a": "cap.port", "b": "rod_side.port", "body": "cap.body", "rod": "cap.rod"}
        shown = {"pressure_a": "cap.pressure", "pressure_b": "rod_side.pressure", "travel": "stops.travel",
                 "void_a": "cap.void", "void_b": "rod_side.void"}  # fmt: skip
        if p.seal_friction == "on":
            shown["friction"] = "seal.friction"
        return Expansion(children, joins, ports, shown)


def seals_make_sense(size, at=""):
    """What is wrong with the seals, as `check` says it; `at` leads to the parameters `size` of CYLINDER."""
    begin, slide = size.seal_breakaway, size.seal_force
    if begin is not None and slide == 0:
        what = "seal_breakaway is given without seal_force"
        yield f"{at}seal_breakaway", what, "Give the force of sliding seals as well."
    elif begin is not None and begin < slide:
        what = f"seal_breakaway {begin:g} N is below seal_force = {slide:g} N"
        yield f"{at}seal_breakaway", what, "Beginning takes at least as much as sliding on."
    if size.seal_speed is not None and begin is None:
        what = "seal_speed is given without seal_breakaway"
        yield f"{at}seal_speed", what, "Give the force from which friction falls."


def seal_curve(size):
    """The curve of the seals, over the force while they slide."""
    if size.seal_force == 0:
        return 0.0
    if size.seal_breakaway is None:
        return 1.0
    ratio = size.seal_breakaway / size.seal_force
    if size.seal_speed is None:
        return {"curve": "coulomb", "coulomb": 1.0, "stiction": ratio}
    return {"curve": "stribeck", "coulomb": 1.0, "stiction": ratio, "velocity": size.seal_speed}


def air_on_rod(size, scene, children, bodies, rods):
    """The air, which pushes a rod in; `size` holds the parameters of CYLINDER."""
    if size.rod_diameter and size.air:
        area = pi * size.rod_diameter**2 / 4
        children["air"] = scene.make(ReturnSpring, preload=0.0, stiffness=0.0, area=area, air=size.air)
        bodies.append("air.body")
        rods.append("air.rod")


class SealForce(Component):
    """Friction of the seals; none while a closed valve holds the rod: two things that hold cannot be told apart."""

    force = Parameter("N", "Sliding friction.", least=0)
    loose = Input("1", "0 while a closed valve holds the rod.")
    normal = Output("N", "Sliding friction.")

    def law(p, loose):
        """All of it or nothing."""
        return Law(normal=loose * p.force)


def mechanics(size, seals, scene, children, joins, bodies, rods, loose=""):
    """Stops, and with `seals` their friction, between what moves with the barrel and what moves with the rod.

    `size` holds the parameters of CYLINDER; `loose` is the output that says whether seals have something to do.
    """
    stops = {"lower": 0.0, "upper": size.stroke, "stiffness": size.stop_stiffness, "damping": size.stop_damping}
    children["stops"] = scene.make(EndStop, **stops)
    bodies.append("stops.a")
    rods.append("stops.b")
    if seals == "on":
        children["seal"] = contact_of(scene, seal_curve(size), normal_force=size.seal_force)
        if loose and size.seal_force:
            children["seals"] = scene.make(SealForce, force=size.seal_force)
            joins += [(loose, "seals.loose"), ("seals.normal", "seal.normal")]
        bodies.append("seal.a")
        rods.append("seal.b")
    if seals == "on" and size.seal_viscous is not None:
        children["film"] = scene.make(Damper, damping=size.seal_viscous)
        bodies.append("film.a")
        rods.append("film.b")
    joins += [tuple(bodies), tuple(rods)]
