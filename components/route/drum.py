"""A drum whose radius follows what is wound on it, and the bond of a stored line with a drum."""

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
    Zones,
    exp,
    guard,
    sqrt,
    zone,
)  # fmt: skip

FADES = 24.0  # e-foldings over the edge: at its end the bond is 4e-11 of full strength, 0.04 N s/m


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


class Bond(Component, abstract=True):
    """What holds a node while it lies on the drum, inboard of `place`: a damper so strong that nothing slips.

    stored    force = lock slip
    edge      force = lock exp(-12 (1 + w)) slip,  w = sqrt(2) u/sqrt(1 + u^2) from -1 to 1,  u = 2 (x - place)/edge
    free      nothing

    A node is let go of, and taken hold of, without a jump. At full strength 1 kN slips 1 um/s, so that the strain
    of what is stored stays as it was wound on. In long runs what is deep on the drum counts as part of the drum.
    """

    node = Translational("the node")
    place = Parameter("m", "Where the drum begins; it stores what is inboard.", default=0.0)
    edge = Parameter("m", "Length over which the drum takes hold.", default=0.1, above=0.02, most=2.0)
    lock = Parameter("N*s/m", "Bond at full strength.", default=1e9, above=0)
    zones = Zones("stored", "edge", "free")

    @guard("stored", to="edge", unit="m")
    def nears(p, node):
        """Close to where the drum ends."""
        return node.x - p.place + p.edge / 2

    @guard("edge", to="stored", unit="m")
    def lies(p, node):
        """Well on the drum."""
        return p.place - p.edge / 2 - node.x

    @guard("edge", to="free", unit="m")
    def leaves(p, node):
        """Off the drum."""
        return node.x - p.place - p.edge / 2

    @guard("free", to="edge", unit="m")
    def arrives(p, node):
        """Back at the drum."""
        return p.place + p.edge / 2 - node.x


def strength(p, node, zone):
    """Damping of the bond in a zone [N s/m]."""
    if zone != "edge":
        return p.lock
    u = 2 * (node.x - p.place) / p.edge
    return p.lock * exp(-FADES / 2 * (1 + sqrt(2) * u / sqrt(1 + u**2)))


class StoredNode(Bond):
    """The bond of a node with the rim of a drum."""

    rim = Translational("the surface of the drum")
    carried = Carries("node", by="rim", zone="stored")

    @zone("stored", "edge")
    def on_drum(p, rim, node, zone):
        """Moves with the rim."""
        slip = node.v - rim.v
        force = strength(p, node, zone) * slip
        return Law(rim=-force, node=+force, dissipated=force * slip)

    @zone("free")
    def free(p, rim, node):
        """On its way."""
        return Law(rim=0, node=0)


class WoundNode(Bond):
    """The bond with a drum that has layers: the node moves with radius times the speed of the drum."""

    drum = Rotational("the drum")
    radius = Input("m", "Radius of the line that comes off.", default=1.0)
    carried = Carries("node", by="drum", zone="stored")

    @zone("stored", "edge")
    def on_drum(p, drum, node, radius, zone):
        """The force acts on the drum at the radius."""
        slip = node.v - radius * drum.speed
        force = strength(p, node, zone) * slip
        return Law(drum=-radius * force, node=+force, dissipated=force * slip)

    @zone("free")
    def free(p, drum, node):
        """On its way."""
        return Law(drum=0, node=0)
