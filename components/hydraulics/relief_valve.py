"""A pressure relief valve."""

from fairlead.component import Component, Hydraulic, Law, Output, Parameter, State, Zones, derived, guard, sqrt, zone

CRITICAL, SHARE = 1e5, 0.05  # Pa, and of the setting; drop below which the open valve passes less than in proportion


class ReliefValve(Component):
    """Opens above a pressure difference:  Q = slope * lift,  lag d(lift)/dt = max(0, p_a - p_b - setting) - lift.

    At a steady flow the pressure is  setting + Q/slope, or up to 0.13 % of Q/slope more. It never drives a flow: Q goes
    to zero with p_a - p_b, below a twentieth of the setting (below 1 bar if that is less).

    Source: docs/physics.md, 5.5. Limits: the poppet has a lag and no mass, so the valve does not chatter; its flow
    grows in proportion to the lift.
    """

    a = Hydraulic("the line it protects")
    b = Hydraulic("to the tank")
    setting = Parameter("Pa", "Difference at which it opens.", above=0)
    slope = Parameter("m^3/s/Pa", "Flow per pressure above the setting.", above=0)
    lag = Parameter("s", "Time constant of the poppet.", default=0.01, above=0)
    raised = State("Pa", "Pressure above the setting that the poppet has followed.", least=0.0)
    flow = Output("m^3/s", "Flow from a to b.")
    lift = Output("Pa", "Pressure above the setting that the poppet has followed.")
    loss = Output("W", "What becomes heat, flow times drop; it may feed a HeatActuator.")
    zones = Zones("closed", "open")

    @derived
    def critical(p):
        """Drop below which less flows than in proportion to the lift."""
        return min(CRITICAL, SHARE * p.setting)

    @zone("closed", "open")
    def poppet(p, a, b, raised, zone):
        """The poppet follows the pressure above the setting."""
        drop = a.pressure - b.pressure
        wanted = drop - p.setting if zone == "open" else 0
        flow = p.slope * raised * drop / sqrt(drop**2 + p.critical**2)
        return Law(a=flow, b=-flow, raised=(wanted - raised) / p.lag, flow=flow, lift=raised, loss=flow * drop,
                   dissipated=flow * drop)  # fmt: skip

    @guard("closed", to="open", unit="Pa")
    def opens(p, a, b):
        """Above the setting."""
        return a.pressure - b.pressure - p.setting

    @guard("open", to="closed", unit="Pa")
    def closes(p, a, b):
        """Below the setting."""
        return p.setting - a.pressure + b.pressure
