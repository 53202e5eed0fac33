"""A hydraulic cylinder with oil on one side."""

from fairlead.components.hydraulics.chamber import Chamber
from fairlead.components.hydraulics.cylinder import CYLINDER, mechanics, seals_make_sense
from fairlead.components.hydraulics.fluid import Fluid
from fairlead.components.hydraulics.return_spring import ReturnSpring

from fairlead.component import (
    Composite,
    Effect,
    Expansion,
    Hydraulic,
    Output,
    Parameter,
    Part,
    Translational,
    pi,
)  # fmt: skip


class SingleActingCylinder(Composite):
    """Pressure at a pushes the rod out; a spring, the air and the load bring it back. The travel ends at stops.

    m dv/dt = A (p_a - air) - preload - stiffness travel - seal friction - load. A plunger is one whose seal is at the
    rod: its diameter is the `bore_diameter`. Seal friction is that of a Cylinder.

    Source: docs/physics.md, 5.4. Limits: no leakage past the piston.
    """

    a = Hydraulic("the bore")
    body, rod = Translational("the barrel"), Translational("the rod")
    bore_diameter, stroke = CYLINDER["bore_diameter"], CYLINDER["stroke"]
    dead_volume = Parameter("m^3", "Volume that the piston does not sweep.", default=1e-4, above=0)
    preload = Parameter("N", "Force of the spring on a rod that is in.", default=0.0, least=0)
    stiffness = Parameter("N/m", "Stiffness of the spring.", default=0.0, least=0)
    air = Parameter("Pa", "Pressure of the air on the other side.", default=1e5, least=0)
    port_diameter, seal_force = CYLINDER["port_diameter"], CYLINDER["seal_force"]
    seal_breakaway = CYLINDER["seal_breakaway"]
    seal_speed, seal_viscous = CYLINDER["seal_speed"], CYLINDER["seal_viscous"]
    stop_stiffness, stop_damping = CYLINDER["stop_stiffness"], CYLINDER["stop_damping"]
    pressure = Parameter("Pa", "Pressure at the start; 1 bar when not given.", default=None, least=0, physics=False)
    fluid = Part(Fluid, "What fills it.", default="oil")
    cavitation = Effect("Pressure does not fall below zero; a void opens and closes.")
    seal_friction = Effect("The seals stick and slide.")
    level = Output("Pa", "Pressure of the oil.", name="pressure")
    travel = Output("m", "rod.x - body.x, 0 when it is in.")
    friction = Output("N", "Dry friction of the seals, positive when it holds back a rod that goes out.")
    void = Output("m^3", "Volume without oil, in the chamber.")

    def check(p):
        """Seals do not begin below sliding."""
        yield from seals_make_sense(p)

    def expand(p, scene):
        """A chamber, a spring and a pair of stops; seals where wanted."""
        area = pi * p.bore_diameter**2 / 4
        children = {
            "chamber": scene.make(Chamber, side="cap", area=area, stroke=p.stroke, dead_volume=p.dead_volume,
                                  bore=p.port_diameter, fluid=p.fluid, pressure=p.pressure, cavitation=p.cavitation),
            "back": scene.make(ReturnSpring, preload=p.preload, stiffness=p.stiffness, area=area, air=p.air),
        }  # fmt: skip
        joins = []
        bodies, rods = ["chamber.body", "back.body"], ["chamber.rod", "back.rod"]
        mechanics(p, p.seal_friction, scene, children, joins, bodies, rods)
        shown = {"pressure": "chamber.pressure", "travel": "stops.travel", "void": "chamber.void"}
        if p.seal_friction == "on":
            shown["friction"] = "seal.friction"
        return Expansion(children, joins, {"a": "chamber.port", "body": "chamber.body", "rod": "chamber.rod"}, shown)
