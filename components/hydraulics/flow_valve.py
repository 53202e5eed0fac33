"""Valves that meter a flow: an orifice opened by a signal, and one that keeps its flow at any pressure."""

from fairlead.components.hydraulics.fluid import Fluid, throttled

from fairlead.component import (
    Component,
    Hydraulic,
    Input,
    Law,
    Output,
    Parameter,
    Part,
    Zones,
    guard,
    zone,
)  # fmt: skip


class VariableOrifice(Component):
    """An orifice that a signal opens, from 0 shut to 1 wholly open; beyond that it stays shut, or open.

    flow = opening C_d A sqrt(2/rho) drop/(drop^2 + p_cr^2)^(1/4),  positive from a to b.

    Source: docs/physics.md, 5.1. Limits: C_d does not depend on the opening; put a SignalTable before it for the shape
    of a notch.
    """

    exempt = {"odd": "It opens one way."}
    a = Hydraulic("one side")
    b = Hydraulic("the other side")
    opening = Input("1", "Share of the area that is open.", signed=True)
    area = Parameter("m^2", "Area when wholly open.", above=0)
    discharge_coefficient = Parameter("1", "C_d, contraction of the jet.", default=0.62, above=0, most=1)
    critical_pressure = Parameter("Pa", "p_cr, drop below which the flow is laminar.", default=1e5, above=0)
    fluid = Part(Fluid, "What flows.", default="oil")
    flow = Output("m^3/s", "Flow from a to b.")
    loss = Output("W", "What becomes heat, flow times drop; it may feed a HeatActuator.")
    zones = Zones("metering", "shut", "open")

    @zone("metering", "shut", "open")
    def passing(p, a, b, opening, zone):
        """An orifice as far as it is open."""
        drop, share = a.pressure - b.pressure, {"shut": 0, "open": 1}.get(zone, opening)
        flow = share * throttled(p.fluid.conductance(p.discharge_coefficient, p.area), drop, p.critical_pressure)
        return Law(a=flow, b=-flow, flow=flow, loss=flow * drop, dissipated=flow * drop)

    @guard("*", to="shut", unit="1")
    def shuts(p, opening):
        """Nothing is open."""
        return -opening

    @guard("*", to="open", unit="1")
    def opens(p, opening):
        """All is open."""
        return opening - 1

    @guard("shut", to="metering", unit="1")
    def begins(p, opening):
        """It opens."""
        return opening

    @guard("open", to="metering", unit="1")
    def narrows(p, opening):
        """It closes."""
        return 1 - opening


class FlowControlValve(Component):
    """Passes `setting` from a to b at any pressure drop above `needs`; below it is an orifice, both ways.

    starved       p_a - p_b < needs     flow as of an orifice that passes `setting` at a drop of `needs`
    regulating    p_a - p_b > needs     flow = setting

    Limits: the compensator has no dynamics.

    Source: a compensator that keeps the drop over an orifice of docs/physics.md, 5.1.
    """

    exempt = {"odd": "It regulates one way."}
    a = Hydraulic("where oil comes from")
    b = Hydraulic("where it goes")
    setting = Parameter("m^3/s", "Flow that it keeps.", above=0)
    needs = Parameter("Pa", "Drop that the compensator needs.", default=5e5, above=0)
    critical_pressure = Parameter("Pa", "p_cr, drop below which the flow is laminar.", default=1e4, above=0)
    flow = Output("m^3/s", "Flow from a to b.")
    loss = Output("W", "What becomes heat, flow times drop; it may feed a HeatActuator.")
    zones = Zones("starved", "regulating")

    @zone("starved")
    def orifice(p, a, b):
        """Not enough pressure to regulate."""
        drop = a.pressure - b.pressure
        flow = throttled(p.setting / throttled(1.0, p.needs, p.critical_pressure), drop, p.critical_pressure)
        return Law(a=flow, b=-flow, flow=flow, loss=flow * drop, dissipated=flow * drop)

    @zone("regulating")
    def kept(p, a, b):
        """The compensator takes what drop is too much."""
        loss = p.setting * (a.pressure - b.pressure)
        return Law(a=p.setting, b=-p.setting, flow=p.setting, loss=loss, dissipated=loss)

    @guard("starved", to="regulating", unit="Pa")
    def regulates(p, a, b):
        """The drop is enough."""
        return a.pressure - b.pressure - p.needs

    @guard("regulating", to="starved", unit="Pa")
    def starves(p, a, b):
        """It is not."""
        return p.needs - a.pressure + b.pressure
