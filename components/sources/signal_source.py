"""A signal given in time."""

from fairlead.component import Component, Law, Output, Waveform


class SignalSource(Component):
    """A plain number that varies with time; it may feed any input, and counts there in SI.

    signal = value(t).  Source: docs/netlist.md, Quantities that vary with time. Limits: a plain number; sources of
    forces and motions take quantities.
    """

    value = Waveform("1", "Value in time.")
    signal = Output("1", "The value.")

    def law(p, t):
        """As given."""
        return Law(signal=p.value(t))
