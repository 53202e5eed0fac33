"""An electric servo drive: torque asked for in, a shaft out."""

from fairlead.components.electric.current_limit import CurrentLimit
from fairlead.components.electric.pm_motor import PmMotor
from fairlead.components.rotation.inertia import Inertia

from fairlead.component import Composite, Effect, Expansion, Input, Output, Parameter, Rotational


class PmDrive(Composite):
    """A permanent-magnet motor with current limit and rotor. See `PmMotor`.

    winding         on: resistance, inductance and the voltage of the supply; off: an ideal current loop
    current_loop    off: the current is the one asked for, i = torque/constant

    Source: docs/physics.md, 5.6. Limits: those of `PmMotor`; the current is limited, however hot the winding is.
    """

    shaft = Rotational("the shaft")
    command = Input("N*m", "Torque asked for.")
    constant = Parameter("N*m/A", "Torque per current (q axis) and voltage per speed.", above=0)
    most_current = Parameter("A", "Largest current.", above=0)
    inertia = Parameter("kg*m^2", "Moment of inertia of the rotor.", above=0)
    resistance = Parameter("ohm", "Resistance of the winding.", default=0.0, least=0)
    inductance = Parameter("V*s/A", "Inductance of the winding.", default=1e-3, above=0)
    most_voltage = Parameter("V", "Voltage of the supply.", default=48.0, above=0)
    lag = Parameter("s", "Time constant of the current loop.", default=1e-3, above=0)
    winding = Effect("The voltage of the winding, which is limited.", "off")
    current_loop = Effect("The current follows what is asked for with a lag.")
    current = Output("A", "Current.")
    torque = Output("N*m", "Torque on the shaft.")
    speed = Output("rad/s", "Speed of the shaft.")
    loss = Output("W", "Heat of the winding; it may feed a HeatActuator.")

    def expand(p, scene):
        """Limit, motor, rotor."""
        same = ("constant", "resistance", "inductance", "most_voltage", "lag", "winding", "current_loop")
        children = {
            "limit": scene.make(CurrentLimit, constant=p.constant, most_current=p.most_current),
            "motor": scene.make(PmMotor, most_current=p.most_current, **{name: getattr(p, name) for name in same}),
            "rotor": scene.make(Inertia, moment=p.inertia),
        }
        joins = [("limit.current", "motor.wanted"), ("motor.shaft", "rotor.shaft")]
        told = {**{name: f"motor.{name}" for name in ("current", "torque", "loss")}, "speed": "rotor.speed"}
        shown = {"command": "limit.torque", **told}
        return Expansion(children, joins, {"shaft": "rotor.shaft"}, shown)
