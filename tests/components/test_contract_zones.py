"""Zones in the contract: circles of them, zones that nothing leads to, and guards that cannot fire."""

import pathlib
import re
import warnings

import pytest

from fairlead.component import (
    Component,
    Discrete,
    Input,
    Law,
    Output,
    Parameter,
    State,
    Translational,
    Unknown,
    Zones,
    guard,
    hold,
    sampled,
    sqrt,
    zone,
)  # fmt: skip
from fairlead.testing import ContractError, ContractRemark, checks, contract
from fairlead.testing.properties import PROPERTIES
from fairlead.testing.world import circle_of


@pytest.mark.parametrize(("path", "once"), [
    (["off", "on"] * 30, "off -> on -> off"),
    (["held", "off", "on", "off", "on", "off"], "off -> on -> off"),
    (["x", "a", "b", "b", "c", "a", "b", "c", "c", "a", "b", "c"], "a -> b -> c -> a"),
    (["a", "b", "a", "c", "a", "b", "a", "c"], "a -> b -> a -> c -> a"),
])  # fmt: skip
def test_a_circle_of_zones_is_told_once_round_from_where_it_is_entered(path, once):
    assert circle_of(path) == once


def ask(kind, *names):
    """Ask some properties of a class."""
    for check in checks(kind):
        if check.name in names:
            check()


class Stop(Component):
    """Pushes when b comes closer to a than `reach`."""

    a, b = Translational(), Translational()
    stiffness, reach = Parameter("N/m", above=0), Parameter("m", least=0)
    push = Output("N")
    zones = Zones("apart", "touching")

    @zone("apart")
    def apart(p, a, b):
        return Law(a=0, b=0, push=0)

    @zone("touching")
    def touching(p, a, b):
        push = p.stiffness * (a.x + p.reach - b.x)
        return Law(a=push, b=-push, push=push, stored=push**2 / (2 * p.stiffness))

    @guard("apart", to="touching", unit="m")
    def meets(p, a, b):
        return a.x + p.reach - b.x

    @guard("touching", to="apart", unit="m")
    def parts(p, a, b):
        return b.x - a.x - p.reach


class MeetsNever(Stop):
    @guard("apart", to="touching", unit="m")
    def meets(p, a, b):
        return -sqrt((a.x - b.x) ** 2 + p.reach**2)


class MeetsByConstant(Stop):
    @guard("apart", to="touching", unit="m")
    def meets(p):
        return -p.reach - 1


class PartsNever(Stop):
    @guard("touching", to="apart", unit="m")
    def parts(p, a, b):
        return -abs(b.x - a.x)


class Dead(Stop):
    zones = Zones("apart", "touching", "dead")

    @zone("dead")
    def dead(p):
        return 0, 0


class Island(Dead):
    zones = Zones("apart", "touching", "dead", "lost")

    @zone("dead", "lost")
    def dead(p):
        return 0, 0

    @guard("dead", to="lost", unit="m/s")
    def loses(p, a):
        return a.v

    @guard("lost", to="dead", unit="m/s")
    def finds(p, a):
        return -a.v


class SameMirror(Component):
    """A gap whose mirrored guard equals the guard."""

    a, b = Translational(), Translational()
    stiffness, play = Parameter("N/m", above=0), Parameter("m", least=0)
    zones = Zones("free", "ahead", "astern", forward=["ahead"], backward=["astern"])

    @zone("free")
    def free(p):
        return 0, 0

    @zone("ahead", "astern")
    def beyond(p, a, b, direction):
        pull = p.stiffness * (b.x - a.x - direction * p.play)
        return Law(a=-pull, b=pull, stored=pull**2 / (2 * p.stiffness))

    @guard("free", to="ahead", unit="m", mirrored="meets_astern")
    def meets(p, a, b, direction):
        return direction**2 * (b.x - a.x) - p.play

    @guard("ahead", to="free", unit="m", mirrored="parts_astern")
    def parts(p, a, b, direction):
        return p.play - direction * (b.x - a.x)


class Shadowed(Dead):
    """A guard that another one, written before it, is always ahead of."""

    @guard("touching", to="dead", unit="m")
    def lets_go(p, a, b):
        return 2 * (b.x - a.x - p.reach)


