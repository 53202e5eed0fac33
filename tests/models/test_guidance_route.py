"""The whole guidance route with ideal drives: deployment, a stop, recovery (physics section 7b).

Where the line slides steadily the tensions are products of capstans, whatever the model is made of:

    before the deployer  T_winch exp(+-mu A)      in the sea  tail + drag * length      after it  T_sea exp(-+mu B)

with + while deploying. The drag belongs to the speed of the water along the line, ship less line. Tensions ripple
as single elements stick and slip, so they are compared as means over time.
"""

import math

import numpy as np
import pytest

from tests.reference.capstan import tension_ratio
from tests.reference.hanging_line import drag_per_length

BEND_A, BEND_B, SEA = math.pi / 2, math.pi / 3, 10.0
WINCH, TAIL, SHIP, SPEED = 200.0, 150.0, 4.0, 0.5
PLACES = (1.0, 4.2, 7.2, 9.7)  # m: at the winch, before and after the deployer, at the sea


def rows_between(result, begin, end):
    """Rows at equal spans of time; those that are recorded at events beside them would weigh bursts of events."""
    return np.searchsorted(result.t, np.arange(begin, end, 0.05))


def tension_at(result, places, begin, end):
    """Mean tension of the line [N] at places of the route [m] over a span of time."""
    hose, core = (result.columns(result.match(f"line.{layer}[*].tension")) for layer in ("hose", "core"))
    tension = hose + core
    nodes = result.columns(result.match("line.hose_node[*].x"))
    middle = (nodes[:, 1:] + nodes[:, :-1]) / 2
    rows = rows_between(result, begin, end)
    return np.mean([np.interp(places, middle[k], tension[k]) for k in rows], axis=0)


def closed_form(result, mu, way, begin, end):
    """The four tensions [N]; `way` is +1 while deploying."""
    rows = rows_between(result, begin, end)
    length = result["line.hose_node[160].x"][rows].mean() - SEA
    sea = TAIL + length * drag_per_length(1025.0, 0.003, 0.085, SHIP - way * SPEED)
    return [
        WINCH,
        WINCH * tension_ratio(way * mu, BEND_A),
        sea * tension_ratio(-way * mu, BEND_B),
        sea,
    ]


@pytest.fixture(scope="module")
def route(bundled):
    return bundled("guidance_route")


@pytest.mark.parametrize(("way", "begin", "end"), [(+1, 18.0, 24.9), (-1, 34.0, 44.0)])
def test_tensions_along_the_route_are_those_of_sliding_through_capstans(route, way, begin, end):
    want = closed_form(route, 0.35, way, begin, end)
    np.testing.assert_allclose(tension_at(route, PLACES, begin, end), want, rtol=0.02)


@pytest.mark.parametrize(("way", "begin", "end"), [(+1, 18.0, 24.9), (-1, 34.0, 44.0)])
def test_the_deployer_gives_the_difference_of_the_tensions_on_both_sides(route, way, begin, end):
    rows = rows_between(route, begin, end)
    _, before, after, _ = closed_form(route, 0.35, way, begin, end)
    assert route["belts.force"][rows].mean() == pytest.approx(before - after, rel=0.02)


def test_when_it_stands_the_tensions_are_inside_the_cone_of_friction(route):
    winch, before, after, sea = tension_at(route, PLACES, 27.0, 28.0)
    assert tension_ratio(-0.36, BEND_A) < before / winch < tension_ratio(0.36, BEND_A)
    assert tension_ratio(-0.36, BEND_B) < after / sea < tension_ratio(0.36, BEND_B)


def test_what_is_paid_out_is_hauled_back(route):
    end = route["line.hose_node[160].x"]
    out, back = 0.25 + 24 * 0.5 + 0.25, 0.25 + 19 * 0.5 + 0.25  # of the belts: ramps of 1 s, 24 and 19 s between them
    assert end[np.searchsorted(route.t, 27.0)] - end[0] == pytest.approx(out, abs=0.03)
    assert end[-1] - end[0] == pytest.approx(out - back, abs=0.06)


def test_every_joule_is_accounted_for(route):
    assert route.run["energy"]["closure"] < 1e-6


@pytest.fixture(scope="module")
def weak(bundled):
    return bundled("weak_clamp", {"run.stop": "26 s"})


def test_belts_clamped_too_weakly_slip_and_pay_out_less(weak):
    run, paid = (weak[name][-1] - weak[name][0] for name in ("belts.x", "line.hose_node[160].x"))
    assert run - paid == pytest.approx(1.0, abs=0.3)  # an independent computation of other discretisation: 1.0 m


def test_a_slipping_belt_carries_all_that_its_clamp_allows_and_no_more(weak):
    friction = np.abs(weak.columns(weak.match("line.outer_deployer[*].friction")).sum(axis=1))
    assert friction.max() == pytest.approx(2 * 0.6 * 150 * 1.5, rel=1e-3)


def test_with_a_slow_ship_and_a_short_tail_the_core_goes_slack_in_the_route(bundled):
    result = bundled("slack_start")
    core = result.columns(result.match("line.core[*].tension"))
    nodes = result.columns(result.match("line.hose_node[*].x"))
    inside = (nodes[:, 1:] < 10.0) & (nodes[:, :-1] > 0.0)
    assert ((core <= 0) & inside).any()
    assert core.min() > -1e-6


def test_with_the_sea_as_usual_it_does_not(route):
    core = route.columns(route.match("line.core[*].tension"))
    nodes = route.columns(route.match("line.hose_node[*].x"))
    assert core[(nodes[:, 1:] < 10.0) & (nodes[:, :-1] > 0.0)].min() > 0.0
