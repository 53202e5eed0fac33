"""A spring and a damper side by side."""

from fairlead.component import Component, Law, Output, Parameter, Translational


class SpringDamper(Component):
    """Kelvin-Voigt element:  tension = stiffness * stretch + damping * rate of stretch.

    The tension is positive when stretched. Source: Kelvin and Voigt, as SpringDamper of the Modelica Standard Library.
    Limits: the damping pulls while the ends part, also where nothing is stretched.
    """

    transmits = True  # in steady motion its ends move alike
    a = Translational("one end")
    b = Translational("the other end")
    stiffness = Parameter("N/m", "Tension per stretch.", above=0)
    damping = Parameter("N*s/m", "Tension per speed of separation.", default=0.0, least=0)
    free_length = Parameter("m", "Distance of the ends without tension.", default=0.0)
    tension = Output("N", "Tension; negative when compressed.")

    def law(p, a, b):
        """The spring stores, the damper dissipates."""
        stretch, speed = b.x - a.x - p.free_length, b.v - a.v
        elastic = p.stiffness * stretch
        tension = elastic + p.damping * speed
        return Law(
            a=-tension, b=+tension, tension=tension, stored=elastic * stretch / 2, dissipated=p.damping * speed**2
        )
