"""A rope round a bend, both ways, and a line on a long guide: closed forms 9 and 12 of physics section 8."""

import math

import numpy as np
import pytest

from tests.reference.capstan import discrete_tension_ratio, tension_ratio
from tests.reference.rod_anchor import FrictionAnchor

HOLD, MU = 100.0, 0.35


@pytest.mark.parametrize("speed", [-0.2, 0.2])
@pytest.mark.parametrize("angle", [90, 180])
def test_the_pulled_side_has_exp_mu_angle_of_the_held_one(bundled, speed, angle):
    result = bundled("capstan", {"speed": f"{speed} m/s", "angle": f"{angle} deg"})
    steady = result.t > 1.0
    force = -result["haul.force"][steady].mean()
    wrap = math.radians(angle)
    assert force == pytest.approx(HOLD * tension_ratio(math.copysign(MU, -speed), wrap), rel=0.005)


def test_a_coarse_mesh_has_the_error_of_the_trapezoid_rule(bundled):
    """Two elements of 45 deg ... the windows share the arc among three or four nodes; the product is the rule's."""
    result = bundled("capstan", {"element": "0.5 m", "mu": 0.7})
    force = -result["haul.force"][result.t > 1.0].mean()
    finest, exact = discrete_tension_ratio(0.7, math.pi / 2, 4), tension_ratio(0.7, math.pi / 2)
    assert HOLD * exact * 0.99 < force < HOLD * finest * 1.01


@pytest.mark.slow
@pytest.mark.parametrize(("stiffness", "within"), [("5 kN", 5e-4), ("2 kN", 1.5e-3)])
def test_a_soft_rope_has_the_capstan_of_a_stiff_one(bundled, stiffness, within):
    """Stretched by 2 or 5 % round the bend; a load that counts the length of the start would leave 0.3 or 1 % out."""
    result = bundled("capstan", {"rope.stiffness": stiffness, "run.stop": "6 s"})
    late = result.t > 3.0
    force = np.trapezoid(-result["haul.force"][late], result.t[late]) / (result.t[-1] - result.t[late][0])
    assert force == pytest.approx(HOLD * tension_ratio(MU, math.pi / 2), rel=within)


@pytest.fixture(scope="module")
def anchor(bundled):
    return lambda pull: bundled("friction_anchor", {"pull": f"{pull} N"})


@pytest.mark.slow
@pytest.mark.parametrize("pull", [500.0, 1000.0])
def test_an_anchored_line_is_drawn_out_by_the_square_of_the_pull(anchor, pull):
    result, exact = anchor(pull), FrictionAnchor(500e3, 50.0)
    travel = result["cable.node[80].x"] - 40.0
    assert travel.max() == pytest.approx(exact.end_travel(pull), rel=0.025)  # half an element of 20 or 40
    assert travel[-1] / travel.max() == pytest.approx(0.5, rel=0.03)
    greatest, left = lumped(pull)
    assert travel.max() == pytest.approx(greatest, rel=0.005)  # 10 mm/s turn round while a wave runs 20 m: some 50 um
    assert travel.max() - travel[-1] == pytest.approx(greatest - left, abs=4e-5)  # creep of 2 um/s for 20 s


def lumped(pull, grip=50.0, stiffness=500e3, element=0.5):
    """Travel of the end [m] under the pull and after it, friction in nodes as the mesh has it (half at the end).

    Going up every node that slides takes q * element of the tension; coming down it gives twice that back.
    """
    held = grip * element * (np.arange(80) + 0.5)
    up = np.maximum(pull - held, 0.0)
    down = up - np.maximum(pull - 2 * held, 0.0)
    return up.sum() * element / stiffness, down.sum() * element / stiffness


@pytest.mark.slow
def test_tension_in_an_anchored_line_falls_along_a_straight_line(anchor):
    result, exact = anchor(1000.0), FrictionAnchor(500e3, 50.0)
    k = int(np.searchsorted(result.t, 10.0))
    tension = result.columns(result.match("cable.line[*].tension"))[k][::-1]
    middle = (np.arange(80) + 0.5) * 0.5
    np.testing.assert_allclose(tension, exact.tension(1000.0, middle), atol=12.5 + 5)  # half an element of q
    assert 0.5 * np.sum(tension > 1.0) == pytest.approx(exact.slipped_length(1000.0), abs=1.0)


def test_half_of_the_work_is_heat(anchor):
    result, exact = anchor(1000.0), FrictionAnchor(500e3, 50.0)
    k = int(np.searchsorted(result.t, 10.0))
    assert result["energy.supplied"][k] == pytest.approx(exact.work(1000.0), rel=0.03)
    assert result["energy.dissipated"][k] == pytest.approx(exact.dissipated(1000.0), rel=0.03)
