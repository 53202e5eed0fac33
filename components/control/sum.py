"""Signals added up."""

from fairlead.component import Component, Input, Law, Output, Parameter


class Sum(Component):
    """Up to four signals added, each times its gain; an input that nothing is connected to counts 0.

    signal = gain_a a + gain_b b + gain_c c + gain_d d + offset. A difference is `gain_b: -1`.

    Source: Add of the Modelica Standard Library. Limits: four inputs; take two of them for more.
    """

    a = Input("1", "First summand.", 0.0, signed=True)
    b = Input("1", "Second summand.", 0.0, signed=True)
    c = Input("1", "Third summand.", 0.0, signed=True)
    d = Input("1", "Fourth summand.", 0.0, signed=True)
    gain_a = Parameter("1", "Factor of a, in SI of both.", default=1.0)
    gain_b = Parameter("1", "Factor of b.", default=1.0)
    gain_c = Parameter("1", "Factor of c.", default=1.0)
    gain_d = Parameter("1", "Factor of d.", default=1.0)
    offset = Parameter("1", "What is added.", default=0.0)
    signal = Output("1", "The sum.")

    def law(p, a, b, c, d):
        """At once."""
        return Law(signal=p.gain_a * a + p.gain_b * b + p.gain_c * c + p.gain_d * d + p.offset)
