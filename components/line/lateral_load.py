"""How hard a node of a line is pressed against what it touches in a bend."""

from fairlead.component import Component, Input, Law, Output, Parameter, Table, Translational


class LateralLoad(Component):
    """Normal force of a node on a curved route: tension times curvature times length.

    force = mean tension * curvature(s) * length

    The mean is over the elements on both sides (the one element at an end: `share` 1 instead of 1/2). The
    curvature of the route at the node's own position contains the window of the device, so that the sum
    over a travelling line is constant. A negative force means that nothing presses.
    """

    flange = Translational("the node, whose position along the route counts")
    curvature = Table("m", "1/m", "Curvature times window along the route.")
    length = Parameter("m", "Length of line that belongs to the node.", above=0)
    share = Parameter("1", "Weight of each adjacent element.", default=0.5)
    hose_in = Input("N", "Hose tension on the inboard side.", default=0.0)
    hose_out = Input("N", "Hose tension on the outboard side.", default=0.0)
    core_in = Input("N", "Core tension on the inboard side.", default=0.0)
    core_out = Input("N", "Core tension on the outboard side.", default=0.0)
    force = Output("N", "Normal force.")

    def law(p, flange, hose_in, hose_out, core_in, core_out):
        """A signal only; the contact makes friction of it."""
        tension = p.share * (hose_in + hose_out + core_in + core_out)
        return Law(flange=0, force=tension * p.curvature(flange.x) * p.length)
