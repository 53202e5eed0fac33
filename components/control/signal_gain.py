"""A signal times a number."""

from fairlead.component import Component, Input, Law, Output, Parameter


class SignalGain(Component):
    """signal = gain * value + offset.

    Source: Gain of the Modelica Standard Library. Limits: none; a Limiter bounds a signal.
    """

    value = Input("1", "What comes in.", signed=True)
    gain = Parameter("1", "Factor, in SI of both.", default=1.0)
    offset = Parameter("1", "What is added.", default=0.0)
    signal = Output("1", "Output signal.")

    def law(p, value):
        """At once."""
        return Law(signal=p.gain * value + p.offset)
