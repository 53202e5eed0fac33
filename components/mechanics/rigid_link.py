"""A massless rigid link."""

from fairlead.component import Component, Law, Parameter, Translational


class RigidLink(Component):
    """Keeps two flanges at a fixed distance:  b.x = a.x + length.

    What is linked becomes one body with one motion, so the link costs nothing. Its own force is not known;
    a ForceSensor holds two flanges together and tells the force.

    Source: definition. Limits: it bears any force, either way.
    """

    a = Translational("one end")
    b = Translational("the other end, at larger x for a positive length")
    length = Parameter("m", "Distance of b from a.", default=0.0)

    def law(p):
        """Nothing is added; the motion of one end is that of the other."""
        return Law()

    def ties(p):
        """(a, b, ratio, offset):  b = ratio * a + offset."""
        return (("a", "b", 1.0, p.length),)
