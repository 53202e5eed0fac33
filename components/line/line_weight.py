"""Weight of a line on a route that goes up and down."""

from fairlead.component import Component, Law, Output, Parameter, Table, Translational


class LineWeight(Component):
    """The part of a node's weight that acts along the route:  force = fall(s) * length, outboard where it goes down.

    `fall` is weight per length times the sine of the slope, times the window of every device.
    """

    node = Translational("the node")
    fall = Table("m", "N/m", "Weight per length along the route, positive where it goes down outboard.")
    length = Parameter("m", "Length of line that belongs to the node.", above=0)
    force = Output("N", "Force outboard.", role="share")

    def law(p, node):
        """The earth gives the power."""
        force = p.fall(node.x) * p.length
        return Law(node=-force, force=force, supplied=force * node.v)
