"""The ledger of energy in the contract: relations of positions, algebraic unknowns and rigid ties."""

import pytest

from fairlead.component import (
    Component,
    Electrical,
    Hydraulic,
    Law,
    Parameter,
    Rotational,
    State,
    Thermal,
    Translational,
    Unknown,
    Zones,
    guard,
    hold_position,
    sin,
    zone,
)  # fmt: skip
from fairlead.testing import ContractError, checks


def ask(kind, *names):
    """Ask some properties of a class."""
    for check in checks(kind):
        if check.name in names:
            check()


class TwoCranks(Component):
    """Two relations of positions move one slider, which has a spring and a damper of its own."""

    one, other, slider = Rotational(), Rotational(), Translational()
    radius, lead = Parameter("m", above=0), Parameter("m", above=0)
    stiffness, damping = Parameter("N/m", above=0), Parameter("N*s/m", above=0)
    first, second = Unknown("N"), Unknown("N")

    def law(p, one, other, slider, first, second):
        pull, kept = p.stiffness * slider.x + p.damping * slider.v, p.stiffness * slider.x**2
        return Law(first=hold_position(slider.x - p.radius * sin(one.angle)),
                   second=hold_position(slider.x - p.lead * other.angle**2), slider=pull,
                   stored=0.5 * kept, dissipated=p.damping * slider.v**2)  # fmt: skip


class WrongCranks(TwoCranks):
    def law(p, one, other, slider, first, second):
        pull = p.stiffness * slider.x
        return Law(first=hold_position(slider.x - p.radius * sin(one.angle)),
                   second=hold_position(slider.x - p.lead * other.angle**2), slider=pull,
                   stored=p.stiffness * slider.x**2)  # fmt: skip


def test_a_law_may_add_to_what_relations_of_positions_put_on_a_port():
    ask(TwoCranks, "as_written", "energy", "settles")
    with pytest.raises(ContractError, match="energy is not accounted for"):
        ask(WrongCranks, "energy")


class Follower(Component):
    """u^3/l^2 + u = s, and the pull is stiffness u."""

    a, b = Translational(), Translational()
    stiffness, length = Parameter("N/m", above=0), Parameter("m", above=0)
    u = Unknown("m")

    def law(p, a, b, u):
        pull = p.stiffness * u
        return Law(a=-pull, b=pull, u=u**3 / p.length**2 + u - (b.x - a.x),
                   stored=p.stiffness * (u**2 / 2 + 3 * u**4 / 4 / p.length**2))  # fmt: skip


class TwoFollowers(Component):
    """Two springs in series, with the stretch of each an unknown."""

    a, b = Translational(), Translational()
    soft, hard = Parameter("N/m", above=0), Parameter("N/m", above=0)
    u, w = Unknown("m"), Unknown("m")

    def law(p, a, b, u, w):
        pull = p.soft * u
        return Law(a=-pull, b=pull, u=u + w - (b.x - a.x), w=pull - p.hard * w,
                   stored=p.soft * u**2 / 2 + p.hard * w**2 / 2)  # fmt: skip


class TautFollower(Component):
    """A follower with a zone in which it is slack."""

    a, b = Translational(), Translational()
    stiffness, length = Parameter("N/m", above=0), Parameter("m", above=0)
    u = Unknown("m")
    zones = Zones("slack", "taut")

    @zone("slack")
    def slack(p, a, b, u):
        return Law(a=0, b=0, u=u, stored=0)

    @zone("taut")
    def taut(p, a, b, u):
        pull = p.stiffness * u
        return Law(a=-pull, b=pull, u=u**3 / p.length**2 + u - (b.x - a.x),
                   stored=p.stiffness * (u**2 / 2 + 3 * u**4 / 4 / p.length**2))  # fmt: skip

    @guard("slack", to="taut", unit="m")
    def tightens(p, a, b):
        return b.x - a.x

    @guard("taut", to="slack", unit="m")
    def slackens(p, u):
        return -u


class MaxwellByForce(Component):
    """A spring and a damper in series, with the force an unknown that follows a state."""

    a, b = Translational(), Translational()
    stiffness, damping = Parameter("N/m", above=0), Parameter("N*s/m", above=0)
    crept, pull = State("m"), Unknown("N")

    def law(p, a, b, crept, pull):
        return Law(a=-pull, b=pull, pull=pull - p.stiffness * (b.x - a.x - crept), crept=pull / p.damping,
                   stored=pull**2 / 2 / p.stiffness, dissipated=pull**2 / p.damping)  # fmt: skip


@pytest.mark.parametrize("kind", [Follower, TwoFollowers, TautFollower, MaxwellByForce])
def test_energy_stored_may_follow_an_algebraic_unknown(kind):
    ask(kind, "energy")


def test_energy_stored_that_follows_an_unknown_and_is_wrong_is_told():
    class Half(Follower):
        def law(p, a, b, u):
            pull = p.stiffness * u
            return Law(a=-pull, b=pull, u=u**3 / p.length**2 + u - (b.x - a.x), stored=p.stiffness * u**2 / 2)

    with pytest.raises(ContractError, match="energy is not accounted for"):
        ask(Half, "energy")


