"""A linear spring."""

from fairlead.component import Component, Law, Output, Parameter, Translational


class Spring(Component):
    """Linear spring:  tension = stiffness * (b.x - a.x - free_length).

    The tension is positive when stretched. Source: Hooke's law. Limits: it may push and pull; it has no mass and no
    damping.
    """

    transmits = True  # in steady motion its ends move alike
    a = Translational("one end")
    b = Translational("the other end, at larger x when the spring is stretched")
    stiffness = Parameter("N/m", "Tension per stretch.", above=0)
    free_length = Parameter("m", "Distance of the ends without tension.", default=0.0)
    tension = Output("N", "Tension; negative when compressed.")
    stretch = Output("m", "Distance of the ends less the free length.")

    def law(p, a, b):
        """Hooke's law; the energy is that of the stretch."""
        stretch = b.x - a.x - p.free_length
        tension = p.stiffness * stretch
        return Law(a=-tension, b=+tension, tension=tension, stretch=stretch, stored=tension * stretch / 2)
