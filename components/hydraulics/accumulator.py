"""A gas-loaded accumulator."""

from fairlead.components.hydraulics.fluid import Fluid, throttled

from fairlead.component import (
    Choice,
    Component,
    Hydraulic,
    Law,
    Output,
    Parameter,
    Part,
    State,
    Zones,
    derived,
    exp,
    guard,
    log,
    pi,
    zone,
)  # fmt: skip

EDGE, CRITICAL = 0.62, 1e5  # C_d and p_cr [Pa] of the neck


class Accumulator(Component):
    """A bladder of gas, closed by a poppet when no oil is left in it.

    charged   gas volume  V = volume (precharge/p)^(1/n),  dV/dt = -Q;   flow through the neck from p_port to p
    empty     p_port <= precharge: no flow

    The gas is ideal. n = 1.4 is for fast changes (adiabatic), n = 1 for slow ones. For n = 1 write  heat: isothermal:
    the gas then keeps its temperature, and takes its heat from the air around. The state is ln(p/precharge).

    Limits: if the accumulator is empty and its port is joined to a shut valve only, no law determines the pressure
    there. Put a Volume at the port.

    Source: docs/physics.md, 5.5; Merritt 1967.
    """

    port = Hydraulic("the neck")
    volume = Parameter("m^3", "Volume of the gas at its precharge.", above=0)
    precharge = Parameter("Pa", "p_0, pressure of the gas without oil.", above=0)
    heat = Choice(("polytropic", "isothermal"), "How the gas keeps its heat.", default="polytropic")
    exponent = Parameter("1", "n, polytropic exponent; 1 of an isothermal gas.", default=1.2, above=1, most=2)
    neck = Parameter("m", "Diameter of the neck.", default=0.03, above=0)
    pressure = Parameter("Pa", "Pressure of the gas at the start; empty when not given.", default=None, above=0,
                         physics=False)  # fmt: skip
    fluid = Part(Fluid, "What fills it.", default="oil")
    log_pressure = State("1", "ln(p/p_0) of the gas.", start="logarithm", nominal=0.1)
    level = Output("Pa", "Pressure of the gas.", name="pressure")
    gas = Output("m^3", "Volume of the gas.")
    flow = Output("m^3/s", "Flow in.")
    zones = Zones("charged", "empty")

    def check(p):
        """A start below the precharge would mean less than no oil."""
        if p.pressure is not None and p.pressure < p.precharge:
            what = f"pressure {p.pressure:g} Pa is below precharge {p.precharge:g} Pa"
            yield "pressure", what, "Leave it out to start empty."

    @derived
    def logarithm(p):
        """ln(p/p_0) at the start."""
        return 0.0 if p.pressure is None else log(p.pressure / p.precharge)

    @derived
    def conductance(p):
        """Flow per root of pressure drop of the neck."""
        return p.fluid.conductance(EDGE, pi * p.neck**2 / 4)

    @zone("charged", "empty")
    def gas_law(p, port, log_pressure, zone):
        """The poppet lets nothing through when the oil is out."""
        n, level = p.exponent if p.heat == "polytropic" else 1, p.precharge * exp(log_pressure)
        drop = port.pressure - level
        flow = throttled(p.conductance, drop, CRITICAL) if zone == "charged" else 0
        rate = n * flow * exp(log_pressure / n) / p.volume
        work = log_pressure if p.heat == "isothermal" else (exp(log_pressure * (n - 1) / n) - 1) / (n - 1)
        return Law(port=flow, log_pressure=rate, pressure=level, gas=p.volume * exp(-log_pressure / n), flow=flow,
                   stored=p.precharge * p.volume * work, dissipated=flow * drop)  # fmt: skip

    @guard("charged", to="empty", unit="1")
    def runs_out(p, port, log_pressure):
        """The last oil leaves."""
        return -log_pressure, 1 - port.pressure / p.precharge

    @guard("empty", to="charged", unit="Pa")
    def opens(p, port):
        """The pressure lifts the poppet."""
        return port.pressure - p.precharge
