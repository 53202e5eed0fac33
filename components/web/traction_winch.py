"""A traction winch: a rope in many half wraps round two drums that turn together, and the drum that stores it."""

from math import pi, sin, sqrt

from fairlead.components.friction.contact import Contact
from fairlead.components.mechanics.mass import Mass
from fairlead.components.rotation.inertia import Inertia
from fairlead.components.rotation.rack import Rack
from fairlead.components.rotation.rubbing import METHODS
from fairlead.components.web.roll import Unwinder, too_light
from fairlead.components.web.roller import WrapGrip
from fairlead.components.web.span import WholeSpan

from fairlead.component import Choice, Composite, Count, Expansion, Input, Output, Parameter, Rotational, Translational

ROUND_OFF = 1e-9  # strain: a tension of 1e-9 of the stiffness is far below any that a winch holds
NESTED = sqrt(3) / 2  # height of a layer in the grooves of the one below, in diameters


class TractionWinch(Composite):
    """Two grooved drums on one shaft, round which a rope runs in half wraps, from a storage drum to the load.

    Each half wrap holds a difference of tensions up to (exp(mu' pi) - 1) times the smaller one, and slips beyond.
    mu' is mu, or mu/sin(groove/2) in a groove with flanks. All half wraps together hold

        load/storage = exp(mu' pi half_wraps)

    Between two half wraps the rope is a span of length `distance` with its balance of material. So strain comes in
    with the rope. While hauling, the wraps next to the storage drum slip in full, and those next to the load do not.
    While paying out it is the other way round. `step` makes each groove larger than the one before it, towards the
    load, to avoid this slip.

    Port `a` is the rim of the storage drum, port `rope` the rope on the last groove. Join a WebSpan or a RopeTail at
    `rope`: its `tension` with `ahead`, its `strain` with `after`, and `strain` with its `before`. Pay-out is positive.

    Source: Euler's formula at each wrap; V-belt grooves; docs/physics.md, 4.9.

    Limits: there is no bending stiffness. In each groove the rope slips as one mass, damped between its spans. mu is
    one coefficient for sticking and sliding. Both drums turn alike.
    """

    a = Translational("rim of the storage drum")
    rope = Translational("the rope on the last groove")
    shaft = Rotational("both drums, forward when they pay out")
    radius = Parameter("m", "Radius of the first groove, to the middle of the rope.", above=0, usual=(0.01, 10))
    half_wraps = Count("Half turns of the rope, on both drums together.")
    distance = Parameter("m", "Free rope from one drum to the other.", above=0, usual=(0.01, 20))
    inlet = Parameter("m", "Free rope from the storage drum to the first groove.", above=0, usual=(0.01, 1e3))
    stiffness = Parameter("N", "EA of the rope.", above=0, usual=(10, 1e9))
    mass = Parameter("kg/m", "Mass of the rope per length; a half wrap moves with its slip.", above=0)
    damping_ratio = Parameter("1", "Damping ratio of a half wrap that slips.", default=0.1, above=0, most=1)
    mu = Parameter("1", "Coefficient of friction of rope on drum.", above=0, usual=(0.01, 1))
    groove = Parameter("rad", "Angle between a groove's flanks; a round one when not given.", default=None, above=0,
                       most=pi)  # fmt: skip
    step = Parameter("1", "Growth from groove to groove, as a share.", default=0.0, least=-0.01, most=0.01)
    moment = Parameter("kg*m^2", "Moment of inertia of both drums.", above=0)
    tension = Parameter("N", "Tension of all spans at the start.", default=0.0, least=0, physics=False)
    round_off = Parameter("N", "Over which the corners of the grip are rounded; 1e-9 of the stiffness if not given.",
                          default=None, above=0)  # fmt: skip
    method = Choice(METHODS, "Treatment of sticking; the scene's when not given.", default=None)
    hands_on = ("method",)
    before = Input("1", "Strain of the rope that comes off the storage drum.", default=0.0)
    after = Input("1", "Strain of the rope beyond the last groove.", default=0.0)
    ahead = Input("N", "Tension of the rope beyond the last groove.", default=0.0)
    strain = Output("1", "Strain of the rope that comes on to the last groove.")
    inboard = Output("N", "Tension of the rope at the storage drum.")
    turns = Output("rad/s", "Angular speed of the drums.", name="speed")

    def expand(p, scene):
        """A span before each half wrap; the outer tensions and strains come from outside."""
        n, word = p.half_wraps, {} if p.method is None else {"method": p.method}
        mu = p.mu if p.groove is None else p.mu / sin(p.groove / 2)
        same = {"stiffness": p.stiffness, "tension": p.tension}
        lies = p.mass * pi * p.radius
        round_off = ROUND_OFF * p.stiffness if p.round_off is None else p.round_off
        damping = p.damping_ratio * p.distance * sqrt(2 * p.stiffness / p.distance * lies)
        children, joins = {"drums": scene.make(Inertia, moment=p.moment)}, []
        for i in range(n):
            length = p.inlet if i == 0 else p.distance
            children |= {
                f"span[{i}]": scene.make(WholeSpan, length=length, damping=damping, **same),
                f"rim[{i}]": scene.make(Rack, radius=p.radius * (1 + p.step) ** i),
                f"grip[{i}]": scene.make(WrapGrip, mu=mu, wrap=pi, round_off=round_off),
                f"wrap[{i}]": scene.make(Contact, curve=1.0, **word),
                f"half[{i}]": scene.make(Mass, mass=lies),
            }
            joins += [
                ("drums.shaft", f"rim[{i}].pinion"), (f"rim[{i}].rack", f"wrap[{i}].a"),
                (f"span[{i}].b", f"wrap[{i}].b"), (f"half[{i}].flange", f"wrap[{i}].b"),
                (f"grip[{i}].grip", f"wrap[{i}].normal"), (f"span[{i}].elastic", f"grip[{i}].behind"),
            ]  # fmt: skip
            if i:
                joins += [
                    (f"wrap[{i - 1}].b", f"span[{i}].a"), (f"span[{i}].elastic", f"grip[{i - 1}].ahead"),
                    (f"span[{i - 1}].strain", f"span[{i}].before"), (f"span[{i}].strain", f"span[{i - 1}].after"),
                ]  # fmt: skip
        told = {
            "before": "span[0].before", "after": f"span[{n - 1}].after", "ahead": f"grip[{n - 1}].ahead",
            "strain": f"span[{n - 1}].strain", "inboard": "span[0].tension", "speed": "drums.speed",
        }  # fmt: skip
        return Expansion(children, joins, {"a": "span[0].a", "rope": f"wrap[{n - 1}].b", "shaft": "drums.shaft"}, told)


