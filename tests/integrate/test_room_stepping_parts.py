"""Parts of a step of `stepping`, alone: guesses, rows that hold, jumps, touches, errors of forces, dense output."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from fairlead.integrate.codes import DIVERGES, DONE, INACCURATE, ONCE_MORE
from fairlead.integrate.linear import ordering
from fairlead.integrate.linear.condensing import columns_of
from tests.integrate.rooms import entry, factorise, fields, memory, room
from tests.integrate.test_linear import memory_for
from tests.integrate.test_room_inside import held_pair
from tests.integrate.test_room_linear import algebraic

H = 0.02


@pytest.mark.parametrize("seed", range(3))
def test_the_first_guess_of_an_end_goes_on_along_the_last_slope_with_forces_as_they_were(seed):
    rng = np.random.default_rng(seed)
    y, slope, differential = rng.normal(size=4), rng.normal(size=4), rng.integers(0, 2, 4)
    at = memory({"n": 4}, y=y, y_end=np.zeros(4), slope_before=slope, differential=differential)
    room("stepping.theta_step.predict", ("point", "stepping.rule"), "d")(at, H)
    np.testing.assert_array_equal(at.array["y_end"], np.where(differential, y + H * slope, y))


@pytest.mark.parametrize("theta", [0.5, 0.75, 1.0])
def test_quadratures_rise_by_the_power_at_the_theta_point_which_the_midpoint_rule_has_booked_already(theta):
    """E' = F v at u = y + theta (y1 - y)."""
    y, y_end = np.array([2.0, 5.0, 1.0]), np.array([4.0, 3.0, 1.0])
    seen = []

    def rhs(t, u, f):
        seen.append(t)
        f[:] = 0.0, 0.0, u[0] * u[1]

    at = memory({"n": 3, "n_quadratures": 1, "t": 1.0, "theta_now": theta}, y=y, y_end=y_end, u=np.zeros(3),
                f=np.zeros(3), quadrature=[0, 0, 1], differential=[1, 1, 1], controlled=np.zeros(3))  # fmt: skip
    kept = fields(at, 3, rhs=(rhs, 3))
    room("stepping.theta_step.add_quadratures", ("problem", "point", "stepping.rule"), "d")(at, H)
    u = y + theta * (y_end - y)
    if theta == 0.5:
        assert at.array["y_end"][2] == 1.0
    else:
        assert at.array["y_end"][2] == pytest.approx(1.0 + H * u[0] * u[1])
        assert seen == [pytest.approx(1.0 + theta * H)]
    assert kept


@functools.cache
def judged():
    from fairlead.integrate.memory.foreign import compiled
    from fairlead.integrate.stepping.theta_step import judge_residual

    @compiled
    def judge(problem, point, linear, stepping, h, solves, previous):
        return judge_residual(problem, point, linear, stepping, h, solves, previous)[0]

    return entry(judge, ("problem", "point", "linear", "stepping"), "did", "i")


@pytest.mark.parametrize(
    ("linear", "residual", "solves", "previous", "verdict", "linearised"),
    [
        (0, 1e-30, 1, 1.0, DONE, 1),
        (0, 1e-30, 3, 1.0, DONE, 0),  # it took many: J is evaluated for the next step
        (0, 1e3, 2, 1e6, ONCE_MORE, 1),
        (0, 1e3, 2, 1e4, ONCE_MORE, 0),  # it shrinks by less than a hundredth
        (0, 1e3, 10, 1e6, DIVERGES, 1),
        (0, np.nan, 1, 1.0, DIVERGES, 1),
        (1, 1e3, 2, 1e6, ONCE_MORE, 1),
        (1, 1e3, 3, 1e6, INACCURATE, 0),
    ],
)
def test_what_follows_a_solve_depends_on_what_is_left_and_how_many_there_were(
    linear, residual, solves, previous, verdict, linearised
):
    at = memory({"n": 1, "linear": linear, "linearised": 1, "dense": 1, "unchecked": 1}, b=[residual],
                row_scale=[1.0], weight=[1.0], quadrature=[0], column_scale=[1.0], diagonal_mass=[-1])  # fmt: skip
    assert judged()(at, 0.1, solves, previous) == verdict
    assert at.number["linearised"] == linearised
    assert at.number["unchecked"] == (0 if verdict == DONE else 1)


