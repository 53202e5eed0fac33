"""Friction of a shaft as its torque over its speed: what a bearing, a seal or a gear motor's data sheet gives."""

from fairlead.components.friction.frictionless import contact_of
from fairlead.components.mechanics.slide_friction import PRESSED, contradictions, curve_of
from fairlead.components.rotation.rack import Rack
from fairlead.components.rotation.rubbing import METHODS, LeverArm

from fairlead.component import (
    Choice,
    Component,
    Composite,
    Expansion,
    Input,
    Law,
    Output,
    Parameter,
    Rotational,
    Table,
)  # fmt: skip

ARM = 1.0  # m; a torque is the force there, and an angular speed the speed: numbers stay as they are


class Turning(Component):
    """Slip at a radius as an angular speed, signal in and out."""

    radius = Parameter("m", "Lever arm.", above=0)
    slip = Input("m/s", "Slip at the radius.", signed=True)
    speed = Output("rad/s", "The same as an angular speed.")

    def law(p, slip):
        """Speed over lever arm."""
        return Law(speed=slip / p.radius)


class ShaftFriction(Composite):
    """Dry friction between two shafts given as a torque over their speed, with no radius and no normal force.

        torque = sliding + (breakaway - sliding) exp(-(w/speed)^2) + viscous w       for w > 0, and the same backward

    w is b.speed - a.speed. Without `speed` the torque falls from breakaway to sliding at once. With `points` of a
    measurement it follows these. On b the torque acts against w. At rest it is the torque that holds, up to breakaway.
    Join `a` with a Housing for the friction of a bearing or a seal.

    Source: Armstrong-Helouvry, Dupont, Canudas de Wit, Automatica 30 (1994), 1083, section 2 (Stribeck curve). Limits:
    the torque does not depend on load, angle or direction.
    """

    a, b = Rotational("one shaft, or a Housing"), Rotational("the other shaft")
    sliding = Parameter("N*m", "Torque while it turns; or give points.", default=None, least=0)
    breakaway = Parameter("N*m", "Torque to begin; that of sliding when not given.", default=None, least=0)
    speed = Parameter("rad/s", "Speed over which breakaway falls to sliding.", default=None, above=0)
    viscous = Parameter("N*m*s/rad", "Torque that grows with speed, beside the dry one.", default=None, least=0)
    points = Table("rad/s", "N*m", "Speed and torque, first point at rest.", default=None)
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    torque = Output("N*m", "Friction torque, positive when it opposes positive slip.")
    slip = Output("rad/s", "Speed of b over a.")

    def check(p):
        """One of the two ways, and a decay from something to something."""
        yield from contradictions(p, "torque", "N*m", "turning on", "rad/s")

    def expand(p, scene):
        """A contact at a lever arm of one metre, pressed with one newton."""
        word = {} if p.method is None else {"method": p.method}
        drag = None if p.viscous is None else p.viscous / ARM**2
        children = {
            "contact": contact_of(scene, curve_of(p), drag, normal_force=PRESSED, **word),
            "lever": scene.make(LeverArm, radius=ARM),
            "turning": scene.make(Turning, radius=ARM),
            "rim_a": scene.make(Rack, radius=ARM),
            "rim_b": scene.make(Rack, radius=ARM),
        }
        joins = [
            ("rim_a.rack", "contact.a"), ("rim_b.rack", "contact.b"), ("contact.friction", "lever.friction"),
            ("contact.slip", "turning.slip"),
        ]  # fmt: skip
        shown = {"torque": "lever.torque", "slip": "turning.speed"}
        return Expansion(children, joins, {"a": "rim_a.pinion", "b": "rim_b.pinion"}, shown)
