"""Steps that are given up, cut or taken again, alone: who is counted, how long the next is, when a run ends."""

from __future__ import annotations

import math

import numpy as np
import pytest

from fairlead.integrate import one_step
from fairlead.integrate.codes import (
    CYCLES,
    DIVERGES,
    DONE,
    GO_ON,
    NOT_FINITE,
    NOT_SETTLED,
    SINGULAR,
    SINGULAR_MATRIX,
    STEP_FLOOR,
)
from fairlead.integrate.stepping.repeated import AT_PLACE, THETA_RISE, TRIES
from tests.integrate.plainly import plain_room
from tests.integrate.rooms import fields, memory


def given_up(**numbers):
    """A run with a trial step of 0.1 s from t = 1 s, an error of 5 weights in unknown 1, zones that were switched."""
    at = memory(
        {"n": 3, "n_machines": 2, "n_guards": 1, "t": 1.0, "h": 0.1, "adaptive": 1, "error": 5.0, "worst": 1,
         "error_exponent": 0.5, "step_floor": 1e-6, "start": 0.0, "stop": 100.0, "n_fired": 1, **numbers},
        rejections_by_unknown=np.zeros(3), zones=[1, 0], zones_at_start=[0, 0], f=np.zeros(3), y=[1.0, 2.0, 3.0],
        kick=np.zeros(3), kick_first=np.zeros(3), kick_second=np.zeros(3), switched=[0, 0], switched_after=[0.5, 0.0],
        left_at=np.zeros(2), latches=[1, 0], slope=np.zeros(3), weight=np.ones(3), differential=np.ones(3),
        unweighed=np.zeros(3),
    )  # fmt: skip
    at.number["rows"] = 0
    kept = fields(at, 3, rhs=(lambda t, y, f: np.copyto(f, [0.0, 0.0, np.nan if t > 1.0 and y[0] == 7 else 0.0]), 3))
    return at, kept


@pytest.mark.parametrize(
    ("status", "error", "counter"),
    [(DONE, 5.0, "rejected_error"), (DONE, math.nan, "rejected_nan"), (SINGULAR, math.inf, "rejected_singular")],
)
def test_a_step_that_is_rejected_counts_once_and_the_next_is_shorter_by_its_error(status, error, counter):
    at, kept = given_up(error=error)
    assert plain_room("one_step.reject", "")(at, 0.1, status) == GO_ON
    counts = {name: int(at.number[name]) for name in ("rejected_error", "rejected_nan", "rejected_singular")}
    assert counts == dict.fromkeys(counts, 0) | {counter: 1}
    assert at.array["rejections_by_unknown"].tolist() == [0, 1, 0]
    wanted = 0.1 * 0.9 * 5.0**-0.5 if error == 5.0 else 0.025
    assert at.number["h_next"] == pytest.approx(wanted, rel=1e-3)
    assert at.number["retried"] == 1
    assert kept


@pytest.mark.parametrize(
    ("status", "error", "law", "ends"),
    [(DONE, 5.0, 0, STEP_FLOOR), (DONE, math.nan, 0, NOT_FINITE), (DONE, math.nan, 7, NOT_FINITE),
     (SINGULAR, math.inf, 0, SINGULAR_MATRIX), (SINGULAR, math.inf, 7, NOT_FINITE)],
)  # fmt: skip
@pytest.mark.parametrize("why", ["adaptive", "floor"])
def test_a_run_ends_where_no_shorter_step_may_be_and_says_whose_law_is_no_number(status, error, law, ends, why):
    at, kept = given_up(error=error, **({"adaptive": 0} if why == "adaptive" else {"step_floor": 0.09}))
    at.array["y"][0] = law
    assert plain_room("one_step.reject", "")(at, 0.1, status) == ends
    assert at.number["worst"] == (2 if law == 7 else 1)
    assert kept


@pytest.mark.parametrize("error", [5.0, math.inf])
def test_a_step_of_stepping_with_too_large_an_error_is_taken_again_in_the_zones_it_began_in(error):
    at, kept = given_up(error=error, allowed=9.0)
    go = plain_room("stepping.repeated.reject_error", "")
    assert go(at, 0.1) == GO_ON
    assert at.array["zones"].tolist() == [0, 0]
    assert at.number["allowed"] == at.number["h_next"] < 0.1
    assert (at.number["rejected_error"], at.number["rejected_nan"]) == ((1, 0) if error == 5.0 else (0, 1))
    assert at.array["rejections_by_unknown"].tolist() == [0, int(error == 5.0), 0]
    at.number["adaptive"] = 0
    assert go(at, 0.1) == STEP_FLOOR
    assert kept