@pytest.mark.parametrize(("ulps", "verdict"), [(2, DONE), (6, ONCE_MORE)])
def test_what_rounding_leaves_of_a_change_is_solved_however_small_its_weight_is(ulps, verdict):
    """M (y1 - y0)/h with M = 2 and y = 2^23: an ulp of that is 2^-29, over h = 1/8."""
    left = ulps * 2.0 * 2.0**-29 * 8.0
    at = memory({"n": 1, "linear": 0, "linearised": 1, "dense": 1, "n_mass": 1}, b=[left], row_scale=[1e3 / left],
                weight=[1.0], quadrature=[0], column_scale=[1.0], diagonal_mass=[0], mass=[2.0],
                y_end=[2.0**23])  # fmt: skip
    assert judged()(at, 0.125, 1, 1.0) == verdict


def test_zones_that_are_given_back_are_not_those_of_the_matrix():
    zones = np.array([1, 2])
    at = memory({"n_machines": 2, "n_fired": 3}, zones_at_start=[5, 6])
    at.point("zones", zones, np.int64)
    room("stepping.theta_step.give_back_zones", ("events.guards", "stepping"))(at)
    assert zones.tolist() == [5, 6]
    assert (at.number["zones_differ"], at.number["n_fired"]) == (1, 0)


@pytest.mark.parametrize(
    ("rest", "h", "adaptive", "step"),
    [(0.25, 1.0, 1, 0.5), (0.6, 1.0, 1, 1.0), (0.25, 1.0, 0, 1.0), (1e-9, 1.0, 1, 1.0)],
)
def test_a_step_over_a_kink_is_implicit_and_goes_as_far_behind_it_as_before(rest, h, adaptive, step):
    at = memory({"t": 2.0, "t_kink": 2.0 + rest, "adaptive": adaptive, "step_floor": 1e-6, "landing": 1})
    over = room("stepping.trial.step_over_kink", ("run", "point", "stepping.rule"), "d", "d")
    assert over(at, h) == pytest.approx(step)
    assert at.number["theta_now"] == 1.0
    assert at.number["landing"] == (0 if step < h else 1)


@pytest.mark.parametrize(("after", "changed"), [([1, 0], False), ([0, 1], True), ([0, 0], False)])
def test_a_part_is_left_when_a_machine_at_its_boundary_has_changed(after, changed):
    at = memory({"n_machines": 2}, zones_at_start=[0, 0], boundary=[0, 1])
    at.point("zones", np.array(after), np.int64)
    assert room("stepping.trial.boundary_changed", ("events.settling", "stepping.contacts"), "", "b")(at) == changed


@pytest.mark.parametrize(("always", "count", "locates"), [(1, 0, True), (0, 0, False), (0, 1, False), (0, 2, True)])
def test_steps_end_at_switches_always_or_for_some_settlements_more(always, count, locates):
    at = memory({"always_locates": always, "locates_for": count})
    assert room("stepping.trial.will_locate", ("stepping.rule",), "", "b")(at) == locates


def test_violators_of_a_step_are_above_their_tolerance():
    at = memory({"n_guards": 4}, g_end=[1e-3, 2e-3, -1.0, 5.0], guard_tolerance=[1e-3, 1e-3, 1e-3, 10.0],
                fired=np.zeros(4))  # fmt: skip
    room("stepping.active_set.fire_violators_of_step", ("events.guards",))(at)
    assert at.array["fired"][: int(at.number["n_fired"])].tolist() == [1]


def test_how_wrong_a_guard_is_is_a_force_beyond_a_limit_or_the_one_that_takes_a_slip_away_in_the_step():
    at = memory({"n_guards": 3, "n_fired": 2}, g_end=[7.0, 0.3, 9.0], guard_inertia=[4.0, 4.0, 4.0],
                limit_guard=[1, 0, 0], fired=[0, 1, 0], wrong=np.zeros(3))  # fmt: skip
    room("stepping.active_set.find_how_wrong", ("events", "stepping.contacts"), "d")(at, H)
    assert at.array["wrong"].tolist() == [7.0, pytest.approx(4.0 * 0.3 / H), 0.0]


@pytest.mark.parametrize("algebraic_speeds", [0, 1])
def test_limits_are_read_at_the_theta_point_and_slips_at_the_end_but_of_nodes_without_inertia(algebraic_speeds):
    """Guard i is i + place: of a limit, of a slip, of a slip of a contact on such a node."""
    at = memory(
        {"n": 1, "n_guards": 3, "n_machines": 3, "t_release": 1e308, "theta_now": 0.5, "has_limits": 1,
         "algebraic_speeds": algebraic_speeds}, y=[0.0], y_end=[0.5], u=[0.0], g_end=np.zeros(3), g_probe=np.zeros(3),
        guard_tolerance=np.full(3, 1e-9), limit_guard=[1, 0, 0], guard_machine=[0, 1, 2], hold_row=[0, -1, 0],
        of_algebraic_speed=[1], differential=[1], controlled=[0],
    )  # fmt: skip

    def guards(_t, y, g):
        g[:] = y[0], 1.0 + y[0], 2.0 + y[0]

    kept = fields(at, 1, guards=(guards, 3))
    room("stepping.active_set.evaluate_guards_of_step", ("",), "d")(at, H)
    assert at.array["g_end"].tolist() == [0.25, 1.5, 2.25 if algebraic_speeds else 2.5]
    assert at.number["time_dependent_limits"] == 1
    assert kept


