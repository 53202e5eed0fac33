"""A rack and pinion; a drum and its rope, a wheel and its road."""

from fairlead.component import Component, Law, Parameter, Rotational, Translational


class Rack(Component):
    """A pinion moves a rack without loss or play:  rack.x = radius * pinion.angle + offset.

    Force on the rack times radius is the torque on the pinion. Both become one degree of freedom.

    Source: rolling without slip. Limits: no loss and no play; rolling that slips is a Clutch or a Contact.
    """

    pinion = Rotational("the shaft")
    rack = Translational("what it moves")
    radius = Parameter("m", "Pitch radius.", above=0)
    offset = Parameter("m", "Position of the rack at angle zero.", default=0.0)

    def law(p):
        """Nothing is added; the motion of one is that of the other."""
        return Law()

    def ties(p):
        """(a, b, ratio, offset):  b = ratio * a + offset."""
        return (("pinion", "rack", p.radius, p.offset),)
