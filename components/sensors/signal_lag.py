"""A sensor that takes its time."""

from fairlead.component import Component, Effect, Input, Law, Output, Parameter, State


class PerfectSignal(Component):
    """Tells what it reads."""

    value = Input("1", "Measured quantity.", signed=True)
    signal = Output("1", "Reading of the sensor.", like="value")

    def law(p, value):
        """At once."""
        return Law(signal=value)


class SignalLag(Component):
    """A sensor with a lag:  lag d(signal)/dt = value - signal.

    Source: FirstOrder of the Modelica Standard Library. Limits: one time constant; a TransferFunction has more.
    """

    passes = "value"
    value = Input("1", "Measured quantity.", signed=True)
    sensor_lag = Effect("The sensor takes its time.", off=PerfectSignal)
    lag = Parameter("s", "Time constant.", above=0)
    initial = Parameter("1", "Reading at the start.", default=0.0, like="value")
    told = State("1", "Reading of the sensor.", start="initial", nominal=0.1)
    signal = Output("1", "Reading of the sensor.", like="value")

    def law(p, value, told):
        """First order."""
        return Law(told=(value - told) / p.lag, signal=told)
