"""An ideal gear."""

from fairlead.component import Component, Law, Parameter, Rotational


class Gear(Component):
    """Two shafts turn in a fixed ratio:  b.angle = ratio * a.angle; torques in the inverse ratio, no loss.

    A negative ratio turns the other way, as a pair of spur gears does. What is geared becomes one degree of
    freedom, in which inertias count with the ratio squared.

    Source: Shigley's Mechanical Engineering Design. Limits: teeth do not give, play or lose; see LossyGear, Backlash.
    """

    a = Rotational("driving shaft")
    b = Rotational("driven shaft")
    ratio = Parameter("1", "Turns of b for one turn of a; not zero.")

    def law(p):
        """Nothing is added; the motion of one shaft is that of the other."""
        return Law()

    def ties(p):
        """(a, b, ratio, offset):  b = ratio * a + offset."""
        return (("a", "b", p.ratio, 0.0),)

    def check(p):
        """A ratio of zero would hold b for ever."""
        if p.ratio == 0:
            yield "ratio", "ratio is zero", "Hold a shaft with a prescribed motion instead."
