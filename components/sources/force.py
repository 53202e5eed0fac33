"""A force given in time."""

from fairlead.component import Component, Law, Output, Translational, Waveform


class ForceSource(Component):
    """Pulls its flange in the direction of +x with a given force."""

    flange = Translational("where the force acts")
    force = Waveform("N", "Force in time, positive towards +x.")
    applied = Output("N", "The force.")

    def law(p, flange, t):
        """The flange takes in the opposite of the force it gives."""
        force = p.force(t)
        return Law(flange=-force, applied=force, supplied=force * flange.v)
