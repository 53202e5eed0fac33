"""Ways on which loads come in, contacts that contradict each other, what is stiff, ends of pieces, alone."""

from __future__ import annotations

import math

import numpy as np
import pytest

from fairlead.integrate.codes import GO_ON, MAX_EVENTS, MAX_STEPS, PARABOLA, QUARTIC
from fairlead.integrate.events.fast_way import NOT_REACHED
from fairlead.integrate.events.torn_loose import DYING_OUT
from fairlead.integrate.events.violators import NUDGE, RISE
from fairlead.integrate.point.stiff import OF_BALANCES, OF_SPEEDS, STIFF
from tests.integrate.plainly import plain_room
from tests.integrate.rooms import fields, memory


def on_a_way(seed):
    """Guards that are linear in forces (first half of the unknowns) and speeds (the rest), and a way of both."""
    rng = np.random.default_rng(seed)
    n, count = 6, 5
    forces = np.arange(n) < n // 2
    G, offset = rng.normal(size=(count, n)), rng.normal(size=count)
    limit = rng.integers(0, 2, count)
    G[:, forces] *= limit[:, None]  # a limit reads forces, a slip speeds
    G[:, ~forces] *= 1 - limit[:, None]
    at = memory(
        {"n": n, "n_guards": count, "n_machines": count, "t": 2.0, "t_release": 1e308, "levels": 1},
        x=rng.normal(size=n), y=rng.normal(size=n), slope=rng.normal(size=n), y_probe=np.zeros(n), u=np.zeros(n),
        is_speed=~forces, differential=~forces, weight=rng.uniform(0.5, 2.0, n), unweighed=np.zeros(n), f=np.zeros(n),
        guard_tolerance=np.full(count, 1e-9), guard_machine=np.full(count, -1), limit_guard=limit, g=np.zeros(count),
        g_probe=np.zeros(count), rate=np.zeros(count), rate_end=np.zeros(count), may_hold=rng.integers(0, 2, count),
        fast_slip=np.zeros(count), born=np.zeros(count), came_back=np.zeros(count), wrong=np.zeros(count),
        fired=np.zeros(count), out=rng.normal(size=16 * n), left=np.ones(16),
    )  # fmt: skip
    kept = fields(at, n, guards=(lambda _t, y, g: np.copyto(g, G @ y + offset), count))
    return rng, G, offset, forces, at, kept


@pytest.mark.parametrize("seed", range(15))
def test_along_a_way_forces_change_at_once_and_slips_by_accelerations(seed):
    _, G, offset, forces, at, kept = on_a_way(seed)
    array = at.array
    y, way, slope = array["y"].copy(), array["x"].copy(), array["slope"].copy()
    plain_room("events.fast_way.look_along", "problem", "run", "point", "events")(at)
    assert array["g"] == pytest.approx(G @ y + offset)
    assert array["g_probe"] == pytest.approx(G @ (y + np.where(forces, way, 0.0)) + offset)
    slips = np.where(forces, 0.0, G)  # a limit has no slip
    assert array["rate"] == pytest.approx(slips @ slope, rel=1e-6, abs=1e-9)
    assert array["rate_end"] == pytest.approx(slips @ (slope + way), rel=1e-6, abs=1e-9)
    fastest = [np.max(np.abs(one)[~forces] / array["weight"][~forces]) for one in (slope, slope + way)]
    assert at.number["fastest"] == pytest.approx(max(fastest))
    assert kept


@pytest.mark.parametrize("seed", range(15))
def test_the_first_on_a_way_is_where_a_load_or_a_slip_of_a_contact_first_comes_to_zero(seed):
    """By a fine grid: loads are straight, and slips have come back where the integral of their rates is zero."""
    rng, *_, at, _ = on_a_way(seed)
    array, count = at.array, 5
    array["g"][:] = np.where(array["limit_guard"] == 1, -rng.uniform(0.2, 1, count), 0.0)
    array["g_probe"][:] = np.where(array["limit_guard"] == 1, array["g"] + rng.uniform(-1, 3, count), 0.0)
    slipping = array["limit_guard"] == 0
    array["fast_slip"][:] = np.where(slipping, -rng.uniform(0.05, 0.5, count), 0.0)
    array["rate"][:], array["rate_end"][:] = np.where(slipping, rng.normal(size=(2, count)), -1.0)
    array["born"][:] = slipping
    s = np.linspace(0.0, 1.0, 100001)
    first = NOT_REACHED
    for i in np.flatnonzero(array["may_hold"]):
        value = array["g"][i] + s * (array["g_probe"][i] - array["g"][i])
        if slipping[i]:
            rate, end = array["rate"][i], array["rate_end"][i]
            value = array["fast_slip"][i] + s * rate + 0.5 * s**2 * (end - rate)
        if (reached := np.flatnonzero(value > 0)).size:
            first = min(first, s[reached[0]])
    assert plain_room("events.fast_way.first_reached", "problem", "events")(at) == pytest.approx(first, abs=2e-5)