@pytest.mark.parametrize(("kind", "says"), [
    (MeetsNever, "no guard leads to zone touching from zone apart, in which it begins: meets did not rise"),
    (MeetsByConstant, "no guard leads to zone touching from zone apart, in which it begins: meets did not rise"),
    (PartsNever, "guard parts can never fire in zone touching"),
    (Dead, "no guard leads to zone dead from zone apart, in which it begins"),
    (Island, "no guard leads to zone dead, lost from zone apart, in which it begins"),
    (SameMirror, "no guard leads to zone astern from zone free, in which it begins: meets_astern did not rise"),
    (Shadowed, "no guard leads to zone dead from zone apart, in which it begins: lets_go did not rise"),
])  # fmt: skip
def test_a_zone_that_nothing_leads_to_and_a_guard_that_never_fires_are_told(kind, says):
    with pytest.raises(ContractError, match=says):
        ask(kind, "zones_reached")


class Fuse(Component):
    """Melts far above what is drawn at random; what tears it may be left out."""

    a, b = Translational(), Translational()
    stiffness, melting = Parameter("N/m", above=0), Parameter("K", default=5000.0, above=0)
    lag, strength = Parameter("s", above=0), Parameter("N", default=None, above=0)
    heat, warm = Input("K", 300.0), State("K", least=0.0)
    zones = Zones("whole", "molten", "torn")

    @zone("whole")
    def whole(p, a, b, warm, heat):
        pull = p.stiffness * (b.x - a.x)
        return Law(a=-pull, b=pull, warm=(heat - warm) / p.lag, stored=pull**2 / (2 * p.stiffness))

    @zone("molten", "torn")
    def gone(p, warm):
        return Law(a=0, b=0, warm=0)

    @guard("whole", to="molten", unit="K")
    def melts(p, warm):
        return warm - p.melting

    @guard("whole", to="torn", unit="N")
    def tears(p, a, b):
        return None if p.strength is None else p.stiffness * (b.x - a.x) - p.strength


class Trap(Component):
    """Snaps in a window of 0.1 mm, far from where bodies are drawn; it never lets go."""

    a = Translational()
    drag, place = Parameter("N*s/m", above=0), Parameter("m", default=7.0, above=0)
    width = Parameter("m", default=1e-4, above=0)
    zones = Zones("free", "snapped")

    @zone("free")
    def free(p, a):
        return Law(a=p.drag * a.v, dissipated=p.drag * a.v**2)

    @zone("snapped")
    def snapped(p, a):
        return 0

    @guard("free", to="snapped", unit="m")
    def snaps(p, a):
        return a.x - p.place, p.place + p.width - a.x


class BegunInside(Stop):
    """It begins in the zone to which no guard leads."""

    zones = Zones("apart", "touching", "new")

    @zone("new")
    def new(p):
        return Law(a=0, b=0, push=0)

    def begins_in(p):
        return "new"

    @guard("new", to="apart", unit="m/s")
    def starts(p, a, b):
        return b.v - a.v


class Sampling(Component):
    """It pushes while the last sample is above a level."""

    a = Translational()
    period, level = Parameter("s", above=0), Parameter("m", above=0)
    push, seen = Parameter("N"), Discrete("m")
    zones = Zones("off", "on")

    @zone("off")
    def off(p):
        return 0

    @zone("on")
    def on(p, a):
        return Law(a=p.push, supplied=-p.push * a.v)

    @sampled(every="period")
    def sample(p, a):
        return Law(seen=a.x)

    @guard("off", to="on", unit="m")
    def rises(p, seen):
        return seen - p.level

    @guard("on", to="off", unit="m")
    def falls(p, seen):
        return p.level / 2 - seen


class Timed(Component):
    """It pushes from an hour on."""

    a = Translational()
    push, instant = Parameter("N"), Parameter("s", default=3600.0, above=0)
    zones = Zones("off", "on")

    @zone("off")
    def off(p):
        return 0

    @zone("on")
    def on(p, a):
        return Law(a=p.push, supplied=-p.push * a.v)

    @guard("off", to="on", unit="s")
    def begins(p, t):
        return t - p.instant


@pytest.mark.parametrize("kind", [Stop, Fuse, Trap, BegunInside, Sampling, Timed])
def test_zones_that_are_met_rarely_are_no_mistake(kind):
    ask(kind, "zones_reached", "settles")


