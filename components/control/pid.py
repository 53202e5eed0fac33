"""A PID controller with limits and anti-windup, ideal or sampled."""

from fairlead.component import (
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
    zone,
)  # fmt: skip

NONE = 1e300  # where there is no limit
SHARE = 0.1  # of the derivative time that its filter takes when none is given


class PidLaw(Component, abstract=True):
    """Half-model: what both forms are given.

    D acts on the value measured, not on the error, so that a step of the reference is no blow.
    """

    asked_with = {"low": -1.0, "high": 1.0}  # or no random motion would find the limits
    reference = Input("1", "Value wanted.", signed=True)
    measured = Input("1", "Value measured.", signed=True)
    ahead = Input("1", "What else is fed forward.", 0.0, signed=True)
    gain = Parameter("1", "K_p, command per error, in SI of both.", default=1.0)
    integral_time = Parameter("s", "T_i; no integral when not given.", default=None, above=0)
    derivative_time = Parameter("s", "T_d; no derivative when not given.", default=None, above=0)
    filter_time = Parameter("s", "T_f of the derivative; a tenth of T_d when not given.", default=None, above=0)
    ahead_gain = Parameter("1", "k_a, command per `ahead`.", default=1.0)
    low = Parameter("1", "Smallest command; no limit when not given.", default=None)
    high = Parameter("1", "Largest command; no limit when not given.", default=None)
    tracking_time = Parameter("s", "T_t of the anti-windup; half of T_i when not given.", default=None, above=0)
    initial = Parameter(
        "1", "Value measured before the start, for the derivative.", default=0.0, physics=False, like="measured"
    )
    command = Output("1", "Command.")
    error = Output("1", "Reference less measured value.")
    integral = Output("1", "I, what the integral has gathered.", role="integral")
    filtered = Output("1", "Value measured, filtered; the derivative is taken from what it lacks.")

    def check(p):
        """There is something between the limits, and a filter has something to filter."""
        if p.most <= p.least:
            yield "high", f"high {p.most:g} is not above low {p.least:g}", "Raise it."
        if p.filter_time is not None and p.derivative_time is None:
            yield "filter_time", "filter_time is given without derivative_time", "Give both, or neither."

    @derived
    def least(p):
        """Smallest command."""
        return -NONE if p.low is None else p.low

    @derived
    def most(p):
        """Largest command."""
        return NONE if p.high is None else p.high

    @derived
    def integral_rate(p):
        """K_p/T_i [1/s]."""
        return 0.0 if p.integral_time is None else p.gain / p.integral_time

    @derived
    def tracking_rate(p):
        """1/T_t [1/s]."""
        if p.integral_time is None:
            return 0.0
        return 2 / p.integral_time if p.tracking_time is None else 1 / p.tracking_time

    @derived
    def filtering(p):
        """T_f [s]."""
        return SHARE * (p.derivative_time or 1.0) if p.filter_time is None else p.filter_time

    @derived
    def derivative_gain(p):
        """K_p T_d [s]."""
        return p.gain * (p.derivative_time or 0.0)


class IdealPid(PidLaw):
    """wanted = K_p e + I + D + k_a ahead,  dI/dt = K_p/T_i e + (u - wanted)/T_t,  u = clip(wanted), at once.

    D = -K_p T_d (y - s)/T_f,  ds/dt = (y - s)/T_f, with y the value measured.
    """

    summed = State("1", "I.", nominal=0.1)
    slow = State("1", "Value measured, filtered.", start="initial", nominal=0.1)
    zones = Zones("within", "above", "below")

    @zone("within", "above", "below")
    def controlling(p, reference, measured, ahead, summed, slow, zone):
        """What is wanted is limited; what that leaves out is taken from the integral."""
        error, wanted = reference - measured, ideal(p, reference, measured, ahead, summed, slow)
        command = {"above": p.most, "below": p.least}.get(zone, wanted)
        gathered = p.integral_rate * error + p.tracking_rate * (command - wanted)
        change = (measured - slow) / p.filtering
        return Law(summed=gathered, slow=change, command=command, error=error, integral=summed, filtered=slow)

    @guard("*", to="above", unit="1")
    def rises_above(p, reference, measured, ahead, summed, slow):
        """More than the largest command is wanted."""
        return None if p.high is None else ideal(p, reference, measured, ahead, summed, slow) - p.high

    @guard("*", to="below", unit="1")
    def falls_below(p, reference, measured, ahead, summed, slow):
        """Less than the smallest is wanted."""
        return None if p.low is None else p.low - ideal(p, reference, measured, ahead, summed, slow)

    @guard("above", to="within", unit="1")
    def comes_down(p, reference, measured, ahead, summed, slow):
        """Within the limits again."""
        return p.most - ideal(p, reference, measured, ahead, summed, slow)

    @guard("below", to="within", unit="1")
    def comes_up(p, reference, measured, ahead, summed, slow):
        """Within the limits again."""
        return ideal(p, reference, measured, ahead, summed, slow) - p.least


def ideal(p, reference, measured, ahead, summed, slow):
    """The command before it is limited."""
    rate = (measured - slow) / p.filtering
    return p.gain * (reference - measured) + summed - p.derivative_gain * rate + p.ahead_gain * ahead


class Pid(PidLaw):
    """A PID controller with limits and anti-windup, sampled or ideal; D acts on the value measured.

    wanted = K_p e + I + D + k_a ahead,  u = clip(wanted), every `period` T_s, and held in between.

    I += T_s (K_p/T_i e + (u - wanted)/T_t),  D = -K_p T_d (y - s)/(T_f + T_s),  s += T_s/(T_f + T_s) (y - s).
    `effects: {sampling: off}` makes it ideal: continuous, at once.

    Source: docs/physics.md, 5.7; Astrom and Hagglund 2006, Advanced PID Control (filtered derivative,
    back-calculation). Limits: numbers are not rounded as those of a processor are, and a sample takes no time.
    """

    sampling = Effect("The controller works in samples; off: continuously and at once.", off=IdealPid)
    period = Parameter("s", "T_s.", default=0.01, above=0)
    summed = Discrete("1", "I.")
    slow = Discrete("1", "Value measured, filtered.", start="initial")
    applied = Discrete("1", "Command.")
    used = Discrete("1", "Error that the command was computed from.")

    def law(p, applied, used, summed, slow):
        """Held between samples."""
        return Law(command=applied, error=used, integral=summed, filtered=slow)

    @sampled(every="period")
    def sample(p, reference, measured, ahead, summed, slow):
        """One sample."""
        error, later = reference - measured, p.filtering + p.period
        change = (measured - slow) / later
        wanted = p.gain * error + summed - p.derivative_gain * change + p.ahead_gain * ahead
        command = clip(wanted, p.least, p.most)
        gathered = p.integral_rate * error + p.tracking_rate * (command - wanted)
        return Law(summed=summed + p.period * gathered, slow=slow + p.period * change, applied=command, used=error)
