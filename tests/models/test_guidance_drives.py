"""The whole guidance route on drives under sampled control: electrohydraulic ones, and electric ones (section 7b)."""

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

DEPLOYING, HAULING = (+1, 18.0, 24.9), (-1, 34.0, 39.9)


@pytest.fixture(scope="module", params=["guidance_route", "guidance_route_electric"])
def route(request, bundled):
    """Well into hauling: 10 s of processor time each."""
    return bundled(request.param, {"run.stop": "40 s"})


@pytest.mark.parametrize(("way", "begin", "end"), [DEPLOYING, HAULING])
def test_tensions_along_the_route_are_those_of_sliding_through_capstans(route, way, begin, end):
    want = closed_form(route, 0.35, way, begin, end)
    np.testing.assert_allclose(tension_at(route, PLACES, begin, end), want, rtol=0.02)


@pytest.mark.parametrize(("way", "begin", "end"), [(+1, 6.0, 24.9), (-1, 32.0, 39.9)])
def test_the_winch_keeps_the_tension_and_the_deployer_the_speed(route, way, begin, end):
    rows = rows_between(route, begin, end)
    assert np.abs(route["route.tensiometer.tension"][rows] - 200.0).max() < 20.0
    np.testing.assert_allclose(route["belt_speed.signal"][rows], way * 0.5, rtol=0.01)


@pytest.mark.parametrize("drives", ["hydraulic", "electric"])
def test_drives_bring_the_line_to_its_speed_and_tension(bundled, drives):
    name = {"hydraulic": "guidance_route", "electric": "guidance_route_electric"}[drives]
    begun = bundled(name, {"run.stop": "7 s"})
    rows = rows_between(begun, 6.0, 7.0)
    assert np.abs(begun["route.tensiometer.tension"][rows] - 200.0).max() < 20.0
    np.testing.assert_allclose(begun["belt_speed.signal"][rows], 0.5, rtol=0.01)
    assert begun.run["energy"]["closure"] < 1e-3


def test_the_tensiometer_reads_the_tension_of_the_line_where_it_stands(route):
    read = route["route.tensiometer.tension"][rows_between(route, 10.0, 20.0)].mean()
    assert read == pytest.approx(tension_at(route, [1.0], 10.0, 20.0)[0], rel=1e-3)


def test_what_is_asked_for_is_paid_out(route):
    """Rise and fall of the speed are alike, so that they add up to half of the 25 s."""
    end = route["line.hose_node[160].x"]
    assert end[np.searchsorted(route.t, 27.5)] - end[0] == pytest.approx(25 * 0.5, abs=0.03)


def test_when_it_stands_the_tensions_are_inside_the_cone_of_friction(route):
    winch, before, after, sea = tension_at(route, PLACES, 27.3, 28.0)
    assert tension_ratio(-0.36, BEND_A) < before / winch < tension_ratio(0.36, BEND_A)
    assert tension_ratio(-0.36, BEND_B) < after / sea < tension_ratio(0.36, BEND_B)


def test_the_line_survives(route):
    """Nowhere slack in the route, and no ruck."""
    assert layer(route, "core")[inside(route)].min() > 0.0
    assert not route.run["limits_broken"]


def test_every_joule_is_accounted_for(route):
    assert route.run["energy"]["closure"] < 1e-3
