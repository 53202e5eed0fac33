"""A pressure by a signal."""

from fairlead.component import Component, Hydraulic, Input, Law, Output, Parameter


class PressureActuator(Component):
    """Keeps its port at the pressure that a signal says, but for what flows:  flow = conductance (wanted - pressure).

    An ideal pressure source whose pressure is given in time is this one with a SignalSource.

    Limits: it gives any flow, and takes it back.
    """

    port = Hydraulic("the outlet")
    wanted = Input("Pa", "Pressure, absolute.")
    conductance = Parameter("m^3/s/Pa", "Flow per pressure that is missing.", default=1e-8, above=0)
    flow = Output("m^3/s", "Flow given.")
    power = Output("W", "Hydraulic power given.")

    def law(p, port, wanted):
        """What is missing flows."""
        missing = wanted - port.pressure
        flow = p.conductance * missing
        return Law(port=-flow, flow=flow, power=flow * port.pressure, supplied=flow * wanted, dissipated=flow * missing)
