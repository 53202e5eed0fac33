"""A sharp-edged orifice."""

from fairlead.components.hydraulics.fluid import Fluid, throttled

from fairlead.component import Component, Hydraulic, Law, Output, Parameter, Part


class Orifice(Component):
    """Turbulent flow through an opening, laminar near zero:  flow = C_d A sqrt(2/rho) drop/(drop^2 + p_cr^2)^(1/4).

    The pressure is not recovered: flow * drop becomes heat.

    flow is positive from a to b. Source: docs/physics.md, 5.1; Merritt 1967. Limits: C_d is constant, and the oil has
    no inertia there.
    """

    a = Hydraulic("one side")
    b = Hydraulic("the other side")
    area = Parameter("m^2", "Area of the opening.", above=0)
    discharge_coefficient = Parameter("1", "C_d, contraction of the jet.", default=0.62, above=0, most=1)
    critical_pressure = Parameter("Pa", "p_cr, drop below which the flow is laminar.", default=1e5, above=0)
    fluid = Part(Fluid, "What flows.", default="oil")
    flow = Output("m^3/s", "Flow from a to b.")
    drop = Output("Pa", "Pressure of a over b.")
    loss = Output("W", "What becomes heat, flow times drop; it may feed a HeatActuator.")

    def law(p, a, b):
        """What a takes in leaves at b."""
        drop = a.pressure - b.pressure
        conductance = p.fluid.conductance(p.discharge_coefficient, p.area)
        flow = throttled(conductance, drop, p.critical_pressure)
        return Law(a=flow, b=-flow, flow=flow, drop=drop, loss=flow * drop, dissipated=flow * drop)
