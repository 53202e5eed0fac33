"""Parts of a settlement and of a step given up, alone: guards, ways of loads, places and balances, signs of forces."""

from __future__ import annotations

import ctypes
import itertools

import numpy as np
import pytest

from fairlead.integrate.codes import BEFORE, DONE, GO_ON, NONE_DUE, SETTLE, SETTLING_FOR_IT
from fairlead.integrate.linear.condensing import columns_of
from tests.integrate.rooms import factorise, fields, memory, room
from tests.integrate.test_linear import memory_for
from tests.integrate.test_room_linear import algebraic

NOT_REACHED = 2.0


def point_of(W, numbers, y, **given):
    """A memory with the matrix W of a full plan, unknowns y, and error weights of 1e-3."""
    n = len(W)
    problem, plan = algebraic(n, (W != 0) | np.eye(n, dtype=bool), True)
    at = memory_for(problem, plan)
    at.array["jacobian"][:] = -W[problem.pattern.rows, columns_of(problem.pattern)]
    for name, value in numbers.items():
        at.number[name] = value
    for name, values in {"absolute": np.full(n, 1e-3), "cap": np.full(n, np.inf), **given}.items():
        at.point(name, np.asarray(values), np.int64 if name in INDEX else np.float64)
    at.array["y"][:] = y
    at.spread()
    return at


INDEX = (
    "balanced_position", "balanced_speed", "move_position", "move_speed", "move_acceleration", "pressing_row",
    "pressing_sign", "pressing_wrong",
)  # fmt: skip


def asked(values, count=1, n=1, **numbers):
    """A memory whose guards are `values(t, y)`; keep what is returned with it."""

    def guards(t, y, g):
        g[:] = values(t, y)

    at = memory({"n": n, "n_guards": count, "n_machines": count, "t_release": 1e308, **numbers},
                guard_machine=np.arange(count), g=np.zeros(count), g_probe=np.zeros(count), fired=np.zeros(count),
                guard_tolerance=np.full(count, 1e-9), blocked_until=np.zeros(count), y=np.zeros(n),
                y_probe=np.zeros(n), latch_guard=np.zeros(count))  # fmt: skip
    return at, fields(at, n, guards=(guards, count))


@pytest.mark.parametrize("release", [1e308, 2.0])
def test_a_machine_that_is_kept_in_its_zone_has_no_guard_until_its_time_has_passed(release):
    at, kept = asked(lambda t, y: [1.0, 2.0, 3.0], 3, t_release=release)
    at.array["blocked_until"][:] = 2.0, 0.5, 1.0
    at.array["guard_machine"][2] = -1
    room("events.guards.evaluate_guards", ("problem", "run", "events.guards"), "dii")(
        at, 1.0, at.array["y"], at.array["g"]
    )
    assert at.array["g"].tolist() == [-1.0 if release == 2.0 else 1.0, 2.0, 3.0]
    assert at.number["guards"] == 1
    assert kept


@pytest.mark.parametrize(("fired", "left"), [([0, 1, 2], [0, 2]), ([1, 3], [1, 3]), ([], [])])
def test_what_remembers_waits_until_nothing_else_changes(fired, left):
    at = memory({"n_guards": 4, "n_fired": len(fired)}, fired=[*fired, *[0] * (4 - len(fired))],
                latch_guard=[0, 1, 0, 1])  # fmt: skip
    room("events.guards.latches_wait", ("problem", "events.guards"))(at)
    assert at.array["fired"][: int(at.number["n_fired"])].tolist() == left


