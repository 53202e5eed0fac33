"""Laminar leakage through a narrow gap."""

from fairlead.component import Component, Hydraulic, Law, Output, Parameter


class Leak(Component):
    """Flow in proportion to the pressure drop:  flow = conductance * (a.pressure - b.pressure).

    Source: laminar flow through a gap, Merritt 1967. Limits: the conductance does not depend on temperature or on the
    pressure that widens a gap.
    """

    a = Hydraulic("one side")
    b = Hydraulic("the other side")
    conductance = Parameter("m^3/s/Pa", "Flow per pressure drop.", least=0)
    flow = Output("m^3/s", "Flow from a to b.")
    loss = Output("W", "What becomes heat, flow times drop; it may feed a HeatActuator.")

    def law(p, a, b):
        """All of flow times drop becomes heat."""
        drop = a.pressure - b.pressure
        flow = p.conductance * drop
        return Law(a=flow, b=-flow, flow=flow, loss=flow * drop, dissipated=flow * drop)
