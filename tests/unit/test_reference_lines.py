"""The closed forms of ropes, rods and windows against quadrature, eigenvalues and optimisation."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.optimize import lsq_linear

from tests.reference import capstan, window
from tests.reference.double_capstan import DoubleCapstan
from tests.reference.elastic_rod import ElasticRod
from tests.reference.hanging_line import HangingLine, drag_per_length
from tests.reference.rod_anchor import FrictionAnchor


def test_the_capstan_ratio_solves_its_differential_equation() -> None:
    run = solve_ivp(
        lambda _a, t: 0.35 * t, (0.0, np.pi / 2), [800.0], method="DOP853", rtol=1e-12, atol=1e-10
    )
    assert 800.0 * capstan.tension_ratio(0.35, np.pi / 2) == pytest.approx(run.y[0, -1], rel=1e-11)
    along = capstan.tension_along(800.0, 0.35, np.array([0.0, np.pi / 2]))
    assert along[1] == pytest.approx(run.y[0, -1], rel=1e-11)


@pytest.mark.parametrize("nodes", [2, 4, 8])
def test_the_discrete_capstan_is_the_solution_of_its_node_balances(nodes: int) -> None:
    step = 0.35 * np.pi / 2 / nodes
    balance = np.diag(np.full(nodes + 1, 1.0 - step / 2)) - np.diag(np.full(nodes, 1.0 + step / 2), -1)
    balance[0] = np.eye(nodes + 1)[0]
    tension = np.linalg.solve(balance, np.eye(nodes + 1)[0])
    assert capstan.discrete_tension_ratio(0.35, np.pi / 2, nodes) == pytest.approx(tension[-1], rel=1e-13)


@pytest.mark.parametrize(("nodes", "published"), [(2, 3.5e-3), (4, 8.7e-4), (8, 2.2e-4)])
def test_the_error_of_the_discrete_capstan_is_its_leading_term(nodes: int, published: float) -> None:
    exact = capstan.tension_ratio(0.35, np.pi / 2)
    error = capstan.discrete_tension_ratio(0.35, np.pi / 2, nodes) / exact - 1.0
    # The next term of the logarithm is (mu d)^2 3/20 of this one: 1.2 % at 2 nodes.
    assert error == pytest.approx(capstan.discrete_error(0.35, np.pi / 2, nodes), rel=0.02)
    assert error == pytest.approx(published, rel=0.03)  # physics 8 item 9, two figures


def test_a_capstan_element_that_turns_too_far_is_refused() -> None:
    with pytest.raises(ValueError, match="below 2"):
        capstan.discrete_tension_ratio(1.0, 4.0, 2)


def test_the_double_capstan_solves_both_balances() -> None:
    bend = DoubleCapstan(core_hold=787.4, hose_hold=12.6, guide_friction=0.6, bulkhead_friction=0.5)

    def balance(_a: float, y: np.ndarray) -> list[float]:
        core, hose = y
        drag = bend.bulkhead_friction * core
        return [drag, bend.guide_friction * (core + hose) - drag]

    run = solve_ivp(balance, (0.0, np.pi / 2), [787.4, 12.6], method="DOP853", rtol=1e-12, atol=1e-10)
    assert float(bend.core(np.pi / 2)) == pytest.approx(run.y[0, -1], rel=1e-10)
    assert float(bend.hose(np.pi / 2)) == pytest.approx(run.y[1, -1], rel=1e-9)


def test_the_slip_threshold_is_where_the_guide_takes_what_the_bulkheads_give() -> None:
    shares = {"core_hold": 787.4, "hose_hold": 12.6, "bulkhead_friction": 0.5}
    threshold = DoubleCapstan(guide_friction=0.0, **shares).slip_threshold
    assert threshold == pytest.approx(0.492, abs=5e-4)  # physics 8 item 11
    at = DoubleCapstan(guide_friction=threshold, **shares)
    step = 1e-6  # the hose tension starts level exactly at the threshold
    assert float(at.hose(step) - at.hose(0.0)) / step == pytest.approx(0.0, abs=1e-3)


def solve_anchor(
    anchor: FrictionAnchor, force: float, length: float, elements: int, rest: np.ndarray
) -> np.ndarray:
    """Node displacements of a discrete rod held by friction, found by minimising complementary energy.

    The unknowns are the friction forces t_i, |t_i| <= q l; the element tensions follow from balance. Minimal
    is sum T^2/(2 k) + sum t_i u_rest,i, the dual of elastic energy plus friction work from `rest`.
    """
    pitch = length / elements
    spring = anchor.stiffness / pitch
    limit = np.full(elements, anchor.grip * pitch)
    limit[0] *= 0.5
    sums = np.tril(np.ones((elements, elements)))  # T_j = F - sum of t up to node j
    linear = np.linalg.solve(sums.T, rest * spring)  # completes the square of the linear term
    best = lsq_linear(sums, force - linear, (-limit, limit), method="bvls", tol=1e-14, max_iter=1000)
    tension = force - sums @ best.x
    return np.cumsum(tension[::-1])[::-1] / spring


def test_a_discrete_rod_slips_as_far_as_the_anchor_says_and_keeps_half() -> None:
    anchor, force, elements = FrictionAnchor(), 800.0, 80
    loaded = solve_anchor(anchor, force, 8.0, elements, np.zeros(elements))
    freed = solve_anchor(anchor, 0.0, 8.0, elements, loaded)
    pitch = 8.0 / elements
    # Friction lumped into nodes changes the sum over a triangle of n slipped nodes by the share 1/(2 n^2).
    assert loaded[0] == pytest.approx(anchor.end_travel(force), rel=1e-3)
    slipped = np.count_nonzero(loaded > 1e-12) * pitch
    assert slipped == pytest.approx(anchor.slipped_length(force), abs=2 * pitch)
    assert freed[0] == pytest.approx(anchor.residual(force), rel=2e-3)


def test_the_anchor_dissipates_half_of_the_work() -> None:
    anchor, force = FrictionAnchor(), 800.0
    work, _ = quad(lambda f: f * f / (anchor.stiffness * anchor.grip), 0.0, force)
    reach = anchor.slipped_length(force)
    stored, _ = quad(lambda s: float(anchor.tension(force, s)) ** 2 / (2 * anchor.stiffness), 0.0, reach)
    assert anchor.work(force) == pytest.approx(work, rel=1e-10)
    assert anchor.dissipated(force) == pytest.approx(work - stored, rel=1e-9)


def test_the_loop_of_the_anchor_encloses_its_dissipated_energy() -> None:
    anchor, force = FrictionAnchor(), 800.0
    going_down = np.linspace(force, -force, 200_001)
    top = anchor.end_travel(force)
    travel = top - 2.0 * anchor.end_travel(1.0) * (0.5 * (force - going_down)) ** 2
    # The loop is symmetric about the origin: both branches do the same work.
    area = 2.0 * np.trapezoid(going_down, travel)
    assert area == pytest.approx(anchor.loop_energy(force), rel=1e-6)


def test_wave_speed_and_frequencies_match_the_published_numbers() -> None:
    rod = ElasticRod()  # physics 8 item 13
    assert rod.wave_speed == pytest.approx(345.03, abs=5e-3)
    assert rod.frequencies(1)[0] == pytest.approx(36.13, abs=5e-3)
    assert rod.chain_ceiling(60) == pytest.approx(2760.0, abs=0.5)


@pytest.mark.parametrize("elements", [1, 2, 7, 60])
def test_the_frequencies_of_the_chain_are_its_eigenvalues(elements: int) -> None:
    rod = ElasticRod()
    pitch = rod.length / elements
    matrix = 2.0 * np.eye(elements) - np.eye(elements, k=1) - np.eye(elements, k=-1)
    matrix[-1, -1] = 1.0
    mass = np.full(elements, rod.mass * pitch)
    mass[-1] *= 0.5
    root = np.sqrt(mass)
    squares = np.linalg.eigvalsh(rod.stiffness / pitch * matrix / np.outer(root, root))
    assert np.allclose(np.sqrt(squares), rod.chain_frequencies(elements), rtol=1e-10)


def test_the_chain_approaches_the_rod_with_the_square_of_the_element() -> None:
    rod = ElasticRod()
    coarse, fine = (1.0 - rod.chain_frequencies(n)[0] / rod.frequencies(1)[0] for n in (20, 40))
    assert coarse / fine == pytest.approx(4.0, rel=1e-2)


def test_the_hanging_line_carries_everything_beyond_each_point() -> None:
    line = HangingLine()
    for s in (0.0, 3.3, 14.0):
        beyond, _ = quad(lambda _s: line.load, s, line.length)
        assert float(line.tension(s)) == pytest.approx(line.tail + beyond, rel=1e-12)
    stretch, _ = quad(lambda s: float(line.tension(s)) / line.stiffness, 0.0, line.length)
    assert line.stretch() == pytest.approx(stretch, rel=1e-12)


def test_the_chain_of_a_hanging_line_has_no_discretisation_error() -> None:
    line, elements = HangingLine(), 7
    share = np.full(elements, line.load * line.length / elements)
    share[-1] *= 0.5
    assert np.allclose(line.chain_tension(elements), line.tail + np.cumsum(share[::-1])[::-1], rtol=1e-14)


def test_the_default_sea_load_is_the_published_one() -> None:
    assert drag_per_length(1025.0, 0.003, 0.085, 4.0) == pytest.approx(6.57, abs=5e-3)  # physics 4.6


@pytest.mark.parametrize("pitches", [1, 2, 3])
@pytest.mark.parametrize("phase", [0.0, 0.01, 0.11, 0.2499, -3.3])
def test_the_window_sum_does_not_depend_on_the_phase(pitches: int, phase: float) -> None:
    start, end, pitch = 3.0, 3.0 + np.pi / 2, 0.25
    total = window.window_sum(start, end, pitches * pitch, pitch, phase)
    assert total == pytest.approx(window.exact_sum(start, end), rel=1e-12)  # physics 8 item 33


def test_an_edge_that_is_no_whole_number_of_pitches_ripples() -> None:
    phases = np.linspace(0.0, 0.25, 201)
    sums = np.array([window.window_sum(3.0, 3.0 + np.pi / 2, 1.4 * 0.25, 0.25, p) for p in phases])
    ripple = np.ptp(sums) / 2 / (np.pi / 2)
    assert 0.005 < ripple < 0.02  # physics 4.0: 1.6 %


def test_the_window_has_the_area_of_its_device() -> None:
    area, _ = quad(
        lambda s: float(window.weight(s, 3.0, 5.0, 0.5)), 2.0, 6.0, points=[2.75, 3.25, 4.75, 5.25]
    )
    assert area == pytest.approx(window.exact_sum(3.0, 5.0), rel=1e-10)
