"""A roll of web that is unwound or wound: its radius and its inertia follow what is on it."""

from math import sqrt

from fairlead.components.mechanics.mass import Mass
from fairlead.components.rotation.inertia import Inertia

from fairlead.component import (
    Component,
    Composite,
    Effect,
    Expansion,
    Law,
    Output,
    Parameter,
    Rotational,
    Translational,
    Unknown,
    Zones,
    guard,
    hold_position,
    pi,
    zone,
)  # fmt: skip

SHARE = 0.25  # of what does not change of the inertia, that stands in the  any share below 1 is exact


class OnRoll(Component, abstract=True):
    """Half-model of web on a roll: what it tells of its radius, its length and its inertia.

    on          some web is left
    used_up     none is; the run ends, unless `left` is told to a span whose end comes off
    gone        the radius is zero, where any run ends
    """

    shaft = Rotational("the roll")
    radius = Parameter("m", "Radius at angle zero.", above=0)
    growth = Parameter("m/rad", "Growth of the radius per angle; negative while web comes off.")
    core_radius = Parameter("m", "Radius of the core.", above=0)
    thickness = Parameter("m", "Thickness of the web.", above=0)
    strain = Parameter("1", "Strain of the web on the roll.", default=0.0)
    back = Parameter("1", "Turns that an empty core may go back.", default=0.0, least=0)
    outside = Output("m", "Radius at which the web comes off or on.", name="radius")
    wound = Output("m", "Web on the roll.")
    inertia_now = Output("kg*m^2", "J, of all that turns.", name="moment")
    held = Output("1", "Strain of the web on the roll.", name="strain")
    used_up = Output("1", "1 once no web is left, 2 where the radius is zero.", role="used_up",
                     of="wound")  # fmt: skip
    zones = Zones("on", "used_up", "gone")


class WoundWeb(OnRoll):
    """What web on a roll tells, and the momentum of what comes or goes:  torque = dJ/dt speed/2.

    J = steady + bulk R^4,  R = radius + growth angle. What comes on or goes off has the speed of the rim before and
    after, so that J acceleration = torque. The bodies of Spiral and Growing obey d(J speed)/dt = torque + dJ/dt speed/2
    instead; the torque here makes up for it. Its power is the energy of motion of the web that comes, or goes.
    """

    asked_with = {"radius": 0.5, "growth": 1e-5}
    bulk = Parameter("kg/m^2", "Pi times density times width over two.", above=0)
    steady = Parameter("kg*m^2", "Inertia at no radius.", least=0)

    @zone("on", "used_up", "gone")
    def carried(p, shaft, zone):
        """A torque along with the growing inertia."""
        outside = p.radius + p.growth * shaft.angle
        torque = 2 * p.bulk * outside**3 * p.growth * shaft.speed**2
        return Law(shaft=-torque, supplied=torque * shaft.speed, radius=outside, strain=p.strain,
                   wound=pi * (outside**2 - p.core_radius**2) / p.thickness,
                   moment=p.steady + p.bulk * outside**4, used_up={"on": 0, "used_up": 1, "gone": 2}[zone])  # fmt: skip

    @guard("on", to="used_up", unit="m")
    def ends(p, shaft):
        """The radius is that of the core."""
        return p.core_radius - p.back * p.thickness - p.radius - p.growth * shaft.angle

    @guard("used_up", to="gone", unit="m")
    def vanishes(p, shaft):
        """The radius is zero."""
        return -p.radius - p.growth * shaft.angle


class Spiral(Component):
    """The rim of a roll, by the radius there is:  rim.x = radius angle + growth angle^2/2."""

    shaft = Rotational("the roll")
    rim = Translational("where the web comes off or on")
    radius = Parameter("m", "Radius at angle zero.", above=0)
    growth = Parameter("m/rad", "Growth of the radius per angle; negative while web comes off.")
    drawn = Unknown("N", "Force at the rim.")

    def law(p, shaft, rim, drawn):
        """Its slope over the angle is R = radius + growth angle."""
        return Law(drawn=hold_position(rim.x - p.radius * shaft.angle - p.growth * shaft.angle**2 / 2))


