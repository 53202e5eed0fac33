"""A torque given in time or by a signal."""

from fairlead.component import Component, Input, Law, Output, Rotational, Waveform


class TorqueSource(Component):
    """Turns its shaft forward with a given torque.

    shaft.torque = -torque(t), as it acts on what is joined.  Source: Torque of the Modelica Standard Library. Limits:
    any speed; it does not depend on the motion.
    """

    shaft = Rotational("where the torque acts")
    torque = Waveform("N*m", "Torque in time, positive forward.")
    applied = Output("N*m", "The torque.", name="torque")

    def law(p, shaft, t):
        """The shaft takes in the opposite of the torque it gives."""
        torque = p.torque(t)
        return Law(shaft=-torque, torque=torque, supplied=torque * shaft.speed)


class TorqueActuator(Component):
    """An ideal drive: turns its shaft forward with the torque of a signal.

    shaft.torque = -torque, as it acts on what is joined.  Source: Torque of the Modelica Standard Library. Limits: any
    speed; no lag.
    """

    shaft = Rotational("where the torque acts")
    torque = Input("N*m", "Torque, positive forward.", signed=True)
    power = Output("W", "Power given.")

    def law(p, shaft, torque):
        """All power given is supplied."""
        return Law(shaft=-torque, power=torque * shaft.speed, supplied=torque * shaft.speed)
