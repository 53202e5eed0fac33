"""A pendulum on a shaft."""

from fairlead.component import Component, Law, Output, Parameter, Rotational, cos, sin

GRAVITY = 9.80665  # m/s^2, standard acceleration of free fall (CGPM 1901)


class Pendulum(Component):
    """A mass on a rigid arm that turns in a vertical plane:  (I + m l^2) alpha = -m g l sin(angle - hanging).

    Small swings have the angular frequency sqrt(m g l/(I + m l^2)). `load` is the torque of gravity on the shaft.

    Source: the physical pendulum, e.g. Meriam and Kraige, Engineering Mechanics: Dynamics. Limits: the pivot stands,
    and the arm is rigid.
    """

    shaft = Rotational("the axis")
    mass = Parameter("kg", "m, at the end of the arm.", above=0)
    arm = Parameter("m", "l, from the axis to the mass.", above=0)
    moment = Parameter("kg*m^2", "I, of what turns beside it.", default=0.0, least=0)
    hanging = Parameter("rad", "Angle of the shaft at which the mass hangs down.", default=0.0)
    angle = Parameter("rad", "Angle at the start.", default=None, physics=False)
    speed = Parameter("rad/s", "Angular speed at the start.", default=None, physics=False)
    turned = Output("rad", "Angle.", name="angle")
    rate = Output("rad/s", "Angular speed.", name="speed")
    load = Output("N*m", "Torque of gravity on the shaft.")

    def law(p, shaft):
        """Gravity pulls it to where it hangs down."""
        weight, lean = p.mass * GRAVITY * p.arm, shaft.angle - p.hanging
        kinetic = (p.moment + p.mass * p.arm**2) * shaft.speed**2 / 2
        return Law(shaft=weight * sin(lean), angle=shaft.angle, speed=shaft.speed, load=-weight * sin(lean),
                   stored=kinetic + weight * (1 - cos(lean)))  # fmt: skip

    def inertia(p):
        """Moment of inertia about the axis [kg m^2]."""
        return {"shaft": p.moment + p.mass * p.arm**2}

    def start(p):
        """Angle and speed at the start, where given."""
        return {"shaft": (p.angle, p.speed)}
