"""Interlocks: they stand between a reference and the drive that is to follow it."""

from fairlead.component import (
    Component,
    Discrete,
    Input,
    Law,
    Output,
    Parameter,
    exceeds,
    greatest,
    least,
    sampled,
)  # fmt: skip


class Trip(Component, abstract=True):
    """Half-model: once tripped the reference is zero for the rest of the run."""

    passes = "target"
    target = Input("1", "Reference that is to pass.", signed=True)
    period = Parameter("s", "Time between samples.", default=0.01, above=0)
    patience = Parameter("s", "How long the limit must be broken without a break.", default=0.0, least=0)
    broken_for = Discrete("s", "Time for which the limit has been broken.")
    trips = Discrete("1", "1 when tripped.")
    reference = Output("1", "The reference, or zero.")
    tripped = Output("1", "1 when tripped.")
    waiting = Output("s", "Time for which the limit has been broken.")

    def law(p, target, trips, broken_for):
        """Let the reference through, or not."""
        return Law(reference=(1 - trips) * target, tripped=trips, waiting=broken_for)


def judged(p, broken, broken_for, trips):
    """Clock and latch; `broken` is 1 while the limit is broken, and a sample stands for the time after it."""
    lasting = broken * (broken_for + p.period)
    return Law(broken_for=lasting, trips=greatest(trips, exceeds(lasting, p.patience)))


class OverTensionTrip(Trip):
    """Stops when the tension has been above a limit for longer than `patience`.

    reference = target,  and 0 for the rest of the run once  tension > limit  has lasted for `patience`.

    Source: an interlock as a controller program has it. Limits: sampled; what is shorter than a `period` is not seen.
    """

    tension = Input("N", "Tension watched, the largest of the line for instance.", signed=True)
    limit = Parameter("N", "Tension above which it trips.", above=0)

    @sampled(every="period")
    def sample(p, tension, broken_for, trips):
        """Watch."""
        return judged(p, exceeds(tension, p.limit), broken_for, trips)


class RuckTrip(Trip):
    """Stops when the hose has been compressed by more than its ruck force for longer than `patience`.

    reference = target,  and 0 for the rest of the run once  -tension > ruck_force  has lasted for `patience`.

    Source: an interlock as a controller program has it. Limits: sampled; what is shorter than a `period` is not seen.
    """

    tension = Input("N", "Tension of the hose, negative when compressed.", signed=True)
    ruck_force = Parameter("N", "Compression that rucks the hose.", above=0)
    patience = Parameter("s", "How long it must be compressed without a break.", default=0.1, least=0)

    @sampled(every="period")
    def sample(p, tension, broken_for, trips):
        """Watch."""
        return judged(p, exceeds(-tension, p.ruck_force), broken_for, trips)


class ZeroTensionHold(Component):
    """Stops paying out while the line is slack: below `low` the reference cannot be positive.

    It passes again when the tension is back above `release`. Hauling in is never held up. Sampled:
    reference = min(target, 0) while it holds, else reference = target.

    Source: an interlock as a controller program has it. Limits: what is shorter than a `period` is not seen.
    """

    passes = "target"
    target = Input("m/s", "Speed reference, pay-out positive.", signed=True)
    tension = Input("N", "Tension watched.", signed=True)
    low = Parameter("N", "Tension below which it holds.", least=0)
    release = Parameter("N", "Tension above which it lets go.", above=0)
    period = Parameter("s", "Time between samples.", default=0.01, above=0)
    holds = Discrete("1", "1 while it holds.")
    passed = Discrete("m/s", "Reference that passes.")
    reference = Output("m/s", "The reference, not positive while it holds.")
    holding = Output("1", "1 while it holds.")

    def check(p):
        """It lets go above where it takes hold."""
        if p.release <= p.low:
            yield "release", f"release {p.release:g} N is not above low {p.low:g} N", "Raise it."

    def law(p, passed, holds):
        """Held between samples."""
        return Law(reference=passed, holding=holds)

    @sampled(every="period")
    def sample(p, target, tension, holds):
        """Hysteresis between the two tensions."""
        now = greatest(exceeds(p.low, tension), holds * (1 - exceeds(tension, p.release)))
        return Law(holds=now, passed=now * least(target, 0) + (1 - now) * target)
