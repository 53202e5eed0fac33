"""A sensor of force."""

from fairlead.component import Component, Law, Output, Translational, Unknown, hold


class ForceSensor(Component):
    """A rigid link that reads the tension it carries; its ends keep their distance at the start.

    A link whose ends move together would be merged away, so the tension is an unknown of its own and
    the link holds its ends to one speed.

    tension = what keeps b.v = a.v.  Source: definition. Limits: it is rigid, exact and without lag; see SignalLag and
    SampledSensor.
    """

    transmits = True  # in steady motion its ends move alike
    a = Translational("one end")
    b = Translational("the other end")
    carried = Unknown("N", "Tension carried.")
    tension = Output("N", "Tension carried.")

    def law(p, a, b, carried):
        """One speed, one tension."""
        return Law(a=-carried, b=+carried, carried=hold(b.v - a.v), tension=carried)
