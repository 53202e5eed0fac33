"""The four metering edges of a servo valve."""

from fairlead.components.hydraulics.fluid import throttled

from fairlead.component import (
    Component,
    Effect,
    Hydraulic,
    Input,
    Law,
    Output,
    Parameter,
    Zones,
    derived,
    guard,
    sqrt,
    zone,
)  # fmt: skip

SOFT = 0.01  # share of the stroke over which the end of an overlap is rounded
SHUT = 1e-6  # opening below which nothing flows, so that a spool that comes to rest switches no more


def rated(flow, drop):
    """Flow per root of pressure drop of a land, from a data sheet."""
    return flow / sqrt(drop)


class ValveLands(Component):
    """Flow through the lands of a spool valve at an opening x from -1 to 1.

    forward    x > 0:  supply -> a  and  b -> tank       backward   x < 0:  supply -> b  and  a -> tank
    closed     x = 0:  nothing but leakage
    each land  Q = |x| rated_flow sqrt(drop/rated_drop), laminar below `critical_pressure`

    Data sheets give the flow at a drop per land (often 35 bar); no area and no density is needed. `overlap` is
    the share of the stroke without flow. Leakage past closed lands is laminar.

    Source: docs/physics.md, 5.2; Merritt 1967. Limits: all four lands alike; the density of the oil is that of the data
    sheet.
    """

    supply = Hydraulic("pressure line")
    tank = Hydraulic("return line")
    a = Hydraulic("joined with supply at positive opening")
    b = Hydraulic("joined with tank at positive opening")
    metered, fed = "conductance", ("supply", "tank")
    opening = Input("1", "Opening, -1 to 1.", signed=True)
    rated_flow = Parameter("m^3/s", "Flow through one land, fully open, at the rated drop.", above=0)
    rated_drop = Parameter("Pa", "Pressure drop over one land at which the rated flow is told.", default=35e5, above=0)
    critical_pressure = Parameter("Pa", "Drop below which the flow is laminar.", default=1e5, above=0)
    overlap = Parameter("1", "Share of the stroke about the middle without flow.", default=None, above=0, most=0.3)
    leakage = Effect("Closed lands leak.")
    leakage_conductance = Parameter("m^3/s/Pa", "Leakage of one land per pressure drop.", default=0.0, least=0)
    flow_a = Output("m^3/s", "Flow out at a.")
    flow_b = Output("m^3/s", "Flow out at b.")
    loss = Output("W", "What becomes heat in all lands; it may feed a HeatActuator.")
    zones = Zones("forward", "backward", "closed", forward=["forward"], backward=["backward"])

    @derived
    def conductance(p):
        """Flow per root of pressure drop, fully open."""
        return rated(p.rated_flow, p.rated_drop)

    @zone("forward", "backward")
    def metering(p, supply, tank, a, b, opening, zone):
        """Two lands are open, the other two only leak."""
        d = 1 if zone == "forward" else -1
        k = p.conductance * effective(p, d * opening)
        fed, drained = (a, b) if zone == "forward" else (b, a)
        rise, fall = supply.pressure - fed.pressure, drained.pressure - tank.pressure
        into, out = throttled(k, rise, p.critical_pressure), throttled(k, fall, p.critical_pressure)
        lost = into * rise + out * fall
        to_a, to_b = (into, -out) if zone == "forward" else (-out, into)
        return lands_law(p, supply, tank, a, b, (to_a, to_b), (into, out), lost)

    @zone("closed")
    def closed(p, supply, tank, a, b):
        """All four lands only leak."""
        return lands_law(p, supply, tank, a, b, (0, 0), (0, 0), 0)

    @guard("forward", to="backward", unit="1", mirrored="returns")
    def reverses(p, opening, direction):
        """From one side to the other at once."""
        return -SHUT - direction * opening

    @guard("forward", to="closed", unit="1", mirrored="closes_from_below")
    def closes_from_above(p, opening, direction):
        """The opening falls to nothing."""
        return SHUT - direction * opening

    @guard("closed", to="forward", unit="1", mirrored="opens_backward")
    def opens_forward(p, opening, direction):
        """It opens."""
        return direction * opening - 2 * SHUT




def lands_law(p, supply, tank, a, b, delivered, drawn, lost):
    """Flows `delivered` at a and b, `drawn` from the supply and returned to the tank, and leakage where wanted."""
    to_a, to_b = delivered
    taken, returned = drawn
    if p.leakage == "on":
        c = p.leakage_conductance
        drops = [(supply.pressure - port.pressure, port.pressure - tank.pressure) for port in (a, b)]
        (in_a, out_a), (in_b, out_b) = drops
        to_a, to_b = to_a + c * (in_a - out_a), to_b + c * (in_b - out_b)
        taken, returned = taken + c * (in_a + in_b), returned + c * (out_a + out_b)
        lost += c * (in_a**2 + out_a**2 + in_b**2 + out_b**2)
    return Law(supply=taken, tank=-returned, a=-to_a, b=-to_b, flow_a=to_a, flow_b=to_b, loss=lost, dissipated=lost)


def effective(p, x):
    """The share of the full area at x >= 0: x itself, or what an overlap leaves of it, rounded where it begins."""
    if p.overlap is None:
        return x

    def past(u):
        """The sum u + |u - overlap| - overlap, rounded, written so that nothing is lost near zero."""
        sides = sqrt((u - p.overlap) ** 2 + SOFT**2) + sqrt(p.overlap**2 + SOFT**2)
        return u * (1 + (u - 2 * p.overlap) / sides)

    return past(x) / past(1)
