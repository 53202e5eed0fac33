"""A PI controller with feed-forward, limits, slew and anti-windup, sampled or continuous."""

from fairlead.component import (
    Choice,
    Component,
    Discrete,
    Effect,
    Input,
    Law,
    Output,
    Parameter,
    State,
    Zones,
    clip,
    derived,
    guard,
    sampled,
    tanh,
    zone,
)  # fmt: skip

LAG = 1e-3  # s; of a command whose rate is limited
NONE = 1e300  # where there is no limit


class Pi(Component, abstract=True):
    """Half-model: what both forms are given."""

    asked_with = {"low": -1.0, "high": 1.0}  # or no random motion would find the limits
    follows = ("reference", "measured")  # steadily the second is the first
    reference = Input("1", "Value wanted.", signed=True)
    measured = Input("1", "Value measured.", signed=True)
    ahead = Input("1", "What else is fed forward, such as the speed of a line that is held tight.", 0.0, signed=True)
    gain = Parameter("1", "K_p, command per error, in SI of both.", default=1.0)
    integral_time = Parameter("s", "T_i.", above=0)
    feed_forward = Parameter("1", "k_ff, command per reference.", default=0.0)
    ahead_gain = Parameter("1", "k_a, command per `ahead`.", default=1.0)
    low = Parameter("1", "Smallest command, -1 of a valve; no limit when not given.", default=None)
    high = Parameter("1", "Largest command, 1 of a valve; no limit when not given.", default=None)
    slew = Parameter("1/s", "Largest rate of the command; no limit when not given.", default=None, above=0)
    tracking_time = Parameter("s", "T_t of the anti-windup; half of T_i when not given.", default=None, above=0)
    command = Output("1", "Command.")
    error = Output("1", "Reference less measured value.")
    integral = Output("1", "I, which the controller has gathered.", role="integral")

    def check(p):
        """There is something between the limits."""
        if p.most <= p.least:
            yield "high", f"high {p.most:g} is not above low {p.least:g}", "Raise it."

    @derived
    def least(p):
        """Smallest command."""
        return -NONE if p.low is None else p.low

    @derived
    def most(p):
        """Largest command."""
        return NONE if p.high is None else p.high

    @derived
    def tracking(p):
        """T_t [s]."""
        return p.integral_time / 2 if p.tracking_time is None else p.tracking_time


class ContinuousPi(Pi):
    """wanted = k_ff r + k_a ahead + K_p e + I,  dI/dt = K_p/T_i e + (u - wanted)/T_t,  u = slew(clip(wanted)).

    Without `smoothing` and `slew` the command is what is wanted, at once. With either it is a state that follows
    behind; a `slew` alone takes a lag of 1 ms.
    """

    smoothing = Parameter("s", "Lag of the command; none when not given.", default=None, above=0)
    summed = State("1", "I.", nominal=0.1)
    applied = State("1", "Command.", nominal=0.1)
    zones = Zones("within", "above", "below")

    @zone("within", "above", "below")
    def controlling(p, reference, measured, ahead, summed, applied, zone):
        """What is wanted is limited; what that leaves out is taken from the integral."""
        error, wanted = reference - measured, wanted_of(p, reference, measured, ahead, summed)
        command, rate = behind(p, {"above": p.most, "below": p.least}.get(zone, wanted), applied)
        gathered = p.gain / p.integral_time * error + (command - wanted) / p.tracking
        return Law(summed=gathered, applied=rate, command=command, error=error, integral=summed)

    @guard("*", to="above", unit="1")
    def rises_above(p, reference, measured, ahead, summed):
        """More than the largest command is wanted."""
        return None if p.high is None else wanted_of(p, reference, measured, ahead, summed) - p.high

    @guard("*", to="below", unit="1")
    def falls_below(p, reference, measured, ahead, summed):
        """Less than the smallest is wanted."""
        return None if p.low is None else p.low - wanted_of(p, reference, measured, ahead, summed)

    @guard("above", to="within", unit="1")
    def comes_down(p, reference, measured, ahead, summed):
        """Within the limits again."""
        return p.most - wanted_of(p, reference, measured, ahead, summed)

    @guard("below", to="within", unit="1")
    def comes_up(p, reference, measured, ahead, summed):
        """Within the limits again."""
        return wanted_of(p, reference, measured, ahead, summed) - p.least


def behind(p, target, applied):
    """The command on its way to what is wanted within the limits, and the rate of the state that it may be."""
    if p.smoothing is None and p.slew is None:
        return target, 0
    lag = LAG if p.smoothing is None else p.smoothing
    if p.slew is None:
        return applied, (target - applied) / lag
    return applied, p.slew * tanh((target - applied) / (p.slew * lag))


def wanted_of(p, reference, measured, ahead, integral):
    """The command before it is limited."""
    return p.feed_forward * reference + p.ahead_gain * ahead + p.gain * (reference - measured) + integral


class PiController(Pi):
    """A PI controller with feed-forward, limits, slew and anti-windup, sampled or ideal.

    wanted = k_ff r + k_a ahead + K_p e + I,  u = slew(clip(wanted)),  I += T_s (K_p/T_i e + (u - wanted)/T_t).

    Every `period` T_s the command is computed and then held; I is that before the sample. `delay: sample` takes the
    value measured one sample earlier, as a processor does that needs its period to compute. Steady with a plant
    K/(T s + 1) while the eigenvalues of the map of plant, I and delayed value lie within the unit circle.

    Source: docs/physics.md, 5.7; Astrom and Hagglund 2006, Advanced PID Control (anti-windup by back-calculation).
    Limits: the integral is lagged by a sample, and numbers are not rounded as those of a processor are.
    """

    sampling = Effect("The controller works in samples; off: continuously.", off=ContinuousPi)
    period = Parameter("s", "T_s.", default=0.01, above=0)
    smoothing = Parameter("s", "Lag of the command, when it works continuously.", default=None, above=0)
    delay = Choice(("sample", "none"), "Whether the value measured is one sample old.", default="sample")
    initial = Parameter("1", "Value measured before the start.", default=0.0, like="measured")
    seen = Discrete("1", "Value measured one sample ago.", start="initial")
    summed = Discrete("1", "I.")
    applied = Discrete("1", "Command.")
    used = Discrete("1", "Error that the command was computed from.")

    def law(p, applied, used, summed):
        """Held between samples."""
        return Law(command=applied, error=used, integral=summed)

    @sampled(every="period")
    def sample(p, reference, measured, ahead, seen, summed, applied):
        """One sample."""
        value = seen if p.delay == "sample" else measured
        error, wanted = reference - value, wanted_of(p, reference, value, ahead, summed)
        command = clip(wanted, p.least, p.most)
        if p.slew is not None:
            most = p.slew * p.period
            command = clip(command, applied - most, applied + most)
        gathered = p.gain / p.integral_time * error + (command - wanted) / p.tracking
        return Law(seen=measured, summed=summed + p.period * gathered, applied=command, used=error)
