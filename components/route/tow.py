"""What the sea does to a line: drag on a node, and the pull at its end."""

from fairlead.component import (
    Component,
    Input,
    Law,
    Output,
    Parameter,
    Table,
    Translational,
    Waveform,
    Zones,
    guard,
    sqrt,
    zone,
)  # fmt: skip

STILL = 1e-3  # m/s; |u| is rounded off here, so that the drag of 4 m/s is 3e-8 of itself too large


class Tow(Component):
    """The speed of the ship through the water, in time."""

    speed = Waveform("m/s", "Speed of the ship through the water.", default=0.0)
    through_water = Output("m/s", "Speed of the ship through the water.")

    def law(p, t):
        """A signal."""
        return Law(through_water=p.speed(t))


def drag(area, flow):
    """Area |u| u [N] for a drag area with 1/2 rho in it [kg/m]; |u| is sqrt(u^2 + STILL^2)."""
    return area * sqrt(flow**2 + STILL**2) * flow


class SeaDrag(Component):
    """Tangential drag on the piece of line that a node stands for.

    drag = per_length length W(x) |u| u,   u = speed - v,   W the share of the piece that is in the water
    """

    node = Translational("the node")
    window = Table("m", "1", "Share of the node in the water, over its place.")
    per_length = Parameter("kg/m^2", "1/2 rho C_t pi d.", least=0)
    length = Parameter("m", "Length of line that belongs to the node.", above=0)
    speed = Input("m/s", "Speed of the ship through the water.", default=0.0)
    drag = Output("N", "Drag, positive outboard.", role="share")

    def law(p, node, speed):
        """The water takes what the line does against it; towing it through the water gives power."""
        flow = speed - node.v
        force = drag(p.per_length * p.length, flow) * p.window(node.x)
        return Law(node=-force, drag=force, supplied=force * speed, dissipated=force * flow)


class Towed(Component, abstract=True):
    """Half-model of what pulls at the outboard end of a line in the sea."""

    node = Translational("the outboard end")
    tail = Parameter("N", "Steady pull.", default=0.0, least=0)
    drogue = Parameter("kg/m", "1/2 rho C_D A.", default=0.0, least=0)
    speed = Input("m/s", "Speed of the ship through the water.", default=0.0)
    pull = Output("N", "Pull, positive outboard.")
    drag = Output("N", "The part of it that is drag.")


def towed(p, node, speed, area):
    """Law of a steady pull, which is given, and of a drag area with 1/2 rho in it [kg/m], whose drag is the water's."""
    flow = speed - node.v
    force = drag(area, flow)
    supplied = force * speed + p.tail * node.v
    return Law(node=-(force + p.tail), pull=force + p.tail, drag=force, supplied=supplied, dissipated=force * flow)


class TailEnd(Towed):
    """A steady pull and a drogue at the outboard end:  pull = tail + drogue |u| u,  u = speed - v."""

    def law(p, node, speed):
        """The drogue is in the water, wherever the end is."""
        return towed(p, node, speed, p.drogue)


class LumpedEnd(Towed):
    """A tail end that also has the drag of all line in the water.

    pull = tail + (drogue + per_length L) |u| u,   u = speed - v,   L = x - dry, and none while the end is inboard of it
    """

    per_length = Parameter("kg/m^2", "1/2 rho C_t pi d of the line.", least=0)
    dry = Parameter("m", "Place of the end at which no line is in the water.", default=0.0)
    zones = Zones("in_water", "out")

    @zone("in_water", "out")
    def both(p, node, speed, zone):
        """The line that has been paid out beyond the place where it would be dry."""
        length = node.x - p.dry if zone == "in_water" else 0
        return towed(p, node, speed, p.drogue + p.per_length * length)

    @guard("in_water", to="out", unit="m")
    def leaves(p, node):
        """The last of it is hauled out."""
        return p.dry - node.x

    @guard("out", to="in_water", unit="m")
    def enters(p, node):
        """The end comes to the water."""
        return node.x - p.dry
