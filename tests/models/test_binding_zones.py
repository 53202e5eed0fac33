"""The zones of binding friction leave no gap and do not overlap (physics section 8, item 35; 1.7 and 1.10).

A contact is put at a random slip v, applied force af and normal force N, in a random zone, and its compiled
guards are followed until none has risen. Asked are

    that this ends, from every zone, however wrong that zone is;
    that it ends where physics says.

The printed law (`form: literal`) has no memory: v, af and N alone decide, so every zone leads to the same
one. The repaired law remembers on purpose, and where it does several zones are admissible:

    |v| < v_n and (1-h) F_s < |af| <= F_s   bound, if it was bound: it lets go only above F_s
                                            transit, if it was not: it binds only below (1-h) F_s
    |v| < v_n and af beyond stiction        break, if it was bound: friction keeps its full force until v_n
                                            transit, if it was not: it is driven through zero slip
    just below the end of the plateau       ramp, if it was there: it leads back at 0.99 of it
    |v| < v_n and |af| <= (1-h) F_s         bound; break, if it broke away and is still above half the border

What no memory can change: sliding at v_n and above, off without normal force, never two zones from one start.
"""

import functools
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as some

from fairlead.component.parameters import make
from fairlead.component.registry import known_types
from fairlead.testing.world import Instant, World

MU, CREEP, NORMAL = 0.5, 1e-4, 10.0
STICTION = MU * NORMAL
MASS_A, MASS_B = 3.0, 2.0
REDUCED = 1 / (1 / MASS_A + 1 / MASS_B)
V_N, V_M = 4 * CREEP, 2 * CREEP
HYSTERESIS = 0.1
# Closer than this to a border, rounding decides the side; relative to the border.
ROUNDING = 1e-6


@functools.cache
def contact(form: str) -> World:
    """A contact between two free bodies."""
    values = make(known_types(())["Contact"].members["binding"], form=form, normal_force=NORMAL, creep=CREEP, curve=MU)
    return World(values, {"a": MASS_A, "b": MASS_B})


FORMS = ("literal", "robust")
ZONES = tuple(known_types(())["Contact"].members["binding"].zones)


def instant(world: World, v: float, af: float, normal: float) -> Instant:
    """The contact at slip v, pulled by loads that it would have to carry af against."""
    keys = dict.fromkeys(world.structure.inputs, 0.0) | {"port:b:v": v, "in:normal": normal}
    # af = m_red (F_b/m_b - F_a/m_a), physics 1.6; all of it is put on b.
    loads = {"a": 0.0, "b": af * MASS_B / REDUCED}
    return Instant(keys, loads, tuple(0 for _ in range(world.structure.machines)))


def settled(form: str, v: float, af: float, normal: float, zone: str) -> str:
    """The zone that the guards lead to. Raises CircleError when they lead nowhere."""
    world = contact(form)
    return world.zone(world.settle(instant(world, v, af, normal), zone))


def near(value: float, border: float) -> bool:
    """Whether rounding may decide on which side of a border a value lies."""
    return abs(value - border) <= ROUNDING * max(abs(border), 1e-12)


speeds = some.one_of(
    some.floats(-2 * V_N, 2 * V_N), some.floats(-1.0, 1.0), some.sampled_from([0.0, V_M / 3, -V_M / 3, 1e-12])
)
forces = some.one_of(some.floats(-1.5 * STICTION, 1.5 * STICTION), some.floats(-100.0, 100.0), some.just(0.0))
normals = some.sampled_from([0.0, 1e-3, 1.0, NORMAL, 1e4])
zones = some.sampled_from(ZONES)


def literal_zone(v: float, af: float, normal: float) -> str:
    """The printed zones, physics 1.7; where the applied force is above stiction there is no sticking."""
    if normal <= 0:
        return "off"
    if abs(v) >= V_N:
        return "slide_forward" if v > 0 else "slide_backward"
    if abs(af) > MU * normal:
        return "transit"
    if abs(v) <= V_M:
        return "plateau"
    return "ramp_forward" if v > 0 else "ramp_backward"


@pytest.mark.slow
@settings(max_examples=400, deadline=None)
@given(v=speeds, af=forces, normal=normals, zone=zones)
def test_the_printed_law_has_one_zone_for_everything_and_forgets_the_old_one(
    v: float, af: float, normal: float, zone: str
) -> None:
    assume(not zone.startswith("break"))  # the printed law has no latch
    assume(not any(near(abs(v), border) for border in (V_M, V_N)) and not near(abs(af), MU * normal))
    assert settled("literal", v, af, normal, zone) == literal_zone(v, af, normal)


