"""A sensor of motion."""

from fairlead.component import Component, Law, Output, Translational


class MotionSensor(Component):
    """Reads position, velocity and acceleration of a flange and takes no force.

    Source: definition. Limits: exact and without lag; see SignalLag and SampledSensor.
    """

    flange = Translational("the point observed")
    x = Output("m", "Position.")
    v = Output("m/s", "Velocity.")
    a = Output("m/s^2", "Acceleration.")

    def law(p, flange):
        """Nothing is taken in."""
        return Law(flange=0, x=flange.x, v=flange.v, a=flange.a)
