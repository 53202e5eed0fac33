"""A crustacean array, and 300 m of line off the drum and through the route."""

import math

import numpy as np
import pytest

import fairlead
from tests.reference.capstan import tension_ratio


@pytest.mark.slow
def test_a_crustacean_array_multiplies_bends_and_adds_the_tube(bundled):
    result = bundled("crustacean")
    force = -result["haul.force"][result.t > 3.0].mean()
    want = 300 * tension_ratio(0.35, math.pi / 4) + 0.3 * 10 * 2
    assert force == pytest.approx(want * tension_ratio(0.35, math.pi / 2), rel=0.01)


def test_it_has_no_core_and_no_bulkheads():
    model = fairlead.load("crustacean")
    assert not [path for path in model.assembly.instances if "core" in path or "inner" in path]


@pytest.fixture(scope="module")
def begun(bundled):
    """The first 10 s, 5 m of 300."""
    return bundled("long_deployment", {"run.stop": "10 s"})


def test_300_m_come_off_the_drum_at_the_speed_of_the_belts(begun):
    end, belts = begun["line.hose_node[600].x"], begun["belts.x"]
    assert end[-1] - end[0] == pytest.approx(belts[-1] - belts[0], abs=0.05)


def test_what_is_still_on_the_drum_has_the_tension_it_was_wound_on_with(begun):
    core = begun.columns(begun.match("line.core[*].tension"))
    nodes = begun.columns(begun.match("line.hose_node[*].x"))
    stored = nodes[-1, 1:] < -2.0  # the last element before the edge creeps, by 2 % here
    assert stored.sum() > 500
    np.testing.assert_allclose(core[-1][stored], 600 * 500 / 508, rtol=1e-3)


def test_what_lies_on_the_drum_or_in_the_sea_touches_nothing(begun):
    """Of 600 nodes some 25 are in devices; the contacts of all others are off, and their zones do not change."""
    nodes = np.array([begun[name][-1] for name in begun.match("line.hose_node[*].x")])
    inside = (nodes > 1.0) & (nodes < 14.0)
    assert inside.sum() < 30
    moved = {int(e.component.split("[")[1][:-1]) for e in begun.events if ".outer" in e.component and e.t > 1.0}
    came_by = {i for i in range(601) if begun[f"line.hose_node[{i}].x"].max() > 1.0 and nodes[i] < 30.0}
    assert moved <= came_by
