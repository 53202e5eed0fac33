"""Sensors between two points of a line."""

from fairlead.component import Component, Law, Output, Translational, Unknown, hold


class RelativeMotionSensor(Component):
    """Reads the position and the velocity of b relative to a; it takes no force.

    x = b.x - a.x,  v = b.v - a.v.  Source: definition. Limits: exact and without lag; see SignalLag and SampledSensor.
    """

    a = Translational("what is read from")
    b = Translational("what is read")
    x = Output("m", "b.x - a.x.")
    v = Output("m/s", "b.v - a.v.")

    def law(p, a, b):
        """Nothing is taken in."""
        return Law(a=0, b=0, x=b.x - a.x, v=b.v - a.v)


class PowerSensor(Component):
    """A rigid link that reads the power it carries from a to b; its ends keep their distance at the start.

    power = -tension b.v.  Source: definition. Limits: it is rigid, exact and without lag.
    """

    transmits = True  # in steady motion its ends move alike
    a = Translational("one end")
    b = Translational("the other end")
    carried = Unknown("N", "Tension carried.")
    power = Output("W", "Power carried from a to b: of a tension while the two move from b to a.")
    tension = Output("N", "Tension carried.")

    def law(p, a, b, carried):
        """One speed, one tension."""
        return Law(a=-carried, b=+carried, carried=hold(b.v - a.v), power=-carried * b.v, tension=carried)