@pytest.mark.parametrize("share", [0.3, 1.0])
@pytest.mark.parametrize("seed", range(5))
def test_who_fires_on_a_way_has_come_to_zero_and_rises_or_has_come_back(seed, share):
    rng, G, offset, _, at, kept = on_a_way(seed)
    array = at.array
    array["g"][:], array["g_probe"][:] = rng.normal(size=(2, 5))
    array["came_back"][:] = rng.random(5) < 0.3
    at.array["y"][:] = np.linalg.lstsq(G, share * rng.choice([-1e-10, 1e-3, -1e-3], 5) - offset, rcond=None)[0]
    here = G @ at.array["y"] + offset
    plain_room("events.fast_way.find_reached", "problem", "run", "point", "events")(at)
    wanted = [i for i in range(5) if array["may_hold"][i]
              and (array["came_back"][i] or (array["g_probe"][i] > array["g"][i] and here[i] >= -1e-9))]  # fmt: skip
    assert array["fired"][: int(at.number["n_fired"])].tolist() == wanted
    assert kept


def test_only_a_change_of_forces_is_a_change():
    _, _, _, forces, at, _ = on_a_way(0)
    hardly = plain_room("events.fast_way.hardly_changes", "point")
    assert not hardly(at)
    at.array["x"][forces] *= 1e-7
    assert hardly(at)
    at.array["x"][~forces] = 1e9
    assert hardly(at)


def two_held(shift, least=0.0, **more):
    """Two rows in one circle that hold; `drift` gives -slip, which is `shift` a second later and at first."""
    at = memory(
        {"n": 3, "n_guards": 1, "n_machines": 1, "start": 0.0, "stop": 1e3, "t": 1.0, "t_release": 1e308,
         "least_lookahead": least, **more},
        y=np.zeros(3), y_probe=np.zeros(3), slope=[0.0, 0.0, 1.0], curvature=np.zeros(3), differential=[0, 0, 1],
        weight=np.ones(3), u=np.zeros(3), x=np.zeros(3), v=np.zeros(3), b=np.zeros(3), unweighed=np.zeros(3),
        may_hold=[1], limit_guard=[0], guard_tolerance=[1e-9], circle=[1, 1, 0], grows_with_slip=[1, -1, 0],
    )  # fmt: skip
    kept = fields(at, 3, drift=(lambda t, _y, out: np.copyto(out, shift(t - 1.0)), 3))
    return at, kept


def test_slips_that_grow_are_told_from_what_rounding_leaves_and_from_what_dies_out():
    """d = a thousandth of a weight at 1 a second; the third row has none."""
    d = NUDGE

    def drift(s):
        return np.array([-2.0, 5e-12, 0.0]) * [s, 1.0 - 900.0 * s, 0.0] + [0.0, 0.0, 0.0]

    at, kept = two_held(drift)
    find = plain_room("events.torn_loose.find_slips", "")
    assert find(at) == pytest.approx(RISE * 1e-9)
    assert at.number["lookahead"] == pytest.approx(d)
    assert at.array["v"] == pytest.approx([2.0 * d, 0.0, 0.0])  # the slip itself; a rounded one has died by 0.9
    at, kept = two_held(drift, least=0.5)
    find(at)
    assert at.number["lookahead"] == 0.5
    start = 3e-6  # a slip that has yet to come to zero counts by what it comes to, if it grows faster than it dies
    for share in (2.0, 0.5):
        grows = share * DYING_OUT * start
        at, kept = two_held(lambda s, grows=grows: np.array([start + grows * s, 0.0, 0.0]))
        find(at)
        assert at.array["v"][0] == pytest.approx(-(start + grows * d) if share > 1 else 0.0, rel=1e-3, abs=1e-15)
    assert kept


@pytest.mark.parametrize("seed", range(10))
def test_forces_of_a_circle_grow_with_their_slips_by_the_largest_of_them(seed):
    """Two circles; in each the largest slip moves its force by the largest force, others by their share of the slip."""
    rng = np.random.default_rng(seed)
    circle, grows = np.array([1, 1, 1, 2, 2, 0]), np.array([1, -1, 1, -1, 1, 0])
    slip, y, weight = rng.normal(size=6), rng.normal(size=6), rng.uniform(0.01, 3.0, 6)
    slip[[1, 5]] = 0.0
    largest = np.array([np.abs(slip[:3]).max(), np.abs(slip[3:5]).max()])
    at = memory({"n": 6, "n_guards": 2, "n_machines": 1, "t_release": 1e308}, circle=circle, grows_with_slip=grows,
                v=slip, b=[*largest, 0, 0, 0, 0], y=y, y_probe=np.zeros(6), weight=weight, u=np.zeros(6),
                g=np.zeros(2), g_probe=np.zeros(2), guard_machine=[-1, -1])  # fmt: skip
    kept = fields(at, 6, guards=(lambda _t, z, g: np.copyto(g, [z.sum(), z[0]]), 2))
    plain_room("events.torn_loose.grow_forces", "problem", "run", "point", "events.guards")(at)
    size = [np.maximum(np.abs(y), weight)[circle == c].max() for c in (1, 2)]
    probe = [y[k] + (grows[k] * slip[k] / largest[c - 1] * size[c - 1] if (c := circle[k]) else 0.0) for k in range(6)]
    assert at.array["y_probe"] == pytest.approx(probe)
    assert at.array["g"] == pytest.approx([y.sum(), y[0]])
    assert at.array["g_probe"] == pytest.approx([np.sum(probe), probe[0]])
    assert kept


