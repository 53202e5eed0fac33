"""A direct-current motor with its amplifier: limited voltage, limited current."""

from fairlead.component import Component, Input, Law, Output, Parameter, Rotational, State, Zones, guard, zone

BRISK = 0.01  # the limiter holds the current with this share of the electrical time constant L/R


class DcDrive(Component):
    """An amplifier gives the voltage asked for, up to its limit, and less if the current would exceed its own limit.

    in range              L di/dt = u - R i - K w,  u the command
    upper, lower          the same with u = +-most_voltage
    forward, backward     the current is kept at +-most_current by less voltage than asked for
    overrun_forward,      the shaft drives the current beyond +-most_current, though all the voltage there is,
    overrun_backward      -+most_voltage, is against it
    """

    shaft = Rotational("the shaft")
    command = Input("V", "Voltage asked for.", signed=True)
    resistance = Parameter("ohm", "R of the winding.", above=0)
    constant = Parameter("N*m/A", "K, torque per current and voltage per speed.", above=0)
    inductance = Parameter("V*s/A", "L of the winding.", default=1e-3, above=0)
    most_voltage = Parameter("V", "Voltage of the supply.", above=0)
    most_current = Parameter("A", "Current to which the amplifier limits.", above=0)
    flowing = State("A", "Current.")
    current, voltage = Output("A", "Current."), Output("V", "Voltage at the motor.")
    torque = Output("N*m", "Torque on the shaft.")
    zones = Zones(
        "in_range", "upper", "lower", "forward", "backward", "overrun_forward", "overrun_backward",
        forward=["upper", "forward", "overrun_forward"], backward=["lower", "backward", "overrun_backward"],
    )  # fmt: skip
    saturates_in = ("upper", "lower", "forward", "backward", "overrun_forward", "overrun_backward")

    @zone("in_range", "upper", "lower", "forward", "backward", "overrun_forward", "overrun_backward")
    def driving(p, shaft, command, flowing, zone):
        """The voltage of the zone at the winding."""
        needed = p.resistance * flowing + p.constant * shaft.speed
        if zone in ("forward", "backward"):
            voltage = limiting(p, shaft, flowing, p.most_current if zone == "forward" else -p.most_current)
        elif zone in ("upper", "overrun_backward"):
            voltage = p.most_voltage
        elif zone in ("lower", "overrun_forward"):
            voltage = -p.most_voltage
        else:
            voltage = command
        torque = p.constant * flowing
        return Law(shaft=-torque, flowing=(voltage - needed) / p.inductance, current=flowing, voltage=voltage,
                   torque=torque, stored=p.inductance * flowing**2 / 2, dissipated=p.resistance * flowing**2,
                   supplied=voltage * flowing)  # fmt: skip

    @guard("in_range", "upper", to="forward", unit="A", mirrored="current_falls")
    def current_rises(p, shaft, command, flowing, zone, direction):
        """The current reaches its limit, and the voltage would drive it on."""
        voltage = command if zone == "in_range" else direction * p.most_voltage
        return direction * flowing - p.most_current, direction * drive(p, shaft, flowing, voltage)

    @guard("forward", to="in_range", unit="A", mirrored="backward_ends")
    def forward_ends(p, shaft, command, flowing, direction):
        """The voltage asked for would lower the current."""
        further = direction * drive(p, shaft, direction * p.most_current, command)
        return -further, (p.most_voltage - direction * command) / p.resistance

    @guard("forward", to="upper", unit="A", mirrored="voltage_runs_out_backward")
    def voltage_runs_out(p, shaft, command, flowing, direction):
        """So would all the voltage there is."""
        further = direction * drive(p, shaft, direction * p.most_current, direction * p.most_voltage)
        return -further, (direction * command - p.most_voltage) / p.resistance

    @guard("forward", to="overrun_forward", unit="V", mirrored="overruns_backward")
    def overruns(p, shaft, flowing, direction):
        """The limiter asks for more voltage against the current than there is."""
        return -p.most_voltage - direction * limiting(p, shaft, flowing, direction * p.most_current)

    @guard("overrun_forward", to="forward", unit="V", mirrored="overrun_ends_backward")
    def overrun_ends(p, shaft, flowing, direction):
        """It asks for no more than there is."""
        return p.most_voltage + direction * limiting(p, shaft, flowing, direction * p.most_current)

    @guard("in_range", "lower", to="upper", unit="V", mirrored="saturates_backward")
    def saturates(p, command, direction):
        """More is asked for than there is."""
        return direction * command - p.most_voltage

    @guard("upper", to="in_range", unit="V", mirrored="comes_back_backward")
    def comes_back(p, command, direction):
        """Less is asked for than there is."""
        return p.most_voltage - direction * command

    def fastest(p):
        """All the voltage of the supply, without current and without speed, or the current it is limited to."""
        return p.most_voltage / p.constant, p.constant * min(p.most_current, p.most_voltage / p.resistance)


def limiting(p, shaft, flowing, current):
    """Voltage by which the limiter keeps a current [V]."""
    return p.resistance * flowing + p.constant * shaft.speed + p.resistance / BRISK * (current - flowing)


def drive(p, shaft, current, voltage):
    """How much further a voltage would drive a current [A]: the final one less this."""
    return (voltage - p.constant * shaft.speed) / p.resistance - current
