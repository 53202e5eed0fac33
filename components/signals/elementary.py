"""What is reckoned with signals beside sums and products: quotients, elementary functions, places not to be missed."""

from fairlead.component import (
    Choice,
    Component,
    Input,
    Law,
    Output,
    Parameter,
    Zones,
    cos,
    exp,
    guard,
    log,
    sin,
    sqrt,
    zone,
)  # fmt: skip

CURVES = {"sin": sin, "cos": cos, "exp": exp, "log": log, "sqrt": sqrt}


class SignalQuotient(Component):
    """signal = gain a/b;  an input that nothing is connected to counts 1.

    Limits: b must not come to zero, where there is no quotient.

    Source: Division of the Modelica Standard Library.
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


class SignalMark(Component):
    """signal = value, and a step ends where the value goes through zero.

    What is made of the value may be narrow there, as exp(-value^2) is: a step that begins and ends beside it sees
    nothing of it. Or it is one of several conditions, and for a short time all of them hold.

    Source: docs/integrator.md, Narrow features. Limits: it marks zero only; subtract a level before it.
    """

    value = Input("1", "What comes in.", signed=True)
    signal = Output("1", "The same.")
    zones = Zones("above", "below", forward=["above"], backward=["below"])

    @zone("above", "below")
    def told(p, value):
        """The value, on either side."""
        return Law(signal=value)

    @guard("above", to="below", unit="1", mirrored="rises_through_zero")
    def falls_through_zero(p, value, direction):
        """It goes through zero."""
        return -direction * value
