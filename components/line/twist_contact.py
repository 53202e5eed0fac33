"""Friction of a line that slips along its axis and turns about it at once."""

from fairlead.components.friction.contact import with_lift
from fairlead.components.friction.curve import Curve, load_factor, stays_in_place

from fairlead.component import (
    Component,
    Effect,
    Input,
    Law,
    Output,
    Parameter,
    Part,
    Rotational,
    Translational,
    Zones,
    exp,
    guard,
    sqrt,
    zone,
)  # fmt: skip


class PlanarContact(Component):
    """Slip in two directions with one friction, against the resultant.

        u = sqrt(v^2 + (r w)^2 + creep^2),   v = b.v - a.v along the line, r w at the surface round it
        friction = N mu(u) v/u               torque = r N mu(u) r w/u

    A line that slides along at v resists turning like a damper of N mu r^2/v. The faster it slides, the less it
    resists, so twist leaves it while it moves. At rest it creeps, at load/(N mu) times `creep` for small loads, as
    with `method: root`. There is no stiction above sliding friction.
    """

    a = Translational("the surface")
    b = Translational("the line")
    turning = Rotational("the line, turning about its axis")
    curve = Part(Curve, "Coefficient of friction over slip speed.")
    radius = Parameter("m", "Radius of the line's surface.", above=0)
    sticks_below, creeps = "creep", True
    creep = Parameter("m/s", "Speed over which the sign changes.", default=1e-4, above=0)
    lift = Parameter(
        "N", "Normal force below which the contact is open; when not given 1 uN, or a thousandth of a normal_force "
        "that is below 1 mN.", default=1e-6, above=0,
    )  # fmt: skip
    normal_force = Parameter("N", "Normal force, when the input `normal` is not connected.", default=None, least=0)
    load_dependence = Effect("The curve's load_exponent; off: friction in proportion to the normal force.")
    extent = Parameter("1", "What shares the normal force, as metres of line: see Contact.", default=1.0, above=0)
    normal = Input("N", "Normal force.", default="normal_force")
    slip = Output("m/s", "Slip speed along the line.")
    friction = Output("N", "Friction along the line.", role="share")
    torque = Output("N*m", "Friction torque about the line.", role="share")
    zones = Zones("on", "off")

    def prepare(given):
        """The normal force below which the contact is open."""
        return with_lift(given)

    def check(p):
        """The curve stays where it is, and is that of the resultant whichever way it goes."""
        yield from stays_in_place(p)
        if p.curve.backward is not None:
            yield (
                "curve", "backward points are given, and a line that turns slips in two directions with one friction",
                "Leave them out, or set planar_slip: off in the block effects.",
            )  # fmt: skip

    @zone("on")
    def on(p, a, b, turning, normal):
        """Against the resultant slip."""
        v, w = b.v - a.v, p.radius * turning.speed
        speed = sqrt(v**2 + w**2 + p.creep**2)
        load = load_factor(p.curve, normal / p.extent, p.lift / p.extent) if p.load_dependence == "on" else 1
        level = normal * load * p.curve.coefficient(speed) / speed
        friction, torque = level * v, p.radius * level * w
        return Law(a=-friction, b=+friction, turning=torque, slip=v, friction=friction, torque=torque,
                   dissipated=friction * v + torque * turning.speed)  # fmt: skip

    @zone("off")
    def off(p, a, b):
        """No force passes."""
        return Law(a=0, b=0, turning=0, slip=b.v - a.v)

    @guard("on", to="off", unit="N")
    def lifts(p, normal):
        """Nothing presses the surfaces together."""
        return p.lift - normal

    @guard("off", to="on", unit="N")
    def lands(p, normal):
        """Pressed again."""
        return normal - 2 * p.lift


class LaidOn(Component):
    """Turns the line that winds on a drum by `lay` for every metre wound.

        torque = bond (node.speed - lay rim.v)        inboard of `place`

    Outboard of `place` the bond fades away over `edge`. The lay of a drum or a fleet angle gives the line such a
    twist. With a lay of 0 the drum only keeps the line from turning.
    """

    node = Rotational("the line, turning about its axis")
    along = Translational("the node of the line, whose place counts")
    rim = Translational("the surface of the drum")
    place = Parameter("m", "Where the drum begins.", default=0.0)
    edge = Parameter("m", "Length over which the drum takes hold.", default=0.1, above=0.02, most=2.0)
    bond = Parameter("N*m*s/rad", "Torque per slip in turning.", default=1e5, above=0)
    lay = Parameter("rad/m", "Twist that winding gives the line, per length.", default=0.0)
    torque = Output("N*m", "Torque of the drum on the line.", role="share")
    zones = Zones("stored", "edge", "free")

    @zone("stored", "edge")
    def stored_node(p, node, along, rim, zone):
        """Turns as it is laid."""
        bond = p.bond
        if zone == "edge":
            u = 2 * (along.x - p.place) / p.edge
            bond = p.bond * exp(-8 * (1 + sqrt(2) * u / sqrt(1 + u**2)))
        slip = node.speed - p.lay * rim.v
        torque = bond * slip
        return Law(node=torque, along=0, rim=-p.lay * torque, torque=torque, dissipated=torque * slip)

    @zone("free")
    def free(p, node, along, rim):
        """On its way."""
        return Law(node=0, along=0, rim=0)

    @guard("stored", to="edge", unit="m")
    def nears(p, along):
        """Close to where the drum ends."""
        return along.x - p.place + p.edge / 2

    @guard("edge", to="stored", unit="m")
    def lies(p, along):
        """Well on the drum."""
        return p.place - p.edge / 2 - along.x

    @guard("edge", to="free", unit="m")
    def leaves(p, along):
        """Off the drum."""
        return along.x - p.place - p.edge / 2

    @guard("free", to="edge", unit="m")
    def arrives(p, along):
        """Back at the drum."""
        return p.place + p.edge / 2 - along.x
