"""Line far out in the sea that moves as one body with its outboard end."""

from fairlead.components.route.bond import Bond, strength

from fairlead.component import Carries, Law, Translational, shared, zone


class FarNode(Bond):
    """The bond of a node outboard of `place` with the outboard end of its line.

    Everything out there has the speed of the end: it has the inertia and the drag of the line, and no waves. Strain
    stays as it was when the node went in, and comes back with it.
    """

    end = Translational("the outboard end of the line")
    carried = Carries("node", by="end", zone="stored")

    @shared
    def depth(p, node):
        """How far out the node is [m]."""
        return node.x - p.place

    @zone("stored", "edge")
    def moves_with_the_end(p, end, node, depth, zone):
        """No slip, but as the edge takes hold."""
        slip = node.v - end.v
        force = strength(p, depth, zone) * slip
        return Law(end=-force, node=+force, dissipated=force * slip)

    @zone("free")
    def free(p, end, node):
        """By itself."""
        return Law(end=0, node=0)
