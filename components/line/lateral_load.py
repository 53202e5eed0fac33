"""How hard a node of a line is pressed against what it touches.

What comes of the tension counts the arc that the node has: half the way between its neighbours as they are, however
far the line is stretched. The pieces of all nodes tile the route, so a stretched line feels no more nor less of a bend
than a stiff one. Weight goes with the line and counts the length it had at the start; clamps and tubes do so too.
"""

from fairlead.component import Component, Input, Law, Output, Parameter, Table, Translational, Zones, guard, zone


class LateralLoad(Component):
    """Normal force of a node on a curved route: tension times curvature times arc.

        force = (mean tension - heavy v^2) * curvature(s) * arc + more,   arc = (ahead.x - behind.x)/2

    The mean is over the elements on both sides (the one element at an end: `share` 1 instead of 1/2). A part of the
    tension makes the line follow the bend and does not press on it: `heavy` v^2, with the mass per length `heavy`.
    Without `heavy` there is no such term. The curvature of the route at the node's own position contains the window of
    the device, so the sum over a travelling line is constant. A negative force means that nothing presses.
    """

    flange = Translational("the node, whose position along the route counts")
    behind = Translational("the node inboard of it; itself at the inboard end")
    ahead = Translational("the node outboard of it; itself at the outboard end")
    curvature = Table("m", "1/m", "Curvature times window along the route.")
    share = Parameter("1", "Weight of each adjacent element.", default=0.5)
    heavy = Parameter("kg/m", "Mass per length that is turned; not counted when not given.", default=None, least=0)
    hose_in = Input("N", "Hose tension on the inboard side.", default=0.0)
    hose_out = Input("N", "Hose tension on the outboard side.", default=0.0)
    core_in = Input("N", "Core tension on the inboard side.", default=0.0)
    core_out = Input("N", "Core tension on the outboard side.", default=0.0)
    more = Input("N", "Further normal force.", default=0.0)
    force = Output("N", "Normal force.", role="share")

    def law(p, flange, behind, ahead, hose_in, hose_out, core_in, core_out, more):
        """A signal only; the contact makes friction of it."""
        tension = pressing(p, flange, p.share * (hose_in + hose_out + core_in + core_out))
        return Law(flange=0, behind=0, ahead=0, force=tension * p.curvature(flange.x) * arc(behind, ahead) + more)


def arc(behind, ahead):
    """The part of the route that a node stands for [m]."""
    return (ahead.x - behind.x) / 2


def pressing(p, flange, tension):
    """The part of the tension that presses on the bend [N]."""
    return tension if p.heavy is None else tension - p.heavy * flange.v**2


class RoundLoad(LateralLoad):
    """The same inside a tube, which holds the line from all sides: a line in compression rides the outer wall.

    force = |mean tension - heavy v^2| * curvature(s) * arc + more
    """

    zones = Zones("inner", "outer")

    @zone("inner", "outer")
    def law(p, flange, behind, ahead, hose_in, hose_out, core_in, core_out, more, zone):
        """The wall it rides on decides the sign."""
        wall = 1 if zone == "inner" else -1
        tension = pressing(p, flange, p.share * (hose_in + hose_out + core_in + core_out))
        load = wall * tension * p.curvature(flange.x) * arc(behind, ahead)
        return Law(flange=0, behind=0, ahead=0, force=load + more)

    @guard("inner", to="outer", unit="N")
    def is_pushed(p, flange, hose_in, hose_out, core_in, core_out):
        """Compression."""
        return -pressing(p, flange, p.share * (hose_in + hose_out + core_in + core_out))

    @guard("outer", to="inner", unit="N")
    def is_pulled(p, flange, hose_in, hose_out, core_in, core_out):
        """Tension."""
        return pressing(p, flange, p.share * (hose_in + hose_out + core_in + core_out))


class PressedLoad(Component):
    """What presses on a node whatever its tension: its weight on a guide, a tight tube.

    force = load(s) * length + more
    """

    flange = Translational("the node, whose position along the route counts")
    load = Table("m", "N/m", "Load per length times window along the route.")
    length = Parameter("m", "Length of line that belongs to the node.", above=0)
    more = Input("N", "Further normal force.", default=0.0)
    force = Output("N", "Normal force.", role="share")

    def law(p, flange, more):
        """A signal only."""
        return Law(flange=0, force=p.load(flange.x) * p.length + more)


class ClampLoad(Component):
    """What the belts of a deployer press on a node.

    force = pressing * window(s) * length + more
    """

    flange = Translational("the node, whose position along the route counts")
    window = Table("m", "1", "Share of the node that lies in the clamp, over its place.")
    length = Parameter("m", "Length of line that belongs to the node.", above=0)
    pressing = Input("N/m", "Load of the belts, per length.", default=0.0)
    more = Input("N", "Further normal force.", default=0.0)
    force = Output("N", "Normal force.", role="share")

    def law(p, flange, pressing, more):
        """A signal only."""
        return Law(flange=0, force=pressing * p.window(flange.x) * p.length + more)
