"""From the torque asked for to the current that may flow."""

from fairlead.component import Component, Input, Law, Output, Parameter, Zones, guard, zone


class CurrentLimit(Component):
    """current = torque/constant, between -most_current and most_current."""

    torque = Input("N*m", "Torque asked for.", signed=True)
    constant = Parameter("N*m/A", "Torque per current.", above=0)
    most_current = Parameter("A", "Largest current.", above=0)
    current = Output("A", "Current that may flow.")
    zones = Zones("within", "upper", "lower")

    @zone("within")
    def within(p, torque):
        """As asked for."""
        return Law(current=torque / p.constant)

    @zone("upper", "lower")
    def limited(p, zone):
        """No more."""
        return Law(current=p.most_current if zone == "upper" else -p.most_current)

    @guard("*", to="upper", unit="N*m")
    def exceeds(p, torque):
        """Too much is asked for."""
        return torque - p.constant * p.most_current

    @guard("*", to="lower", unit="N*m")
    def exceeds_backward(p, torque):
        """The same the other way."""
        return -torque - p.constant * p.most_current

    @guard("upper", to="within", unit="N*m")
    def returns(p, torque):
        """Less is asked for."""
        return p.constant * p.most_current - torque

    @guard("lower", to="within", unit="N*m")
    def returns_backward(p, torque):
        """The same the other way."""
        return p.constant * p.most_current + torque
