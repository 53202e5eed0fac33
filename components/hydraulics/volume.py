"""Oil under pressure in a closed space, and what it does when the pressure falls to nothing."""

from fairlead.components.hydraulics.fluid import Fluid

from fairlead.component import (
    Component,
    Effect,
    Hydraulic,
    Law,
    Output,
    Parameter,
    Part,
    State,
    Unknown,
    Zones,
    derived,
    exp,
    guard,
    log,
    zone,
)  # fmt: skip

REFERENCE = 1e5  # Pa; the share of air in the oil is told at this pressure
LAG = 1e-10  # s; a pressure that is followed is off by flow * LAG * bulk_modulus/volume: 16 Pa of 1 cm^3 at 6 l/min


class Enclosed(Component, abstract=True):
    """Half-model of a constant volume of oil."""

    port = Hydraulic("the oil in it")
    volume = Parameter("m^3", "Volume.", above=0)
    pressure = Parameter("Pa", "Pressure at the start; 1 bar when nothing on its node says.", default=None, above=0,
                         physics=False)  # fmt: skip
    fluid = Part(Fluid, "What fills it.", default="oil")
    level = Output("Pa", "Pressure.", name="pressure")
    void = Output("m^3", "Volume without oil: the void, or the air.")

    def start(p):
        """Pressure at the start."""
        return {"port": p.pressure}


class FullVolume(Enclosed):
    """Oil that is only compressed:  (volume/bulk_modulus) dp/dt = flow in. Its pressure may fall below zero.

    Several on one node act as one.
    """

    def law(p, port):
        """The capacity is an entry of the mass matrix, see `inertia`."""
        stored = p.volume / p.fluid.bulk_modulus * port.pressure**2 / 2
        return Law(port=0, pressure=port.pressure, void=0, stored=stored)

    def inertia(p):
        """Capacity at the port [m^3/Pa]."""
        return {"port": p.volume / p.fluid.bulk_modulus}


class CavitatingVolume(Enclosed):
    """Oil whose pressure does not fall below zero: what is then missing is a void, filled up again before it rises.

    full         (volume/bulk_modulus) dp/dt = flow in
    cavitating   the void gives what is missing at p = 0, d(void)/dt = -flow in
    """

    cavitation = Effect("Pressure does not fall below zero; a void opens and closes.", off=FullVolume)
    empty = State("m^3", "Volume without oil.")
    zones = Zones("full", "cavitating")

    def inertia(p):
        """Capacity of the oil at the port [m^3/Pa]."""
        return {"port": p.volume / p.fluid.bulk_modulus}

    @zone("full", "cavitating")
    def both(p, port, empty, zone):
        """The void gives (takes back) its volume at a pressure that differs from zero by nearly nothing."""
        capacity = p.volume / p.fluid.bulk_modulus
        given = -capacity / LAG * port.pressure if zone == "cavitating" else 0
        return Law(port=-given, empty=given, void=empty, pressure=port.pressure, stored=capacity * port.pressure**2 / 2,
                   dissipated=-given * port.pressure)  # fmt: skip

    @guard("full", to="cavitating", unit="Pa")
    def tears(p, port):
        """The pressure falls through zero."""
        return -port.pressure

    @guard("cavitating", to="full", unit="1")
    def closes(p, port, empty):
        """The void is filled, and more flows in."""
        return -empty / p.volume, port.pressure / REFERENCE


class Volume(Enclosed):
    """A constant volume of oil; by `effects` also with entrained air, which makes it soft at low pressure.

    1/bulk_modulus(p) = 1/bulk_modulus + air_share/(n p) (p_0/p)^(1/n),  p_0 = 1 bar

    With air the pressure stays above zero by itself, and `void` is the volume of the air, air_share (p_0/p)^(1/n)
    of the oil's.

    A void opens where the pressure reaches zero first. Beside a Cylinder that is its chamber, behind the bore: see
    `void_a` and `void_b` there. Two volumes on one node share their void in proportion.

    Flow in is positive. Source: docs/physics.md, 5.1; Merritt 1967. Limits: one pressure for the whole volume; its
    walls give as much as the bulk modulus says.
    """

    air = Effect("Entrained air makes the oil soft at low pressure.", "off", off=CavitatingVolume)
    cavitation = Effect("Pressure does not fall below zero; a void opens and closes.")
    air_share = Parameter("1", "Volume of air in that of oil at 1 bar.", default=0.005, least=0, below=1)
    exponent = Parameter("1", "n, polytropic exponent of the air.", default=1.2, above=1)
    log_pressure = State("1", "ln(p/p_0).", start="logarithm")
    inflow = Unknown("m^3/s", "Flow in.")

    @derived
    def logarithm(p):
        """ln(p/p_0) at the start."""
        return 0.0 if p.pressure is None else log(p.pressure / REFERENCE)

    def law(p, port, log_pressure, inflow):
        """The logarithm as the state keeps the pressure positive; an inflow lifts the port by next to nothing."""
        n = p.exponent
        pressure = REFERENCE * exp(log_pressure)
        compliance = p.volume * (pressure / p.fluid.bulk_modulus + p.air_share / n * exp(-log_pressure / n))
        oil = pressure**2 / (2 * p.fluid.bulk_modulus)
        air = p.air_share * REFERENCE / (n - 1) * exp(log_pressure * (n - 1) / n)
        lifted = inflow * LAG * p.fluid.bulk_modulus / p.volume
        return Law(port=inflow, inflow=port.pressure - pressure - lifted, log_pressure=inflow / compliance,
                   pressure=pressure, stored=p.volume * (oil + air), dissipated=inflow * lifted,
                   void=p.volume * p.air_share * exp(-log_pressure / n))  # fmt: skip
