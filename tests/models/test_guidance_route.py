"""The whole guidance route with ideal drives: deployment, a stop, recovery (physics section 7b)."""

import numpy as np
import pytest

from tests.models.along_the_route import (
    BEND_A,
    BEND_B,
    PLACES,
    closed_form,
    inside,
    layer,
    rows_between,
    tension_at,
)
from tests.reference.capstan import tension_ratio


@pytest.fixture(scope="module")
def route(bundled):
    return bundled("guidance_route_ideal")


@pytest.mark.slow
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
    assert route.run["energy"]["closure"] < 1e-5  # at accuracy 1e-3


@pytest.fixture(scope="module")
def weak(bundled):
    return bundled("weak_clamp", {"run.stop": "26 s"})


def test_belts_clamped_too_weakly_slip_and_pay_out_less(weak):
    run, paid = (weak[name][-1] - weak[name][0] for name in ("belts.x", "line.hose_node[160].x"))
    assert run - paid == pytest.approx(1.0, abs=0.3)  # an independent computation of other discretisation: 1.0 m


@pytest.mark.slow
def test_a_slipping_belt_carries_all_that_its_clamp_allows_and_no_more(weak):
    friction = np.abs(weak.columns(weak.match("line.outer_deployer[*].friction")).sum(axis=1))
    assert friction.max() == pytest.approx(2 * 0.6 * 150 * 1.5, rel=1e-3)


def test_with_a_slow_ship_and_a_short_tail_the_core_goes_slack_in_the_route(bundled):
    result = bundled("slack_start")
    core = layer(result, "core")
    assert ((core <= 0) & inside(result)).any()
    assert core.min() > -1e-6


def test_with_the_sea_as_usual_it_does_not(route):
    assert layer(route, "core")[inside(route)].min() > 0.0


def test_more_friction_compresses_the_hose_more(route, bundled):
    """An independent computation of other discretisation: -78 N against -64 N."""
    begun = bundled("guidance_route_ideal", {"mu": "0.6", "run.stop": "2 s"})
    assert layer(begun, "hose").min() < 1.1 * layer(route, "hose").min()
