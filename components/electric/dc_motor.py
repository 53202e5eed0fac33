"""A direct-current motor between two terminals."""

from fairlead.component import Component, Effect, Electrical, Law, Output, Parameter, Rotational, State


class Winding(Component, abstract=True):
    """Half-model of a motor with constant field: terminals, shaft, resistance and the constant K."""

    plus, minus = Electrical("one terminal"), Electrical("the other terminal")
    shaft = Rotational("the shaft")
    resistance = Parameter("ohm", "R of the winding.", above=0)
    constant = Parameter("N*m/A", "K_t = K_e, torque per current and voltage per speed.", above=0)
    current = Output("A", "Current from plus to minus.")
    torque = Output("N*m", "Torque on the shaft.")
    loss = Output("W", "Heat of the winding, R i^2; it may feed a HeatActuator.")


class ResistiveMotor(Winding):
    """current = (u - K w)/R,  torque = K current."""

    def law(p, plus, minus, shaft):
        """The current follows at once."""
        current = (plus.voltage - minus.voltage - p.constant * shaft.speed) / p.resistance
        torque, loss = p.constant * current, p.resistance * current**2
        return Law(plus=current, minus=-current, shaft=-torque, current=current, torque=torque, loss=loss,
                   dissipated=loss)  # fmt: skip


class DcMotor(Winding):
    """L di/dt = u - R i - K w,  torque = K i.

    Without load it runs at u/K, stalled it gives K u/R; with an inertia J its speed has the time constant J R/K^2.

    Source: docs/physics.md, 5.6; Leonhard, Control of Electrical Drives. A positive current from plus to minus turns
    the shaft forward. Limits: constant field; no friction, no iron loss, no drop of brushes; the resistance does not
    depend on temperature.
    """

    inductance = Parameter("V*s/A", "L of the winding.", default=1e-3, above=0)
    current_loop = Effect("The current has a lag, L/R.", off=ResistiveMotor)
    flowing = State("A", "Current.")

    def law(p, plus, minus, shaft, flowing):
        """The field of the winding stores energy."""
        voltage = plus.voltage - minus.voltage
        rate = (voltage - p.resistance * flowing - p.constant * shaft.speed) / p.inductance
        torque, loss = p.constant * flowing, p.resistance * flowing**2
        return Law(plus=flowing, minus=-flowing, shaft=-torque, flowing=rate, current=flowing, torque=torque, loss=loss,
                   stored=p.inductance * flowing**2 / 2, dissipated=loss)  # fmt: skip
