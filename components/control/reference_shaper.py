"""A reference that changes no faster than a drive can follow."""

from fairlead.component import Component, Discrete, Input, Law, Output, Parameter, clip, least, sampled, sqrt


class ReferenceShaper(Component):
    """Follows a target with limited rate, and with limited rate of that rate where `jerk` is given; sampled.

    A speed as the target gives a trapezoid of speed with limited acceleration, or one with rounded corners. With
    jerk the rate is at most sqrt(2 jerk |what is left|), so that it has come down when the target is reached.

    Source: profiles of limited acceleration and jerk, as those of drives have them. Limits: sampled, so with jerk the
    target may be passed by up to most times period.
    """

    passes, at_most = "target", "most"  # steadily the target, on the way at most this rate
    target = Input("1", "Target of the reference.", signed=True)
    period = Parameter("s", "Time between samples.", default=0.01, above=0)
    most = Parameter("1/s", "Largest rate.", above=0)
    jerk = Parameter("1/s^2", "Largest rate of the rate; no limit when not given.", default=None, above=0)
    initial = Parameter("1", "Value at the start.", default=0.0, like="target")
    value = Discrete("1", "Value.", start="initial")
    rate = Discrete("1/s", "Its rate.")
    reference = Output("1", "The value.", like="target")
    slope = Output("1/s", "Its rate.")

    def law(p, value, rate):
        """Held between samples."""
        return Law(reference=value, slope=rate)

    @sampled(every="period")
    def sample(p, target, value, rate):
        """One step towards the target."""
        left = target - value
        most = p.most
        if p.jerk is not None:
            most = least(p.most, sqrt(2 * p.jerk * abs(left)))
        new = clip(left / p.period, -most, most)
        if p.jerk is not None:
            new = clip(new, rate - p.jerk * p.period, rate + p.jerk * p.period)
        return Law(value=value + new * p.period, rate=new)