def thickness(p):
    """Of a web that takes the room of the rope [m]."""
    return (NESTED if p.nested == "yes" else 1.0) * p.diameter**2 / p.width


class StorageDrum(Composite):
    """A drum that stores rope in layers without a bond: its rim has the speed of the rope that comes off.

        R = radius - diameter^2/(2 pi width) angle        angle paid out; nested: sqrt(3)/2 of diameter^2

    So it is an Unwinder whose web is a layer of rope. Turned backward it winds. `held` is the strain that the rope
    keeps on the drum. A run ends when no rope is left, at R = core_radius.

    Source: docs/physics.md, 4.4 and 4.9.

    Limits: the radius grows evenly and not layer by layer (a Winch of a Route has layers). All rope on the drum has
    one strain. Only `rodas` takes it.
    """

    shaft = Rotational("the drum, forward when it pays out")
    rim = Translational("where the rope comes off")
    radius = Parameter("m", "Radius at which the rope comes off at angle zero.", above=0, usual=(1e-3, 10))
    core_radius = Parameter("m", "Radius of the empty drum.", above=0, usual=(1e-3, 10))
    width = Parameter("m", "Width between the flanges.", above=0)
    diameter = Parameter("m", "Diameter of the rope.", above=0)
    mass = Parameter("kg/m", "Mass of the rope per length.", above=0)
    nested = Choice(("yes", "no"), "Whether layers lie in the grooves of those below.", default="yes")
    moment = Parameter("kg*m^2", "Moment of inertia of the empty drum and its drive.", above=0)
    strain = Parameter("1", "Strain of the rope on the drum.", default=0.0, usual=(0, 0.1))
    speed = Parameter("rad/s", "Angular speed at the start.", default=None, physics=False)
    outside = Output("m", "Radius at which the rope comes off.", name="radius")
    inertia = Output("kg*m^2", "Moment of inertia of all that turns.", name="moment")
    left = Output("m", "Rope on the drum.")
    held = Output("1", "Strain of the rope that comes off.")

    def check(p):
        """Rope lies outside the drum, and there is room for it side by side."""
        if p.radius < p.core_radius:
            what = f"radius {p.radius:g} m is below core_radius = {p.core_radius:g} m"
            yield "radius", what, "Rope lies outside the empty drum."
        if p.width < p.diameter:
            yield "width", f"width {p.width:g} m is below diameter = {p.diameter:g} m", "One wrap must fit."
        yield from too_light(p.moment, pi * p.mass / thickness(p) * p.core_radius**4 / 2)

    def expand(p, scene):
        """A web of the same mass and the same growth of the radius."""
        same = {name: getattr(p, name) for name in ("radius", "core_radius", "width", "moment", "strain")}
        start = {} if p.speed is None else {"speed": p.speed}
        density = p.mass / (thickness(p) * p.width)
        drum = scene.make(Unwinder, thickness=thickness(p), density=density, **same, **start)
        told = {name: f"drum.{name}" for name in ("radius", "moment", "left", "held")}
        return Expansion({"drum": drum}, [], {"shaft": "drum.shaft", "rim": "drum.rim"}, told)
