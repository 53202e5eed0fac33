"""A torsion spring with a damper."""

from fairlead.component import Component, Law, Output, Parameter, Rotational


class TorsionSpring(Component):
    """A shaft that twists:  torque = stiffness * (b.angle - a.angle - rest) + damping * (b.speed - a.speed).

    Source: Saint-Venant's torsion, with damping in proportion. Limits: no inertia and no waves along the shaft; put
    Inertia and TorsionSpring in turn.
    """

    transmits = True  # in steady motion its ends move alike
    a = Rotational("one end")
    b = Rotational("the other end")
    stiffness = Parameter("N*m/rad", "Torque per twist.", above=0)
    damping = Parameter("N*m*s/rad", "Torque per rate of twist.", default=0.0, least=0)
    rest = Parameter("rad", "Twist without torque.", default=0.0)
    torque = Output("N*m", "Torque that turns b back.")
    twist = Output("rad", "Angle of b over a, less that at rest.")

    def law(p, a, b):
        """The spring stores, the damper dissipates."""
        twist, rate = b.angle - a.angle - p.rest, b.speed - a.speed
        elastic = p.stiffness * twist
        torque = elastic + p.damping * rate
        return Law(a=-torque, b=torque, torque=torque, twist=twist, stored=elastic * twist / 2,
                   dissipated=p.damping * rate**2)  # fmt: skip
