"""Friction is odd in slip: what the contract reverses with the motion, and how a class says that it is one-sided."""

import pytest

from fairlead.component import (
    Component,
    Hydraulic,
    Input,
    Law,
    Output,
    Parameter,
    State,
    Thermal,
    Translational,
    Zones,
    guard,
    tanh,
    zone,
)  # fmt: skip
from fairlead.testing import ContractError, checks


def ask(kind):
    """Ask whether friction is odd."""
    next(check for check in checks(kind) if check.name == "odd")()


class Remembering(Component):
    """The normal force that counts follows the signal with a lag; it does not turn round with the motion."""

    a, b = Translational(), Translational()
    normal = Input("N")
    lag, coefficient, near = Parameter("s", above=0), Parameter("1", above=0), Parameter("m/s", above=0)
    load = State("N")
    slip = Output("m/s")

    def law(p, a, b, normal, load):
        slip = b.v - a.v
        force = p.coefficient * load * tanh(slip / p.near)
        return Law(a=-force, b=force, load=(normal - load) / p.lag, slip=slip, dissipated=force * slip)


class Wearing(Component):
    """The level grows with the way that was rubbed, in either direction."""

    a, b = Translational(), Translational()
    level, growth, near = Parameter("N", above=0), Parameter("N/m", above=0), Parameter("m/s", above=0)
    worn = State("m")
    slip = Output("m/s")

    def law(p, a, b, worn):
        slip = b.v - a.v
        force = (p.level + p.growth * worn) * tanh(slip / p.near)
        return Law(a=-force, b=force, worn=slip * tanh(slip / p.near), slip=slip, dissipated=force * slip)


class WearingOneWay(Wearing):
    def law(p, a, b, worn):
        slip = b.v - a.v
        force = (p.level + p.growth * worn) * tanh(slip / p.near)
        return Law(a=-force, b=force, worn=slip, slip=slip, dissipated=force * slip)


class PressedByOil(Component):
    """Oil presses the plates, and they rub less when they are warm."""

    a, b, oil, plates = Translational(), Translational(), Hydraulic(), Thermal()
    area, per_kelvin, near = Parameter("m^2", above=0), Parameter("1/K", above=0), Parameter("m/s", above=0)
    slip = Output("m/s")

    def law(p, a, b, oil, plates):
        slip = b.v - a.v
        force = p.per_kelvin * plates.temperature * p.area * oil.pressure * tanh(slip / p.near)
        return Law(a=-force, b=force, oil=0, plates=-force * slip, slip=slip, dissipated=force * slip)


class OnBelt(Component):
    """The speed of the belt is a signal."""

    b = Translational()
    drag, more = Parameter("N*s/m", above=0), Parameter("N*s^3/m^3", above=0)
    speed = Input("m/s", signed=True)
    slip = Output("m/s")

    def law(p, b, speed):
        slip = b.v - speed
        return Law(b=p.drag * slip + p.more * slip**3, slip=slip)


class Unpaired(Component):
    """Its two zones are not declared as a pair."""

    a, b = Translational(), Translational()
    drag = Parameter("N*s^2/m^2", above=0)
    slip = Output("m/s")
    zones = Zones("up", "down")

    @zone("up")
    def up(p, a, b):
        return Law(a=-p.drag * (b.v - a.v) ** 2, b=p.drag * (b.v - a.v) ** 2, slip=b.v - a.v)

    @zone("down")
    def down(p, a, b):
        return Law(a=p.drag * (b.v - a.v) ** 2, b=-p.drag * (b.v - a.v) ** 2, slip=b.v - a.v)

    @guard("up", to="down", unit="m/s")
    def reverses(p, a, b):
        return a.v - b.v

    @guard("down", to="up", unit="m/s")
    def comes_back(p, a, b):
        return b.v - a.v


class Lopsided(Unpaired):
    @zone("down")
    def down(p, a, b):
        return Law(a=2 * p.drag * (b.v - a.v) ** 2, b=-2 * p.drag * (b.v - a.v) ** 2, slip=b.v - a.v)


class SaysSo(Lopsided):
    exempt = {"odd": "It brakes harder on the way back."}


@pytest.mark.parametrize("kind", [Remembering, Wearing, PressedByOil, OnBelt, Unpaired, SaysSo])
def test_friction_is_odd_if_some_of_its_quantities_do_not_turn_round_with_the_motion(kind):
    ask(kind)


@pytest.mark.parametrize("kind", [WearingOneWay, Lopsided])
def test_one_sided_friction_is_told_how_to_say_so(kind):
    with pytest.raises(ContractError, match=r'friction is odd in slip. .* say so: exempt = {"odd": "why"}'):
        ask(kind)
