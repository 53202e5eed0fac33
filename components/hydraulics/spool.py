"""The spool of a servo valve: how the opening follows the command."""

from fairlead.component import (
    Component,
    Effect,
    Input,
    Law,
    Output,
    Parameter,
    State,
    Zones,
    derived,
    guard,
    pi,
    tanh,
    zone,
)  # fmt: skip

STOP = 50.0  # the stops are springs of this times the natural frequency, critically damped: a hit goes 1 % beyond


class FollowingSpool(Component):
    """A spool without inertia: the opening is the command, between -1 and 1."""

    command = Input("1", "Opening asked for, -1 to 1.", signed=True)
    opening = Output("1", "Opening; positive joins supply with a and b with tank.")
    zones = Zones("within", "open", "reversed", forward=["open"], backward=["reversed"])
    saturates_in = ("open", "reversed")

    @zone("within")
    def within(p, command):
        """The command itself."""
        return Law(opening=command)

    @zone("open", "reversed")
    def limited(p, zone):
        """More is not to be had."""
        return Law(opening=1 if zone == "open" else -1)

    @guard("within", to="open", unit="1", mirrored="reverses")
    def opens(p, command, direction):
        """More than all is asked for."""
        return direction * command - 1

    @guard("open", to="within", unit="1", mirrored="leaves_reversed")
    def leaves_open(p, command, direction):
        """Less than all is asked for."""
        return 1 - direction * command




class Spool(Component):
    """A spool with the dynamics of a data sheet, second order, between stops.

        x'' = w^2 (command - x) - 2 damping w x',   w = 2 pi natural_frequency,   -1 <= x <= 1

    With `rate_limit` the pull towards the command is limited so that x' stays below it. Rule of thumb: the frequency
    at which the valve lags by 90 degrees should be at least three times that of the load.

    Source: docs/physics.md, 5.2. Limits: forces of the flow and stiction of the spool are not there; a hit on a stop
    goes up to 1 % beyond.
    """

    command = Input("1", "Opening asked for, -1 to 1.", signed=True)
    valve_dynamics = Effect("The spool lags behind its command and hits stops.", off=FollowingSpool)
    natural_frequency = Parameter("Hz", "Undamped frequency of the spool.", default=60.0, above=0)
    damping = Parameter("1", "Damping relative to critical.", default=0.7, above=0)
    rate_limit = Parameter("1/s", "Largest speed of the spool.", default=None, above=0)
    position = State("1", "Opening.", nominal=0.1)
    speed = State("1/s", "Rate of the opening.", nominal=10.0)
    opening = Output("1", "Opening; positive joins supply with a and b with tank.")
    zones = Zones("free", "upper_stop", "lower_stop", forward=["upper_stop"], backward=["lower_stop"])
    saturates_in = ("upper_stop", "lower_stop")

    @derived
    def omega(p):
        """Undamped angular frequency [rad/s]."""
        return 2 * pi * p.natural_frequency

    @zone("free", "upper_stop", "lower_stop")
    def moving(p, command, position, speed, zone):
        """The stop adds the force of a stiff spring with a damper."""
        lag = command - position
        if p.rate_limit is not None:
            most = 2 * p.damping * p.rate_limit / p.omega
            lag = most * tanh(lag / most)
        force = p.omega**2 * lag - 2 * p.damping * p.omega * speed
        if zone != "free":
            stiff = STOP * p.omega
            beyond = position - (1 if zone == "upper_stop" else -1)
            force -= stiff**2 * beyond + 2 * stiff * speed
        return Law(position=speed, speed=force, opening=position)

    @guard("free", to="upper_stop", unit="1", mirrored="hits_lower")
    def hits_upper(p, position, direction):
        """Fully open."""
        return direction * position - 1

    @guard("upper_stop", to="free", unit="1", mirrored="leaves_lower")
    def leaves_upper(p, position, direction):
        """Back from the stop."""
        return 1 - direction * position
