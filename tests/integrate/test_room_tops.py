"""Tops of guards between the ends of a step: cubics, parabolas and tangents by hand, and a search against a scan."""

from __future__ import annotations

import functools

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from tests.integrate.rooms import entry, fields, memory, room

NEAR = 2.0**-10


def next_place(at, *given):
    return room("events.bumps.next_place", (), "ddddddd", "d")(at, *given)


def bump(at, h):
    return room("events.bumps.find_earliest_bump", ("",), "d", "d")(at, h)


def edge(at, h, before):
    return room("events.edges.find_edge", ("",), "dd", "d")(at, h, before)


@functools.cache
def pair(name, kinds):
    """call(memory, ..., out): both results of a function of `bumps` into out[0], out[1]."""
    from fairlead.integrate.events import bumps
    from fairlead.integrate.memory.foreign import compiled, reals

    function = getattr(bumps, name)

    @compiled
    def both(a, b, c, d, out):
        found = reals(out, 2)
        found[0], found[1] = function(a, b, c, d)

    both.__qualname__ = f"both of {name}"  # by which the code is kept
    return entry(both, (), kinds + "i")


@pytest.mark.parametrize("seed", range(40))
def test_the_top_of_the_cubic_of_a_guard_is_where_its_derivative_falls_through_zero(seed):
    g0, g1, s0, s1 = np.random.default_rng(seed).normal(size=4)
    spline = CubicHermiteSpline([0.0, 1.0], [g0, g1], [s0, s1])
    slope, bend = spline.derivative(), spline.derivative(2)
    tops = [x for x in slope.roots(extrapolate=False) if 0.0 < x < 1.0 and bend(x) < 0.0]
    found = np.zeros(2)
    pair("hermite_top", "dddd")(memory(), g0, g1, s0, s1, found)
    place = tops[0] if tops else 1.0
    assert found[0] == pytest.approx(place, abs=1e-9)
    assert found[1] == pytest.approx(float(spline(place)), abs=1e-9)


@pytest.mark.parametrize("seed", range(10))
def test_a_parabola_that_leaves_an_end_by_its_slope_and_comes_down_to_a_value_has_its_top_in_between(seed):
    rng = np.random.default_rng(seed)
    g, slope, way = rng.normal(), rng.uniform(0.1, 3.0), rng.uniform(0.1, 1.0)
    value = g - rng.uniform(0.0, 2.0)
    curve = (value - g - slope * way) / way**2
    found = np.zeros(2)
    pair("top_after_end", "dddd")(memory(), g, slope, value, way, found)
    assert found == pytest.approx([-slope / (2 * curve), -(slope**2) / (4 * curve)], rel=1e-12)


@pytest.mark.parametrize(("slope", "value"), [(1.0, 0.1), (0.0, -1.0), (-1.0, -1.0)])
def test_an_end_that_is_left_downwards_or_below_what_follows_promises_no_top(slope, value):
    found = np.zeros(2)
    pair("top_after_end", "dddd")(memory(), 0.0, slope, value, 1.0, found)
    assert found.tolist() == [0.0, -np.inf]


@pytest.mark.parametrize("seed", range(20))
def test_the_next_place_is_the_top_of_the_parabola_through_three_unless_as_much_again_stays_below_the_floor(seed):
    rng = np.random.default_rng(seed)
    a, x, b = np.sort(rng.uniform(0, 1, 3))
    gx = -rng.uniform(0.0, 1.0)
    ga, gb = gx - rng.uniform(0.1, 1.0, 2)
    curve, line, constant = np.polyfit([a, x, b], [ga, gx, gb], 2)
    top = -line / (2 * curve)
    height = constant - line**2 / (4 * curve)
    inside = a + 0.1 * (x - a) <= top <= b - 0.1 * (b - x) and abs(top - x) > 1e-3 * (b - a)
    above, below = gx + 2 * (height - gx) - 1e-9, gx + 2 * (height - gx) + 1e-9
    assert next_place(memory(), a, ga, x, gx, b, gb, below) == 1.0
    if inside:
        assert next_place(memory(), a, ga, x, gx, b, gb, above) == pytest.approx(top, rel=1e-6)


