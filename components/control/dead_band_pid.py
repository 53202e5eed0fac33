"""A controller that rests while its error is small."""

from fairlead.components.control.pid import Pid
from fairlead.components.control.sum import Sum
from fairlead.components.signals.limits import DeadBand

from fairlead.component import Component, Composite, Effect, Expansion, Input, Law, Output, Parameter

HANDED_ON = (
    "gain", "integral_time", "derivative_time", "filter_time", "ahead_gain", "low", "high", "tracking_time", "initial",
    "period",
)  # fmt: skip
OF_PID = Pid.declaration.parameters


class ErrorSeen(Component):
    """error = reference - measured, and the value measured, for what hears part of the error alone."""

    reference = Input("1", "Value wanted.", signed=True)
    measured = Input("1", "Value measured.", signed=True)
    error = Output("1", "Reference less measured value.")
    seen = Output("1", "Value measured.")

    def law(p, reference, measured):
        """A difference."""
        return Law(error=reference - measured, seen=measured)


class DeadBandPid(Composite):
    """A PID controller (see `Pid`) that rests while the error is small.

    The error is e = reference - measured. The controller begins to act when |e| is above `band`, and rests when |e| is
    below `inner`. It acts on the whole error. While it rests P is zero, I keeps its value, and D continues to act. Use
    it for a control whose integral would hunt because of stiction.

    Source: T. Kuphaldt, Lessons in Industrial Instrumentation (a dead band against cycling behind a valve's stiction).

    Limits: the measured value ends within `inner` to `band` of the reference, not on it. The command jumps by K_p e
    when it begins to rest or to act, and is constant in between if nothing moves. A part that integrates the command
    itself, as a valve and a cylinder do, would drift on the value that I keeps: leave the integral out there. A
    reference that steps at the instant of a sample is heard at the next one, since a sample is from before a switch.
    """

    reference = Input("1", "Value wanted.", signed=True)
    measured = Input("1", "Value measured.", signed=True)
    ahead = Input("1", "Feed-forward input, added to the command times `ahead_gain`.", 0.0, signed=True)
    band = Parameter("1", "Size of the error above which it acts.", above=0, like="measured")
    inner = Parameter(
        "1", "Size below which it rests again; half the band when not given.", default=None, above=0, like="measured"
    )
    gain, integral_time = OF_PID["gain"], OF_PID["integral_time"]
    derivative_time, filter_time = OF_PID["derivative_time"], OF_PID["filter_time"]
    ahead_gain, low, high = OF_PID["ahead_gain"], OF_PID["low"], OF_PID["high"]
    tracking_time, initial, period = OF_PID["tracking_time"], OF_PID["initial"], OF_PID["period"]
    sampling = Effect("The controller works in samples; off: continuously and at once.")
    command = Output("1", "Command.")
    error = Output("1", "Reference less measured value.")
    heard = Output("1", "The error on which it acts; 0 while it rests.")
    integral = Output("1", "I, what the integral has gathered.")

    def check(p):
        """As its parts."""
        yield from DeadBand.check(p)
        if p.low is not None and p.high is not None and p.high <= p.low:
            yield "high", f"high {p.high:g} is not above low {p.low:g}", "Raise it."
        if p.filter_time is not None and p.derivative_time is None:
            yield "filter_time", "filter_time is given without derivative_time", "Give both, or neither."

    def expand(p, scene):
        """The error, the band, and a PID that is given what is left."""
        given = {name: getattr(p, name) for name in HANDED_ON if getattr(p, name) is not None}
        edge = {} if p.inner is None else {"inner": p.inner}
        children = {
            "whole": scene.make(ErrorSeen),
            "rest": scene.make(DeadBand, band=p.band, **edge),
            "left": scene.make(Sum),
            "pid": scene.make(Pid, sampling=p.sampling, **given),
        }
        joins = [
            ("whole.error", "rest.value"), ("rest.signal", "left.a"), ("whole.seen", "left.b"),
            ("left.signal", "pid.reference"), ("whole.seen", "pid.measured"),
        ]  # fmt: skip
        shown = {
            "reference": "whole.reference", "measured": "whole.measured", "ahead": "pid.ahead",
            "command": "pid.command", "error": "whole.error", "heard": "rest.signal", "integral": "pid.integral",
        }  # fmt: skip
        return Expansion(children, joins, {}, shown)