class Pad(Component):
    """Set-valued friction that breaks away at `stiction` and slides with `level`."""

    a, b = Translational(), Translational()
    level, near = Parameter("N", above=0), Parameter("m/s", default=1e-7, above=0)
    force = Unknown("N")
    zones = Zones("held", "forward", "backward", forward=["forward"], backward=["backward"])

    @zone("held")
    def held(p, a, b, force):
        return Law(a=-force, b=force, force=hold(b.v - a.v, within=p.near), dissipated=force * (b.v - a.v))

    @zone("forward", "backward")
    def slides(p, a, b, force, direction):
        friction = direction * p.level
        return Law(a=-friction, b=friction, force=force - friction, dissipated=friction * (b.v - a.v))

    @guard("held", to="forward", unit="m/s", mirrored="torn_back")
    def torn(p, a, b, direction):
        return direction * (b.v - a.v) - p.near

    @guard("held", to="forward", unit="N", mirrored="breaks_back")
    def breaks(p, force, direction):
        return direction * force - p.level

    @guard("forward", to="held", unit="m/s", mirrored="stops_back")
    def stops(p, a, b, direction):
        return -direction * (b.v - a.v)


class BreaksLow(Pad):
    @guard("held", to="forward", unit="N", mirrored="breaks_back")
    def breaks(p, force, direction):
        return direction * force - 0.9 * p.level


class BreaksBack(Pad):
    @guard("held", to="backward", unit="N", mirrored="breaks_back")
    def breaks(p, force, direction):
        return direction * force - p.level


class TurnsAtOnce(Pad):
    @guard("forward", to="backward", unit="m/s", mirrored="stops_back")
    def stops(p, a, b, direction):
        return -direction * (b.v - a.v)


class NoRest(Component):
    """The sign of the slip chooses between two forces, and there is no zone for rest."""

    a, b = Translational(), Translational()
    level = Parameter("N", above=0)
    zones = Zones("forward", "backward", forward=["forward"], backward=["backward"])

    @zone("forward", "backward")
    def slides(p, a, b, direction):
        friction = direction * p.level
        return Law(a=-friction, b=friction, dissipated=friction * (b.v - a.v))

    @guard("forward", to="backward", unit="m/s", mirrored="turns_back")
    def turns(p, a, b, direction):
        return -direction * (b.v - a.v)


class SaysSo(NoRest):
    can_hold = False


@pytest.mark.parametrize(("kind", "circle"), [
    (BreaksLow, "ward -> held -> (for|back)ward"),
    (BreaksBack, "held -> backward -> held"),
    (TurnsAtOnce, "forward -> backward -> forward"),
    (NoRest, "forward -> backward -> forward"),
])  # fmt: skip
def test_friction_that_cannot_come_to_rest_is_told(kind, circle):
    with pytest.raises(ContractError, match=f"at this border its zones do not settle, .* in a circle: .*{circle}"):
        ask(kind, "settles")


class HoldsAll(Pad):
    @guard("held", to="forward", unit="m/s", mirrored="breaks_back")
    def breaks(p, a, b, direction):
        return direction * (b.v - a.v) - 2 * p.near


def test_friction_that_slides_and_holds_any_load_is_told():
    with pytest.raises(ContractError, match="HoldsAll in zone held: it holds any load, and slides with a limited"):
        ask(HoldsAll, "zones_reached")


@pytest.mark.parametrize("kind", [Pad, SaysSo])
def test_friction_that_comes_to_rest_or_says_that_it_cannot_passes(kind):
    ask(kind, "settles", "zones_reached")


def test_an_output_that_one_zone_leaves_out_is_remarked():
    class Silent(Stop):
        @zone("apart")
        def apart(p, a, b):
            return 0, 0

    with pytest.warns(ContractRemark, match="the law of zone apart does not give the output push, which is 0 there"):
        contract(Silent)
    with warnings.catch_warnings():
        warnings.simplefilter("error", ContractRemark)
        contract(Stop)


def test_the_page_has_a_row_for_every_property_that_exempt_may_name():
    page = (pathlib.Path(__file__).parents[2] / "docs" / "components.md").read_text(encoding="utf-8")
    section = page.partition("## Does it keep the contract?")[2]
    assert re.findall(r"^\| `(\w+)` \|", section, re.MULTILINE) == list(PROPERTIES)