class Gas(Component):
    """A bladder keeps its port at the pressure of the gas, p V^n; what flows in follows from what it is joined to."""

    port = Hydraulic()
    pressure, volume = Parameter("Pa", above=0), Parameter("m^3", default=1e-3, above=0)
    exponent = Parameter("1", default=1.4, above=1)
    gas = State("m^3", start="volume", nominal="volume", least=1e-6)
    flow = Unknown("m^3/s")

    def law(p, port, gas, flow):
        pressure = p.pressure * (p.volume / gas) ** p.exponent
        return Law(port=flow, gas=-flow, flow=port.pressure - pressure, stored=pressure * gas / (p.exponent - 1))


class WrongGas(Gas):
    def law(p, port, gas, flow):
        pressure = p.pressure * (p.volume / gas) ** p.exponent
        return Law(port=flow, gas=-flow, flow=port.pressure - pressure, stored=pressure * gas)


class Cells(Component):
    """Keep two ports at a difference of voltage."""

    plus, minus = Electrical(), Electrical()
    voltage, resistance = Parameter("V", above=0), Parameter("ohm", above=0)
    first, second = Unknown("A"), Unknown("A")

    def law(p, plus, minus, first, second):
        return Law(plus=first, minus=-second, first=plus.voltage - minus.voltage - p.voltage, second=first - second,
                   supplied=-first * p.voltage)  # fmt: skip


class Undetermined(Cells):
    def law(p, plus, minus, first, second):
        return Law(plus=p.voltage / p.resistance, minus=-p.voltage / p.resistance, second=first - second,
                   first=plus.voltage - minus.voltage - p.voltage)  # fmt: skip


def test_an_unknown_flow_may_keep_the_potential_of_its_port():
    ask(Gas, "as_written", "energy", "settles")
    ask(Cells, "as_written", "balance", "energy", "settles")
    with pytest.raises(ContractError, match="energy is not accounted for"):
        ask(WrongGas, "energy")
    with pytest.raises(ContractError, match="the law does not determine its unknown first, second"):
        ask(Undetermined, "energy")


class Geared(Component):
    """Three ports that move as one, with a spring at one of them and a mass at another."""

    a, b, c = Translational(), Translational(), Rotational()
    stiffness, mass = Parameter("N/m", above=0), Parameter("kg", above=0)
    radius = Parameter("m", above=0)

    def law(p, a, b):
        return Law(a=p.stiffness * a.x, b=0, stored=p.stiffness * a.x**2 / 2 + p.mass * b.v**2 / 2)

    def inertia(p):
        return {"b": p.mass}

    def ties(p):
        return ("c", "b", p.radius, 0.1), ("a", "b", -2.0, 0.3)


class WrongGeared(Geared):
    def law(p, a, b):
        return Law(a=p.stiffness * a.x, b=0, stored=p.stiffness * b.x**2 / 2 + p.mass * b.v**2 / 2)


class PushedTie(Component):
    a, b = Translational(), Translational()
    push = Parameter("N")

    def law(p):
        return Law(a=p.push, b=0)

    def ties(p):
        return (("a", "b", 1.0, 0.0),)


def test_the_ledger_of_ports_that_are_tied_is_asked_at_motions_that_the_ties_allow():
    ask(Geared, "energy")
    for wrong in (WrongGeared, PushedTie):
        with pytest.raises(ContractError, match="energy is not accounted for"):
            ask(wrong, "energy")


class Conductor(Component):
    a, b, c = Thermal(), Thermal(), Thermal()
    one, other = Parameter("W/K", above=0), Parameter("W/K", above=0)

    def law(p, a, b, c):
        first, second = p.one * (a.temperature - b.temperature), p.other * (b.temperature - c.temperature)
        return Law(a=first, b=second - first, c=-second)


class Uphill(Conductor):
    def law(p, a, b, c):
        first, second = p.one * (b.temperature - a.temperature), p.other * (c.temperature - b.temperature)
        return Law(a=first, b=second - first, c=-second)


class UphillWhenOpen(Component):
    a, b = Thermal(), Thermal()
    conductance = Parameter("W/K", above=0)
    zones = Zones("shut", "open")

    @zone("shut")
    def shut(p):
        return 0, 0

    @zone("open")
    def leads(p, a, b):
        heat = p.conductance * (a.temperature - b.temperature)
        return -heat, heat

    @guard("shut", to="open", unit="K")
    def opens(p, a, b):
        return a.temperature - b.temperature

    @guard("open", to="shut", unit="K")
    def shuts(p, a, b):
        return b.temperature - a.temperature


class HeatPump(Component):
    """Moves heat at a rate of its own, from cold to hot as well."""

    a, b = Thermal(), Thermal()
    heat = Parameter("W", above=0)

    def law(p):
        return p.heat, -p.heat


def test_heat_that_only_flows_from_cold_to_hot_is_told():
    ask(Conductor, "dissipates")
    ask(HeatPump, "dissipates")
    for wrong in (Uphill, UphillWhenOpen):
        with pytest.raises(ContractError, match="heat flows from cold to hot"):
            ask(wrong, "dissipates")
