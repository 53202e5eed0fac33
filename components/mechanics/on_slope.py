"""A body on a slope."""

from math import cos, sin

from fairlead.components.friction.curve import Curve
from fairlead.components.friction.frictionless import contact_of
from fairlead.components.mechanics.ground import Ground
from fairlead.components.mechanics.mass import Mass
from fairlead.components.rotation.rubbing import METHODS
from fairlead.components.sources.force import ForceSource

from fairlead.component import Choice, Composite, Effect, Expansion, Output, Parameter, Part, Translational


class MassOnSlope(Composite):
    """A body that slides or rolls on a slope: its weight draws it by m g sin(angle), and presses it by m g cos(angle).

    x grows up the slope. `curve` is sliding friction, or the coefficient of rolling resistance; it rests while that
    is above tan(angle). On level ground (angle 0) it is a body on a floor.

    m a = force - m g sin(angle) - friction,  friction up to mu m g cos(angle), against the motion.

    Source: friction on an inclined plane, e.g. Meriam and Kraige, Engineering Mechanics: Dynamics. Limits: the slope is
    the same everywhere, and the body does not tip or leave it.
    """

    flange = Translational("the body, along the slope")
    mass = Parameter("kg", "Mass.", above=0)
    angle = Parameter("rad", "Slope, rising towards +x.", above=-1.5707, below=1.5707)
    curve = Part(Curve, "Coefficient of friction, or of rolling resistance, over speed.", default=0.0)
    gravity = Parameter("m/s^2", "Acceleration of free fall.", default=9.80665, above=0)
    position = Parameter("m", "Position at the start, along the slope.", default=None, physics=False)
    velocity = Parameter("m/s", "Velocity at the start, up the slope.", default=None, physics=False)
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    rubs = Effect("Friction on the slope.")
    x = Output("m", "Position along the slope.")
    v = Output("m/s", "Velocity up the slope.")
    friction = Output("N", "Friction, positive when it holds back a body that goes up.")

    def expand(p, scene):
        """A mass, the part of its weight along the slope, and a contact with the ground."""
        weight = p.mass * p.gravity
        children = {
            "body": scene.make(Mass, mass=p.mass, position=p.position, velocity=p.velocity),
            "weight": scene.make(ForceSource, force=-weight * sin(p.angle)),
        }
        joins, shown = [("body.flange", "weight.flange")], {"x": "body.x", "v": "body.v"}
        if p.rubs == "on":
            word = {} if p.method is None else {"method": p.method}
            children["ground"] = scene.make(Ground)
            children["contact"] = contact_of(scene, p.curve, normal_force=weight * cos(p.angle), **word)
            joins += [("ground.flange", "contact.a"), ("contact.b", "body.flange")]
            shown["friction"] = "contact.friction"
        return Expansion(children, joins, {"flange": "body.flange"}, shown)
