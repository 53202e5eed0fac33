"""A direct-current motor with its amplifier: limited voltage, limited current."""

from fairlead.component import Component, Input, Law, Output, Parameter, Rotational, State, Zones, guard, zone

BRISK = 0.01  # the limiter holds the current with this share of the electrical time constant L/R


class DcDrive(Component):
    """An amplifier gives the voltage asked for, or what keeps the current below its limit, and no more than it has.

        L di/dt = u - R i - K w
        u = clip(clip(command, u-, u+), -most_voltage, most_voltage),  u+- = R i + K w + (R/0.01) (+-most_current - i)

    u+ and u- are what a limiter asks for that keeps the current at its limits within a hundredth of L/R. A load that
    overruns the motor may still drive the current beyond them: all the voltage there is is then against it.

    in_range              u = command
    forward, backward     u = u+, u-
    upper, lower          u = +-most_voltage

    Source: docs/physics.md, 5.6; Leonhard, Control of Electrical Drives. Limits: the amplifier has no losses and takes
    back what the motor generates; there is no ripple of switching.
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
    loss = Output("W", "Heat of the winding, R i^2; it may feed a HeatActuator.")
    zones = Zones(
        "in_range", "upper", "lower", "forward", "backward",
        forward=["upper", "forward"], backward=["lower", "backward"],
    )  # fmt: skip
    saturates_in = ("upper", "lower", "forward", "backward")

    @zone("in_range", "upper", "lower", "forward", "backward")
    def driving(p, shaft, command, flowing, zone):
        """The voltage of the zone at the winding."""
        if zone in ("forward", "backward"):
            voltage = limiting(p, shaft, flowing, p.most_current if zone == "forward" else -p.most_current)
        else:
            voltage = {"upper": p.most_voltage, "lower": -p.most_voltage}.get(zone, command)
        torque, loss = p.constant * flowing, p.resistance * flowing**2
        return Law(shaft=-torque, flowing=(voltage - p.resistance * flowing - p.constant * shaft.speed) / p.inductance,
                   current=flowing, voltage=voltage, torque=torque, loss=loss,
                   stored=p.inductance * flowing**2 / 2, dissipated=loss, supplied=voltage * flowing)  # fmt: skip

    @guard("in_range", to="forward", unit="V", mirrored="current_falls")
    def current_rises(p, shaft, command, flowing, direction):
        """The limiter asks for less than the command."""
        return direction * (command - limiting(p, shaft, flowing, direction * p.most_current))

    @guard("forward", to="in_range", unit="V", mirrored="backward_ends")
    def forward_ends(p, shaft, command, flowing, direction):
        """It asks for more than the command."""
        return direction * (limiting(p, shaft, flowing, direction * p.most_current) - command)

    @guard("upper", to="forward", unit="V", mirrored="current_falls_from_lower")
    def current_rises_from_upper(p, shaft, flowing, direction):
        """It asks for less than all there is."""
        return p.most_voltage - direction * limiting(p, shaft, flowing, direction * p.most_current)

    @guard("forward", to="upper", unit="V", mirrored="backward_ends_at_lower")
    def forward_ends_at_upper(p, shaft, flowing, direction):
        """It asks for more than there is."""
        return direction * limiting(p, shaft, flowing, direction * p.most_current) - p.most_voltage

    @guard("forward", to="lower", unit="V", mirrored="overruns_backward")
    def overruns(p, shaft, flowing, direction):
        """It asks for more against the current than there is: the load overruns the motor."""
        return -p.most_voltage - direction * limiting(p, shaft, flowing, direction * p.most_current)

    @guard("in_range", to="upper", unit="V", mirrored="saturates_backward")
    def saturates(p, command, direction):
        """The command asks for more than there is."""
        return direction * command - p.most_voltage

    @guard("upper", to="in_range", unit="V", mirrored="comes_back_backward")
    def comes_back(p, shaft, command, flowing, direction):
        """Neither the command nor the limiter of the other direction asks for all there is."""
        against = direction * limiting(p, shaft, flowing, -direction * p.most_current)
        return p.most_voltage - direction * command, p.most_voltage - against

    def fastest(p):
        """All the voltage of the supply, without current and without speed, or the current it is limited to."""
        return p.most_voltage / p.constant, p.constant * min(p.most_current, p.most_voltage / p.resistance)


def limiting(p, shaft, flowing, current):
    """Voltage by which the limiter keeps a current [V]."""
    return p.resistance * flowing + p.constant * shaft.speed + p.resistance / BRISK * (current - flowing)