@pytest.mark.parametrize(("status", "counter", "ends"), [
    (CYCLES, "rejected_cycling", NOT_SETTLED), (DIVERGES, "rejected_diverged", STEP_FLOOR),
    (SINGULAR, "rejected_singular", SINGULAR_MATRIX),
])  # fmt: skip
def test_a_step_that_is_not_solved_is_halved_down_to_the_floor(status, counter, ends):
    at, kept = given_up()
    go = plain_room("stepping.repeated.halve_unsolved", "")
    h, taken = 0.1, 0
    while (said := go(at, h, status)) == GO_ON:
        taken += 1
        assert at.number["h_next"] == 0.5 * h
        assert at.array["zones"].tolist() == [0, 0]
        h = 0.5 * h
    assert said == ends
    assert taken == math.floor(math.log2(0.1 / 1e-6))
    assert at.number[counter] == taken + 1
    assert at.number["failed"] == 2 * (taken + 1)
    rise = min((taken + 1) * THETA_RISE, 0.5) if status == CYCLES else 0.0
    assert at.number["theta_raise"] == pytest.approx(rise)
    assert kept


def test_a_step_whose_zones_were_guessed_is_taken_as_long_without_guesses():
    at, kept = given_up(expecting=1)
    go = plain_room("stepping.repeated.halve_unsolved", "")
    go(at, 0.1, CYCLES)
    assert (at.number["h_next"], at.number["failed"], at.number["theta_raise"]) == (0.1, 1, 0.0)
    at, kept = given_up(adaptive=0)
    for k in range(3):  # a fixed step is made up of ever more halves
        go(at, 0.1, CYCLES)
        assert at.number["failed"] == 2 ** (k + 1)
    assert kept


@pytest.mark.parametrize(("slope", "after", "early"), [
    (0.0, 0.9e-7, True), (0.0, 1.1e-7, False), (1e9, 0.9e-10, True), (1e9, 1.1e-10, False), (1e12, 0.9e-12, True),
])  # fmt: skip
def test_a_jump_is_where_a_step_begins_if_nothing_moves_by_then(slope, after, early):
    """A billionth of 100 s; by slopes a tenth of a weight; the least step, 1e-12 s here."""
    at, kept = given_up(step_floor=1e-12, t_cut=1.0 + after)
    at.array["slope"][1] = slope
    asked = plain_room("stepping.repeated.jump_at_start", "run", "point", "stepping.rule")
    assert asked(at) == early
    at.array["differential"][1] = 0
    assert asked(at) == (after < 1e-7)
    assert kept


def test_a_step_ends_beside_a_jump_in_the_zones_of_its_start_or_after_so_many_tries():
    at, kept = given_up(passes=0, t_cut=1.1)
    go = plain_room("stepping.repeated.localise_jump", "point", "events.guards", "events.settling", "stepping")
    assert not go(at, 0.1)  # the first try says where
    assert at.number["localising"] == 1
    at.number["t_cut"] = 1.1 + 1.1 * AT_PLACE * 0.1
    assert not go(at, 0.1)
    at.number["t_cut"] = 1.1 - 0.9 * AT_PLACE * 0.1
    assert go(at, 0.1)
    assert at.array["zones"].tolist() == [0, 0]
    at.number["localising"], at.number["t_cut"] = TRIES, 1.05
    assert go(at, 0.1)
    at.number["passes"] = 1  # zones switched in it: no end to use
    assert not go(at, 0.1)
    assert at.number["t_cut"] == pytest.approx(1.05)
    assert kept


@pytest.mark.parametrize(("retried", "after", "adaptive", "found"), [
    (0, 0.005, 1, True), (0, 0.5, 1, False), (TRIES, 0.5, 1, True), (0, 0.005, 0, False),
])  # fmt: skip
def test_a_relay_that_switches_just_ahead_has_the_start_settled(retried, after, adaptive, found):
    at, kept = given_up(retried=retried, adaptive=adaptive, n_switched=1)
    at.array["switched_after"][0] = after
    assert plain_room("stepping.repeated.find_latch_ahead", "run", "events.guards", "stepping")(at) == found
    assert (at.number["locates_for"] > 0, at.number["rejected_switch"]) == (found, found)
    assert at.array["zones"].tolist() == ([0, 0] if found else [1, 0])
    assert kept


