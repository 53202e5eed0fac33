"""A dancer on a swinging arm, round whose roller a web makes a loop."""

from fairlead.components.rotation.inertia import Inertia
from fairlead.components.rotation.rack import Rack
from fairlead.components.web.span import WebAccumulator

from fairlead.component import Composite, Expansion, Input, Output, Parameter, Rotational, Translational


class RotaryDancer(Composite):
    """A roller on a swinging arm, in a loop of web:  arm_moment angle'' = torque - arm (tension_in + tension_out).

    Each side of the loop has the length  length + arm angle  and the material of a WebAccumulator with one strand. The
    web between the two sides turns the roller:  moment d(speed)/dt = radius (tension_out - tension_in). Join at
    `pivot` what draws the loop out: a TorqueSource, or an air cylinder by a Rack. A RotationalDamper, a RotationalStop
    and a RotationSensor for the controller go there, too.

    Source: docs/physics.md, 4.9; V. Gassmann, D. Knittel, P. R. Pagilla, M.-A. Bueno, American Control Conference
    2009, WeB07.3.

    Limits: the sides of the loop are square to the arm, so angles are small. The web does not slip. The whole mass of
    arm and roller is in `arm_moment`; add their weight to what acts on `pivot`.
    """

    a = Translational("rim of the roller behind the loop")
    b = Translational("rim of the roller ahead of it")
    pivot = Rotational("the arm")
    arm = Parameter("m", "Length from the pivot to the roller.", above=0, usual=(0.01, 10))
    arm_moment = Parameter("kg*m^2", "Moment of inertia of arm and roller about the pivot.", above=0)
    angle = Parameter("rad", "Angle of the arm at the start.", default=None, physics=False)
    radius = Parameter("m", "Radius of the roller.", above=0)
    moment = Parameter("kg*m^2", "Moment of inertia of the roller.", above=0)
    speed = Parameter("rad/s", "Angular speed of the roller at the start.", default=None, physics=False)
    length = Parameter("m", "Length of either side of the loop, at angle zero.", above=0)
    stiffness = Parameter("N", "Young's modulus times width times thickness of the web.", above=0, usual=(10, 1e9))
    tension = Parameter("N", "Tension at the start.", default=0.0, least=0, physics=False)
    before = Input("1", "Strain of the web behind the loop.", default=0.0)
    after = Input("1", "Strain of the web ahead of it.", default=0.0)
    tension_in = Output("N", "Tension of the side where the web comes.")
    tension_out = Output("N", "Tension of the side where it goes.")
    strain_in = Output("1", "Strain of the side where the web comes.")
    strain_out = Output("1", "Strain of the side where it goes.")
    swing = Output("rad", "Angle of the arm.", name="angle")
    turns = Output("rad/s", "Angular speed of the roller.", name="speed")

    def expand(p, scene):
        """Two sides, the roller between them, and the arm."""
        side = {"length": p.length, "stiffness": p.stiffness, "tension": p.tension, "strands": 1.0}
        start = {} if p.speed is None else {"speed": p.speed}
        begins = {} if p.angle is None else {"angle": p.angle}
        children = {
            "inward": scene.make(WebAccumulator, **side),
            "outward": scene.make(WebAccumulator, **side),
            "roller": scene.make(Inertia, moment=p.moment, **start),
            "rim": scene.make(Rack, radius=p.radius),
            "arm": scene.make(Inertia, moment=p.arm_moment, **begins),
            "lever": scene.make(Rack, radius=p.arm),
        }
        joins = [
            ("roller.shaft", "rim.pinion"), ("inward.b", "rim.rack"), ("outward.a", "rim.rack"),
            ("arm.shaft", "lever.pinion"), ("lever.rack", "inward.carriage"), ("lever.rack", "outward.carriage"),
            ("inward.strain", "outward.before"), ("outward.strain", "inward.after"),
        ]  # fmt: skip
        told = {
            "before": "inward.before", "after": "outward.after", "tension_in": "inward.tension",
            "tension_out": "outward.tension", "strain_in": "inward.strain", "strain_out": "outward.strain",
            "angle": "arm.angle", "speed": "roller.speed",
        }  # fmt: skip
        return Expansion(children, joins, {"a": "inward.a", "b": "outward.b", "pivot": "arm.shaft"}, told)