class Growing(Component):
    """A body whose motion stands for the inertia of web on a roll:  d(layers.x)/d(angle) = R^2/reach - offset.

    With the mass M here and m = 2 M offset/reach at the rim of a Spiral both have M R^4/reach^2 + M offset^2: the term
    with R^2 drops out. See docs/physics.md, 4.9.
    """

    shaft = Rotational("the roll")
    layers = Translational("the body")
    radius = Parameter("m", "Radius at angle zero.", above=0)
    growth = Parameter("m/rad", "Growth of the radius per angle; negative while web comes off.")
    reach = Parameter("m", "Radius at which the body moves as the rim does, but for the offset.", above=0)
    offset = Parameter("m", "What it moves less per angle.", default=0.0, least=0)
    moved = Unknown("N", "Force on the body.")

    def law(p, shaft, layers, moved):
        """A polynomial of the angle."""
        angle, k = shaft.angle, p.growth
        squares = (p.radius**2 * angle + p.radius * k * angle**2 + k**2 * angle**3 / 3) / p.reach
        return Law(moved=hold_position(layers.x - squares + p.offset * angle))


class SteadyRoll(OnRoll):
    """The limit of a Spiral with web so thin that radius and inertia stay."""

    rim = Translational("where the web comes off or on")
    moment = Parameter("kg*m^2", "Moment of inertia of all that turns.", above=0)

    @zone("on", "used_up", "gone")
    def carried(p, shaft, zone):
        """The web on it becomes less, or more, all the same."""
        wound = pi * (p.radius**2 - p.core_radius**2 + 2 * p.radius * p.growth * shaft.angle) / p.thickness
        return Law(shaft=0, rim=0, radius=p.radius, wound=wound, moment=p.moment, strain=p.strain,
                   used_up={"on": 0, "used_up": 1, "gone": 2}[zone])  # fmt: skip

    @guard("on", to="used_up", unit="m")
    def ends(p, shaft):
        """The web on it is none, in turns of the core."""
        turned = p.radius**2 - p.core_radius**2 + 2 * p.radius * p.growth * shaft.angle
        return -turned / (2 * p.core_radius) - p.back * p.thickness

    @guard("used_up", to="gone", unit="m")
    def vanishes(p, shaft):
        """The radius would be zero, had it followed."""
        return -(p.radius**2 + 2 * p.radius * p.growth * shaft.angle) / (2 * p.radius)

    def ties(p):
        """A rack."""
        return (("shaft", "rim", p.radius, 0.0),)


class WebRoll(Composite, abstract=True):
    """Half-model of a roll of web with its core and shaft.

    layers      on: radius and inertia follow what is on the roll; off: both stay as at angle zero
    """

    shaft = Rotational("the roll, forward with the web")
    rim = Translational("where the web comes off or on, forward with it")
    radius = Parameter("m", "Outer radius at angle zero of the shaft.", above=0, usual=(1e-3, 5))
    core_radius = Parameter("m", "Radius of the core.", above=0, usual=(1e-3, 5))
    width = Parameter("m", "Width of the web.", above=0, usual=(1e-3, 20))
    thickness = Parameter("m", "Thickness of the web.", above=0, usual=(1e-6, 0.05))
    density = Parameter("kg/m^3", "Density of the web as it lies on the roll.", above=0, usual=(100, 1e4))
    moment = Parameter("kg*m^2", "Inertia of core, shaft and chucks, and of a drive that is not modelled.", above=0)
    strain = Parameter("1", "Strain of the web as it lies on the roll.", default=0.0, usual=(0, 0.1))
    speed = Parameter("rad/s", "Angular speed at the start.", default=None, physics=False)
    layers = Effect("Radius and inertia follow what is on the roll.")
    outside = Output("m", "Radius at which the web comes off or on.", name="radius")
    inertia = Output("kg*m^2", "J, of all that turns.", name="moment")

    def check(p):
        """There is web on it, and an inertia that does not change."""
        if p.radius < p.core_radius:
            what = f"radius {p.radius:g} m is below core_radius = {p.core_radius:g} m"
            yield "radius", what, "Web lies outside the core."
        yield from too_light(p.moment, pi * p.density * p.width * p.core_radius**4 / 2)


