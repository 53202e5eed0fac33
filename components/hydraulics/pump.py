"""Pumps at constant drive speed."""

from fairlead.component import Component, Hydraulic, Law, Output, Parameter, State, Zones, guard, zone


class FixedPump(Component):
    """Gives a constant flow at any pressure; a relief valve must take the flow that is not used.

    outlet.flow = -flow, as the flow goes out there; power = flow (p_outlet - p_inlet).  Source: Merritt 1967. Limits:
    no leakage, no shaft (a HydraulicMotor turned from outside has one), and any pressure is overcome.
    """

    inlet = Hydraulic("from the tank")
    outlet = Hydraulic("pressure side")
    flow = Parameter("m^3/s", "Flow.", least=0)
    power = Output("W", "Hydraulic power given.")

    def law(p, inlet, outlet):
        """The drive of the pump supplies what the pressure takes."""
        power = p.flow * (outlet.pressure - inlet.pressure)
        return Law(inlet=p.flow, outlet=-p.flow, power=power, supplied=power)


class PressurePump(Component):
    """Pressure-compensated pump: full flow up to cut_off - band, none from cut_off on, with a lag.

    lag dQ/dt = clip((cut_off - p)/band, 0, 1) * most - Q,  p the pressure of the outlet

    Source: docs/physics.md, 5.5. Limits: no shaft, no leakage; the swash plate has a lag and no other dynamics.
    """

    inlet = Hydraulic("from the tank")
    outlet = Hydraulic("pressure side")
    most = Parameter("m^3/s", "Full flow.", above=0)
    cut_off = Parameter("Pa", "Pressure at which it gives no flow.", above=0)
    band = Parameter("Pa", "Range below cut_off over which the flow falls from full to none.", default=10e5, above=0)
    lag = Parameter("s", "Time constant of the swash plate.", default=0.05, above=0)
    initial = Parameter("m^3/s", "Flow at the start.", default=0.0, least=0)
    delivered = State("m^3/s", "Flow.", start="initial", nominal=1e-4)
    flow = Output("m^3/s", "Flow.")
    power = Output("W", "Hydraulic power given.")
    zones = Zones("regulating", "full", "idle")

    @zone("regulating", "full", "idle")
    def pumping(p, inlet, outlet, delivered, zone):
        """The swash plate follows the pressure."""
        wanted = {"full": 1, "idle": 0}.get(zone, (p.cut_off - outlet.pressure) / p.band)
        power = delivered * (outlet.pressure - inlet.pressure)
        return Law(inlet=delivered, outlet=-delivered, delivered=(wanted * p.most - delivered) / p.lag, flow=delivered,
                   power=power, supplied=power)  # fmt: skip

    @guard("regulating", to="full", unit="Pa")
    def falls(p, outlet):
        """The pressure leaves the band downward."""
        return p.cut_off - p.band - outlet.pressure

    @guard("regulating", to="idle", unit="Pa")
    def rises(p, outlet):
        """The pressure leaves the band upward."""
        return outlet.pressure - p.cut_off

    @guard("full", to="regulating", unit="Pa")
    def comes_up(p, outlet):
        """The pressure enters the band from below."""
        return outlet.pressure - (p.cut_off - p.band)

    @guard("idle", to="regulating", unit="Pa")
    def comes_down(p, outlet):
        """The pressure enters the band from above."""
        return p.cut_off - outlet.pressure
