"""The bond of a node with what takes it along, such as a drum on which it lies."""

from fairlead.component import Component, Parameter, Translational, Zones, exp, guard, sqrt

TAKES_HOLD, SLOWEST_HOLD = 0.02, 2.0  # m; lengths over which a drum takes hold of line lie between
FADES = 24.0  # e-foldings over the edge: at its end the bond is 4e-11 of full strength, 0.04 N s/m


class Bond(Component, abstract=True):
    """What holds a node while it lies beyond `place`: a damper so strong that nothing slips.

    stored    force = lock slip
    edge      force = lock exp(-12 (1 - w)) slip,  w = sqrt(2) u/sqrt(1 + u^2) from -1 to 1,  u = 2 depth/edge
    free      nothing

    `depth` is how far beyond `place` the node is, which each kind of bond says. A node is let go of, and taken hold
    of, without a jump. At full strength 1 kN slips 1 um/s, so that the strain of what is stored stays as it was when
    it went in. In long runs what is deep inside counts as part of what carries it.
    """

    node = Translational("the node")
    place = Parameter("m", "Where the bond begins.", default=0.0)
    edge = Parameter("m", "Length over which it takes hold.", default=0.1, above=TAKES_HOLD, most=SLOWEST_HOLD)
    lock = Parameter("N*s/m", "Bond at full strength.", default=1e9, above=0)
    zones = Zones("stored", "edge", "free")

    @guard("stored", to="edge", unit="m")
    def nears(p, depth):
        """Close to where it ends."""
        return p.edge / 2 - depth

    @guard("edge", to="stored", unit="m")
    def lies(p, depth):
        """Well inside."""
        return depth - p.edge / 2

    @guard("edge", to="free", unit="m")
    def leaves(p, depth):
        """Outside."""
        return -p.edge / 2 - depth

    @guard("free", to="edge", unit="m")
    def arrives(p, depth):
        """Back at the edge."""
        return depth + p.edge / 2


def strength(p, depth, zone):
    """Damping of the bond in a zone [N s/m]."""
    if zone != "edge":
        return p.lock
    u = 2 * depth / p.edge
    return p.lock * exp(-FADES / 2 * (1 - sqrt(2) * u / sqrt(1 + u**2)))
