"""A drum whose radius follows what is wound on it, and the bond of a stored line with a drum."""

from fairlead.components.route.bond import Bond, strength

from fairlead.component import (
    Carries,
    Component,
    Input,
    Law,
    Output,
    Parameter,
    Rotational,
    Table,
    Translational,
    shared,
    zone,
)  # fmt: skip

OFF = 1e-3  # m; an end that lies so far outboard of a drum has come off it: who pays out just all of it keeps it


class Drum(Component):
    """Radius over the angle paid out: a signal for what is bound to the drum.

    What winds on brings its own momentum, so the balance of the drum has no term for its growing inertia.
    """

    shaft = Rotational("the drum; it turns forward when it pays out")
    radius = Table("rad", "m", "Radius of the line that comes off, over the angle paid out.")
    radius_now = Output("m", "Radius at which the line comes off.")
    line_speed = Output("m/s", "Speed of the line at the drum.")

    def law(p, shaft):
        """Takes no torque itself."""
        radius = p.radius(shaft.angle)
        return Law(shaft=0, radius_now=radius, line_speed=radius * shaft.speed)


class FastenedEnd(Component):
    """How much line lies on the drum to which its inboard end is fastened: once none does, no law says what follows."""

    node = Translational("the inboard end of the line")
    place = Parameter("m", "Where the drum begins.", default=0.0)
    lies = Output("m", "Line on the drum.")
    used_up = Output("1", "Above 1 where no line lies there.", role="used_up", of="lies")

    def law(p, node):
        """It takes nothing."""
        lies = p.place - node.x
        return Law(node=0, lies=lies, used_up=-lies / OFF - 1)


class OnDrum(Bond, abstract=True):
    """The bond with a drum, which stores what is inboard of `place`."""

    @shared
    def depth(p, node):
        """How far the node is on the drum [m]."""
        return p.place - node.x


class StoredNode(OnDrum):
    """The bond of a node with the rim of a drum."""

    rim = Translational("the surface of the drum")
    carried = Carries("node", by="rim", zone="stored")

    @zone("stored", "edge")
    def on_drum(p, rim, node, depth, zone):
        """Moves with the rim."""
        slip = node.v - rim.v
        force = strength(p, depth, zone) * slip
        return Law(rim=-force, node=+force, dissipated=force * slip)

    @zone("free")
    def free(p, rim, node):
        """On its way."""
        return Law(rim=0, node=0)


class WoundNode(OnDrum):
    """The bond with a drum that has layers: the node moves with radius times the speed of the drum."""

    drum = Rotational("the drum")
    radius = Input("m", "Radius of the line that comes off.", default=1.0)
    carried = Carries("node", by="drum", zone="stored")

    @zone("stored", "edge")
    def on_drum(p, drum, node, radius, depth, zone):
        """The force acts on the drum at the radius."""
        slip = node.v - radius * drum.speed
        force = strength(p, depth, zone) * slip
        return Law(drum=-radius * force, node=+force, dissipated=force * slip)

    @zone("free")
    def free(p, drum, node):
        """On its way."""
        return Law(drum=0, node=0)
