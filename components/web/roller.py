"""Rollers that a web runs over: an idler, and two that nip it. On both it may slip."""

from fairlead.components.friction.contact import Contact
from fairlead.components.mechanics.mass import Mass
from fairlead.components.rotation.housing import Housing
from fairlead.components.rotation.inertia import Inertia
from fairlead.components.rotation.rack import Rack
from fairlead.components.rotation.rotational_damper import RotationalDamper
from fairlead.components.rotation.rubbing import METHODS
from fairlead.components.rotation.shaft_friction import ShaftFriction

from fairlead.component import (
    Choice,
    Component,
    Composite,
    Effect,
    Expansion,
    Input,
    Law,
    Output,
    Parameter,
    Rotational,
    Translational,
    exp,
    sqrt,
)  # fmt: skip


class WrapGrip(Component):
    """The largest difference of tensions that a wrapped roller holds:  least tension (exp(mu wrap) - 1) + mu nip."""

    mu = Parameter("1", "Coefficient of friction of web on roller.", above=0)
    wrap = Parameter("rad", "Angle that the web wraps.", least=0)
    nip = Parameter("N", "Force that presses the web to the roller.", default=0.0, least=0)
    round_off = Parameter("N", "Tension over which corners are rounded off.", above=0)
    behind = Input("N", "Tension of the web that comes.", default=0.0)
    ahead = Input("N", "Tension of the web that goes.", default=0.0)
    grip = Output("N", "Largest difference of tensions.")
    least = Output("N", "The smaller tension.", rounded_by="round_off")

    def law(p, behind, ahead):
        """Euler's formula on the smaller tension."""
        spread = sqrt((behind - ahead) ** 2 + p.round_off**2) - p.round_off
        least = (behind + ahead - spread) / 2
        return Law(grip=(exp(p.mu * p.wrap) - 1) * least + p.mu * p.nip, least=least)


class WebRoller(Composite, abstract=True):
    """Half-model of a roller that a web runs over.

    traction    on: the web slips on the roller beyond what friction holds; off: it moves with the rim
    """

    web = Translational("the web on the roller")
    shaft = Rotational("the roller", optional=True)
    radius = Parameter("m", "Radius of the roller, to the middle of the web.", above=0, usual=(1e-3, 5))
    moment = Parameter("kg*m^2", "Moment of inertia of all that turns.", above=0)
    drag = Parameter("N*m*s/rad", "Viscous torque of the bearings.", default=None, above=0)
    rubbing = Parameter("N*m", "Dry torque of the bearings.", default=None, above=0)
    speed = Parameter("rad/s", "Angular speed at the start.", default=None, physics=False)
    mu = Parameter("1", "Coefficient of friction of web on roller, with traction on.", default=0.3, above=0)
    wrap = Parameter("rad", "Angle that the web wraps, with traction on.", default=3.14159, least=0, usual=(0, 7))
    web_mass = Parameter(
        "kg", "Of the web on the roller, with traction on; none when not given.", default=None, above=0
    )
    round_off = Parameter("N", "Tension over which the corners of `grip` are rounded off.", default=1e-3, above=0)
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    traction = Effect("The web slips on the roller.", "off")
    behind = Input("N", "Tension of the web that comes; what it slips at, and `grip`, need both.", default=0.0)
    ahead = Input("N", "Tension of the web that goes.", default=0.0)
    grip = Output("N", "Largest difference of tensions that the roller holds.")
    slip = Output("m/s", "Speed of the web over the roller, with traction on.")
    turns = Output("rad/s", "Angular speed.", name="speed")


def roller(p, scene, nip=0.0, rubs=None):
    """Expansion of a roller that is pressed with `nip` and whose dry torque is `rubs`."""
    start = {} if p.speed is None else {"speed": p.speed}
    word = {} if p.method is None else {"method": p.method}
    children = {
        "roller": scene.make(Inertia, moment=p.moment, **start),
        "rim": scene.make(Rack, radius=p.radius),
        "grip": scene.make(WrapGrip, mu=p.mu, wrap=p.wrap, nip=nip, round_off=p.round_off),
    }
    joins, web = [("roller.shaft", "rim.pinion")], "rim.rack"
    told = {"behind": "grip.behind", "ahead": "grip.ahead", "grip": "grip.grip", "speed": "roller.speed"}
    if p.drag is not None or rubs:
        children["frame"] = scene.make(Housing)
    if p.drag is not None:
        children["drag"] = scene.make(RotationalDamper, damping=p.drag)
        joins += [("frame.shaft", "drag.a"), ("drag.b", "roller.shaft")]
    if rubs:
        children["rubbing"] = scene.make(ShaftFriction, sliding=rubs, **word)
        joins += [("frame.shaft", "rubbing.a"), ("rubbing.b", "roller.shaft")]
    if p.traction == "on":
        children["contact"] = scene.make(Contact, curve=1.0, **word)
        joins += [("rim.rack", "contact.a"), ("grip.grip", "contact.normal")]
        web, told["slip"] = "contact.b", "contact.slip"
        if p.web_mass is not None:
            children["band"] = scene.make(Mass, mass=p.web_mass)
            joins.append(("contact.b", "band.flange"))
    return Expansion(children, joins, {"web": web, "shaft": "roller.shaft"}, told)


class Idler(WebRoller):
    """A roller that the web turns, or that a drive turns:  moment d(speed)/dt = radius (ahead - behind) - bearing.

    With `traction` the web sticks up to

        |ahead - behind| = least tension (exp(mu wrap) - 1)

    and slips beyond. Without `traction` web and rim have one speed, and `grip` is the force that the roller could
    hold.

    Source: Euler's formula; docs/physics.md, 4.9.

    Limits: there is no film of air, which lowers mu at speed. mu is one coefficient for sticking and sliding. The web
    on the roller has no mass, so the tensions alone determine its slip. If a roller that slips reaches the speed of
    the web and zones do not settle, give `web_mass`, and give the spans `damping`.
    """

    def expand(p, scene):
        """Only wrapped."""
        return roller(p, scene, rubs=p.rubbing)


class NipRoller(WebRoller):
    """A driven roller to which a second one presses the web:  holds least tension (exp(mu wrap) - 1) + mu force.

    |ahead - behind| <= least tension (exp(mu wrap) - 1) + mu force,  and it slips beyond. The pressed roller turns with
    the web; add its inertia, by the square of the ratio of radii, to `moment`. Rolling in the cover takes the torque
    rolling force radius  beside that of the bearings. The drive is joined to `shaft`.

    Limits: as of an Idler; the web is not drawn thinner by the nip and has one speed in it. The pressed roller drives
    nothing, so that one face holds.

    Source: docs/physics.md, 4.9.
    """

    force = Parameter("N", "Force that presses the rollers together.", least=0)
    rolling = Parameter(
        "1", "Rolling resistance of the cover, as a share of the force.", default=0.0, least=0, most=0.5
    )

    def expand(p, scene):
        """Pressed beside being wrapped."""
        dry = (p.rubbing or 0.0) + p.rolling * p.force * p.radius
        return roller(p, scene, nip=p.force, rubs=dry)
