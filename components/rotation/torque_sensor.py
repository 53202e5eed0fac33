"""A sensor of torque."""

from fairlead.component import Component, Law, Output, Rotational, Unknown, Zones, guard, hold, zone


class TorqueSensor(Component):
    """A rigid coupling that reads the torque it carries; its ends keep their angle to each other.

    A coupling whose ends move together would be merged away, so the torque is an unknown and the ends are held to
    one speed. The zones only choose the sign in `size`, the torque without sign, which friction may follow.
    """

    a = Rotational("one end")
    b = Rotational("the other end")
    carried = Unknown("N*m", "Torque carried from a to b.")
    torque = Output("N*m", "Torque carried from a to b; positive turns b forward.")
    size = Output("N*m", "The same without sign.")
    zones = Zones("forward", "backward")

    @zone("forward", "backward")
    def coupled(p, a, b, carried, zone):
        """One speed, one torque."""
        size = carried if zone == "forward" else -carried
        return Law(a=carried, b=-carried, carried=hold(b.speed - a.speed), torque=carried, size=size,
                   dissipated=carried * (a.speed - b.speed))  # fmt: skip

    @guard("forward", to="backward", unit="N*m")
    def turns_back(p, carried):
        """The torque changes sign."""
        return -carried

    @guard("backward", to="forward", unit="N*m")
    def turns_forward(p, carried):
        """The torque changes sign."""
        return carried
