"""A permanent-magnet synchronous motor in the q axis, with its current controller."""

import math

from fairlead.component import (
    Component,
    Effect,
    Input,
    Law,
    Output,
    Parameter,
    Rotational,
    State,
    Zones,
    guard,
    zone,
)  # fmt: skip

AS_ONE_LIKES = 1e9  # rad/s


class PmTorque(Component, abstract=True):
    """Half-model: current asked for in, torque K i out."""

    shaft = Rotational("the shaft")
    wanted = Input("A", "Current asked for.", signed=True)
    constant = Parameter("N*m/A", "K, torque per current (q axis) and voltage per speed.", above=0)
    resistance = Parameter("ohm", "R of the winding.", default=0.0, least=0)
    most_current = Parameter("A", "What its drive limits the current to; for what `check` says of its speed.",
                             default=None, above=0, physics=False)  # fmt: skip
    current, torque = Output("A", "Current."), Output("N*m", "Torque on the shaft.")
    loss = Output("W", "Heat of the winding, R i^2; it may feed a HeatActuator.")
    integral = Output("A", "Integral of the current controller, which is the current as long as nothing limits it.")

    def fastest(p):
        """As fast as one likes without a voltage that ends; and no torque beyond that of the largest current."""
        return AS_ONE_LIKES, stall(p)


class IdealPm(PmTorque):
    """The current is the one asked for."""

    def law(p, shaft, wanted):
        """Supplied is what goes to the shaft and what the winding loses."""
        return pm_law(p, shaft, wanted)


class LaggingPm(PmTorque):
    """The current follows with a lag:  lag di/dt = wanted - i."""

    current_loop = Effect("The current follows what is asked for with a lag.", off=IdealPm)
    lag = Parameter("s", "Time constant of the current loop.", default=1e-3, above=0)
    flowing = State("A", "Current.")

    def law(p, shaft, wanted, flowing):
        """An ideal current loop."""
        return pm_law(p, shaft, flowing, flowing=(wanted - flowing) / p.lag)


class PmMotor(PmTorque):
    """Winding and current controller:  L di/dt = u - R i - K w,  u = K w + L/lag (wanted - i) + R integral.

    The controller cancels the pole of the winding, d(integral)/dt = (wanted - i)/lag. So the current follows with a
    lag, as without `winding`, while the voltage is within that of the supply. Beyond it the voltage stays at its
    limit.

    Source: docs/physics.md, 5.6; Leonhard, Control of Electrical Drives (field-oriented control). Limits: no current in
    the d axis, so no field weakening; no cogging, iron loss or friction.
    """

    winding = Effect("The voltage of the winding, which is limited.", "off", off=LaggingPm)
    current_loop = Effect("The current follows what is asked for with a lag.")
    lag = Parameter("s", "Time constant of the current loop.", default=1e-3, above=0)
    inductance = Parameter("V*s/A", "L of the winding.", default=1e-3, above=0)
    most_voltage = Parameter("V", "Voltage of the supply.", default=48.0, above=0)
    flowing = State("A", "Current.")
    summed = State("A", "Integral of the current controller.")
    zones = Zones("in_range", "upper", "lower", forward=["upper"], backward=["lower"])

    @zone("in_range", "upper", "lower")
    def driving(p, shaft, wanted, flowing, summed, zone):
        """At a limit the integral follows the current that flows."""
        error, back = wanted - flowing, p.constant * shaft.speed
        free = back + p.inductance / p.lag * error + p.resistance * summed
        voltage = {"upper": p.most_voltage, "lower": -p.most_voltage}.get(zone, free)
        rate = (voltage - p.resistance * flowing - back) / p.inductance
        catching = error / p.lag if zone == "in_range" else (flowing - summed) / p.lag
        torque, loss = p.constant * flowing, p.resistance * flowing**2
        return Law(shaft=-torque, flowing=rate, summed=catching, integral=summed, current=flowing, torque=torque,
                   loss=loss, stored=p.inductance * flowing**2 / 2, dissipated=loss,
                   supplied=voltage * flowing)  # fmt: skip

    @guard("*", to="upper", unit="V", mirrored="runs_out_backward")
    def runs_out(p, shaft, wanted, flowing, summed, direction):
        """The controller wants more than the supply has."""
        return direction * voltage_wanted(p, shaft, wanted, flowing, summed) - p.most_voltage

    @guard("upper", to="in_range", unit="V", mirrored="comes_back_backward")
    def comes_back(p, shaft, wanted, flowing, summed, direction):
        """The supply has enough again."""
        return p.most_voltage - direction * voltage_wanted(p, shaft, wanted, flowing, summed)

    def fastest(p):
        """All the voltage of the supply, without current and without speed, or the current it is limited to."""
        at_rest = p.constant * p.most_voltage / p.resistance if p.resistance else math.inf
        return p.most_voltage / p.constant, min(at_rest, stall(p))


def stall(p):
    """Torque at the largest current [N m]."""
    return math.inf if p.most_current is None else p.constant * p.most_current


def pm_law(p, shaft, current, **own):
    """Law of a motor at a current."""
    torque, lost = p.constant * current, p.resistance * current**2
    return Law(shaft=-torque, current=current, torque=torque, loss=lost, integral=current, dissipated=lost,
               supplied=torque * shaft.speed + lost, **own)  # fmt: skip


def voltage_wanted(p, shaft, wanted, flowing, integral):
    """What the current controller asks for."""
    return p.constant * shaft.speed + p.inductance / p.lag * (wanted - flowing) + p.resistance * integral
