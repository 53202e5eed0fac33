"""The load with which a deployer squeezes the line."""

from fairlead.component import Component, Input, Law, Output, Waveform


class Clamp(Component):
    """Two belts, each pressed on the line with a load per length: given in time, a signal, or both.

    pressing = 2 (load + added)
    """

    load = Waveform("N/m", "Clamp load of each belt, per length.", default=0.0)
    added = Input("N/m", "What a cylinder or a controller adds to the load of each belt.", default=0.0)
    pressing = Output("N/m", "Load of both belts on the line, per length.")

    def law(p, t, added):
        """Both belts press alike."""
        return Law(pressing=2 * (p.load(t) + added))
