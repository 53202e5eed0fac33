"""Signals in samples: held, and told later."""

from fairlead.component import Component, Controller, Count, Discrete, Input, Law, Output, Parameter, sampled


class SampleHold(Component):
    """signal = the value at the last sample, one every `period`.

    Source: a zero-order hold, as Sampler of the Modelica Standard Library. Limits: the first sample is taken at the
    start.
    """

    value = Input("1", "What is sampled.", signed=True)
    period = Parameter("s", "Time between samples.", above=0)
    kept = Discrete("1", "The value at the last sample.")
    signal = Output("1", "What is held.", like="value")

    def law(p, kept):
        """Held between samples."""
        return Law(signal=kept)

    @sampled(every="period")
    def sample(p, value):
        """One sample."""
        return Law(kept=value)


class SignalDelay(Controller):
    """signal = the value `samples` samples ago, one every `period`:  a delay of samples period, as of a bus.

    Before the first value has come through it is `initial`.

    Source: UnitDelay of the Modelica Standard Library, `samples` of them in a row. Limits: a delay that is no multiple
    of a period is not there.
    """

    value = Input("1", "What comes in.", signed=True)
    samples = Count("Delay in samples.", default=1)
    initial = Parameter(
        "1", "Signal before the first value has come through.", default=0.0, physics=False, like="value"
    )
    signal = Output("1", "Output signal.", start="initial", like="value")

    def begin(self):
        """Nothing is under way."""
        self.under_way = [self.initial] * self.samples

    def sample(self, value):
        """One comes in, one goes out."""
        self.under_way.append(value)
        return self.under_way.pop(0)