@pytest.mark.parametrize("means", [True, False])
@pytest.mark.parametrize("seed", range(12))
def test_what_is_shown_in_balance_are_balances_and_speeds_of_laws_that_are_stiff_in_the_step(seed, means):
    """J and M are full; a speed is stiff where -J_kk h > 100 M_kk, and moves another where |J_jk| h > M_jj."""
    rng = np.random.default_rng(seed)
    n, h = 6, 0.01
    J = -(10.0 ** rng.uniform(-1, 6, (n, n))) * np.where(np.eye(n), 1, rng.choice([-1, 1], (n, n)))
    mass = rng.choice([0.0, 1.0, 2.0], n)
    balance, position = rng.choice([0, 1, 2], n), rng.choice([-1, 3], n)
    asked = rng.permutation(n)[: rng.integers(0, n + 1)]
    at = memory(
        {"n": n, "n_jacobian": n * n, "n_mass": n, "n_asked_stiff": len(asked),
         "most_inside": PARABOLA if means else QUARTIC},
        is_stiff=np.ones(n), position_of=position, of_balance=balance, diagonal_slope=(n + 1) * np.arange(n),
        diagonal_mass=np.arange(n), jacobian=J.T.ravel(), jacobian_starts=n * np.arange(n + 1),
        jacobian_rows=np.tile(np.arange(n), n), mass=mass, asked_stiff=asked,
    )  # fmt: skip
    found = plain_room("point.stiff.mark_stiff", "problem", "linear.matrices", "recorder")(at, h)
    balances = {k for k in asked if balance[k] == 1 or (balance[k] == 2 and means)}
    speeds = {k for k in asked if position[k] >= 0 and -J[k, k] * h > STIFF * mass[k] > 0} - balances
    beside = {j for j in range(n) for k in speeds if means and position[j] >= 0 and abs(J[j, k]) * h > mass[j]}
    assert set(np.flatnonzero(at.array["is_stiff"]).tolist()) == balances | speeds | beside
    assert found == (OF_BALANCES if balances else OF_SPEEDS if speeds else 0)


@pytest.mark.parametrize("landing", [0, 1])
@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize("left", [0.4, 1e-13, 0.0])
def test_a_piece_ends_at_the_crossing_or_where_the_step_does(landing, crossed, left):
    """At a time event to its last digit, also where less is left of the step than a step can be: 4e-15 of 3 s."""
    t, h = 3.0, 0.1
    due = t + h * (1 + 1e-15)
    at = memory({"n": 2, "t": t, "landing": landing, "t_land": due, "cut_at": 1.0 - left, "phase": 99, "is_part": 1},
                y=[1.0, 5.0], y_end=[2.0, 7.0], y_piece=np.zeros(2), D=np.zeros(6))  # fmt: skip
    plain_room("events.pace.accept", "")(at, h, crossed)
    inside = crossed and left > 0.0
    lands = landing == 1 and not (inside and left == 0.4)
    assert at.number["t_piece"] == (due if lands else t + (1.0 - left) * h if inside else t + h)
    assert at.array["y_piece"] == pytest.approx([2.0 - left, 7.0 - 2.0 * left] if inside else [2.0, 7.0])
    assert at.number["landing"] == lands
    assert (at.number["crossed"], at.number["steps"], at.number["partial_steps"]) == (crossed, 1, 1)


@pytest.mark.parametrize(("gap", "landing", "instant"), [(1e-15, 1, True), (1e-15, 0, False), (1e-9, 1, False),
                                                         (math.nan, 1, True)])  # fmt: skip
def test_a_time_event_at_this_very_instant_needs_no_step(gap, landing, instant):
    at = memory({"landing": landing, "t_land": 2.0, "t": 2.0, "stop": 5.0})
    asked = plain_room("events.pace.is_instant", "run", "point")
    assert asked(at, gap) == instant
    at.number["stop"] = 2.0  # the stop is arrived at by a step
    assert not asked(at, gap)
    at.number["stop"], at.number["start"] = 5.0, 5.0 - 1e5  # of a long span more is rounding
    assert asked(at, 1e-9) == (landing == 1)


def test_budgets_end_a_run_where_they_are_used_up():
    at = memory({"steps": 9, "max_steps": 10, "total_events": 6, "max_events": 7})
    over = plain_room("events.pace.over_budget", "run", "recorder")
    assert over(at) == GO_ON
    at.number["total_events"] = 7
    assert over(at) == MAX_EVENTS
    at.number["steps"] = 10
    assert over(at) == MAX_STEPS