def robust_zones(v: float, af: float, normal: float, zone: str) -> set[str]:
    """Where the repaired law may end, from physics 1.10; the plateau ends where friction reaches F_s."""
    stiction = MU * normal
    border = stiction / (stiction / CREEP + stiction / V_N) if normal > 0 else 0.0
    ramp = "ramp_forward" if v > 0 else "ramp_backward"
    # A ramp leads back to the plateau a hundredth below the end of it.
    bound = "plateau" if abs(v) <= border * (0.99 if zone == ramp else 1) else ramp
    was_bound = zone == "plateau" or zone.startswith("ramp")
    ahead = "break_forward" if af > 0 else "break_backward"
    if normal <= 0:
        return {"off"}
    if abs(v) >= V_N:
        return {"slide_forward" if v > 0 else "slide_backward"}
    if zone.startswith("break"):
        d = +1 if zone == "break_forward" else -1
        if d * af < -stiction:
            return {"transit"}
        gives_up = abs(af) <= (1 - HYSTERESIS) * stiction and d * v <= border / 2
        return {bound} if gives_up else {zone}
    if abs(af) <= (1 - HYSTERESIS) * stiction:
        return {bound}
    if not was_bound:
        return {"transit"}
    if abs(af) <= stiction:
        return {bound}
    # Beyond stiction: on the plateau it breaks away. A ramp in the direction of the load is on its way to
    # sliding already; against it, it slows down to the plateau and breaks away from there.
    return {ahead} if bound == "plateau" else {ahead, bound}


@pytest.mark.slow
@settings(max_examples=400, deadline=None)
@given(v=speeds, af=forces, normal=normals, zone=zones)
def test_the_repaired_law_ends_in_one_zone_that_its_memory_admits(
    v: float, af: float, normal: float, zone: str
) -> None:
    end = STICTION / (STICTION / CREEP + STICTION / V_N)
    borders = (end, 0.99 * end, V_N)
    assume(not any(near(abs(v), border) or near(2 * abs(v), border) for border in borders))
    assume(not any(near(abs(af), share * MU * normal) for share in (1.0, 1 - HYSTERESIS)))
    assert settled("robust", v, af, normal, zone) in robust_zones(v, af, normal, zone)


@pytest.mark.slow
@settings(max_examples=200, deadline=None)
@given(v=speeds, af=forces, normal=normals)
@pytest.mark.parametrize("form", FORMS)
def test_some_zone_is_always_at_rest_and_sliding_ones_exclude_each_other(
    form: str, v: float, af: float, normal: float
) -> None:
    """Exhaustive: never nowhere to be. Exclusive: where |v| >= v_n or nothing presses, nowhere else to be.

    Except where the applied force is exactly at a border: both ways out of the wrong sliding zone stand at zero there.
    """
    assume(not any(near(abs(af), share * MU * normal) for share in (1.0, 1 - HYSTERESIS)) or normal == 0.0)
    ends = {settled(form, v, af, normal, zone) for zone in ZONES}
    assert ends
    if normal == 0.0 or abs(v) > V_N * (1 + ROUNDING):
        assert len(ends) == 1


@pytest.mark.parametrize("form", FORMS)
def test_equality_belongs_to_one_side(form: str) -> None:
    """At a border itself there is a zone, and settling ends: nothing toggles between the two sides."""
    for v in (0.0, V_N, -V_N, V_M, math.nextafter(V_N, 1), math.nextafter(V_N, 0)):
        for af in (0.0, STICTION, -STICTION, (1 - HYSTERESIS) * STICTION):
            for zone in ZONES:
                assert settled(form, v, af, NORMAL, zone) in ZONES


@pytest.mark.slow
def test_bound_friction_is_capped_at_stiction() -> None:
    """Hazard H2: uncapped it reaches 2.5 F_s while a block is caught, enough to break the next contact away."""
    greatest = {}
    for form in FORMS:
        world = contact(form)
        met = []
        for v in np.linspace(0, V_N, 2001)[:-1]:
            at = instant(world, float(v), 0.0, NORMAL)
            end = world.settle(at, "plateau")
            met.append(world.flows(end)["port:a"].real)
        greatest[form] = -min(met) / STICTION
    assert greatest["robust"] == pytest.approx(1.0, abs=1e-3)
    # With u = v/creep:  T/F_s = u (4 - u)/2 + u/4,  greatest at u = 2.25: 2.53125; sampled at 1/500 of u.
    assert greatest["literal"] == pytest.approx(2.25**2 / 2, abs=1e-5)


@pytest.mark.slow
def test_friction_opposes_slip_in_every_zone_but_the_latch() -> None:
    """T v >= 0. A latched break-away keeps the force of sliding while the slip is still that of creeping back."""
    rng = np.random.default_rng(3)
    for form in FORMS:
        world = contact(form)
        for _ in range(300):
            v, af = rng.normal() * 10 ** rng.uniform(-6, 0), rng.normal() * 20
            for zone in ZONES:
                end = world.settle(instant(world, v, af, NORMAL), zone)
                power = -world.flows(end)["port:a"].real * v
                if world.zone(end).startswith("break"):
                    assert power >= -STICTION * V_N
                else:
                    assert power >= 0.0, (form, world.zone(end))