def test_guards_along_a_step_are_those_of_the_interpolant_and_at_its_end_those_of_the_time_it_lands_on():
    seen = []

    def values(t, y):
        seen.append((t, float(y[0])))
        return [0.0]

    at, kept = asked(values, t=1.0)
    for name, value in (("y", [2.0]), ("y_end", [4.0]), ("D", [0.5, 0.0, 0.0])):
        at.point(name, np.array(value), np.float64)
    at.number["landing"], at.number["t_land"] = 1, 1.5000000001
    for s in (0.25, 1.0):
        room("events.guards.guards_at", ("",), "ddi")(at, s, 0.5, at.array["g"])
    assert seen == [(1.125, pytest.approx(2.0 + 0.25 * 2.0 + 0.25 * 0.75 * 0.5)), (1.5000000001, 4.0)]
    assert kept


def test_a_step_that_is_taken_again_is_as_long_as_asked_and_tells_whether_it_was_too_long():
    at = memory({"retried": 2})
    for why, retried in ((0, 2), (1, 3)):
        assert room("events.given_up.take_again", ("run",), "di", "i")(at, 0.25, why) == GO_ON
        assert (at.number["h_next"], at.number["retried"]) == (0.25, retried)


@pytest.mark.parametrize("judged", [0, 1])
@pytest.mark.parametrize("slope", [-1.0, 1.0])
def test_guards_that_were_never_below_zero_settle_the_start_unless_it_is_settled_and_they_fall_from_it(judged, slope):
    at, kept = asked(lambda _t, y: [y[0]], adaptive=1, judged=judged, n_fired=1, row_capacity=4, stop=1.0)
    given = {"slope": [slope], "weight": [1e-3], "curvature": [0.0], "g_end": [1.0], "u": [0.0],
             "row_t": np.zeros(4), "row_values": np.zeros(4), "patterns_met": np.zeros(4)}  # fmt: skip
    for name, values in given.items():
        at.point(name, np.array(values), np.float64)
    at.point("row_side", np.zeros(4), np.int64)
    at.point("differential", np.ones(1), np.int64)
    assert room("events.given_up.settle_inconsistent_start", ("",), "d", "i")(at, 0.5) == GO_ON
    assert at.number["rejected_inconsistent"] == 1
    if judged and slope < 0.0:
        assert at.number["h_next"] == 0.05
        assert at.number["phase"] != SETTLE
        assert at.number["n_fired"] == 0
    else:
        assert at.number["phase"] == SETTLE
        assert at.array["row_side"][0] == BEFORE
    assert kept


def test_the_first_sample_is_taken_at_the_settled_point_and_the_scene_begins_from_what_was_given():
    """Time events are asked just before the start, then at it twice: of the settled values and of the given ones."""
    times, places = [], []

    def at_time(_c, t, at_y):
        times.append(t)
        places.append(ctypes.c_double.from_address(at_y).value)
        return 0

    call = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64, ctypes.c_double, ctypes.c_int64)(at_time)
    zones = np.array([3])
    at = memory({"n": 1, "n_machines": 1, "t": 100.0, "start": 100.0, "stop": 101.0, "n_fired": 1}, y=[7.0],
                begun=[0.0], zones_given=[0], slope=[1.0], lost=[1.0], not_given_back=[1.0], patterns_met=[0.0],
                guard_machine=[-1], fired=[0])  # fmt: skip
    at.point("zones", zones, np.int64)
    at.number["call_at_time"] = ctypes.cast(call, ctypes.c_void_p).value
    room("events.first_sample.settle_for_sample", ("problem", "run", "point", "events"))(at)
    assert at.number["first_sample"] == SETTLING_FOR_IT
    assert 99.999999 < times[0] < 100.0
    at.array["y"][0], zones[0] = 8.0, 4  # what a settlement makes of them
    room("events.first_sample.take_first_sample", ("problem", "run", "point", "events"))(at)
    assert times[1:] == [100.0, 100.0]
    assert places == [7.0, 8.0, 7.0]
    assert (at.array["y"][0], zones[0]) == (7.0, 3)
    assert [at.array[name][0] for name in ("slope", "lost", "not_given_back")] == [0.0, 0.0, 0.0]
    assert (at.number["first_sample"], at.number["n_fired"], at.number["nothing_before"]) == (NONE_DUE, 0, 1)


