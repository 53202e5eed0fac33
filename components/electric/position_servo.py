"""A servo: a direct-current motor whose supply is set by a proportional controller of its angle."""

from fairlead.component import Component, Law, Output, Parameter, Rotational, Waveform, Zones, guard, shared, zone


class PositionServo(Component):
    """Torque on the shaft by the wanted angle:  torque = K (duty U - K w)/R,  duty = gain (goal - angle) within +-1.

    U is the supply. With `on` below one the torque is that share of it; at zero the motor's terminals are open.
    Limits: the current follows at once, and the controller is not sampled.

    Source: docs/physics.md, 5.6 (motor); a proportional law with a limited duty, as hobby and robot servos have it.
    """

    asked_with = {"on": 1.0, "goal": 0.0, "gain": 50.0}  # a motor that is on in part or less than off gives no power
    shaft = Rotational("the shaft")
    goal = Waveform("rad", "Wanted angle in time.")
    supply = Waveform("V", "U, voltage of the supply in time.")
    on = Waveform("1", "1 while the motor is on, 0 while its terminals are open.", default=1.0)
    gain = Parameter("1/rad", "Duty cycle per angle.", above=0)
    resistance = Parameter("ohm", "R of the winding.", above=0)
    constant = Parameter("N*m/A", "K, at the shaft: torque per current and voltage per speed.", above=0)
    current = Output("A", "Current.")
    torque = Output("N*m", "Torque on the shaft.")
    zones = Zones("linear", "forward", "backward", forward=["forward"], backward=["backward"])

    @shared
    def duty(p, shaft, t):
        """What the controller asks for."""
        return p.gain * (p.goal(t) - shaft.angle)

    @zone("linear")
    def linear(p, shaft, t, duty):
        """The controller gives a share of the supply to the winding."""
        return driven(p, shaft, t, duty)

    @zone("forward", "backward")
    def saturated(p, shaft, t, direction):
        """It gives all of it."""
        return driven(p, shaft, t, direction)

    @guard("linear", to="forward", unit="1", mirrored="saturates_backward")
    def saturates_forward(p, duty, direction):
        """More than all is asked for."""
        return direction * duty - 1

    @guard("forward", to="linear", unit="1", mirrored="returns_backward")
    def returns_forward(p, duty, direction):
        """Less than all is asked for."""
        return 1 - direction * duty


def driven(p, shaft, t, duty):
    """The law of a winding that has this share of the supply."""
    voltage = duty * p.supply(t)
    current = p.on(t) * (voltage - p.constant * shaft.speed) / p.resistance
    torque = p.constant * current
    return Law(shaft=-torque, current=current, torque=torque, supplied=voltage * current,
               dissipated=voltage * current - torque * shaft.speed)  # fmt: skip
