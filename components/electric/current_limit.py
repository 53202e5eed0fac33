"""From the torque asked for to the current that may flow."""

from fairlead.component import Component, Input, Law, Output, Parameter, Zones, guard, zone


class CurrentLimit(Component):
    """current = torque/constant, between -most_current and most_current."""

    torque = Input("N*m", "Torque asked for.", signed=True)
    constant = Parameter("N*m/A", "Torque per current.", above=0)
    most_current = Parameter("A", "Largest current.", above=0)
    current = Output("A", "Current that may flow.")
    zones = Zones("within", "upper", "lower", forward=["upper"], backward=["lower"])
    saturates_in = ("upper", "lower")

    @zone("within")
    def within(p, torque):
        """As asked for."""
        return Law(current=torque / p.constant)

    @zone("upper", "lower")
    def limited(p, zone):
        """No more."""
        return Law(current=p.most_current if zone == "upper" else -p.most_current)

    @guard("*", to="upper", unit="N*m", mirrored="exceeds_backward")
    def exceeds(p, torque, direction):
        """Too much is asked for."""
        return direction * torque - p.constant * p.most_current

    @guard("upper", to="within", unit="N*m", mirrored="returns_backward")
    def returns(p, torque, direction):
        """Less is asked for."""
        return p.constant * p.most_current - direction * torque
