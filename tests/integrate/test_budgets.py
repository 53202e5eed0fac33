"""How runs end: budgets, numbers that are not finite, floors, Ctrl-C; what was computed is kept."""

from __future__ import annotations

import os
import signal
from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.integrate import Block, Run, Status, integrate
from fairlead.integrate.textbook import textbook
from tests.integrate.problems import belt_block, clock, nonlinear_ode


def decay(rhs, slope=-1.0, **settings):
    def jacobian(t, y, z, J, ft):
        J[0, 0] = slope

    return textbook([1.0], rhs, jacobian, **settings)


def test_a_budget_of_steps_ends_the_run_and_keeps_what_was_computed():
    outcome = integrate(belt_block(), Run(stop=1e4, max_steps=50))
    assert outcome.status == Status.MAX_STEPS
    assert outcome.status.is_budget
    assert outcome.counters.steps == 50
    assert outcome.times[-1] == outcome.t > 0
    assert "50 steps" in outcome.sentence


def test_a_budget_of_events_ends_the_run_and_keeps_the_events():
    outcome = integrate(belt_block(), Run(stop=1e4, max_events=7))
    assert outcome.status == Status.MAX_EVENTS
    assert len(outcome.events) == 7


def test_a_budget_of_wall_time_ends_the_run():
    outcome = integrate(belt_block(), Run(stop=1e9, every=1e3, max_wall=0.2))
    assert outcome.status == Status.MAX_WALL
    assert outcome.t > 0


def test_loading_an_engine_is_in_no_budget_of_wall_time(monkeypatch):
    """The first run on a machine compiles it for half a minute; here the clock says so."""
    from fairlead.integrate import run

    now = [0.0]

    class Loaded(run.Underway):
        def __init__(self, *given):
            super().__init__(*given)
            now[0] += 30.0

    monkeypatch.setattr(run, "Underway", Loaded)
    monkeypatch.setattr(run, "time", SimpleNamespace(perf_counter=lambda: now[0]))
    assert integrate(belt_block(), Run(stop=2.0, max_wall=1.0)).ok


def test_ctrl_c_ends_the_run_and_keeps_what_was_computed():
    def interrupt(block: Block) -> None:
        kept.append(block)
        if len(kept) == 2:
            os.kill(os.getpid(), signal.SIGINT)

    kept: list[Block] = []
    outcome = integrate(belt_block(), Run(stop=1e9), interrupt)
    assert outcome.status == Status.INTERRUPTED
    assert kept[-1].reached == outcome.t > 0


@pytest.mark.slow
def test_blocks_arrive_while_the_run_goes_and_tell_its_fraction():
    fractions = []
    outcome = integrate(belt_block(), Run(stop=200.0), lambda block: fractions.append(block.fraction))
    assert outcome.ok
    assert len(fractions) > 2
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0


def test_blocks_small_enough_to_fill_lose_no_row(monkeypatch):
    from fairlead.integrate import prepare

    whole = integrate(belt_block(), Run(stop=5.0, every=0.001))
    monkeypatch.setattr(prepare, "BLOCK_NUMBERS", 1)
    pieces = integrate(belt_block(), Run(stop=5.0, every=0.001))
    assert len(pieces.blocks) > 50
    assert pieces.values.tobytes() == whole.values.tobytes()
    assert pieces.times.tobytes() == whole.times.tobytes()


def test_a_law_that_stops_being_a_number_ends_the_run_and_names_the_unknown():
    def rhs(t, y, z, f):
        f[0] = -y[0]
        f[1] = np.nan if t > 0.5 else 0.0

    def jacobian(t, y, z, J, ft):
        J[0, 0] = -1.0

    problem = textbook([1.0, 0.0], rhs, jacobian, unknown_names=["line.x", "pump.p"])
    outcome = integrate(problem, Run(stop=1.0))
    assert outcome.status == Status.NOT_FINITE
    assert outcome.culprits == ("pump.p",)
    assert outcome.t == pytest.approx(0.5, abs=1e-6)
    assert "pump.p is not a finite number" in outcome.sentence
    assert outcome.counters.rejected_nan > 0


@pytest.mark.slow
def test_a_jump_inside_a_zone_ends_at_the_step_floor_and_names_the_unknown():
    def rhs(t, y, z, f):
        f[0] = 1.0 / max(1e-30, 1.0 - t) ** 2

    outcome = integrate(decay(rhs, slope=0.0), Run(stop=2.0, step_floor=1e-6))
    assert outcome.status == Status.STEP_FLOOR
    assert "its floor (run.step_floor = 1e-06 s)" in outcome.sentence
    assert outcome.culprits == ("y[0]",)
    assert outcome.t == pytest.approx(1.0, abs=1e-3)


