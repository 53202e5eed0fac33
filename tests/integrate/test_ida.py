"""The engine ida: BDF by SUNDIALS under the same rules of zones, and what it says when it is missing."""

from __future__ import annotations

import os
import signal
import sys

import numpy as np
import pytest

from fairlead.errors import UsageError
from fairlead.integrate import Block, Run, Status, integrate
from fairlead.integrate.ida.solver import require_package
from fairlead.integrate.textbook import textbook
from tests.integrate.problems import (
    belt_block,
    clock,
    coulomb_oscillator,
    falling_ball,
    index_one_dae,
    nonlinear_ode,
    pulled_block,
    stick_slip_times,
)
from tests.integrate.test_budgets import chattering_machine

CURE = "the engine ida is tested where scikit-sundae is installed: pip install 'fairlead[ida]'"


@pytest.fixture
def _installed():
    pytest.importorskip("sksundae.ida", reason=CURE)


needs_package = pytest.mark.usefixtures("_installed")


def run(problem, stop, **settings):
    outcome = integrate(problem, Run(stop=stop, engine="ida", **settings))
    return outcome


@needs_package
@pytest.mark.parametrize("made", [nonlinear_ode, index_one_dae], ids=["ode", "dae"])
def test_the_error_follows_the_accuracy_at_the_end_and_on_the_grid(made):
    for accuracy in (1e-4, 1e-6, 1e-8):
        problem, exact = made(absolute=accuracy, relative=accuracy)
        outcome = run(problem, 2.0, every=0.05)
        assert outcome.ok, outcome.sentence
        truth = np.array([exact(t) for t in outcome.times])
        # The error of some hundred steps adds up; BDF has no stiff decay to forget it here.
        assert np.abs(outcome.values - truth).max() < 10 * accuracy