def too_light(moment, solid):
    """What of the inertia does not change would be below zero."""
    if moment <= solid:
        what = f"moment {moment:g} kg*m^2 is not above that of a core of solid web, {solid:.3g} kg*m^2"
        yield "moment", what, "Add the inertia of shaft, chucks and drive; it must be more than that."


def rolled(p, scene, way, length):
    """Expansion of a roll whose radius grows (way +1) or falls (-1) as it turns; `length` is what its web is called."""
    bulk = pi * p.density * p.width / 2
    same = {"radius": p.radius, "growth": way * p.thickness / (2 * pi), "core_radius": p.core_radius,
            "thickness": p.thickness, "strain": p.strain, "back": float(way > 0)}  # fmt: skip
    told = {"radius": "roll.radius", "moment": "roll.moment", length: "roll.wound"}
    if way < 0:
        told["held"] = "roll.strain"
    start = {} if p.speed is None else {"speed": p.speed}
    if p.layers == "off":
        turns = p.moment + bulk * (p.radius**4 - p.core_radius**4)
        children = {
            "roll": scene.make(SteadyRoll, moment=turns, **same),
            "core": scene.make(Inertia, moment=turns, **start),
        }
        return Expansion(children, [("roll.shaft", "core.shaft")], {"shaft": "core.shaft", "rim": "roll.rim"}, told)
    steady = p.moment - bulk * p.core_radius**4
    mass, offset = bulk * p.radius**2, sqrt(SHARE * steady / bulk) / p.radius
    children = {
        "roll": scene.make(WoundWeb, bulk=bulk, steady=steady, **same),
        "spiral": scene.make(Spiral, radius=p.radius, growth=same["growth"]),
        "growing": scene.make(Growing, radius=p.radius, growth=same["growth"], reach=p.radius, offset=offset),
        "core": scene.make(Inertia, moment=(1 - SHARE) * steady, **start),
        "edge": scene.make(Mass, mass=2 * mass * offset / p.radius),
        "web": scene.make(Mass, mass=mass),
    }
    joins = [("roll.shaft", "core.shaft"), ("spiral.shaft", "core.shaft"), ("spiral.rim", "edge.flange"),
             ("growing.shaft", "core.shaft"), ("growing.layers", "web.flange")]  # fmt: skip
    return Expansion(children, joins, {"shaft": "core.shaft", "rim": "edge.flange"}, told)


class Unwinder(WebRoll):
    """A roll that web is drawn from:  rim.v = R shaft.speed,   R = radius - thickness angle/(2 pi).

        J = moment + pi density width (R^4 - core_radius^4)/2,    J d(speed)/dt = torque + R tension

    There is no term speed dJ/dt, because web that leaves keeps its momentum. The output `left` is the length of web
    still on the roll, pi (R^2 - core_radius^2)/thickness. Connect it with `left` of the first span, and `held` with
    its `before`.

    A run ends when the roll is used up, at R = core_radius. If `left` is connected, the end of the web comes off there
    instead. The rest of the roll then turns on, and a run ends at R = 0 at the latest.

    Source: docs/physics.md, 4.9.

    Limits: layers do not slip or give. The thickness is that of the web as it comes off. Only `rodas` takes radii that
    change (docs/components.md).
    """

    left = Output("m", "Web left on the roll; at zero it is used up.")
    held = Output("1", "Strain of the web that comes off.")

    def expand(p, scene):
        """A spiral that becomes smaller."""
        return rolled(p, scene, -1, "left")


class Winder(WebRoll):
    """A roll on to which web is drawn:  rim.v = R shaft.speed,   R = radius + thickness angle/(2 pi).

    J = moment + pi density width (R^4 - core_radius^4)/2,    J d(speed)/dt = torque - R tension

    `wound` is the web on it, pi (R^2 - core_radius^2)/thickness. A TaperTension tells the torque that is wanted over
    `radius`. There is no term speed dJ/dt, because web that comes brings its momentum. A run ends where an empty core
    has turned back by a whole turn.

    Source: docs/physics.md, 4.9. Limits: layers do not slip or give; no air is wound in; `strain` is not that of
    what comes on. Only `rodas` takes radii that change (docs/components.md).
    """

    wound = Output("m", "Web on the roll.")

    def expand(p, scene):
        """A spiral that becomes larger."""
        return rolled(p, scene, +1, "wound")
