"""Valves whose poppet is lifted by pressure: check valves, plain and piloted, and the counterbalance valve."""

from fairlead.components.hydraulics.fluid import Fluid, throttled

from fairlead.component import (
    Component,
    Composite,
    Expansion,
    Hydraulic,
    Law,
    Output,
    Parameter,
    Part,
    Zones,
    guard,
    shared,
    zone,
)  # fmt: skip


class LiftValve(Component, abstract=True):
    """Half-model: `lift` is the pressure that lifts the poppet; it opens from `cracking` to `cracking + range`.

    closed    lift < cracking             flow = 0
    partly    in between                  area in proportion to lift - cracking
    open      lift > cracking + range     the whole area
    """

    exempt = {"odd": "It opens one way."}
    a = Hydraulic("where oil comes from")
    b = Hydraulic("where it goes")
    area = Parameter("m^2", "Area when open.", above=0)
    cracking = Parameter("Pa", "Pressure at which it begins to open.", default=0.5e5, least=0)
    range = Parameter("Pa", "Pressure beyond that which opens it wholly.", default=1e5, above=0)
    discharge_coefficient = Parameter("1", "C_d, contraction of the jet.", default=0.62, above=0, most=1)
    critical_pressure = Parameter("Pa", "p_cr, drop below which the flow is laminar.", default=1e4, above=0)
    fluid = Part(Fluid, "What flows.", default="oil")
    flow = Output("m^3/s", "Flow from a to b.")
    opening = Output("1", "Share of the area that is open.")
    loss = Output("W", "What becomes heat, flow times drop; it may feed a HeatActuator.")
    zones = Zones("closed", "partly", "open")

    @zone("closed", "partly", "open")
    def passing(p, a, b, lift, zone):
        """An orifice as far as it is open."""
        return Law(**through(p, a, b, lift, zone))

    @guard("closed", to="partly", unit="Pa")
    def lifts(p, lift):
        """The poppet leaves its seat."""
        return lift - p.cracking

    @guard("partly", to="closed", unit="Pa")
    def seats(p, lift):
        """It is back on it."""
        return p.cracking - lift

    @guard("partly", to="open", unit="Pa")
    def opens(p, lift):
        """It is at its stop."""
        return lift - p.cracking - p.range

    @guard("open", to="partly", unit="Pa")
    def leaves_stop(p, lift):
        """It comes down from it."""
        return p.cracking + p.range - lift


def through(p, a, b, lift, zone):
    """What the two ends take in, flow and opening of a poppet that is lifted so far."""
    drop = a.pressure - b.pressure
    opening = {"closed": 0, "open": 1}.get(zone, (lift - p.cracking) / p.range)
    flow = opening * throttled(p.fluid.conductance(p.discharge_coefficient, p.area), drop, p.critical_pressure)
    told = {"flow": flow, "opening": opening, "loss": flow * drop}
    return {"a": flow, "b": -flow, "dissipated": flow * drop, **told}


class CheckValve(LiftValve):
    """Lets oil pass from a to b alone:  opens at p_a - p_b = cracking, wholly at cracking + range.

    As it opens, the flow is that of an Orifice of the open area, positive from a to b.

    Source: docs/physics.md, 5.1 (orifice); Merritt 1967. Limits: the poppet has no mass and no hysteresis, and shut it
    is tight.
    """

    @shared
    def lift(p, a, b):
        """Pressure of a over b."""
        return a.pressure - b.pressure


class PilotCheckValve(LiftValve):
    """A check valve that its pilot opens the other way too:  lift = p_a - p_b + ratio (p_pilot - p_a).

    So it holds a load at b, until the pilot has (p_b - p_a + cracking)/ratio more than a. The pilot takes no oil.

    Source: the balance of forces on poppet and piston, with an orifice of docs/physics.md, 5.1. Limits: the poppet has
    no mass and no hysteresis, and shut it is tight.
    """

    pilot = Hydraulic("what opens it")
    ratio = Parameter("1", "Area of the pilot's piston over that of the seat.", default=4.0, above=0, usual=(1, 20))

    @shared
    def lift(p, a, b, pilot):
        """Pressure on the seat and on the piston of the pilot."""
        return a.pressure - b.pressure + p.ratio * (pilot.pressure - a.pressure)

    @zone("closed", "partly", "open")
    def passing(p, a, b, pilot, lift, zone):
        """An orifice as far as it is open; nothing flows into the pilot."""
        return Law(pilot=0, **through(p, a, b, lift, zone))


class PilotedRelief(PilotCheckValve):
    """Opens by a load's pressure and by a pilot's:  lift = p_a - p_b + ratio (p_pilot - p_b),  from `cracking` on."""

    @shared
    def lift(p, a, b, pilot):
        """Pressure on the seat and on the piston of the pilot; the spring's chamber is joined with b."""
        return a.pressure - b.pressure + p.ratio * (pilot.pressure - b.pressure)


class CounterbalanceValve(Composite):
    """Holds a load, and lowers it under the control of its pilot; oil that lifts the load passes freely.

    It opens from  p_load - p_valve + ratio (p_pilot - p_valve) = setting  on. A check valve beside leads from `valve`
    to `load`. A load that would run ahead of the pump takes the pressure from the pilot, so the valve closes and brakes
    it. Set it some 1.3 times the pressure of the largest load. Limits: the poppet has no dynamics; the spring's chamber
    is joined with `valve`, so pressure there acts against it.

    Source: the balance of forces on the poppet of an overcentre valve, with an orifice of docs/physics.md, 5.1.
    """

    load = Hydraulic("side of the load")
    valve = Hydraulic("side of the directional valve")
    pilot = Hydraulic("the opposite line")
    area = Parameter("m^2", "Area when open.", above=0)
    setting = Parameter("Pa", "Pressure at which it begins to open without a pilot.", above=0)
    range = Parameter("Pa", "Pressure beyond that which opens it wholly.", default=30e5, above=0)
    ratio = Parameter("1", "Area of the pilot's piston over that of the seat.", default=3.0, above=0, usual=(1, 20))
    free_area = Parameter("m^2", "Area of the check valve; that of `area` when not given.", default=None, above=0)
    fluid = Part(Fluid, "What flows.", default="oil")
    flow = Output("m^3/s", "Flow let down, from load to valve.")
    opening = Output("1", "Share of the area that is open.")
    loss = Output("W", "What letting down makes heat, flow times drop; it may feed a HeatActuator.")

    def expand(p, scene):
        """A relief with a pilot, and a check valve beside it."""
        free = p.area if p.free_area is None else p.free_area
        children = {
            "relief": scene.make(PilotedRelief, area=p.area, cracking=p.setting, range=p.range, ratio=p.ratio,
                                 fluid=p.fluid),
            "check": scene.make(CheckValve, area=free, fluid=p.fluid),
        }  # fmt: skip
        joins = [("relief.a", "check.b"), ("relief.b", "check.a")]
        ports = {"load": "relief.a", "valve": "relief.b", "pilot": "relief.pilot"}
        return Expansion(children, joins, ports, {name: f"relief.{name}" for name in ("flow", "opening", "loss")})
