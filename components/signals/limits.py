"""Signals that end at limits, and that are not heard within a band."""

from fairlead.component import Component, Input, Law, Output, Parameter, Zones, derived, guard, zone


class Limiter(Component):
    """signal = value, but not below `low` nor above `high`; at a limit it is in a zone of its own.

    Source: Limiter of the Modelica Standard Library. Limits: the limits are constants; SignalSelect takes one that
    moves.
    """

    asked_with = {"low": -1.0, "high": 1.0}
    value = Input("1", "What comes in.", signed=True)
    low = Parameter("1", "Smallest value.", like="value")
    high = Parameter("1", "Largest value.", like="value")
    signal = Output("1", "The value within its limits.", like="value")
    zones = Zones("within", "above", "below")
    saturates_in = ("above", "below")

    def check(p):
        """There is something between the limits."""
        if p.high <= p.low:
            yield "high", f"high {p.high:g} is not above low {p.low:g}", "Raise it."

    @zone("within", "above", "below")
    def limited(p, value, zone):
        """The value, or the limit it has passed."""
        return Law(signal={"above": p.high, "below": p.low}.get(zone, value))

    @guard("*", to="above", unit="1")
    def rises_above(p, value):
        """Beyond the largest value."""
        return value - p.high

    @guard("*", to="below", unit="1")
    def falls_below(p, value):
        """Below the smallest."""
        return p.low - value

    @guard("above", to="within", unit="1")
    def comes_down(p, value):
        """Within the limits again."""
        return p.high - value

    @guard("below", to="within", unit="1")
    def comes_up(p, value):
        """Within the limits again."""
        return value - p.low


class DeadZone(Component):
    """signal = 0 while |value| is below `band`, and gain (|value| - band) with the sign of the value beyond.

    Source: DeadZone of the Modelica Standard Library. Limits: the same on both sides; shift the value before it.
    """

    value = Input("1", "What comes in.", signed=True)
    band = Parameter("1", "Half the width that is not heard.", above=0, like="value")
    gain = Parameter("1", "Factor beyond the band, in SI of both.", default=1.0)
    signal = Output("1", "What is heard.")
    zones = Zones("silent", "above", "below", forward=["above"], backward=["below"])

    @zone("silent")
    def unheard(p, value):
        """Nothing."""
        return Law(signal=0)

    @zone("above", "below")
    def heard(p, value, direction):
        """What is beyond the band."""
        return Law(signal=p.gain * (value - direction * p.band))

    @guard("silent", to="above", unit="1", mirrored="leaves_below")
    def leaves_above(p, value, direction):
        """Beyond the band."""
        return direction * value - p.band

    @guard("above", to="silent", unit="1", mirrored="comes_back_from_below")
    def comes_back(p, value, direction):
        """Within the band."""
        return p.band - direction * value


class DeadBand(Component):
    """signal = value once |value| has risen above `band`, and 0 once it has fallen below `inner` again.

    Between `inner` and `band` the signal stays what it was. A DeadZone passes what exceeds its limit; a DeadBand
    passes the whole value, so its signal jumps. Put it before the error of a control to let the control rest while the
    error is small.

    Source: a dead band of controllers that rest. Limits: its signal jumps, so a loop over it may oscillate about the
    band.
    """

    asked_with = {"inner": 0.2, "band": 0.5}
    value = Input("1", "What comes in.", signed=True)
    band = Parameter("1", "Size of the value from which on it is heard.", above=0, like="value")
    inner = Parameter(
        "1", "Size below which it is lost again; half the band when not given.", default=None, above=0, like="value"
    )
    signal = Output("1", "What is heard.", like="value")
    zones = Zones("silent", "above", "below", forward=["above"], backward=["below"])

    def check(p):
        """It is lost below where it is heard."""
        if p.inner is not None and p.inner >= p.band:
            yield "inner", f"inner {p.inner:g} is not below band = {p.band:g}", "Lower it."

    @derived
    def lost(p):
        """Size below which the value is lost."""
        return p.band / 2 if p.inner is None else p.inner

    @zone("silent")
    def unheard(p, value):
        """Nothing."""
        return Law(signal=0)

    @zone("above", "below")
    def heard(p, value):
        """All of it."""
        return Law(signal=value)

    @guard("silent", to="above", unit="1", mirrored="leaves_below")
    def leaves_above(p, value, direction):
        """Beyond the band."""
        return direction * value - p.band

    @guard("above", to="silent", unit="1", mirrored="comes_back_from_below")
    def comes_back(p, value, direction):
        """Well within the band."""
        return p.lost - direction * value
