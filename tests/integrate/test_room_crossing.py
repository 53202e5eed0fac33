"""The room `events`: where in a step a guard fires, how long the next step is, and what grows from rest."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

from fairlead.integrate.codes import DONE
from fairlead.integrate.linear import ordering
from tests.integrate.rooms import entry, fields, memory
from tests.integrate.test_linear import memory_for
from tests.integrate.test_room_linear import algebraic

NONE, CROSSING, INCONSISTENT_START = 0, 1, 2
NEVER = 1e308
BUMPS = ("left", "left_g", "top", "top_g", "right", "right_g", "asks", "rise", "fall", "guard", "places")


@functools.cache
def crossed():
    """call(memory, h) -> what `find_first_crossing` says."""
    from fairlead.integrate.events.crossing import find_first_crossing

    return entry(find_first_crossing, ("",), "d", "i")


@functools.cache
def proposed():
    from fairlead.integrate.events.pace import propose

    return entry(propose, ("run", "point"), "", "d")


@functools.cache
def short():
    from fairlead.integrate.events.growth import shorten_for_growth

    return entry(shorten_for_growth, ("run", "point"), "d", "d")


@functools.cache
def grown():
    """call(memory): `watch_growth` with the factors of the consistent point."""
    from fairlead.integrate.events.growth import watch_growth
    from fairlead.integrate.linear.systems import assemble_consistent, factorise_dense
    from fairlead.integrate.memory.foreign import compiled

    @compiled
    def watch(m):
        assemble_consistent(m.linear)
        if factorise_dense(m.linear.factors) == DONE:
            watch_growth(m)

    return entry(watch, ("",))


def step_of(*guards, tolerance=1e-9):
    """A trial step from t = 0 to 1 in which y = theta, with these guards of y; and what must be kept."""
    count = len(guards)
    given = {"g_left": [f(0.0) for f in guards], "g_right": [f(1.0) for f in guards], "g": [f(0.0) for f in guards]}
    others = {name: np.zeros(count) for name in ("g_probe", "g_early", "g_late", "g_since", "g_end", "g_later")}
    others |= {f"bump_{of}": np.zeros(count) for of in BUMPS}
    at = memory(
        {"n": 1, "n_guards": count, "h": 1.0, "t_release": np.inf}, y=[0.0], y_end=[1.0], D=np.zeros(3),
        y_probe=[0.0], guard_tolerance=[tolerance] * count, guard_machine=[-1] * count, fired=[0] * count,
        **given, **others,
    )  # fmt: skip

    def evaluate(_t, y, out):
        out[:] = [f(y[0]) for f in guards]

    return at, fields(at, 1, guards=(evaluate, count))


def cubic(root, rng):
    """A cubic that rises through this root alone, steep or flat."""
    a, b, size = rng.uniform(0, 1), 10.0 ** rng.uniform(-3, 1), 10.0 ** rng.uniform(-6, 6)
    return lambda y: size * (y - root) * ((y - a) ** 2 + b)


@pytest.mark.parametrize("seed", range(10))
def test_the_root_of_a_cubic_guard_is_found_to_rounding_in_fewer_evaluations_than_halving_takes(seed):
    rng = np.random.default_rng(seed)
    root = rng.uniform(0.01, 0.99)
    guard = cubic(root, rng)
    at, kept = step_of(guard)
    assert crossed()(at, 1.0) == CROSSING
    theta = float(at.number["cut_at"])
    assert theta == pytest.approx(root, abs=1e-15)
    assert guard(theta) >= 0.0  # the end of the bracket on which it has fired
    assert at.number["guards"] < -math.log2(4e-16)
    assert kept


@pytest.mark.parametrize("seed", range(10))
def test_of_several_guards_the_first_is_found_and_it_alone_fires(seed):
    rng = np.random.default_rng(seed)
    roots = rng.uniform(0.05, 0.95, 4)
    at, _kept = step_of(*(cubic(root, rng) for root in roots), lambda _y: -1.0)
    assert crossed()(at, 1.0) == CROSSING
    assert at.number["cut_at"] == pytest.approx(roots.min(), abs=1e-15)
    assert at.array["fired"][: int(at.number["n_fired"])].tolist() == [roots.argmin()]


@pytest.mark.parametrize("width", [0.3, 0.03])
@pytest.mark.parametrize("middle", [0.4, 0.5, 0.7])
def test_a_guard_that_rises_above_zero_and_falls_again_inside_fires_where_it_rose(width, middle):
    at, _kept = step_of(lambda y: width**2 - (y - middle) ** 2)
    assert crossed()(at, 1.0) == CROSSING
    assert at.number["cut_at"] == pytest.approx(middle - width, abs=1e-14)


@pytest.mark.parametrize("below", [1e-3, 0.1])
def test_a_guard_that_comes_near_and_turns_does_not_fire(below):
    at, _kept = step_of(lambda y: -below - (y - 0.5) ** 2)
    assert crossed()(at, 1.0) == NONE


def hump(rng, height):
    """A smooth guard below zero at both ends whose top has this height: one hump that the ends tell of."""
    middle, width, size = rng.uniform(0.3, 0.7), rng.uniform(0.2, 0.4), 10.0 ** rng.uniform(-6, 6)
    return lambda y: size * (height - np.expm1(0.5 * ((y - middle) / width) ** 2))


@pytest.mark.parametrize("seed", range(40))
def test_of_many_humps_the_first_that_reaches_zero_is_found_whatever_their_order(seed):
    rng = np.random.default_rng(seed)
    guards = [hump(rng, height) for height in (*rng.uniform(1e-3, 0.05, 3), *rng.uniform(-0.3, -1e-3, 20))]
    grid = np.linspace(0.0, 1.0, 200001)
    reached = [grid[guard(grid) >= 0.0] for guard in guards]
    first = min(places[0] for places in reached if places.size)
    for order in (np.arange(23), rng.permutation(23)):
        at, _kept = step_of(*(guards[k] for k in order))
        assert crossed()(at, 1.0) == CROSSING
        assert at.number["cut_at"] == pytest.approx(first, abs=6e-6)
        fired = at.array["fired"][: int(at.number["n_fired"])]
        assert [reached[order[i]][0] for i in fired] == [first]


@pytest.mark.parametrize("many", [10, 100])
def test_humps_that_lie_side_by_side_are_followed_with_the_same_evaluations(many):
    """Their tops lie between 0.4 and 0.6. Three evaluations are for the ends."""

    def evaluations(count):
        at, _kept = step_of(*(
            lambda y, middle=middle: -0.02 - (y - middle) ** 2 * (1.0 + y) for middle in np.linspace(0.4, 0.6, count)
        ))  # fmt: skip
        assert crossed()(at, 1.0) == NONE
        return int(at.number["guards"]) - 3

    assert evaluations(many) <= 3 * evaluations(1)


@pytest.mark.parametrize("late", [False, True])
def test_a_hump_beside_an_end_that_the_cubic_looks_for_in_the_middle_is_found(late):
    """It leaves -1e-3 with the slope that the cubic takes from there to a third; its own top is at a twentieth."""

    def guard(y):
        y = 1.0 - y if late else y
        return -1e-3 + 0.1 * y * math.exp(-y / 0.05) - 0.3 * y**4

    at, _kept = step_of(guard)
    assert crossed()(at, 1.0) == CROSSING
    assert guard(float(at.number["cut_at"])) == pytest.approx(0.0, abs=1e-15)


def test_a_guard_that_leaves_zero_downwards_and_comes_back_fires_where_it_comes_back():
    at, _kept = step_of(lambda y: y * (y - 0.25))
    assert crossed()(at, 1.0) == CROSSING
    assert at.number["cut_at"] == pytest.approx(0.25, abs=1e-15)


@pytest.mark.parametrize("end", [1e-6, 1.0, 1e6])
@pytest.mark.parametrize("start", [1e-6, 1e-4])
def test_where_rounding_has_a_guard_above_zero_before_it_dips_is_not_where_it_comes_back(start, end):
    """A place that a stop was met at, to the last digit: it shows 5e-17 for a while, and is below zero until 0.7."""
    at, _kept = step_of(lambda y: 5e-17 if y < start else (-1e-9 if y < 0.7 else end), tolerance=1e-9)
    assert crossed()(at, 1.0) == CROSSING
    assert at.number["cut_at"] == pytest.approx(0.7, abs=1e-14)


def test_a_guard_that_leaves_zero_upwards_says_that_the_zones_were_wrong():
    at, _kept = step_of(lambda y: y, lambda y: y - 0.5)
    assert crossed()(at, 1.0) == INCONSISTENT_START
    assert at.array["fired"][: int(at.number["n_fired"])].tolist() == [0]


@pytest.mark.parametrize("adaptive", [0, 1])
@pytest.mark.parametrize("seed", range(5))
def test_steps_land_on_every_time_event_and_on_the_stop_and_leave_no_sliver_before_one(seed, adaptive):
    rng = np.random.default_rng(seed)
    stop, wanted, longest = 10.0, rng.uniform(0.05, 0.5), 0.3
    events = [*np.sort(rng.uniform(0, stop, 6)), NEVER]
    release = rng.uniform(0, stop)
    at = memory({"stop": stop, "adaptive": adaptive, "h_next": wanted, "max_step": longest, "t_release": release})
    t, met, usual = 0.0, [], min(wanted, longest)
    while t < stop:
        at.number["t"], at.number["t_next"] = t, min(event for event in events if event > t)
        at.number["t_release"] = release if t < release else NEVER
        land = min(stop, at.number["t_next"], at.number["t_release"])
        h = proposed()(at)
        assert 0.0 < h <= max(usual, 0.0) / 0.98
        if at.number["landing"]:
            assert t + h == pytest.approx(land, rel=1e-15)
            t = land
            met.append(t)
        else:
            t += h
            assert t < land
            assert not adaptive or land - t >= 0.5 * h - 1e-12  # what is left is no sliver
    assert met == sorted({*events[:-1], release, stop})


def test_what_grows_from_rest_shortens_steps_for_its_time_and_until_the_error_sees_it():
    given = {"growth": 50.0, "t_growth": 1.0, "last_error": 1e-4}
    assert short()(memory({**given, "t": 0.5}), 1.0) == pytest.approx(1.0 / 50.0, rel=1e-3)
    assert short()(memory({**given, "t": 0.5}), 1e-3) == 1e-3
    assert short()(memory({**given, "t": 1.5}), 1.0) == 1.0
    assert short()(memory({**given, "t": 0.5, "last_error": 0.5}), 1.0) == 1.0
    assert short()(memory({"t": 0.5}), 1.0) == 1.0


@pytest.mark.parametrize("falls", [True, False])
@pytest.mark.parametrize("seed", range(4))
def test_a_slip_grows_from_rest_by_the_slope_of_its_friction_over_its_inertia(seed, falls):
    """m v' = s v + r t: from rest v'' = r/m and v''' = (s/m) r/m. With a slope that brakes nothing grows."""
    rng = np.random.default_rng(seed)
    mass, rate = 10.0 ** rng.uniform(-2, 2), 10.0 ** rng.uniform(-1, 1)
    slope = (1.0 if falls else -1.0) * 10.0 ** rng.uniform(0, 3)
    problem, _ = algebraic(1, np.ones((1, 1), bool), True)
    problem.mass_pattern, problem.differential = problem.pattern, np.ones(1, bool)
    at = memory_for(problem, ordering.dense_plan(problem))
    at.array["jacobian"][:], at.array["mass"][:] = slope, mass
    at.array["curvature"][:], at.array["weight"][:] = rate / mass, 1e-6
    at.number["n_guards"], at.number["t_release"], at.number["t"] = 1, np.inf, 2.0
    for name, value in (("guard_tolerance", 1e-6), ("guard_inertia", mass)):
        at.point(name, np.array([value]), np.float64)
    at.spread()
    kept = fields(at, 1, guards=(lambda _t, y, out: np.negative(y, out=out), 1))
    grown()(at)
    if falls:
        assert at.number["growth"] == pytest.approx(slope / mass, rel=1e-9)
        assert at.number["t_growth"] > 2.0 + 10.0 * mass / slope
    else:
        assert at.number["growth"] == 0.0
    assert kept


@pytest.mark.parametrize("ends", [(1.0, -3.0), (-1e-9, 2e-12), (5.0, -5e-3)])
@pytest.mark.parametrize("bend", [0.0, 0.9])
def test_the_zero_of_a_force_inside_a_step_is_that_of_its_interpolant(ends, bend):
    """(1 - s) y0 + s (y1 + (1 - s) D0): a parabola, whose root has a closed form."""
    from fairlead.integrate.events.corners import zero_of

    start, end = ends
    D = bend * (end - start)
    at = memory({"n": 2}, y=[0.0, start], y_end=[0.0, end], D=[0.0, D, 0.0, 0.0, 0.0, 0.0])
    s = entry(zero_of, ("point",), "i", "d")(at, 1)
    roots = np.roots([-D, end - start + D, start])
    assert s == pytest.approx(float(roots[(roots > 0) & (roots < 1)][0]), rel=1e-12)
