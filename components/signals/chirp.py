"""A sine whose frequency grows."""

from fairlead.component import Choice, Component, Law, Output, Parameter, Zones, exp, guard, log, pi, sin, zone


class SignalChirp(Component):
    """signal = offset + amplitude sin(phase(t)),  a sine whose frequency goes from `first` at 0 to `last` at `over`.

    linear        frequency = first + (last - first) t/over
    exponential   frequency = first (last/first)^(t/over): as many octaves a second

    After `over` the frequency stays at `last`. What else a signal is in time, a SignalSource tells: ramps, pulses, a
    table from a file.

    Limits: a frequency that is swept fast is never steady; a step has to be short beside its last period.
    """

    amplitude = Parameter("1", "Amplitude of the sine, in the SI unit of the input that it feeds.", default=1.0)
    offset = Parameter("1", "What is added.", default=0.0)
    first = Parameter("1/s", "Frequency at the start.", above=0)
    last = Parameter("1/s", "Frequency at `over`; another one than the first.", above=0)
    over = Parameter("s", "Time in which the frequency changes.", above=0)
    sweep = Choice(("linear", "exponential"), "How the frequency changes.", default="linear")
    signal = Output("1", "The signal.")
    frequency = Output("1/s", "Frequency now.")
    zones = Zones("sweeping", "swept")

    def check(p):
        """A sweep goes somewhere."""
        if p.first == p.last:
            yield "last", f"last is the same frequency as first, {p.first:g} Hz", "Take a SignalSource with a sine."

    @zone("sweeping", "swept")
    def sweeping(p, t, zone):
        """The phase is the integral of the frequency."""
        swept = t if zone == "sweeping" else p.over
        if p.sweep == "linear":
            slope = (p.last - p.first) / p.over
            turns, frequency = p.first * swept + slope * swept**2 / 2, p.first + slope * swept
        else:
            rate = log(p.last / p.first) / p.over
            frequency = p.first * exp(rate * swept)
            turns = (frequency - p.first) / rate
        turns = turns + p.last * (t - swept)
        return Law(signal=p.offset + p.amplitude * sin(2 * pi * turns), frequency=frequency)

    @guard("sweeping", to="swept", unit="s")
    def ends(p, t):
        """The frequency is the last."""
        return t - p.over