def test_rows_in_which_the_mass_matrix_has_an_entry_hold_and_lose_their_slopes():
    """Row 2 holds anew, row 3 held and does no more, row 4 holds an algebraic speed on a surface that moves."""
    at = memory(
        {"n": 5, "n_hold_mass": 3, "n_hold_slope": 3, "n_jacobian": 3, "n_mass": 3}, holds=[0, 0, 0, 1, 1],
        captured=np.zeros(5), jacobian=[7.0, 8.0, 9.0], ft=[0.0, 0.0, 0.0, 0.0, 3.0], hold_mass=[0, 1, 2],
        hold_mass_row=[2, 3, 4], hold_mass_column=[0, 0, 1], mass=[1.0, 0.0, -1.0], differential=[1, 0, 0, 0, 0],
        of_algebraic_speed=np.zeros(5), hold_slope=[0, 1, 2], hold_slope_row=[2, 3, 4],
    )  # fmt: skip
    room("stepping.linearise.find_holds", ("point", "linear.matrices", "stepping.exchange"))(at)
    assert at.array["holds"].tolist() == [0, 0, 1, 0, 1]
    assert at.array["captured"].tolist() == [0, 0, 1, 0, 0]
    assert at.array["of_algebraic_speed"].tolist() == [0, 0, 0, 0, 1]
    assert at.array["jacobian"].tolist() == [0.0, 8.0, 0.0]
    assert [at.number[name] for name in ("any_captured", "support_accelerates", "algebraic_speeds")] == [1, 1, 1]


@pytest.mark.parametrize("seed", range(10))
def test_of_the_row_of_a_law_that_jumps_its_mean_is_asked_and_what_moves_the_end(seed):
    """r falls along the step to J at the place of the limit: s J, -12 s^2 J and 2 s (3 s - 1) J."""
    rng = np.random.default_rng(seed)
    gap, at_limit = 0.5 * H, rng.uniform(0.0, 1.0)  # of the way between the middles
    start, end = rng.normal(size=2) * 10.0
    at = memory(
        {"n": 2, "n_machines": 2, "gap": gap}, y=[0.0, 0.0], y_end=[1.0, 0.0], x=np.zeros(2), f=np.zeros(2),
        holder=[0, 1], jump_at=[at_limit, at_limit], jumped=np.zeros(2), falls=[1, 0], column_scale=np.full(2, 1e-9),
        kick=np.zeros(2), kick_first=np.zeros(2), kick_second=np.zeros(2),
    )  # fmt: skip

    def forces(_t, y, f):
        f[:] = start + y[0] * (end - start)

    kept = fields(at, 2, forces=(forces, 2))
    room("stepping.jump_inside.ask_of_rows", ("",), "d")(at, H)
    jump = np.interp(at_limit, [0, 1], [start, end])
    s = np.interp(at_limit, [0, 1], [-gap, 0.5 * H]) / H
    assert at.array["kick"] == pytest.approx([s * jump, 0.0])
    assert at.array["kick_first"] == pytest.approx([-12 * s**2 * jump, 0.0])
    assert at.array["kick_second"] == pytest.approx([2 * s * (3 * s - 1) * jump, 0.0])
    assert at.array["jumped"].tolist() == [1, 0]
    assert kept


def test_a_limit_is_placed_of_those_that_left_the_zone_of_the_start_by_a_guard_that_may_jump():
    """Machine 0 stays; 1 left it by its limit; 2 by another guard; 3 was in another zone before this pass."""
    at = memory(
        {"n_machines": 4, "n_guards": 4, "n_suspects": 4}, suspects=[0, 1, 2, 3], guard_machine=[0, 1, 2, 3],
        may_jump=[1, 1, 0, 1], zones_probed=[0, 0, 0, 5], zones_at_start=np.zeros(4), jump_at=np.zeros(4),
        g=[-1.0, -1.0, -1.0, -1.0], g_end=[3.0, 3.0, 3.0, 3.0], guard_tolerance=np.full(4, 1e-9),
    )  # fmt: skip
    at.point("zones", np.array([0, 1, 1, 1]), np.int64)
    room("stepping.jump_inside.find_limits", ("events.guards", "stepping.contacts"))(at)
    assert at.array["jump_at"].tolist() == [-2.0, 0.25, -1.0, -1.0]


