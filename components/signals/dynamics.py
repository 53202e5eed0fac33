"""Signals with a memory: an integral, a filtered derivative, an oscillation of second order."""

from fairlead.component import Component, Input, Law, Output, Parameter, State, Zones, guard, least, zone

HALF = 0.5  # above it a signal counts as on
ROOM = 1e-6
"""Share of a limit, and of 0.1, by which a signal that rests there may be short of it. It came to rest within 1e-9,
what a guard is known to; chosen is a thousand times that, so that the two never send to each other."""


class Integrator(Component):
    """d(signal)/dt = gain value, from `initial` on, and at rest at a limit while the value would lead beyond it.

    Without limits it is free. Limits hold the signal where it met them (no windup); it leaves at once when the value
    changes its sign, or once the limit is moved away from it.

    While `reset` is above 1/2 nothing is integrated: the signal returns to `initial`, and what is left of the way falls
    as exp(-t/return_time). It begins there anew when `reset` goes off. Limits: the impulse of an impact may carry it
    beyond `low` or `high`, and then it stays there; a reset that is on for less than ten return times is not finished.

    Source: Integrator and LimIntegrator of the Modelica Standard Library, whose reset is at once.
    """

    exempt = {"zones_reached returning": "Only what is connected to `reset` leads there."}
    asked_with = {"low": -1.0, "high": 1.0}
    value = Input("1", "What is integrated.", signed=True)
    reset = Input("1", "Above 1/2 the signal returns to `initial`.", 0.0, signed=True)
    gain = Parameter("1/s", "Rate per value, in SI of both; not zero.", default=1.0)
    initial = Parameter("1", "Signal at the start.", default=0.0, physics=False)
    low = Parameter("1", "Smallest signal; no limit when not given.", default=None)
    high = Parameter("1", "Largest signal; no limit when not given.", default=None)
    return_time = Parameter("s", "Time constant with which a reset takes the signal back.", default=1e-4, above=0)
    gathered = State("1", "The integral.", start="initial", nominal=0.1)
    signal = Output("1", "The integral.")
    zones = Zones("free", "full", "empty", "returning")

    def check(p):
        """It begins between its limits, and has somewhere to go."""
        if p.gain == 0:
            yield "gain", "gain is zero", "Without a rate the signal is a constant: take a SignalSource."
        if p.low is not None and p.high is not None and p.high <= p.low:
            yield "high", f"high {p.high:g} is not above low {p.low:g}", "Raise it."
        if (p.high is not None and p.initial > p.high) or (p.low is not None and p.initial < p.low):
            yield "initial", f"initial {p.initial:g} is beyond the limits", "Begin between low and high."

    @zone("free")
    def gathering(p, value, gathered):
        """At the rate of the value."""
        return Law(gathered=p.gain * value, signal=gathered)

    @zone("full", "empty")
    def at_limit(p, gathered):
        """It stays."""
        return Law(gathered=0, signal=gathered)

    @zone("returning")
    def goes_back(p, gathered):
        """Back to where it began."""
        return Law(gathered=(p.initial - gathered) / p.return_time, signal=gathered)

    @guard("free", to="full", unit="1")
    def fills(p, value, gathered):
        """The largest signal is met, and the value leads on."""
        return None if p.high is None else least(gathered - p.high, p.gain * value)

    @guard("free", to="empty", unit="1")
    def empties(p, value, gathered):
        """The smallest is met, and the value leads on."""
        return None if p.low is None else least(p.low - gathered, -p.gain * value)

    @guard("full", to="free", unit="1/s")
    def comes_down(p, value):
        """The value leads back."""
        return -p.gain * value

    @guard("empty", to="free", unit="1/s")
    def comes_up(p, value):
        """The value leads back."""
        return p.gain * value

    @guard("full", to="free", unit="1")
    def has_room_above(p, gathered):
        """The limit was raised while the signal was there."""
        return None if p.high is None else p.high - gathered - ROOM * (abs(p.high) + 0.1)

    @guard("empty", to="free", unit="1")
    def has_room_below(p, gathered):
        """The limit was lowered while the signal was there."""
        return None if p.low is None else gathered - p.low - ROOM * (abs(p.low) + 0.1)

    @guard("free", "full", "empty", to="returning", unit="1")
    def is_reset(p, reset):
        """Told to begin anew."""
        return reset - HALF

    @guard("returning", to="free", unit="1")
    def goes_on(p, reset):
        """Told to go on."""
        return HALF - reset


class FilteredDerivative(Component):
    """signal = (value - s)/lag,  ds/dt = the same:  the rate of a signal, filtered with a lag of first order.

    Source: Derivative of the Modelica Standard Library. Limits: what is faster than the lag comes out smaller; a jump
    gives a peak of jump/lag.
    """

    value = Input("1", "What is differentiated.", signed=True)
    lag = Parameter("s", "Time constant of the filter.", above=0)
    initial = Parameter("1", "Value before the start.", default=0.0, physics=False, like="value")
    slow = State("1", "The value, filtered.", start="initial", nominal=0.1)
    signal = Output("1/s", "The rate.")
    filtered = Output("1", "The value, filtered.")

    def law(p, value, slow):
        """First order."""
        return Law(slow=(value - slow) / p.lag, signal=(value - slow) / p.lag, filtered=slow)


class SecondOrder(Component):
    """signal'' = omega^2 (gain value - signal) - 2 damping omega signal':  an oscillation, or a filter.

    Source: SecondOrder of the Modelica Standard Library. Limits: from rest at `initial`; complex filters are a
    TransferFunction or a StateSpace.
    """

    value = Input("1", "What comes in.", signed=True)
    gain = Parameter("1", "Steady signal per value, in SI of both.", default=1.0)
    omega = Parameter("rad/s", "Angular frequency without damping.", above=0)
    damping = Parameter("1", "Damping ratio; 1 is critical.", default=1.0, least=0)
    initial = Parameter("1", "Signal at the start.", default=0.0, physics=False)
    told = State("1", "The signal.", start="initial", nominal=0.1)
    rate = State("1/s", "Its rate.", nominal=1.0)
    signal = Output("1", "Output signal.")
    slope = Output("1/s", "Its rate.")

    def law(p, value, told, rate):
        """Spring and damper of a unit mass."""
        return Law(told=rate, rate=p.omega**2 * (p.gain * value - told) - 2 * p.damping * p.omega * rate,
                   signal=told, slope=rate)  # fmt: skip
