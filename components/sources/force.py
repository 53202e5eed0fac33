"""A force given in time or by a signal."""

from fairlead.component import Component, Input, Law, Output, Translational, Waveform


class ForceSource(Component):
    """Pulls its flange in the direction of +x with a given force.

    flange.force = -force(t), as it acts on what is joined.  Source: Force of the Modelica Standard Library. Limits: any
    speed; it does not depend on the motion.
    """

    flange = Translational("where the force acts")
    force = Waveform("N", "Force in time, positive towards +x.")
    applied = Output("N", "The force.", name="force")

    def law(p, flange, t):
        """The flange takes in the opposite of the force it gives."""
        force = p.force(t)
        return Law(flange=-force, force=force, supplied=force * flange.v)


class ForceActuator(Component):
    """An ideal drive: pulls its flange in the direction of +x with the force of a signal.

    flange.force = -force, as it acts on what is joined.  Source: Force of the Modelica Standard Library. Limits: any
    speed; no lag.
    """

    flange = Translational("where the force acts")
    force = Input("N", "Force, positive towards +x.", signed=True)
    power = Output("W", "Power given.")

    def law(p, flange, force):
        """All power given is supplied."""
        return Law(flange=-force, power=force * flange.v, supplied=force * flange.v)
