"""A rotating body."""

from fairlead.component import Component, Law, Output, Parameter, Rotational


class Inertia(Component):
    """A body that turns about a fixed axis:  torque = inertia * angular acceleration.

    The torque is positive forward. Source: Euler's second law. Limits: a fixed axis; no imbalance.
    """

    shaft = Rotational("the body itself")
    moment = Parameter("kg*m^2", "Moment of inertia about the axis.", above=0)
    angle = Parameter("rad", "Angle at the start.", default=None, physics=False)
    speed = Parameter("rad/s", "Angular speed at the start.", default=None, physics=False)
    turned = Output("rad", "Angle.", name="angle")
    rate = Output("rad/s", "Angular speed.", name="speed")

    def law(p, shaft):
        """Inertia is not a flow of this law but an entry of the mass matrix, see `inertia`."""
        return Law(shaft=0, angle=shaft.angle, speed=shaft.speed, stored=p.moment * shaft.speed**2 / 2)

    def inertia(p):
        """Moment of inertia at the shaft [kg m^2]."""
        return {"shaft": p.moment}

    def start(p):
        """Angle and speed at the start, where given."""
        return {"shaft": (p.angle, p.speed)}
