"""Pumps whose displacement is moved: by a signal, and by the pressure of a load."""

from fairlead.component import (
    Component,
    Hydraulic,
    Input,
    Law,
    Output,
    Parameter,
    Rotational,
    State,
    Zones,
    guard,
    least,
    zone,
)  # fmt: skip


class VariablePump(Component):
    """A pump whose displacement a signal moves:  flow = setting displacement speed,  with the speed of its shaft.

    torque = setting displacement (p_out - p_in), which brakes the shaft. The setting goes from -1 (the flow turns
    round) to 1 and stays at these ends beyond them. Leakage is laminar, from side to side.

    Source: Merritt 1967. Limits: friction of the shaft and the way of the swash plate are components of their own
    (ShaftFriction, SignalLag).
    """

    exempt = {"odd": "Its setting chooses the direction."}
    inlet = Hydraulic("from the tank")
    outlet = Hydraulic("pressure side")
    shaft = Rotational("what drives it")
    setting = Input("1", "Share of the displacement, with its direction.", signed=True)
    displacement = Parameter("m^3/rad", "Oil per angle at full setting; 28 cm^3/rev is a size.", above=0)
    leakage = Parameter("m^3/s/Pa", "Conductance of the leak from side to side.", default=0.0, least=0)
    flow = Output("m^3/s", "Flow out, after leakage.")
    torque = Output("N*m", "Torque that brakes the shaft.")
    zones = Zones("within", "full", "reversed", forward=["full"], backward=["reversed"])

    @zone("within", "full", "reversed")
    def pumping(p, inlet, outlet, shaft, setting, zone):
        """Oil displaced turn by turn."""
        swept = p.displacement * {"full": 1, "reversed": -1}.get(zone, setting)
        difference = outlet.pressure - inlet.pressure
        back = p.leakage * difference
        flow, torque = swept * shaft.speed - back, swept * difference
        return Law(inlet=flow, outlet=-flow, shaft=torque, flow=flow, torque=torque, dissipated=back * difference)

    @guard("within", to="full", unit="1", mirrored="goes_beyond_backward")
    def goes_beyond(p, setting, direction):
        """More than there is."""
        return direction * setting - 1

    @guard("full", to="within", unit="1", mirrored="comes_back_forward")
    def comes_back(p, setting, direction):
        """Less than there is."""
        return 1 - direction * setting


class LoadSensingPump(Component):
    """A pump that keeps its pressure `margin` above that of the load at `sense`, and below `cut_off`.

        lag dQ/dt = most clip((target - p)/band, 0, 1) - Q,  target = least(p_sense + margin, cut_off),  p of the outlet

    So it gives the flow that the valves pass at a drop of `margin`, at any load. `sense` takes no oil.

    Source: load-sensing pump with a flow and a pressure compensator, e.g. Manring, Fales, Hydraulic Control Systems,
    2nd edition 2020, chapter 7.

    Limits: the drive speed is constant. The compensators have no dynamics except the lag.
    """

    inlet = Hydraulic("from the tank")
    outlet = Hydraulic("pressure side")
    sense = Hydraulic("pressure of the load")
    most = Parameter("m^3/s", "Full flow.", above=0)
    margin = Parameter("Pa", "Pressure kept above that of the load.", default=20e5, above=0)
    cut_off = Parameter("Pa", "Pressure at which it gives no flow.", above=0)
    band = Parameter("Pa", "Range below the target over which the flow falls from full to none.", default=4e5, above=0)
    lag = Parameter("s", "Time constant of the swash plate.", default=0.05, above=0)
    initial = Parameter("m^3/s", "Flow at the start.", default=0.0, least=0, physics=False)
    delivered = State("m^3/s", "Flow.", start="initial", nominal=1e-4)
    flow = Output("m^3/s", "Flow.")
    power = Output("W", "Hydraulic power given.")
    zones = Zones("sensing", "limiting", "full", "idle")

    @zone("sensing", "limiting", "full", "idle")
    def pumping(p, inlet, outlet, sense, delivered, zone):
        """The swash plate follows the pressures."""
        target = p.cut_off if zone == "limiting" else sense.pressure + p.margin
        wanted = {"full": 1, "idle": 0}.get(zone, (target - outlet.pressure) / p.band)
        power = delivered * (outlet.pressure - inlet.pressure)
        return Law(inlet=delivered, outlet=-delivered, sense=0, delivered=(wanted * p.most - delivered) / p.lag,
                   flow=delivered, power=power, supplied=power)  # fmt: skip

    @guard("sensing", to="limiting", unit="Pa")
    def load_is_high(p, sense):
        """The margin would lead beyond cut_off."""
        return sense.pressure + p.margin - p.cut_off

    @guard("limiting", to="sensing", unit="Pa")
    def load_is_low(p, sense):
        """The margin is there again."""
        return p.cut_off - sense.pressure - p.margin

    @guard("sensing", to="full", unit="Pa")
    def lacks_oil(p, outlet, sense):
        """The pressure leaves the band downward."""
        return lacking(p, outlet, sense)

    @guard("limiting", to="full", unit="Pa")
    def lacks_oil_at_the_limit(p, outlet, sense):
        """The same at cut_off."""
        return lacking(p, outlet, sense)

    @guard("sensing", to="idle", unit="Pa")
    def has_enough(p, outlet, sense):
        """The pressure leaves the band upward."""
        return -p.band - lacking(p, outlet, sense)

    @guard("limiting", to="idle", unit="Pa")
    def has_enough_at_the_limit(p, outlet, sense):
        """The same at cut_off."""
        return -p.band - lacking(p, outlet, sense)

    @guard("full", to="sensing", unit="Pa")
    def comes_up(p, outlet, sense):
        """The pressure enters the band from below."""
        return -lacking(p, outlet, sense)

    @guard("idle", to="sensing", unit="Pa")
    def comes_down(p, outlet, sense):
        """The pressure enters the band from above."""
        return p.band + lacking(p, outlet, sense)


def lacking(p, outlet, sense):
    """By how much the pressure is below the band [Pa]."""
    return least(sense.pressure + p.margin, p.cut_off) - p.band - outlet.pressure
