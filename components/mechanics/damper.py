"""A linear damper."""

from fairlead.component import Component, Law, Output, Parameter, Translational


class Damper(Component):
    """Linear viscous damper:  tension = damping * (b.v - a.v).

    The tension is positive while the ends part. Source: Newton's law of viscosity, as Damper of the Modelica Standard
    Library. Limits: it pushes and pulls, at any speed.
    """

    a = Translational("one end")
    b = Translational("the other end")
    damping = Parameter("N*s/m", "Tension per speed of separation.", least=0)
    tension = Output("N", "Tension; positive while the ends separate.")

    def law(p, a, b):
        """All the power that goes in is dissipated."""
        speed = b.v - a.v
        tension = p.damping * speed
        return Law(a=-tension, b=+tension, tension=tension, dissipated=tension * speed)
