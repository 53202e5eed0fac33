"""A signal that is given from outside."""

from fairlead.component import Component, Input, Law, Output, Parameter


class SignalInput(Component):
    """A plain number that another program sets while the model runs (docs/coupling.md); it may feed any input.

    signal = what was set last.  Source: definition. Limits: it is held between two calls.
    """

    start = Parameter("1", "The number as long as none is set.", default=0.0)
    value = Input("1", "What is set; joined to nothing.", default="start", signed=True)
    signal = Output("1", "The number.")

    def law(p, value):
        """As set."""
        return Law(signal=value)
