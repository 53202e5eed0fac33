"""What is reckoned with signals beside sums and products: quotients and elementary functions."""

from fairlead.component import Choice, Component, Input, Law, Output, Parameter, cos, exp, log, sin, sqrt

CURVES = {"sin": sin, "cos": cos, "exp": exp, "log": log, "sqrt": sqrt}


class SignalQuotient(Component):
    """signal = gain a/b;  an input that nothing is connected to counts 1.

    Limits: b must not come to zero, where there is no quotient.
    """

    a = Input("1", "What is divided.", 1.0, signed=True)
    b = Input("1", "What it is divided by.", 1.0)
    gain = Parameter("1", "Factor, in SI of all.", default=1.0)
    signal = Output("1", "The quotient.")

    def law(p, a, b):
        """At once."""
        return Law(signal=p.gain * a / b)


class ElementaryFunction(Component):
    """signal = curve(value):  a sine, a cosine, an exponential, a natural logarithm or a square root.

    Angles are in rad. The last two want a value above zero; at zero the slope of a root is infinite.
    """

    exempt = {"odd": "Most of these functions are not."}
    value = Input("1", "What comes in.")
    curve = Choice(tuple(CURVES), "Which function.")
    signal = Output("1", "Output signal.")

    def law(p, value):
        """At once."""
        return Law(signal=CURVES[p.curve](value))
