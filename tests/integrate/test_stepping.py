"""The stepping engine: order, zones found inside the step, exact holding, agreement with `rodas`."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, Status, integrate
from fairlead.integrate.textbook import textbook
from tests.integrate.problems import (
    belt_block,
    coulomb_oscillator,
    falling_ball,
    index_one_dae,
    nonlinear_ode,
    stick_slip_times,
    stiff_follower,
)


def end_error(made, step, stop=2.0, **settings):
    problem, exact = made(**settings)
    outcome = integrate(problem, Run(stop=stop, engine="stepping", fixed_step=step))
    assert outcome.ok, outcome.sentence
    return np.abs(outcome.y - exact(stop))


@pytest.mark.parametrize(("made", "order"), [(nonlinear_ode, 3), (index_one_dae, 2)], ids=["ode", "dae"])
def test_the_order_where_the_motion_is_smooth(made, order):
    """Of algebraic unknowns there is one value to a step: where they are not linear in the others it is two."""
    problem, _ = made(absolute=1e-10, relative=1e-10)
    states = problem.differential
    errors = [end_error(made, h, absolute=1e-10, relative=1e-10)[states].max() for h in (0.02, 0.01)]
    assert order - 0.2 < np.log2(errors[0] / errors[1]) < order + 0.2


def test_what_is_stiff_for_a_step_dies_away():
    """To a third with every step, and to its other side; the midpoint rule alone would leave it where it is."""
    problem, exact = stiff_follower()
    ends = 5e-3 * np.arange(1, 8)
    outcomes = [integrate(problem, Run(stop=float(t), engine="stepping", fixed_step=5e-3)) for t in ends]
    found = np.array([one.y[0] - exact(t)[0] for one, t in zip(outcomes, ends)])  # what is recorded is balanced
    assert found[1:] / found[:-1] == pytest.approx(-np.ones(6) / 3, rel=2e-2)
    outcome = integrate(problem, Run(stop=1.0, engine="stepping", fixed_step=5e-3))
    assert abs(outcome.y[0] - exact(1.0)[0]) < 1e-5


@pytest.mark.slow
def test_reversals_of_friction_inside_the_step_cost_no_order_but_one():
    steps = np.array([0.02, 0.01, 0.005, 0.0025])
    errors = [end_error(coulomb_oscillator, h, stop=7.3)[0] for h in steps]
    order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert order > 0.9  # an instant is rounded to a step: order 1 at least, by luck more


def test_the_step_follows_the_accuracy():
    found = []
    for accuracy in (1e-4, 1e-6):
        problem, exact = nonlinear_ode(absolute=accuracy, relative=accuracy)
        outcome = integrate(problem, Run(stop=2.0, engine="stepping"))
        found.append(np.abs(outcome.y - exact(2.0)).max())
        assert outcome.ok
        assert found[-1] < 100 * accuracy  # the error of some hundred steps adds up
    assert found[1] < 0.1 * found[0]


@pytest.mark.parametrize("theta", [0.55, 1.0])
def test_a_theta_above_the_middle_makes_at_most_one_weight_of_error_a_step(theta):
    """Its leading error is (theta - 1/2) h^2 y''. Errors of steps add up."""
    problem, exact = nonlinear_ode(absolute=1e-6, relative=1e-6)
    outcome = integrate(problem, Run(stop=2.0, engine="stepping", theta=theta))
    assert outcome.ok
    assert outcome.counters.rejected <= 5
    assert np.abs(outcome.y - exact(2.0)).max() < 1e-6 * outcome.counters.steps


def test_the_first_step_makes_no_more_error_than_is_allowed():
    """A tenth of a weight where every switch is landed on, one weight else."""
    for located in (40, -1):
        problem, _ = nonlinear_ode(absolute=1e-6, relative=1e-6)
        outcome = integrate(problem, Run(stop=2.0, engine="stepping", most_located=located, max_steps=1))
        assert outcome.counters.steps == 1
        assert outcome.counters.rejected == 0
        assert 1e-4 < outcome.t < 1e-1


def test_a_time_event_of_the_same_instant_that_changes_nothing_leaves_no_trace():
    """No step is taken to it, so none is remembered."""
    outcomes = []
    for events in ([0.7], [0.7, 0.7 + 2e-16]):
        problem, _ = nonlinear_ode(
            absolute=1e-6, relative=1e-6, at_time=lambda *_: 0,
            next_time=lambda t, _z, events=events: min((e for e in events if e > t), default=np.inf),
        )  # fmt: skip
        outcomes.append(integrate(problem, Run(stop=2.0, engine="stepping")))
    once, twice = outcomes
    assert twice.counters.time_events == once.counters.time_events + 1
    assert twice.counters.steps == once.counters.steps
    assert twice.y == pytest.approx(once.y, abs=1e-14)


def test_a_held_block_does_not_creep():
    problem = belt_block(start=(0.05, 0.2))
    outcome = integrate(problem, Run(stop=0.2, engine="stepping", fixed_step=1e-3))
    assert outcome.counters.switches == 0
    assert np.abs(outcome.values[:, 1] - 0.2).max() < 1e-12  # the belt moves with 0.2 m/s


@pytest.mark.slow
def test_two_runs_are_the_same_to_the_last_bit():
    outcomes = [integrate(belt_block(), Run(stop=3.0, engine="stepping")) for _ in range(2)]
    assert outcomes[0].ok
    assert outcomes[0].y.tobytes() == outcomes[1].y.tobytes()
    assert outcomes[0].values.tobytes() == outcomes[1].values.tobytes()


def test_budgets_end_the_run_and_keep_the_results():
    outcome = integrate(belt_block(), Run(stop=3.0, engine="stepping", fixed_step=1e-3, max_steps=50))
    assert outcome.status == Status.MAX_STEPS
    assert outcome.counters.steps == 50
    assert len(outcome.times) >= 50


def test_theta_outside_its_range_is_refused():
    with pytest.raises(ValueError, match="theta"):
        integrate(belt_block(), Run(stop=1.0, engine="stepping", theta=0.3))


@pytest.mark.slow
def test_a_break_away_from_stiction_is_landed_on_to_order_two():
    """Stiction 10 above Coulomb 6: a jump. The catch at the end of each slip is a matter of one step."""
    breaks, slip, stick = stick_slip_times()
    step = 1e-3
    outcome = integrate(belt_block(), Run(stop=2.5, engine="stepping", fixed_step=step))
    times, zones = outcome.events["t"], outcome.events["after"].tolist()
    assert zones[:4] == [2, 0, 2, 0]
    assert times[0] == pytest.approx(breaks, abs=1e-9)  # the force of the belt is linear in time
    assert times[1] == pytest.approx(breaks + slip, abs=2 * step)  # the log has the end of the step
    assert times[2] == pytest.approx(breaks + slip + stick, abs=100 * step**2)


@pytest.mark.parametrize("step", [0.03, None])
def test_a_rebound_inside_steps_is_where_the_ball_meets_the_ground(step):
    """After 1 s with 2 m/s, half of which are left. The guard is a position, read at the ends of steps."""
    problem = falling_ball(absolute=1e-6, relative=1e-6)
    outcome = integrate(problem, Run(stop=1.7, engine="stepping", most_located=0, fixed_step=step))
    assert outcome.y == pytest.approx([0.7 - 0.7**2, 1.0 - 1.4], abs=1e-8)


def place_where_a_force_jumps(place, acceleration=1.0, beside=1e5):
    """y = x, v, a, w: a goes from 0 to -3 where x comes to `place`; beside it w follows a stiff, bent law."""

    def rhs(t, y, z, f):
        f[0], f[1], f[2] = y[1], acceleration + y[2], y[2] + 3.0 * z[0]
        f[3] = -beside * (y[3] ** 3 + 0.1 * y[3] - np.sin(20 * t))

    def jacobian(t, y, z, J, ft):
        J[0, 1], J[1, 2], J[2, 2], J[3, 3] = 1.0, 1.0, 1.0, -beside * (3 * y[3] ** 2 + 0.1)
        ft[3] = beside * 20 * np.cos(20 * t)

    def guards(t, y, z, g):
        g[0] = y[0] - place if z[0] == 0 else -1.0

    def switch(t, y, z, fired):
        z[0] = 1

    return textbook(
        [0.0, 1.0, 0.0, 0.0], rhs, jacobian, guards=guards, switch=switch, zones=[0], guard_machine=[0], algebraic=[2]
    )


@pytest.mark.parametrize("acceleration", [1.0, -1.0])
@pytest.mark.parametrize("step", [0.02, 0.01])
def test_a_law_that_jumps_at_a_place_does_so_there(step, acceleration):
    """Told by both ends of the step: the place is missed by less than a hundredth of it, and so is the impulse."""
    due = 0.311
    problem = place_where_a_force_jumps(due + 0.5 * acceleration * due**2, acceleration)
    outcome = integrate(problem, Run(stop=0.5, engine="stepping", most_located=0, fixed_step=step))
    right = 1.0 + acceleration * 0.5 - 3.0 * (0.5 - due)
    assert outcome.y[1] == pytest.approx(right, abs=0.01 * 3.0 * step)


@pytest.mark.parametrize("due", [0.311, 0.477])
def test_what_is_beside_a_jump_is_solved_in_the_step_that_ends_there(due):
    """As in a step of the same length that ends there without a jump."""
    jumps, stays = (place_where_a_force_jumps(place, -1.0) for place in (due - 0.5 * due**2, 9.0))
    outcome = integrate(jumps, Run(stop=due + 0.01, engine="stepping", most_located=0, fixed_step=0.02))
    before = int(np.flatnonzero(outcome.sides == 1)[0])
    run = Run(stop=float(outcome.times[before]), engine="stepping", most_located=0, fixed_step=0.02)
    assert outcome.values[before] == pytest.approx(integrate(stays, run).y, abs=1e-9)  # weights of 1e-6, SOLVED 1e-3


def test_the_belt_agrees_with_rodas():
    problem = belt_block(absolute=[1e-8, 1e-7, 1e-6], relative=1e-6)
    one = integrate(problem, Run(stop=3.0, engine="stepping"))
    other = integrate(belt_block(), Run(stop=3.0))
    assert one.counters.switches == other.counters.switches
    assert one.y[0] == pytest.approx(other.y[0], abs=1e-5)  # 2 mm of slip a step, error h^2 of that


def test_no_recorded_row_shows_a_held_block_that_slips():
    """Rows on a grid lie inside steps, also inside the one that catches the block and the one after it."""
    outcome = integrate(belt_block(), Run(stop=2.5, engine="stepping", fixed_step=3e-3, every=7e-4))
    events = outcome.events[outcome.events["after"] == 0]["t"]
    for caught in events:
        after = (outcome.times > caught) & (outcome.times < caught + 0.3)
        assert np.abs(outcome.values[after, 1] - 0.2).max() < 1e-12


def test_a_fixed_step_that_leads_to_no_number_ends_the_run():
    """y' = sqrt(1 - t) - y has no value after one second; a step that may not get shorter would be tried for ever."""

    def rhs(t, y, z, f):
        f[0] = (np.sqrt(1.0 - t) if t <= 1.0 else np.nan) - y[0]

    def jacobian(t, y, z, J, ft):
        J[0, 0] = -1.0

    run = Run(stop=2.0, engine="stepping", fixed_step=0.05, max_wall=600.0)  # that it ends at all
    outcome = integrate(textbook([1.0], rhs, jacobian), run)
    assert outcome.status == Status.NOT_FINITE
    assert 0.9 < outcome.t < 1.0 + 1e-9
