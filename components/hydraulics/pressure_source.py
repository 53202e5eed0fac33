"""Constant pressures: an ideal supply, and a tank."""

from fairlead.component import Component, Hydraulic, Law, Output, Parameter


class PressureSource(Component):
    """Keeps its port at a pressure, at any flow.

    port.pressure = pressure,  and `flow` is what goes out.  Source: definition. Limits: it gives any flow, and takes it
    back.
    """

    port = Hydraulic("the outlet")
    pressure = Parameter("Pa", "Pressure, absolute.", least=0)
    flow = Output("m^3/s", "Flow given.")
    level = Output("Pa", "Pressure.", name="pressure")
    power = Output("W", "Hydraulic power given.")

    def law(p, port):
        """The flow is known when all others are; what it gives is supplied."""
        power = port.flow * port.pressure
        return Law(port=0, flow=port.flow, pressure=port.pressure, power=power, supplied=power)

    def prescribes():
        """The pressure does not change."""
        return {"port": None}

    def start(p):
        """The pressure."""
        return {"port": p.pressure}


class Tank(PressureSource):
    """An open tank: constant pressure, by default that of the air. It takes whatever comes back.

    port.pressure = pressure,  and `flow` is what goes out: below zero what comes back.  Source: definition. Limits: its
    level does not change, and it is never empty.
    """

    pressure = Parameter("Pa", "Pressure, absolute.", default=1e5, least=0)