def touched(third, end=-1.0, start=-1.0, error=1.0, machine=0, gap=0.0, place=None, h=H):
    """A memory with the guard of a stop; in the middle of the step or one before it is `third`."""
    at = memory(
        {"n": 1, "n_guards": 1, "n_machines": 1, "n_free_guards": 1, "gap": gap, "t_release": 1e308, "error": error},
        y=[0.0], y_end=[1.0], D=np.zeros(3), y_probe=[0.0], g=[start], g_end=[end], g_before=[third], g_late=[0.0],
        g_probe=[0.0], guard_machine=[machine], guard_tolerance=[1e-9], hold_row=[-1], kink_guard=[0], fired=[0],
    )  # fmt: skip
    found = {}

    def guards(t, y, g):
        found["t"] = t
        s = y[0]
        g[0] = start + (end - start) * s + 4.0 * (third - 0.5 * (start + end)) * s * (1.0 - s)

    return at, fields(at, 1, guards=(guards, 1)), found


@pytest.mark.parametrize(("top", "found"), [(0.2, True), (-0.2, False)])
def test_in_a_step_that_no_error_limits_a_touch_is_looked_for_in_eight_parts(top, found):
    at, kept, _ = touched(top)
    assert room("stepping.passed_over.find_touch_while_idle", ("",), "d", "b")(at, H) == found
    if found:  # first above zero: -1 + 4 (top + 1) s (1 - s)
        first = next(k for k in range(1, 8) if -1.0 + 4.0 * (top + 1.0) * (k / 8) * (1 - k / 8) > 0.0)
        assert at.number["t_cut"] == pytest.approx(first / 8 * H)
    assert at.number["guards"] == (first if found else 7)
    assert kept


@pytest.mark.parametrize("machine", [-1, 0])
def test_guards_of_no_machine_touch_nothing(machine):
    at, kept, _ = touched(0.5, machine=machine)
    assert room("stepping.passed_over.find_touch_while_idle", ("",), "d", "b")(at, H) == (machine == 0)
    assert kept


@pytest.mark.parametrize("slope", [0.0, 0.4, -0.4])
def test_a_touch_is_asked_where_the_parabola_through_both_ends_and_the_middle_is_highest(slope):
    """One that falls short of zero by the allowance: it is asked there, and found to touch nothing."""
    start, end = -1.0 - 0.5 * slope, -1.0 + 0.5 * slope
    at, kept, found = touched(-0.05, end=end, start=start)
    assert not room("stepping.passed_over.find_touch", ("",), "d", "b")(at, H)
    curve, line, _ = np.polyfit([0.0, 0.5, 1.0], [start, -0.05, end], 2)
    assert found["t"] == pytest.approx(-line / (2 * curve) * H)
    assert at.number["guards"] == 2
    assert kept


def test_what_follows_a_slow_load_lags_by_a_twelfth_of_what_the_last_solve_left():
    """`sharpen` leaves c/2 in `minus_slip`; one weight of c/12 is allowed, in an error of which a tenth is."""
    c = np.array([12.0, -6.0, 1e-3])
    at = memory({"n": 3}, error_vector=[0.0, 0.01, 5.0], minus_slip=0.5 * c)
    room("stepping.located_step.add_lag", ("point",))(at)
    np.testing.assert_allclose(at.array["error_vector"], np.maximum([0.0, 0.01, 5.0], 0.1 * np.abs(c) / 12.0))


@pytest.mark.parametrize("speed", [0.0, 3.0, 3e13])
def test_the_error_of_a_holding_force_is_a_share_of_its_second_difference_beyond_the_rounding_of_a_momentum(speed):
    mass, entry_of_row, slope, before = 2.0, -0.5, 8.0, 3.0
    at = memory(
        {"n": 2, "n_hold_mass": 1, "n_mass": 2}, error_vector=np.zeros(2), mean_slope=[0.0, slope],
        slope_before=[0.0, before], holds=[0, 1], differential=[1, 0], hold_mass=[1], hold_mass_row=[1],
        hold_mass_column=[0], mass=[mass, entry_of_row], diagonal_mass=[0, -1], y_end=[speed, 0.0],
    )  # fmt: skip
    room("stepping.located_step.add_error_of_forces", ("",), "d")(at, H)
    ulps = 16 * np.finfo(float).eps * abs(mass * speed / entry_of_row) / H
    assert at.array["error_vector"][1] == pytest.approx(max(0.025 * (H * (slope - before) - ulps), 0.0), rel=1e-12)