def searched(find, guards, *arguments, least=0):
    """What a search finds over a step in which the one unknown goes from 0 to 1, and how often it asked."""
    n = len(guards)

    def values(_t, y, g):
        g[:] = [one(y[0]) for one in guards]

    def at(s):
        return [one(s) for one in guards]

    scratch = {name: np.zeros(n) for name in (
        "g_probe", "g_late", "g_later", "fired", "bump_left", "bump_left_g", "bump_top", "bump_top_g", "bump_right",
        "bump_right_g", "bump_asks", "bump_rise", "bump_fall", "bump_guard", "bump_places")}  # fmt: skip
    made = memory(
        {"n": 1, "n_guards": n, "t_release": 1e308}, y=[0.0], y_end=[1.0], D=np.zeros(3), y_probe=[0.0], g=at(0.0),
        g_early=at(NEAR), g_end=at(1.0), guard_tolerance=np.full(n, 1e-9), guard_machine=np.full(n, -1),
        least_guard=np.full(n, least), **scratch,
    )  # fmt: skip
    kept = fields(made, 1, guards=(values, n))
    made.array["g_late"][:] = at(1.0 - NEAR)
    place = find(made, 1.0, *arguments)
    assert kept
    return place, int(made.number["guards"])


def hump(centre, height, lean):
    """A guard with its only top inside the step, steeper on one side; a quartic, which no cubic is."""
    return lambda s: height - 3.0 * (s - centre) ** 2 * (1.0 + lean * (s - centre) + 0.5 * (s - centre) ** 2)


@pytest.mark.parametrize("height", [1e-3, 0.03, 0.2])
@pytest.mark.parametrize("centre", [0.3, 0.5, 0.7])
@pytest.mark.parametrize("lean", [-0.9, 0.0, 0.9])
def test_a_guard_that_is_above_zero_inside_a_step_is_found_where_it_is(height, centre, lean):
    guard = hump(centre, height, lean)
    assert max(guard(0.0), guard(1.0)) < 0.0
    place, asked = searched(bump, [guard])
    assert guard(place) >= 0.0
    assert asked <= 6  # the one before the end, and a few on the way to the top: parabolas close in fast


def test_of_humps_anywhere_some_five_in_six_are_found_with_a_few_evaluations():
    """Early or late, broad or narrow, nearly zero at the top. The others are given up: their ends tell too little."""
    rng, found, evaluations = np.random.default_rng(0), 0, 0
    for _ in range(300):
        middle, width, height = rng.uniform(0.15, 0.85), rng.uniform(0.1, 0.4), rng.uniform(1e-3, 0.05)
        place, asked = searched(bump, [lambda s: height - np.expm1(0.5 * ((s - middle) / width) ** 2)])  # noqa: B023
        found, evaluations = found + (place < 1.0), evaluations + asked - 1
    assert found >= 240
    assert evaluations <= 3 * 300


@pytest.mark.parametrize("seed", range(10))
def test_of_many_guards_the_first_place_found_is_above_zero_and_none_is_found_where_none_is(seed):
    rng = np.random.default_rng(seed)
    high = [hump(rng.uniform(0.35, 0.65), rng.uniform(0.001, 0.2), rng.uniform(-0.9, 0.9)) for _ in range(3)]
    low = [hump(rng.uniform(0.35, 0.65), -rng.uniform(0.01, 0.5), rng.uniform(-0.9, 0.9)) for _ in range(3)]
    place, _ = searched(bump, [*low, *high])
    assert max(one(place) for one in high) >= 0.0
    assert searched(bump, low)[0] == 1.0


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("above", [True, False])
def test_the_edge_where_two_straight_values_meet_is_found_with_the_first_place_asked(seed, above):
    rng = np.random.default_rng(seed)
    edge_at, height = rng.uniform(0.1, 0.9), (1 if above else -1) * rng.uniform(0.05, 0.2)
    up, down = rng.uniform(2.5, 5.0) / edge_at, rng.uniform(2.5, 5.0) / (1.0 - edge_at)

    def least(s):
        return min(height + up * (s - edge_at), height - down * (s - edge_at))

    place, asked = searched(edge, [least], 1.0, least=1)
    if above:
        assert place == pytest.approx(edge_at, abs=2e-3)
        assert least(place) >= 0.0
        assert asked == 1
    else:
        assert place == 1.0


@pytest.mark.parametrize("seed", range(10))
def test_an_edge_of_curved_values_is_found_wherever_a_scan_finds_it_well_above_zero(seed):
    rng = np.random.default_rng(seed)
    edge_at, height = rng.uniform(0.3, 0.7), rng.uniform(0.02, 0.2)
    bends = rng.uniform(-4.0, 0.0, 2)

    def least(s):
        d = s - edge_at
        return min(height + 4.0 * d + bends[0] * d * d, height - 4.0 * d + bends[1] * d * d)

    assert max(least(s) for s in np.linspace(0, 1, 501)) > 0.0
    place, _ = searched(edge, [least], 1.0, least=1)
    assert least(place) >= 0.0


def test_an_edge_is_looked_for_only_of_a_least_of_several_values_and_before_what_was_found():
    def least(s):
        return 0.1 - 4.0 * abs(s - 0.5)

    assert searched(edge, [least], 1.0, least=0)[0] == 1.0
    assert searched(edge, [least], 0.25, least=1)[0] == 0.25
