"""A pulley: a wheel that turns the line through an angle and turns with it."""

import math
from typing import Any

from fairlead.components.friction.curve import Curve
from fairlead.components.rotation.inertia import Inertia
from fairlead.components.rotation.rack import Rack
from fairlead.components.rotation.rubbing import Bearing
from fairlead.components.route.bearing_load import BearingLoad
from fairlead.components.route.station import Machinery, Station

from fairlead.component import Block, Choice, Parameter, Part

BEARING: dict[str, Any] = {
    "friction": Part(Curve, "Friction of the bearing.", default=0.0),
    "radius": Parameter("m", "Radius of the bearing's bore.", default=0.03, above=0),
}


class Pulley(Station):
    """An arc as in a bend, whose surface moves with radius times the speed of the wheel.

        moment dw/dt = radius (sum of friction on the wheel) - bearing - what the shaft takes

    In steady motion the tensions on both sides differ by the torque of the bearing over the radius. The bearing
    carries Q = 2 T sin(angle/2), which for two tensions that differ little is the sum of the loads of all nodes
    on the wheel times 2 sin(angle/2)/angle.

    `route.<name>.shaft` may be connected to a brake, a drive or a load; `turns: locked` makes it a bend.
    """

    word = "Pulley"
    angle = Parameter("rad", "Angle the line turns through.", above=0)
    radius = Parameter("m", "Radius of the wheel.", above=0, usual=(5e-3, 200))
    friction = Part(Curve, "Friction of the line on the wheel.")
    moment = Parameter("kg*m^2", "Moment of inertia of the wheel.", default=5.0, above=0)
    bearing = Block(BEARING, "Friction of the bearing; none when not given.")
    turns = Choice(("freely", "locked"), "Whether the wheel turns.", default="freely")

    def extent(p):
        """Length of the arc."""
        return p.angle * p.radius

    def bend_radius(p):
        """The radius."""
        return p.radius

    def rubs(p):
        """The groove."""
        return p.friction

    def lever(p):
        """The radius."""
        return p.radius

    def taken_by_bearing(p):
        """Torque mu r Q over the radius, Q = 2 T sin(angle/2).

        T is the mean of both sides, which differ by just that much: T = tension + half of it at the slack side.
        """
        if p.bearing is None:
            return 0.0
        share = p.bearing.friction.breakaway() * p.bearing.radius / p.radius * 2 * math.sin(min(p.angle, math.pi) / 2)
        return share / (1 - share / 2) if share < 2 else math.inf

    def machinery(p, scene):
        """Wheel and rim; the bearing with the load it carries, if it rubs."""
        if p.turns == "locked":
            return None
        children = {"wheel": scene.make(Inertia, moment=p.moment), "rim": scene.make(Rack, radius=p.radius)}
        joins = [("wheel.shaft", "rim.pinion")]
        ports, total = {"shaft": "wheel.shaft", "rim": "rim.rack"}, ""
        if p.bearing.friction.breakaway() > 0:
            share = 2 * math.sin(min(p.angle, math.pi) / 2) / p.angle
            children["bearing"] = scene.make(Bearing, radius=p.bearing.radius, curve=p.bearing.friction)
            children["load"] = scene.make(BearingLoad, share=share)
            joins += [("wheel.shaft", "bearing.shaft"), ("load.load", "bearing.normal")]
            total = "load.sum"
        return Machinery(children, tuple(joins), ports, {"speed": "wheel.speed"}, "rim.rack", total=total)
