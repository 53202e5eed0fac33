"""Valve and motor, or valve and cylinder, with oil that is not compressed: no pressure is an unknown.

With the opening x > 0 both lands carry what is displaced, so the pressures follow from the speed in closed form:

    p_a = p_s - drop(Q_a),  p_b = p_t + drop(Q_b),  Q = displacement * speed,  drop about (Q/(K x))^2

A closed valve holds what it drives: the force is then an unknown and the speed is zero.
"""

from fairlead.components.hydraulics.fluid import Fluid, drop_of
from fairlead.components.hydraulics.valve_lands import effective, rated

from fairlead.component import (
    Component,
    Hydraulic,
    Input,
    Law,
    Output,
    Parameter,
    Part,
    Rotational,
    Translational,
    Unknown,
    Zones,
    derived,
    guard,
    hold,
    pi,
    sqrt,
    zone,
)  # fmt: skip

CLOSED = 1e-4  # opening below which the valve is closed; it opens again at twice that


class ThrottledDrive(Component, abstract=True):
    """Half-model: lands, ports of the supply, zones by the sign of the opening."""

    supply, tank = Hydraulic("pressure line"), Hydraulic("return line")
    metered, fed = "conductance", ("supply", "tank")
    opening = Input("1", "Opening, -1 to 1.", signed=True)
    rated_flow = Parameter("m^3/s", "Flow through one land, fully open, at the rated drop.", above=0)
    rated_drop = Parameter("Pa", "Pressure drop over one land at which the rated flow is told.", default=35e5, above=0)
    critical_pressure = Parameter("Pa", "Drop below which the flow is laminar.", default=1e5, above=0)
    overlap = Parameter("1", "Share of the stroke about the middle without flow.", default=None, above=0, most=0.3)
    load_pressure = Output("Pa", "Pressure of a over b.")
    pressure_a = Output("Pa", "Pressure at a.")
    pressure_b = Output("Pa", "Pressure at b.")
    loose = Output("1", "1 while oil can flow, 0 while the valve holds; friction beside it would have nothing to do.")
    zones = Zones("forward", "backward", "closed", forward=["forward"], backward=["backward"])

    @derived
    def conductance(p):
        """Flow per root of pressure drop, fully open."""
        return rated(p.rated_flow, p.rated_drop)

    @guard("forward", to="backward", unit="1", mirrored="crosses_up")
    def crosses_down(p, opening, direction):
        """From one side to the other at once."""
        return -CLOSED - direction * opening

    @guard("forward", to="closed", unit="1", mirrored="closes_from_below")
    def closes_from_above(p, opening, direction):
        """Nearly closed."""
        return CLOSED - direction * opening

    @guard("closed", to="forward", unit="1", mirrored="opens_backward")
    def opens_forward(p, opening, direction):
        """Open again."""
        return direction * opening - 2 * CLOSED




def pressures(p, supply, tank, opening, zone, into, out, series=None):
    """(p_a, p_b, heat) when `into` flows in at a and `out` comes back from b; `series`: further throttles."""
    d = 1 if zone == "forward" else -1
    k = p.conductance * sqrt(effective(p, d * opening) ** 2 + CLOSED**2)  # never zero, whatever a step tries
    k = k if series is None else k / sqrt(1 + (k / series) ** 2)
    first, second = drop_of(k, into, p.critical_pressure), drop_of(k, out, p.critical_pressure)
    heat = into * first + out * second
    at_a, at_b = (supply, tank) if zone == "forward" else (tank, supply)
    return at_a.pressure - first, at_b.pressure + second, heat


class ThrottledMotor(ThrottledDrive):
    """torque = displacement * (p_a - p_b), both pressures from the speed in closed form; without leakage."""

    shaft = Rotational("the shaft of the motor")
    swept = "displacement"
    displacement = Parameter("m^3/rad", "Oil per angle.", above=0)
    holding = Unknown("N*m", "Torque of the oil on the shaft.")
    torque = Output("N*m", "Torque of the oil on the shaft.")
    loaded = Output("N*m", "The torque without its sign, to within 1 bar.")

    @zone("forward", "backward")
    def flowing(p, supply, tank, shaft, opening, holding, zone):
        """Both lands carry what is displaced."""
        flow = p.displacement * shaft.speed
        at_a, at_b, heat = pressures(p, supply, tank, opening, zone, flow, flow)
        drawn = flow if zone == "forward" else -flow
        return Law(supply=drawn, tank=-drawn, shaft=-holding, holding=holding - p.displacement * (at_a - at_b),
                   dissipated=heat, loose=1, **told(p, at_a, at_b, holding))  # fmt: skip

    @zone("closed")
    def locked(p, supply, tank, shaft, holding):
        """The oil cannot get away; only the difference of the pressures is known, so they are told about the mean."""
        mean, half = (supply.pressure + tank.pressure) / 2, holding / (2 * p.displacement)
        return Law(supply=0, tank=0, shaft=-holding, holding=hold(shaft.speed), dissipated=-holding * shaft.speed,
                   loose=0, **told(p, mean + half, mean - half, holding))  # fmt: skip


def told(p, at_a, at_b, torque):
    """Outputs of a motor."""
    rounded = 1e5 * p.displacement
    return {"pressure_a": at_a, "pressure_b": at_b, "load_pressure": at_a - at_b, "torque": torque,
            "loaded": sqrt(torque**2 + rounded**2) - rounded}  # fmt: skip


class ThrottledCylinder(ThrottledDrive):
    """force = A_a p_a - A_b p_b, both pressures from the speed in closed form; without leakage and compression."""

    body, rod = Translational("the barrel"), Translational("the rod")
    cap_area = Parameter("m^2", "Area of the piston.", above=0)
    rod_area = Parameter("m^2", "Area of the piston less that of the rod.", above=0)
    bore = Parameter("m", "Diameter of the bores that fill the chambers.", default=0.02, above=0)
    fluid = Part(Fluid, "What fills it.", default="oil")
    holding = Unknown("N", "Force that pushes the rod out.")
    force = Output("N", "Force that pushes the rod out.")

    @derived
    def series(p):
        """Flow per root of pressure drop of a bore."""
        return p.fluid.conductance(0.62, pi * p.bore**2 / 4)

    @zone("forward", "backward")
    def flowing(p, supply, tank, body, rod, opening, holding, zone):
        """Each land carries what its side of the piston displaces."""
        speed = rod.v - body.v
        into, out = p.cap_area * speed, p.rod_area * speed
        at_a, at_b, heat = pressures(p, supply, tank, opening, zone, into, out, p.series)
        drawn, returned = (into, out) if zone == "forward" else (-out, -into)
        return Law(supply=drawn, tank=-returned, rod=-holding, body=holding,
                   holding=holding - p.cap_area * at_a + p.rod_area * at_b, dissipated=heat, pressure_a=at_a,
                   pressure_b=at_b, load_pressure=at_a - at_b, force=holding, loose=1)  # fmt: skip

    @zone("closed")
    def locked(p, supply, tank, body, rod, holding):
        """The oil cannot get away; the pressures are told as if that of b were the mean of supply and tank."""
        at_b = (supply.pressure + tank.pressure) / 2
        at_a = (holding + p.rod_area * at_b) / p.cap_area
        return Law(supply=0, tank=0, rod=-holding, body=holding, holding=hold(rod.v - body.v),
                   dissipated=-holding * (rod.v - body.v), pressure_a=at_a, pressure_b=at_b, load_pressure=at_a - at_b,
                   force=holding, loose=0)  # fmt: skip
