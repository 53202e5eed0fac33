"""What the sea does to a line: drag on a node, and the pull at its end."""

from fairlead.component import Component, Input, Law, Output, Parameter, Table, Translational, Waveform, sqrt

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


class TailEnd(Component):
    """What pulls at the outboard end of a line in the sea: a steady pull, a drogue, and drag that is lumped there.

    pull = tail + (drogue + per_length (beyond + x - start)) |u| u,   u = speed - v
    """

    node = Translational("the outboard end")
    tail = Parameter("N", "Steady pull.", default=0.0, least=0)
    drogue = Parameter("kg/m", "1/2 rho C_D A.", default=0.0, least=0)
    per_length = Parameter("kg/m^2", "1/2 rho C_t pi d of line outboard of the end.", default=0.0, least=0)
    beyond = Parameter("m", "Line outboard of the end when it is at `place`.", default=0.0, least=0)
    place = Parameter("m", "Where the end is at the start.", default=0.0)
    speed = Input("m/s", "Speed of the ship through the water.", default=0.0)
    pull = Output("N", "Pull, positive outboard.")
    drag = Output("N", "The part of it that is drag.")
    asked_with = {"beyond": 10.0, "place": 0.0}  # there is line outboard of the end, wherever it is

    def law(p, node, speed):
        """The steady pull is given, the drag is the water's."""
        flow = speed - node.v
        towed = drag(p.drogue + p.per_length * (p.beyond + node.x - p.place), flow)
        supplied = towed * speed + p.tail * node.v
        return Law(node=-(towed + p.tail), pull=towed + p.tail, drag=towed, supplied=supplied, dissipated=towed * flow)
