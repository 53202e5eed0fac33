"""The independent engines of `benchmarks/`: their derivatives, and that they agree where they must.

These engines are the measure of fairlead's results, so they are measured here against each other.
"""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))  # scripts that import each other by name

from bend_equations import Bend
from bend_scene import BendScene, ruck_times
from chain_reference import set_valued
from convex_bend import ConvexBend
from convex_bend import integrate as integrate_convex
from independent_bend import integrate as integrate_scipy
from peer_cases import Belt, Chain
from peer_cvode import cvode
from peer_scipy import event_driven
from peers import belt_positions, error, reference_positions, sample_times

from tests.reference.belt import StickSlipBelt


def differences(function, y: np.ndarray, step: float) -> np.ndarray:
    """Central differences of a vector function, one column per unknown."""
    columns = [(function(y + e) - function(y - e)) / (2 * step) for e in step * np.eye(y.size)]
    return np.array(columns).T


@pytest.mark.parametrize("law", ["line", "tanh"])
def test_the_jacobian_of_the_bend_is_the_derivative_of_its_right_hand_side(law: str) -> None:
    bend = Bend(BendScene(elements=24, mu=0.6), law)
    rng = np.random.default_rng(1)
    y = bend.initial() + 1e-4 * rng.normal(size=bend.size)
    found = differences(lambda at: bend.rhs(0.5, at), y, 1e-9)
    found[-2:] = 0.0  # the rows of the two works are left out on purpose
    scale = np.abs(found).max(axis=1, keepdims=True) + 1e-9
    # Differences over 1e-9 of forces of 1e3 N lose nine of sixteen digits.
    assert np.max(np.abs(bend.jacobian(0.5, y).toarray() - found) / scale) < 1e-5


def test_the_hessian_of_the_convex_step_is_the_derivative_of_its_gradient() -> None:
    bend = ConvexBend(BendScene(elements=24, mu=0.6), 1e-3)
    step = bend.prepare(1e-3)
    speed = 1e-4 * np.random.default_rng(2).normal(size=bend.mass.size)
    found = differences(lambda at: bend.gradient(step, at)[0], speed, 1e-9)
    band = bend.hessian(bend.gradient(step, speed)[1])
    full = np.diag(band[2])
    for off in (1, 2):
        full += np.diag(band[2 - off, off:], off) + np.diag(band[2 - off, off:], -off)
    assert np.allclose(full, found, rtol=1e-5, atol=1e-5 * np.abs(full).max())


def test_the_gradient_of_the_convex_step_is_the_derivative_of_its_energy() -> None:
    bend = ConvexBend(BendScene(elements=24, mu=0.6), 1e-3)
    step = bend.prepare(1e-3)
    speed = 1e-4 * np.random.default_rng(3).normal(size=bend.mass.size)
    found = differences(lambda at: np.array([bend.energy(step, at)]), speed, 1e-6)[0]
    slope = bend.gradient(step, speed)[0]
    assert np.allclose(found, slope, atol=1e-5 * np.abs(slope).max())


def test_both_bend_engines_agree_on_the_first_half_second() -> None:
    scene = BendScene(elements=30, stop=0.5, mu=0.35)
    tight, _ = integrate_scipy(Bend(scene, "line"), "Radau", 1e-6, 5e-3, 600.0)
    errors = []
    for step in (5e-4, 2.5e-4):
        rough, _ = integrate_convex(ConvexBend(scene, step), 5e-3)
        errors.append(np.abs(rough.core - tight.core).max())
    # The convex engine is of first order; the core moves 37 mm meanwhile and rings, so 0.1 mm is 0.3 %.
    assert errors[1] < 1e-4
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.15)


def test_a_ruck_needs_one_element_below_the_limit_for_the_whole_dwell() -> None:
    time = np.arange(0.0, 1.0, 1e-3)
    tension = np.zeros((time.size, 2))
    tension[100:180, 0] = -200.0  # too short
    tension[180:260, 1] = -200.0  # another element: its own 80 ms
    assert ruck_times(time, tension) == (0.1, None)
    tension[500:700, 1] = -200.0
    first, dwell = ruck_times(time, tension)
    assert first == 0.1
    assert dwell == pytest.approx(0.6, abs=2e-3)


def test_the_belt_of_the_benchmarks_is_the_reference_belt() -> None:
    belt = Belt()
    times = sample_times(belt)
    assert np.allclose(belt_positions(belt, times), StickSlipBelt().position(times), rtol=0, atol=1e-12)
    assert belt.stop == pytest.approx(50 * StickSlipBelt().period)


def test_event_driven_integration_of_the_belt_meets_the_closed_form() -> None:
    belt = Belt()
    run = event_driven(belt, "DOP853", 1e-10)
    assert error(belt, run, reference_positions(belt)) < 1e-7
    assert run.counters["switches"] == 99  # 50 breakaways and 49 captures; the run ends inside the last slip


def test_the_root_functions_of_cvode_lead_the_short_chain_along_its_reference() -> None:
    pytest.importorskip("sksundae.cvode", reason="needs scikit-sundae: pip install 'fairlead[ida]'")
    chain = Chain(10)
    run = cvode(chain, "Adams", 1e-7)
    assert error(chain, run, reference_positions(chain)) < 1e-5
    assert run.counters["switches"] == 116  # as often as scipy's methods switch


def test_the_peak_of_the_smooth_belt_law_is_the_stiction_force() -> None:
    belt, width = Belt(), 1e-4
    slips = np.linspace(0.0, 20 * width, 4001)
    force = [-belt.smooth_rhs(0.0, np.array([0.0, belt.speed + u]), width)[1] for u in slips]
    assert max(force) == pytest.approx(belt.stiction, rel=1e-6)
    assert force[-1] == pytest.approx(belt.coulomb, rel=1e-6)


@pytest.mark.parametrize("case", [Belt(), Chain(5)], ids=["belt", "chain"])
def test_the_smooth_jacobians_are_derivatives(case: Belt | Chain) -> None:
    y = case.initial()[0] + 1e-4 * np.random.default_rng(4).normal(size=case.initial()[0].size)
    found = differences(lambda at: case.smooth_rhs(0.3, at, 1e-3), y, 1e-8)
    matrix = case.smooth_jacobian(0.3, y, 1e-3)
    matrix = matrix if isinstance(matrix, np.ndarray) else matrix.toarray()
    assert np.allclose(matrix, found, atol=1e-6 * np.abs(found).max())


def test_event_driven_and_set_valued_chains_agree_at_second_order() -> None:
    case = Chain(10)
    reference = reference_positions(case)
    assert error(case, event_driven(case, "DOP853", 1e-9), reference) < 1e-8
    errors = [error(case, set_valued(case, step), reference) for step in (2e-3, 5e-4)]
    assert errors[1] < 5e-6
    # Four times finer: sixteen times better, give or take where the switches fall between the steps.
    assert errors[0] / errors[1] > 8.0