@needs_package
def test_a_block_on_a_belt_sticks_and_slips_at_the_times_of_the_closed_form():
    outcome = run(belt_block(), 5.0)
    first, slip, stick = stick_slip_times()
    expected = [first + (k // 2) * (slip + stick) + (k % 2) * slip for k in range(12)]
    np.testing.assert_allclose(outcome.events["t"], expected, rtol=1e-6)
    assert outcome.events["after"].tolist() == [2, 0] * 6


@needs_package
def test_reversals_and_a_breakaway_are_located_as_exactly_as_the_motion_is_known():
    problem, exact = coulomb_oscillator(absolute=1e-8, relative=1e-8)
    assert run(problem, 6.0).y == pytest.approx(exact(6.0), abs=1e-6)
    problem, exact, breaks = pulled_block(absolute=1e-8, relative=1e-8)
    outcome = run(problem, 2.0)
    np.testing.assert_allclose(outcome.events["t"], [breaks], rtol=1e-6)
    assert outcome.y[0] == pytest.approx(exact(2.0), rel=1e-5)


@needs_package
def test_a_jump_of_the_state_at_a_switch_bounces_a_ball():
    # g = 2, height 1: first impact at t = 1 with speed 2; flights last 2 e^n v/g.
    outcome = run(falling_ball(restitution=0.5, absolute=1e-9, relative=1e-9), 2.8)
    np.testing.assert_allclose(outcome.events["t"], [1.0, 2.0, 2.5, 2.75], rtol=1e-7)


@needs_package
def test_a_held_block_does_not_creep():
    outcome = run(belt_block(belt=0.0, start=(0.05, 0.0)), 3600.0)
    assert outcome.ok, outcome.sentence
    assert np.abs(outcome.values[:, 1]).max() < 1e-12
    assert outcome.y[2] == pytest.approx(5.0, rel=1e-12)


@needs_package
def test_a_double_crossing_inside_one_step_is_found_by_the_rules_of_the_other_engines():
    outcome = run(clock(lambda t, z: 1e-4 - (t - 1) ** 2 if z == 0 else -1), 2.0)
    assert outcome.events["t"] == pytest.approx([0.99], abs=1e-9)


@needs_package
def test_time_events_are_landed_on_and_both_sides_recorded():
    held = {"u": 0.0}

    def rhs(t, y, z, f):
        f[0] = held["u"]

    def at_time(t, y, z):
        held["u"] = -y[0]
        return 1

    problem = textbook(
        [1.0], rhs, lambda *_: None, next_time=lambda t, z: 0.1 * (np.floor(t / 0.1 + 1e-9) + 1), at_time=at_time
    )
    outcome = run(problem, 1.0)
    assert outcome.y[0] == pytest.approx(0.9**10, rel=1e-10)
    assert outcome.counters.time_events == 9
    assert outcome.times[outcome.sides == 1].tolist() == [0.1 * k for k in range(1, 10)]


@pytest.mark.slow
@needs_package
def test_two_runs_are_the_same_to_the_last_bit():
    one, two = (run(belt_block(), 3.0, every=0.01) for _ in range(2))
    assert one.values.tobytes() == two.values.tobytes()
    assert one.events.tobytes() == two.events.tobytes()


@needs_package
def test_budgets_end_the_run_and_keep_the_results():
    outcome = run(belt_block(), 1e4, max_steps=50)
    assert (outcome.status, outcome.counters.steps) == (Status.MAX_STEPS, 50)
    assert outcome.times[-1] == outcome.t > 0
    assert run(belt_block(), 1e4, max_events=3).status == Status.MAX_EVENTS
    assert run(belt_block(), 1e9, every=1e3, max_wall=0.1).status == Status.MAX_WALL


@needs_package
def test_ctrl_c_ends_the_run_between_steps_and_keeps_what_was_computed():
    def interrupt(block: Block) -> None:
        kept.append(block)
        if len(kept) == 2:
            os.kill(os.getpid(), signal.SIGINT)

    kept: list[Block] = []
    outcome = integrate(belt_block(), Run(stop=1e9, engine="ida"), interrupt)
    assert outcome.status == Status.INTERRUPTED
    assert kept[-1].reached == outcome.t > 0


@needs_package
def test_a_law_that_stops_being_a_number_ends_the_run_and_names_the_unknown(capsys):
    def rhs(t, y, z, f):
        f[0] = -y[0]
        f[1] = np.nan if t > 0.5 else 0.0

    def jacobian(t, y, z, J, ft):
        J[0, 0] = -1.0

    outcome = run(textbook([1.0, 0.0], rhs, jacobian, unknown_names=["line.x", "pump.p"]), 1.0)
    assert (outcome.status, outcome.culprits) == (Status.NOT_FINITE, ("pump.p",))
    assert outcome.t == pytest.approx(0.5, abs=1e-6)
    assert capsys.readouterr().out == ""  # what SUNDIALS prints about it is not for users


@needs_package
def test_a_pole_ends_at_the_step_floor_and_names_the_unknown():
    def rhs(t, y, z, f):
        f[0] = 1.0 / max(1e-30, 1.0 - t) ** 2

    outcome = run(textbook([1.0], rhs, lambda *_: None), 2.0, step_floor=1e-6)
    assert (outcome.status, outcome.culprits) == (Status.STEP_FLOOR, ("y[0]",))
    assert outcome.t == pytest.approx(1.0, abs=1e-3)


@needs_package
def test_chatter_may_be_held():
    outcome = run(chattering_machine(), 0.5001, dwell=1e-5, on_chatter="hold")
    assert outcome.ok
    assert outcome.chattering == ("relay",)


def test_a_fixed_step_is_refused():
    with pytest.raises(ValueError, match="fixed_step is for rodas and stepping"):
        integrate(belt_block(), Run(stop=1.0, engine="ida", fixed_step=0.1))


def test_without_the_package_the_message_names_the_cure(monkeypatch):
    monkeypatch.setitem(sys.modules, "sksundae.ida", None)
    with pytest.raises(UsageError, match=r"pip install 'fairlead\[ida\]'.*run.engine: rodas"):
        require_package()
