"""A sensor of torque."""

from fairlead.component import Component, Law, Output, Parameter, Rotational, Unknown, hold, sqrt


class TorqueSensor(Component):
    """A rigid coupling that reads the torque it carries; its ends keep their angle to each other.

    A coupling whose ends move together would be merged away, so the torque is an unknown and the ends are held to
    one speed. `size` is the torque without sign, rounded at zero: sqrt(torque^2 + rounding^2) - rounding.
    """

    transmits = True  # in steady motion its ends move alike
    a = Rotational("one end")
    b = Rotational("the other end")
    rounding = Parameter("N*m", "Torque below which `size` is rounded.", default=1e-3, above=0)
    carried = Unknown("N*m", "Torque carried from a to b.")
    torque = Output("N*m", "Torque carried from a to b; positive turns b forward.")
    size = Output("N*m", "The same without sign.")

    def law(p, a, b, carried):
        """One speed, one torque."""
        size = sqrt(carried**2 + p.rounding**2) - p.rounding
        return Law(a=carried, b=-carried, carried=hold(b.speed - a.speed), torque=carried, size=size,
                   dissipated=carried * (a.speed - b.speed))  # fmt: skip
