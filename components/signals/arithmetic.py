"""Signals multiplied, and the larger, the smaller and the size of signals."""

from fairlead.component import Choice, Component, Input, Law, Output, Parameter, Zones, guard, zone


class SignalProduct(Component):
    """signal = gain a b;  an input that nothing is connected to counts 1.

    Source: Product of the Modelica Standard Library. Limits: two inputs.
    """

    a = Input("1", "First factor.", 1.0, signed=True)
    b = Input("1", "Second factor.", 1.0, signed=True)
    gain = Parameter("1", "Factor, in SI of all.", default=1.0)
    signal = Output("1", "The product.")

    def law(p, a, b):
        """At once."""
        return Law(signal=p.gain * a * b)


class SignalSelect(Component):
    """The larger of two signals, or the smaller:  `pick: greatest` or `least`. Which one passes is a zone.

    signal = max(a, b), or min(a, b).  Source: Min and Max of the Modelica Standard Library. Limits: two inputs; take
    two of them for three.
    """

    exempt = {"odd": "The larger of two signals reversed is the smaller one."}
    a = Input("1", "One signal.", signed=True)
    b = Input("1", "The other.", signed=True)
    pick = Choice(("greatest", "least"), "Which one passes.", default="greatest")
    signal = Output("1", "The one that passes.", like="a")
    zones = Zones("a_passes", "b_passes")
    saturates_in = {"a": ("b_passes",), "b": ("a_passes",)}

    @zone("a_passes")
    def first(p, a, b):
        """The first one."""
        return Law(signal=a)

    @zone("b_passes")
    def second(p, a, b):
        """The other one."""
        return Law(signal=b)

    @guard("a_passes", to="b_passes", unit="1")
    def b_takes_over(p, a, b):
        """B is ahead."""
        return b - a if p.pick == "greatest" else a - b

    @guard("b_passes", to="a_passes", unit="1")
    def a_takes_over(p, a, b):
        """A is ahead."""
        return a - b if p.pick == "greatest" else b - a


class SignalSize(Component):
    """signal = |value|;  the corner at zero is a change of zone, not rounded.

    Source: Abs of the Modelica Standard Library. Limits: it has a corner, at which a step ends.
    """

    value = Input("1", "What comes in.", signed=True)
    signal = Output("1", "Its size.", like="value")
    zones = Zones("positive", "negative", forward=["positive"], backward=["negative"])
    exempt = {"odd": "The size of a signal is even."}

    @zone("positive", "negative")
    def sized(p, value, direction):
        """The value or its opposite."""
        return Law(signal=direction * value)

    @guard("positive", to="negative", unit="1", mirrored="rises_through_zero")
    def falls_through_zero(p, value, direction):
        """The sign changes."""
        return -direction * value
