"""Logic of signals that are 0 or 1: gates, and what counts and times their edges in samples."""

from fairlead.component import (
    Choice,
    Component,
    Discrete,
    Input,
    Law,
    Output,
    Parameter,
    Zones,
    exceeds,
    guard,
    sampled,
    zone,
)  # fmt: skip

HALF = 0.5  # above it a signal counts as on
ROOM = 1e-6  # of a period: sums of periods are rounded
HOLDS = {"and": ("both",), "or": ("a_alone", "b_alone", "both"), "xor": ("a_alone", "b_alone")}  # by gate: the zones


def a_is_on(p, a):
    """The signal a is above the level."""
    return a - p.level


def a_is_off(p, a):
    """The signal a is below the level."""
    return p.level - a


def b_is_on(p, b):
    """The signal b is above the level."""
    return b - p.level


def b_is_off(p, b):
    """The signal b is below the level."""
    return p.level - b


class LogicGate(Component):
    """signal = 1 while `gate` holds of a and b, else 0; a signal is on above `level`, and `inverse` is 1 - signal.

    and: both are on.  or: one at least.  xor: one alone. A `not` is the inverse of a signal joined to both. Its zone
    says which of the two are on, so what is on for a short time together is not missed.

    Source: And, Or and Xor of the Modelica Standard Library. Limits: two inputs; a StateMachine takes conditions over
    more.
    """

    exempt = {"odd": "On and off are not symmetric."}
    asked_with = {"level": 0.01}  # or random signals would hardly both be on
    a = Input("1", "One signal.", signed=True)
    b = Input("1", "The other.", signed=True)
    gate = Choice(("and", "or", "xor"), "What must hold.")
    level = Parameter("1", "Above it a signal is on.", default=0.5, like="a")
    signal = Output("1", "1 while it holds.")
    inverse = Output("1", "1 while it does not.")
    zones = Zones("neither", "a_alone", "b_alone", "both")

    @zone("neither", "a_alone", "b_alone", "both")
    def told(p, zone):
        """Which of the two are on, and whether that is what the gate asks."""
        on = 1.0 if zone in HOLDS[p.gate] else 0.0
        return Law(signal=on, inverse=1.0 - on)

    a_comes_on = guard("neither", to="a_alone", unit="1")(a_is_on)
    a_comes_on_too = guard("b_alone", to="both", unit="1")(a_is_on)
    a_goes_off = guard("a_alone", to="neither", unit="1")(a_is_off)
    a_leaves_b = guard("both", to="b_alone", unit="1")(a_is_off)
    b_comes_on = guard("neither", to="b_alone", unit="1")(b_is_on)
    b_comes_on_too = guard("a_alone", to="both", unit="1")(b_is_on)
    b_goes_off = guard("b_alone", to="neither", unit="1")(b_is_off)
    b_leaves_a = guard("both", to="a_alone", unit="1")(b_is_off)


class SignalEdge(Component):
    """signal = 1 for one sample after value has come on (above 1/2), or gone off, since the last; it counts them too.

    What is shorter than a `period` is not seen, as in a controller that scans its inputs. `reset` above 1/2 sets the
    count to zero and keeps it there.

    Source: rising and falling edges of IEC 61131-3 (R_TRIG, F_TRIG, CTU). Limits: sampled; a step of the count is late
    by up to a period.
    """

    value = Input("1", "What is watched.", signed=True)
    reset = Input("1", "Above 1/2 the count is zero.", 0.0, signed=True)
    edge = Choice(("rising", "falling", "both"), "Which edges.", default="rising")
    period = Parameter("s", "Time between samples.", default=0.01, above=0)
    was = Discrete("1", "1 if it was on at the last sample.")
    found = Discrete("1", "1 if an edge was found.")
    edges = Discrete("1", "Edges counted.")
    signal = Output("1", "1 for the sample at which an edge is found.")
    count = Output("1", "Edges since the start or the last reset.")
    last = Output("1", "1 if the value was on at the last sample.")

    def law(p, was, found, edges):
        """Held between samples."""
        return Law(signal=found, count=edges, last=was)

    @sampled(every="period")
    def sample(p, value, reset, was, edges):
        """Compare with the last sample."""
        on = exceeds(value, HALF)
        rises, falls = on * (1 - was), was * (1 - on)
        new = {"rising": rises, "falling": falls}.get(p.edge, rises + falls)
        return Law(was=on, found=new, edges=(1 - exceeds(reset, HALF)) * (edges + new))


class SignalTimer(Component):
    """elapsed = the time for which value has been on (above 1/2); signal = 1 once that is `delay`. In samples.

    It begins anew when the value goes off: a delay on making, as a timer relay has it. `keep: on` keeps what has
    elapsed, which `reset` alone sets to zero: a meter of hours.

    Source: the timer TON of IEC 61131-3. Limits: sampled, so times are multiples of the period.
    """

    value = Input("1", "What is timed.", signed=True)
    reset = Input("1", "Above 1/2 what has elapsed is zero.", 0.0, signed=True)
    delay = Parameter("s", "Time after which the signal comes on.", default=0.0, least=0)
    keep = Choice(("off", "on"), "Whether what has elapsed is kept while the value is off.", default="off")
    period = Parameter("s", "Time between samples.", default=0.01, above=0)
    lasted = Discrete("s", "Time for which it has been on.")
    was = Discrete("1", "1 if it was on at the last sample.")
    done = Discrete("1", "1 when the delay is over.")
    elapsed = Output("s", "Time for which it has been on.")
    last = Output("1", "1 if it was on at the last sample.")
    signal = Output("1", "1 when the delay is over.")

    def law(p, lasted, was, done):
        """Held between samples."""
        return Law(elapsed=lasted, last=was, signal=done)

    @sampled(every="period")
    def sample(p, value, reset, lasted, was):
        """A sample at which it was on stands for the time since; what is left for rounding is ROOM."""
        on = exceeds(value, HALF)
        cleared = 1 - exceeds(reset, HALF)
        kept = cleared * (lasted + was * p.period) * (1 if p.keep == "on" else on)
        over = exceeds(kept - p.delay + ROOM * p.period, 0.0)
        return Law(lasted=kept, was=cleared * on, done=cleared * over * (1 if p.keep == "on" else on))
