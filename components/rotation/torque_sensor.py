"""A sensor of torque."""

from fairlead.component import Component, Law, Output, Rotational, Unknown, hold


class TorqueSensor(Component):
    """A rigid coupling that reads the torque it carries; its ends keep their angle to each other.

    A coupling whose ends move together would be merged away, so the torque is an unknown and the ends are held to
    one speed.

    torque = what keeps b.speed = a.speed; positive where b would lag behind.  Source: definition. Limits: it is rigid;
    what twists is a TorsionSpring.
    """

    transmits = True  # in steady motion its ends move alike
    a = Rotational("one end")
    b = Rotational("the other end")
    carried = Unknown("N*m", "Torque carried from a to b.")
    torque = Output("N*m", "Torque carried from a to b; positive turns b forward.")

    def law(p, a, b, carried):
        """One speed, one torque."""
        return Law(a=carried, b=-carried, carried=hold(b.speed - a.speed), torque=carried,
                   dissipated=carried * (a.speed - b.speed))  # fmt: skip
