"""A fixed point."""

from fairlead.component import Component, Law, Output, Parameter, Translational


class Ground(Component):
    """A point that never moves; it takes any force.

    flange.v = 0, wherever that is.  Source: definition. Limits: it does not move; what moves as given is a
    MotionSource.
    """

    flange = Translational("the fixed point")

    def law(p, flange):
        """Nothing to add; the motion is prescribed."""
        return (0,)

    def prescribes():
        """Position, velocity and acceleration of the flange: zero."""
        return {"flange": None}


class FixedPoint(Component):
    """A fixed point at `position`; it takes any force.

    flange.x = position.  Source: definition. Limits: it does not move; what moves as given is a MotionSource.
    """

    flange = Translational("the fixed point")
    position = Parameter("m", "Position of the point.", physics=False)
    x = Output("m", "Position.")
    v = Output("m/s", "Velocity: none.")
    a = Output("m/s^2", "Acceleration: none.")

    def law(p, flange):
        """Nothing to add; the motion is prescribed."""
        return Law(flange=0, x=p.position, v=0, a=0, supplied=flange.force * flange.v)

    def prescribes():
        """Names of the outputs that are the position, velocity and acceleration of the flange."""
        return {"flange": ("x", "v", "a")}
