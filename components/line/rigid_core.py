"""One element of a core that does not stretch."""

from fairlead.component import Component, Law, Output, Parameter, Translational, Unknown


class RigidCore(Component):
    """Keeps its ends at a fixed distance, and carries what that takes:  b.x = a.x + length.

    What it joins is one body with one position and one speed. The tension is what the balance of each part of that body
    leaves for it, and it may push: where a core would go slack, leave it its stretch.
    """

    bears = "carried"
    a = Translational("inboard end")
    b = Translational("outboard end")
    length = Parameter("m", "Distance of its ends.", above=0)
    carried = Unknown("N", "Tension.")
    tension = Output("N", "Tension; negative when it pushes, which a run remarks.", role="pull")

    def law(p, a, b, carried):
        """One tension, whose work on one end is what it takes from the other."""
        return Law(a=-carried, b=+carried, tension=carried, stored=0, dissipated=0)

    def ties(p):
        """(a, b, ratio, offset):  b = ratio * a + offset."""
        return (("a", "b", 1.0, p.length),)
