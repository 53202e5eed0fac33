"""A signal by a table of another."""

from fairlead.component import Component, Input, Law, Output, Table


class SignalTable(Component):
    """signal = points(value):  a characteristic in one dimension, as measured or from a data sheet.

    Source: CombiTable1D of the Modelica Standard Library. Limits: beyond its ends a table keeps its last value, unless
    it says `beyond: line`.
    """

    exempt = {"odd": "A table is what it is."}
    value = Input("1", "What comes in.", signed=True)
    points = Table("1", "1", "Value and signal, in SI of both.")
    signal = Output("1", "Output signal.")

    def law(p, value):
        """At once."""
        return Law(signal=p.points(value))