def test_an_algebraic_unknown_that_no_equation_determines_is_named():
    def rhs(t, y, z, f):
        f[0], f[1] = y[0], 0.0

    def jacobian(t, y, z, J, ft):
        J[0, 0] = 1.0

    problem = textbook([1.0, 0.0], rhs, jacobian, algebraic=[1], unknown_names=["x", "loose.force"])
    outcome = integrate(problem, Run(stop=1.0))
    assert outcome.status == Status.SINGULAR
    assert outcome.culprits == ("loose.force",)


def test_algebraic_equations_without_a_solution_are_reported_at_the_start():
    def rhs(t, y, z, f):
        f[0], f[1] = 1.0, y[1] ** 2 + 1.0

    def jacobian(t, y, z, J, ft):
        J[1, 1] = 2 * y[1]

    outcome = integrate(textbook([0.0, 1.0], rhs, jacobian, algebraic=[1]), Run(stop=1.0))
    assert outcome.status in (Status.INCONSISTENT, Status.SINGULAR)
    assert outcome.t == 0.0


def test_a_poor_first_guess_of_an_algebraic_unknown_is_corrected_at_the_start():
    def rhs(t, y, z, f):
        f[0], f[1] = 1.0, np.exp(y[1]) - 2.0

    def jacobian(t, y, z, J, ft):
        J[1, 1] = np.exp(y[1])

    outcome = integrate(textbook([0.0, 5.0], rhs, jacobian, algebraic=[1]), Run(stop=1.0))
    assert outcome.ok, outcome.sentence
    assert outcome.values[0, 1] == pytest.approx(np.log(2.0), rel=1e-12)


def test_settings_that_do_not_fit_are_refused_with_both_numbers():
    problem, _ = nonlinear_ode()
    with pytest.raises(ValueError, match=r"stop = 0 s must be after start = 1 s"):
        integrate(problem, Run(start=1.0, stop=0.0))
    with pytest.raises(ValueError, match=r"every = -1 s must be above zero"):
        integrate(problem, Run(stop=1.0, every=-1.0))


def chattering_machine():
    """x' = -1 above zero and +1 below, without a zone to slide in: it can only toggle."""

    def rhs(t, y, z, f):
        f[0] = -1.0 if z[0] == 0 else 1.0

    def guards(t, y, z, g):
        g[0] = -y[0] - 1e-9 if z[0] == 0 else -1.0
        g[1] = y[0] - 1e-9 if z[0] == 1 else -1.0

    def switch(t, y, z, fired):
        z[0] = 1 - z[0]

    return textbook(
        [0.5], rhs, lambda *_: None, guards=guards, switch=switch, zones=[0], guard_machine=[0, 0],
        machine_names=["relay"], guard_tolerance=1e-12,
    )  # fmt: skip


def test_a_machine_that_toggles_faster_than_its_dwell_is_named_and_the_run_goes_on():
    outcome = integrate(chattering_machine(), Run(stop=0.500001, dwell=1e-7))
    assert outcome.ok
    assert outcome.chattering == ("relay",)


def test_chatter_may_stop_the_run():
    outcome = integrate(chattering_machine(), Run(stop=1.0, dwell=1e-6, on_chatter="stop"))
    assert outcome.status == Status.CHATTER
    assert outcome.culprits == ("relay",)
    assert outcome.t == pytest.approx(0.5, abs=1e-6)


def test_chatter_may_be_held_and_then_costs_one_switch_per_dwell():
    warned = integrate(chattering_machine(), Run(stop=0.500002, dwell=2e-6))
    held = integrate(chattering_machine(), Run(stop=0.500002, dwell=2e-6, on_chatter="hold"))
    assert held.ok
    assert held.chattering == ("relay",)
    assert len(held.events) < 0.01 * len(warned.events)


def test_counters_tell_who_switched_and_whose_error_rejected_steps():
    outcome = integrate(belt_block(), Run(stop=5.0, first_step=1.0))
    counters = outcome.counters
    assert counters.switches_by_machine.tolist() == [len(outcome.events)]
    assert counters.rejections_by_unknown.sum() == counters.rejected_error + counters.rejected_nan
    assert counters.solves > 8 * counters.steps
    assert counters.jacobians >= counters.steps


def test_a_guard_without_crossing_costs_no_switch():
    assert integrate(clock(lambda t, z: -1.0 - t), Run(stop=1.0)).counters.switches == 0
