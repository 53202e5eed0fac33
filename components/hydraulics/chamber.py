"""A chamber of a cylinder: oil whose volume the piston changes."""

from fairlead.components.hydraulics.fluid import Fluid, throttled

from fairlead.component import (
    Choice,
    Component,
    Effect,
    Hydraulic,
    Law,
    Output,
    Parameter,
    Part,
    State,
    Translational,
    Zones,
    derived,
    guard,
    pi,
    zone,
)  # fmt: skip

LEAST = 0.01  # share of the dead volume that must be left
LAG, NOTHING = 1e-6, 1.0  # s; Pa: what rounding has left of the pressure in a void is gone after this time
EDGE, CRITICAL = 0.62, 1e5  # C_d and p_cr [Pa] of the bore through which a chamber is filled


class PistonChamber(Component, abstract=True):
    """Half-model of a chamber: volume, flow through its bore, force of the piston.

    V = dead_volume + area * (free length of the chamber);  (V/bulk_modulus) dp/dt = Q - area * speed;  force = area p

    The power of a port is pressure times flow, which leaves out the energy of compression that oil carries along.
    With a volume that changes it does not cancel: p^2/(2 bulk_modulus) * area * speed, 1 % of the power at 200 bar,
    is told as supplied. (`travel` is rod.x - body.x; `side: cap` grows with it, `side: rod` shrinks.)
    """

    port = Hydraulic("the bore")
    body = Translational("the barrel")
    rod = Translational("the piston with its rod")
    side = Choice(("cap", "rod"), "Which way the piston pushes: out, or in.", default="cap", physics=False)
    area = Parameter("m^2", "Area of the piston.", above=0)
    stroke = Parameter("m", "Travel from stop to stop.", above=0)
    dead_volume = Parameter("m^3", "Volume that the piston does not sweep, with the line to it.", above=0)
    bore = Parameter("m", "Diameter of the bore that fills the chamber.", default=0.02, above=0)
    pressure = Parameter("Pa", "Pressure at the start; 1 bar when not given.", default=None, least=0, physics=False)
    fluid = Part(Fluid, "What fills it.", default="oil")
    level = Output("Pa", "Pressure on the piston.", name="pressure")
    force = Output("N", "Force that pushes the rod out.")
    void = Output("m^3", "Volume without oil.")
    crushed = Output(
        "1", "Above zero where less than a hundredth of the dead volume is left.", role="used_up",
        gone=("has no volume left: its piston went through the end stop by as much as the dead volume is long",
              "Give it a stiffer stop, or a larger dead volume."),
    )  # fmt: skip

    def start(p):
        """Pressure at the start, where given."""
        return {"port": p.pressure}

    @derived
    def first(p):
        """Pressure at the start [Pa]."""
        return 1e5 if p.pressure is None else p.pressure

    @derived
    def conductance(p):
        """Flow per root of pressure drop of the bore."""
        return p.fluid.conductance(EDGE, pi * p.bore**2 / 4)


def chamber_volume(p, body, rod):
    """The volume of a chamber, with its dead volume."""
    travel = rod.x - body.x
    return p.dead_volume + p.area * (travel if p.side == "cap" else p.stroke - travel)


def chamber_law(p, port, body, rod, level, **own):
    """Law of a chamber at a pressure; `own` gives the rate of it when it is held, and further states."""
    d = 1 if p.side == "cap" else -1
    speed = d * (rod.v - body.v)
    volume = chamber_volume(p, body, rod)
    drop = port.pressure - level
    flow = throttled(p.conductance, drop, CRITICAL)
    push = d * p.area * level
    rate = own.pop("rate", None)
    supplied, lost = 0, flow * drop
    if rate is None:
        rate = p.fluid.bulk_modulus / volume * (flow - p.area * speed)
        supplied = level**2 / (2 * p.fluid.bulk_modulus) * p.area * speed
    return Law(port=flow, rod=-push, body=push, pressure=level, force=push, oil=rate, supplied=supplied,
               stored=volume * level**2 / (2 * p.fluid.bulk_modulus), dissipated=lost,
               crushed=LEAST - volume / p.dead_volume, **own)  # fmt: skip


class FullChamber(PistonChamber):
    """A chamber whose pressure may fall below zero."""

    oil = State("Pa", "Pressure on the piston.", start="first")

    def law(p, port, body, rod, oil):
        """Only compressed."""
        return chamber_law(p, port, body, rod, oil, void=0)


class Chamber(PistonChamber):
    """A chamber of a cylinder; where its pressure would fall below zero a void opens (see `PistonChamber`)."""

    cavitation = Effect("Pressure does not fall below zero; a void opens and closes.", off=FullChamber)
    oil = State("Pa", "Pressure on the piston.", start="first")
    empty = State("m^3", "Volume without oil.")
    zones = Zones("full", "cavitating")

    @zone("full")
    def full(p, port, body, rod, oil):
        """Only compressed."""
        return chamber_law(p, port, body, rod, oil, empty=0, void=0)

    @zone("cavitating")
    def cavitating(p, port, body, rod, oil, empty):
        """The piston leaves the oil behind, at no pressure."""
        speed = (1 if p.side == "cap" else -1) * (rod.v - body.v)
        flow = throttled(p.conductance, port.pressure, CRITICAL)
        return Law(port=flow, rod=0, body=0, pressure=0, force=0, oil=-oil / LAG, empty=p.area * speed - flow,
                   void=empty, dissipated=flow * port.pressure,
                   crushed=LEAST - chamber_volume(p, body, rod) / p.dead_volume)  # fmt: skip

    @guard("full", to="cavitating", unit="Pa")
    def tears(p, oil):
        """The pressure falls through zero."""
        return -oil

    @guard("cavitating", to="full", unit="1")
    def closes(p, port, body, rod, oil, empty):
        """The void is filled, and more flows in than the piston gives room for."""
        speed = (1 if p.side == "cap" else -1) * (rod.v - body.v)
        flow = throttled(p.conductance, port.pressure, CRITICAL)
        more = (flow - p.area * speed) / (p.conductance * CRITICAL**0.5)
        return -empty / p.dead_volume, more, (oil + NOTHING) / CRITICAL


class RigidChamber(Component):
    """A chamber whose oil is not compressed: what flows in moves the piston, and the pressure is that of the port.

    flow = area (rod.v - body.v),  force = area pressure, which pushes the rod out; `side: rod` pulls it in.

    Source: Merritt 1967; docs/physics.md, 5.4 without compressibility. Limits: no leakage past the piston, no friction
    and no stops.
    """

    port = Hydraulic("the bore")
    body = Translational("the barrel")
    rod = Translational("the piston with its rod")
    side = Choice(("cap", "rod"), "Which way the piston pushes: out, or in.", default="cap", physics=False)
    area = Parameter("m^2", "Area of the piston.", above=0)
    pressure = Output("Pa", "Pressure on the piston.")
    force = Output("N", "Force that pushes the rod out.")
    void = Output("m^3", "Volume without oil.")

    def law(p, port, body, rod):
        """Flow is area times speed, force area times pressure; nothing is lost."""
        area = p.area if p.side == "cap" else -p.area
        push = area * port.pressure
        return Law(port=area * (rod.v - body.v), rod=-push, body=push, pressure=port.pressure, force=push, void=0)