@pytest.mark.parametrize("often", [0, 8])
@pytest.mark.parametrize(("first", "pressing"), [(1.0, 0), (-1.0, 0), (-1.0, 1)])
def test_without_an_answer_guards_are_asked_at_the_point_before_then_without_forces_that_press(first, pressing, often):
    """The second guard is above zero where the force y1 is zero."""
    at, kept = asked(lambda _t, y: [first * y[0], 0.5 - abs(y[1])], 2, 2, n_pressing=pressing, without_answer=often)
    for name, values in (("y_unsettled", [2.0, 3.0]), ("slope_unsettled", [4.0, 5.0]), ("slope", np.zeros(2))):
        at.point(name, np.array(values), np.float64)
    at.point("pressing_row", np.array([1]), np.int64)
    fires = room("events.no_answer.fire_without_answer", ("",), "", "b")(at)
    wanted = [] if often else [0] if first > 0.0 else [1] if pressing else []
    assert fires == bool(wanted)
    if not often:
        assert at.array["fired"][: int(at.number["n_fired"])].tolist() == wanted
        assert at.array["y"].tolist() == [2.0, 3.0]
        assert at.array["slope"].tolist() == [4.0, 5.0]
    assert kept


@pytest.mark.parametrize("seed", range(30))
def test_rigid_parts_can_have_the_answers_of_a_matrix_without_a_negative_principal_minor(seed):
    """Answers are the inverse of W in the signs of the parts; all 2^n - 1 minors by numpy."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 5))
    W, signs = rng.normal(size=(count, count)) + 1.5 * np.eye(count), rng.choice([-1, 1], count)
    W *= signs  # so that about half of the draws have no negative minor
    answers = np.linalg.inv(W) * signs
    subsets = itertools.chain.from_iterable(itertools.combinations(range(count), k) for k in range(1, count + 1))
    minors = [np.linalg.det(answers[np.ix_(some, some)]) for some in subsets]
    at = point_of(W, {"n_pressing": count}, np.zeros(count), pressing_row=np.arange(count), pressing_sign=signs,
                  pressing_wrong=np.zeros(count), pressing_answer=np.zeros(count**2),
                  pressing_left=np.zeros(count**2))  # fmt: skip
    factorise(at, 1.0)
    assert room("events.right_root.are_rigid", ("problem", "point", "linear"), "", "b")(at) == (min(minors) >= 0.0)


@pytest.mark.parametrize("seed", range(60))
def test_a_slip_comes_back_at_the_first_root_at_which_it_rises(seed):
    rng = np.random.default_rng(seed)
    value, rate, rate_end = -rng.uniform(0.0, 0.5) * (seed % 3 > 0), *rng.normal(size=2)
    roots = np.roots([0.5 * (rate_end - rate), rate, value])
    rising = [r.real for r in roots if abs(r.imag) < 1e-12 and rate + (rate_end - rate) * r.real > 0.0]
    wanted = min([r for r in rising if -1e-12 <= r <= 1.0], default=NOT_REACHED)
    found = room("events.fast_way.first_root", (), "ddd", "d")(memory(), value, rate, rate_end)
    assert found == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize(
    ("now", "then", "share"),
    [(-1.0, 3.0, 0.25), (-1.0, -0.5, NOT_REACHED), (0.0, 1.0, 0.0), (0.0, -1.0, NOT_REACHED), (0.5, 0.5, NOT_REACHED)],
)
def test_a_load_brings_a_guard_to_zero_after_the_share_of_its_way_that_a_line_says(now, then, share):
    at = memory({"n_guards": 1}, g=[now], g_probe=[then], guard_tolerance=[1e-9])
    assert room("events.fast_way.reached_by_load", ("events.guards",), "i", "d")(at, 0) == share


def test_of_a_way_that_is_gone_in_shares_the_rest_of_the_load_is_left():
    """Two thirds, then half of the rest: five sixths of the way; loads that are out and left shrink alike."""
    n = 2
    at = memory(
        {"n": n, "levels": 1}, x=[6.0, 3.0], y=[0.0, 1.0], slope=[2.0, 0.0], differential=[1, 0], out=[12.0, 5.0],
        left=[1.0], g=[0.0], guard_tolerance=[1e-9], may_hold=[0], rate=[0.0], rate_end=[0.0], fast_slip=[0.0],
        born=[0], came_back=[0],
    )  # fmt: skip
    go = room("events.fast_way.go_along", ("problem", "point", "events"), "d")
    go(at, 2.0 / 3.0)
    assert at.array["slope"][0] == pytest.approx(2.0 + 4.0)
    assert at.array["y"].tolist() == [0.0, pytest.approx(1.0 + 2.0)]
    at.array["x"][:] = 2.0, 1.0  # what is left of the way
    go(at, 0.5)
    assert at.array["out"] == pytest.approx([2.0, 5.0 / 6.0])
    assert at.array["left"][0] == pytest.approx(1.0 / 6.0)


@pytest.mark.parametrize(("rate", "rate_end", "born"), [(-3.0, -1.0, 1), (0.0, 0.0, 0)])
def test_a_slip_in_the_time_of_a_level_is_the_integral_of_its_rate(rate, rate_end, born):
    """Of a rate that goes evenly from one value to the other, over a share s of what is left of the level."""
    s, left = 0.4, 0.5
    at = memory(
        {"n": 1, "n_guards": 1, "levels": 1}, x=[0.0], y=[0.0], slope=[0.0], differential=[1], out=[0.0], left=[left],
        g=[0.0], guard_tolerance=[1e-9], may_hold=[1], rate=[rate], rate_end=[rate_end], fast_slip=[0.0], born=[0],
        came_back=[0],
    )  # fmt: skip
    room("events.fast_way.go_along", ("problem", "point", "events"), "d")(at, s)
    nodes, weights = np.polynomial.legendre.leggauss(3)
    places = 0.5 * s * (nodes + 1.0)
    integral = 0.5 * s * weights @ (rate + (rate_end - rate) * places)
    assert at.array["fast_slip"][0] == pytest.approx(left * integral)
    assert at.array["born"][0] == born


@pytest.mark.parametrize(("off", "moves"), [(1e-13, False), (5e-4, True), (2e-3, False)])
def test_a_node_between_two_springs_goes_to_where_they_balance_by_less_than_a_weight_and_more_than_rounding(off, moves):
    """k1 (a - x) + k2 (b - x) = 0 at (k1 a + k2 b)/(k1 + k2); a weight is 1e-3."""
    k1, k2, a, b = 30.0, 50.0, 1.0, 3.0
    place = (k1 * a + k2 * b) / (k1 + k2)

    def gap(_t, y, out):
        out[:] = 0.0, k1 * (a - y[0]) + k2 * (b - y[0])

    at = point_of(np.diag([1.0, k1 + k2]), {"n_balanced": 1}, [place + off, 0.0], balanced_position=[0],
                  balanced_speed=[1])  # fmt: skip
    kept = fields(at, 2, gap=(gap, 2))
    factorise(at, 1.0)
    assert room("events.balance.close_balance", ("problem", "point", "linear"), "", "b")(at) == moves
    assert at.array["y"][0] == pytest.approx(place if moves else place + off, abs=1e-15)
    assert kept


@pytest.mark.parametrize("start", [0.0, 1.0])
def test_what_springs_give_in_a_jump_is_dissipated_but_at_the_start(start):
    k, off = 40.0, 0.2

    def gap(_t, y, out):
        out[:] = 0.0, -k * y[0], 0.0

    def energy(_t, y, out):
        out[:] = 99.0, 0.5 * k * y[0] ** 2

    at = point_of(np.diag([1.0, k, 1.0]), {"n_balanced": 1, "n_outputs": 2, "dissipated_at": 2, "t": 1.0,
                  "start": start}, [off, 0.0, 5.0], balanced_position=[0], balanced_speed=[1],
                  row_values=np.zeros(2))  # fmt: skip
    kept = fields(at, 3, gap=(gap, 3), outputs=(energy, 2))
    factorise(at, 1.0)
    assert room("events.balance.jump_to_balance", ("",), "", "b")(at)
    assert at.array["y"] == pytest.approx([0.0, 0.0, 5.0 + (0.5 * k * off**2 if start < 1.0 else 0.0)], abs=1e-15)
    assert kept


def pendulum(place):
    """x, y, their speeds and the force of a rod of length 1: C (dV, force) = r, with masses of one."""
    W = np.eye(5)
    W[4, 4] = 0.0
    W[2:4, 4], W[4, 2:4] = -place, 2.0 * place
    at = point_of(W, {"n_moves": 2}, [*place, 0.0, 0.0, 0.0], move_position=[0, 1], move_speed=[2, 3],
                  move_acceleration=[-1, -1])  # fmt: skip

    def gap(_t, y, out):
        out[:] = 0.0, 0.0, 0.0, 0.0, 1.0 - y[0] ** 2 - y[1] ** 2

    return at, fields(at, 5, gap=(gap, 5))


@pytest.mark.parametrize("angle", [0.3, 2.0, 4.5])
@pytest.mark.parametrize("off", [1e-3, -1e-2])
def test_a_pendulum_that_is_off_its_circle_goes_back_the_least_way(angle, off):
    """Along the rod; what it has moved is told in weights of 1e-3, of the position that moves most of them."""
    direction = np.array([np.cos(angle), np.sin(angle)])
    at, kept = pendulum((1.0 + off) * direction)
    assert room("events.position.off_place", ("problem", "point"), "", "b")(at)
    factorise(at, 1.0)
    assert room("events.position.project_positions", ("problem", "point", "linear"), "", "i")(at) == DONE
    np.testing.assert_allclose(at.array["y"][:2], direction, atol=abs(off) ** 4)
    moved = np.max(np.abs(off * direction)) / 1e-3
    assert at.number["moved"] == pytest.approx(moved, rel=1e-6)
    assert kept


def test_how_far_the_end_of_a_step_is_off_is_read_from_the_accelerations_that_would_bring_it_back():
    at = point_of(np.diag([2.0, 4.0]), {"n_moves": 1, "t": 1.0}, [0.0, 0.0], move_position=[0], move_speed=[1],
                  move_acceleration=[1], weight=[1e-3, 1.0])  # fmt: skip
    times = []

    def gap(t, _y, out):
        times.append(t)
        out[:] = 0.0, 0.02

    kept = fields(at, 2, gap=(gap, 2))
    factorise(at, 1.0)
    way_back = room("events.position.way_back", ("problem", "point", "linear"), "d", "d")
    assert way_back(at, 0.25) == pytest.approx(0.02 / 4.0 / 1e-3)
    assert times == [1.25]
    assert kept


def test_rows_that_hold_a_node_without_inertia_are_in_units_of_its_speed():
    """J v of the row -5 for a speed of one, M 2: a change of the speed by one gives 1 + 5/2 of what M says."""
    at = memory(
        {"n": 2, "n_light": 1, "n_mass": 1, "n_jacobian": 1}, light=[0], mass=[2.0], mass_columns=[0], mass_rows=[1],
        jacobian=[-5.0], jacobian_starts=[0, 1, 1], jacobian_rows=[1],
    )  # fmt: skip
    r = np.zeros(2)
    room("events.position.in_units_of_light", ("problem", "linear.matrices"), "ii")(at, np.array([9.0, 4.0]), r)
    assert r.tolist() == [0.0, 4.0 * (1.0 + 5.0 / 2.0)]
