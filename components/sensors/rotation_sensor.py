"""Sensors of turning."""

from fairlead.component import Component, Law, Output, Rotational, Unknown, hold


class RotationSensor(Component):
    """Reads angle, speed and acceleration of a shaft and takes no torque.

    Source: definition. Limits: exact and without lag; see SignalLag and SampledSensor.
    """

    shaft = Rotational("the shaft observed")
    angle = Output("rad", "Angle.")
    speed = Output("rad/s", "Angular speed.")
    acceleration = Output("rad/s^2", "Angular acceleration.")

    def law(p, shaft):
        """Nothing is taken in."""
        return Law(shaft=0, angle=shaft.angle, speed=shaft.speed, acceleration=shaft.acceleration)


class RelativeRotationSensor(Component):
    """Reads the angle and the speed of b relative to a; it takes no torque.

    angle = b.angle - a.angle,  speed = b.speed - a.speed.  Source: definition. Limits: exact and without lag.
    """

    a = Rotational("what is read from")
    b = Rotational("what is read")
    angle = Output("rad", "b.angle - a.angle.")
    speed = Output("rad/s", "b.speed - a.speed.")

    def law(p, a, b):
        """Nothing is taken in."""
        return Law(a=0, b=0, angle=b.angle - a.angle, speed=b.speed - a.speed)


class RotationalPowerSensor(Component):
    """A rigid coupling that reads the power it carries from a to b; its ends keep their angle to each other.

    power = torque b.speed,  the torque that turns b forward.  Source: definition. Limits: it is rigid, exact and
    without lag.
    """

    transmits = True  # in steady motion its ends move alike
    a = Rotational("one end")
    b = Rotational("the other end")
    carried = Unknown("N*m", "Torque carried from a to b.")
    power = Output("W", "Power carried from a to b.")
    torque = Output("N*m", "Torque carried from a to b; positive turns b forward.")

    def law(p, a, b, carried):
        """One speed, one torque."""
        return Law(
            a=carried, b=-carried, carried=hold(b.speed - a.speed), power=carried * b.speed, torque=carried,
            dissipated=carried * (a.speed - b.speed),
        )  # fmt: skip