@pytest.mark.parametrize("gap", [0.0, 0.004])
def test_a_force_that_changes_evenly_is_in_the_middle_what_the_line_through_two_middles_says(gap):
    """F = 2 + 5 t, from the start of the first step or the middle of the one before."""
    t, slope = 1.0, 5.0
    at = memory({"n": 1, "gap": gap}, y=[2.0 + slope * t], mean_slope=[slope], mean_before=[2.0 + slope * (t - gap)],
                differential=[0])  # fmt: skip
    room("stepping.located_step.remember_middle", ("point", "stepping.rule"), "d")(at, H)
    assert at.array["mean_before"][0] == pytest.approx(2.0 + slope * (t + 0.5 * H))


@pytest.mark.parametrize(("slip", "notices"), [(1e-12, False), (1e-3, True)])
def test_a_slip_at_the_start_counts_if_stopping_it_in_the_step_takes_a_force_above_a_tenth_of_a_weight(slip, notices):
    """m v/h with 3 kg, 0.02 s and a weight of 1: 0.15 N for 1 mm/s."""
    at = memory({"n": 2, "n_machines": 1, "h": H}, y=[0.0, 0.0], minus_slip=np.zeros(2), holder=[-1, 0], holds=[0, 1],
                weight=[1.0, 1.0], absolute=[1.0, 1.0], relative=np.zeros(2), cap=np.full(2, np.inf),
                held_inertia=[3.0])  # fmt: skip

    def drift(_t, _y, out):
        out[:] = 0.0, -slip

    kept = fields(at, 2, drift=(drift, 2))
    assert room("stepping.located_step.holds_with_slip", ("",), "", "b")(at) == notices
    assert kept


def test_the_bulge_of_a_step_keeps_together_what_holds_and_leaves_the_mean_of_its_momentum():
    """Two bodies that hold each other, of which the dense output of one bulges more."""
    bulge = np.array([3.0, -1.0, 0.0])
    at, masses, scale = held_pair([1.0, 1.0])
    at.array["D"][:3] = bulge
    factorise(at, scale)
    room("stepping.dense_output.hold_inside", ("",))(at)
    together = masses @ bulge[:2] / masses.sum()
    np.testing.assert_allclose(at.array["D"][:3], [together, together, 0.0], rtol=1e-12)
    assert at.number["rows_slip"] == 0


def test_where_a_surface_accelerates_every_row_is_done_by_itself():
    at, _, scale = held_pair([1.0, 1.0])
    at.number["support_accelerates"] = 1
    at.array["D"][:3] = 3.0, -1.0, 0.0
    factorise(at, scale)
    room("stepping.dense_output.hold_inside", ("",))(at)
    assert at.array["D"][:3].tolist() == [3.0, -1.0, 0.0]
    assert at.number["rows_slip"] == 1


@pytest.mark.parametrize("known", [0, 1])
def test_a_node_without_inertia_that_is_held_has_at_the_end_the_speed_of_its_surface(known):
    """Speed and force of a node with a damper, 0 = F - d v; the row -(v - w) with w the speed of the surface."""
    damper, surface, mean, scale = 4.0, 1.5, 0.9, 100.0
    J, M = np.array([[-damper, 1.0], [0.0, 0.0]]), np.array([[0.0, 0.0], [1.0, 0.0]])
    problem, _ = algebraic(2, np.ones((2, 2), bool), True)
    problem.mass_pattern, problem.differential = problem.pattern, np.zeros(2, bool)
    at = memory_for(problem, ordering.dense_plan(problem))
    for name, matrix in (("jacobian", J), ("mass", M)):
        at.array[name][:] = matrix[problem.pattern.rows, columns_of(problem.pattern)]
    at.number["n_hold_mass"] = 1
    for name, values in (("holds", [0, 1]), ("of_algebraic_speed", [0, known]), ("hold_mass_row", [1]),
                         ("hold_mass_column", [0])):  # fmt: skip
        at.point(name, np.array(values), np.int64)
    at.array["y_end"][:] = mean, damper * mean
    at.spread()

    def drift(_t, y, out):
        out[:] = 0.0, surface - y[0]

    kept = fields(at, 2, drift=(drift, 2))
    factorise(at, scale)
    room("stepping.dense_output.end_algebraic_speeds", ("problem", "point", "linear", "stepping.exchange"), "d")(at, H)
    assert at.array["y_end"][0] == pytest.approx(surface if known else mean)
    assert at.array["y_end"][1] == damper * mean
    assert kept