@pytest.mark.parametrize("seed", range(20))
def test_a_force_at_its_limit_is_asked_for_a_share_of_what_it_is(seed):
    rng = np.random.default_rng(seed)
    count, n = 4, 3
    row, limit, fired = rng.integers(-1, n, count), rng.integers(0, 2, count), rng.permutation(count)[:2]
    y, end = rng.normal(size=(2, n)) * rng.choice([1e-9, 1.0], n)
    absolute, relative = rng.uniform(0.1, 1, n), rng.uniform(0.01, 0.1, n)
    own = np.maximum(relative * np.maximum(np.abs(y), np.abs(end)), one_step.NEGLIGIBLE * absolute)
    error = own * one_step.ROUGH * rng.choice([0.9, -1.1], n)
    at = memory({"n": n, "n_guards": count, "n_fired": 2}, fired=[*fired, 0, 0], bounded_row=row, limit_guard=limit,
                y=y, y_end=end, error_vector=error, absolute=absolute, relative=relative)  # fmt: skip
    wanted = any(limit[i] and row[i] >= 0 and abs(error[row[i]]) > one_step.ROUGH * own[row[i]] for i in fired)
    assert plain_room("one_step.limits_are_rough", "problem", "point", "events.guards")(at) == wanted


@pytest.mark.parametrize("changes", [{}, {"g": -3e-9}, {"end": 1e-12}, {"adaptive": 0}, {"h": 0.4}, {"n_fired": 0}])
def test_a_load_that_turns_at_its_limit_is_below_it_at_the_end_of_a_step_longer_than_a_dwell(changes):
    step = changes.get("h", 2.0) * 1e-3 / one_step.DOUBT
    at = memory({"n_guards": 2, "n_fired": 2, "adaptive": 1, "dwell": 1e-3, "dwell_given": 1} |
                {name: value for name, value in changes.items() if name in ("adaptive", "n_fired")}, fired=[1, 0],
                g=[changes.get("g", 1e-10), -5e-10], g_end=[-1.0, changes.get("end", -1.0)],
                guard_tolerance=[1e-9] * 2)  # fmt: skip
    asked = plain_room("one_step.turns_at_limit", "run", "point", "events.guards")
    assert bool(asked(at, step)) == (not changes)


def test_a_stop_is_met_if_its_guard_is_among_those_that_fired():
    at = memory({"n_guards": 4, "n_fired": 2, "n_met_guards": 2}, fired=[2, 0, 3, 1], met_guard=[3, 1])
    met = plain_room("one_step.meets_stop", "problem", "events.guards")
    assert not met(at)
    at.number["n_fired"] = 3
    assert met(at)


@pytest.mark.parametrize(("passes", "g", "after", "half", "due"), [
    (0, [-0.05, -0.05], 1e-8, 0.05, [0]),  # found by the first solve: what falls due there
    (3, [-0.05, -0.05], 1e-8, 0.05, []),  # after switches its end tells nothing
    (3, [-0.05, 0.0], 1e-8, 0.05, [1]),  # but what is at its limit from the start
    (3, [-0.05, -0.05], 1e-8, 0.4e-7, [0, 1]),  # a step that is no longer than its start is not halved
    (3, [-0.05, -0.05], 1e-3, 0.05, None),
])  # fmt: skip
def test_an_end_of_zones_that_were_given_up_tells_no_jump_at_the_start(passes, g, after, half, due):
    """The first guard passes zero after `after` s by the line to the end, the second after 80 of 100 ms."""
    h = 2.0 * half
    at, kept = given_up(passes=passes, n_guards=2, n_fired=2, t_cut=1.0 + after)
    for name, values, kind in (("g", g, float), ("g_end", [-g[0] * (h / after - 1.0), 0.25 * abs(g[1])], float),
                               ("guard_tolerance", [1e-9, 1e-9], float), ("is_mean", [0, 0], np.int64),
                               ("fired", [0, 1], np.int64)):  # fmt: skip
        at.point(name, np.array(values), kind)
    at.spread()
    found = plain_room("stepping.repeated.due_at_start", "")(at, h)
    assert found == bool(due)
    if due:
        assert at.array["fired"][: at.number["n_fired"]].tolist() == due
    elif due is not None:
        assert at.number["t_cut"] == pytest.approx(1.0 + half)
    assert kept
