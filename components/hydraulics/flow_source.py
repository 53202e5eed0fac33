"""A flow given in time, and by a signal."""

from fairlead.component import Component, Hydraulic, Input, Law, Output, Waveform


class FlowSource(Component):
    """Moves a given flow from its inlet to its outlet, at any pressure.

    outlet.flow = -flow, as the flow goes out there; power = flow (p_outlet - p_inlet).  Source: definition. Limits: any
    pressure is overcome, and no loss is counted.
    """

    inlet = Hydraulic("from the tank")
    outlet = Hydraulic("where it goes")
    flow = Waveform("m^3/s", "Flow in time.")
    moved = Output("m^3/s", "The flow.", name="flow")
    power = Output("W", "Hydraulic power given.")

    def law(p, inlet, outlet, t):
        """What moves it supplies what the pressure takes."""
        flow = p.flow(t)
        power = flow * (outlet.pressure - inlet.pressure)
        return Law(inlet=flow, outlet=-flow, flow=flow, power=power, supplied=power)


class FlowActuator(Component):
    """An ideal pump of variable displacement: the flow of a signal, from its inlet to its outlet.

    outlet.flow = -flow, as the flow goes out there; power = flow (p_outlet - p_inlet).  Source: definition. Limits: any
    pressure is overcome, and no loss is counted.
    """

    inlet = Hydraulic("from the tank")
    outlet = Hydraulic("where it goes")
    flow = Input("m^3/s", "Flow.", signed=True)
    power = Output("W", "Hydraulic power given.")

    def law(p, inlet, outlet, flow):
        """What moves it supplies what the pressure takes."""
        power = flow * (outlet.pressure - inlet.pressure)
        return Law(inlet=flow, outlet=-flow, power=power, supplied=power)
