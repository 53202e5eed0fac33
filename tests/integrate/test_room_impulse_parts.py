"""What an impulse loads, changes and gives back, function by function: sums and graphs by numpy and scipy."""

from __future__ import annotations

import ctypes
import functools

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from fairlead.integrate.linear.condensing import columns_of
from tests.integrate.rooms import fields, memory, room
from tests.integrate.test_linear import pattern_of

LIMITED, UNLIMITED = 1, 2
SHORT = 1e-12


def along(name, matrix):
    """A matrix by its pattern, as `memory` takes it: J by columns, M with rows and columns."""
    pattern = pattern_of(matrix != 0)
    given = {name: matrix[pattern.rows, columns_of(pattern)], f"{name}_starts": pattern.starts,
             f"{name}_rows": pattern.rows}  # fmt: skip
    if name == "mass":
        given["mass_columns"] = columns_of(pattern)
    return given, {f"n_{name}": len(pattern.rows)}


def test_an_impulse_acts_as_a_force_for_a_billionth_of_a_thousandth_of_the_time_of_the_bodies():
    """Those that are rounding beside the largest are none, and shares of a circle without friction are not asked."""
    n = 6
    at = memory(
        {"n": n, "own_time": 0.2}, b=[5.0, 2.0, 1e-11, 0.4, 0.3, 7.0], y=np.arange(n), y_probe=np.zeros(n),
        differential=[0, 0, 0, 0, 0, 1], takes_impulse=[UNLIMITED, LIMITED, UNLIMITED, 0, 0, 0],
        circle=[0, 1, 0, 1, 2, 0], least_share=np.zeros(n),
    )  # fmt: skip
    assert room("events.impulse_load.least_impulse", ("problem", "point"), "", "d")(at) == pytest.approx(5e-10)
    room("events.impulse_load.load", ("problem", "events.settling", "point"))(at)
    per = SHORT * 0.2
    assert at.array["y_probe"] == pytest.approx([5.0 / per, 2.0 / per, 2.0, 0.4 / per, 4.0, 5.0])


@pytest.mark.parametrize("seed", range(10))
def test_the_time_of_an_impact_is_that_in_which_the_fastest_goes_as_far_as_it_is(seed):
    """The least of |x| over the speed before or after; sizes of places are weights over their relative part."""
    rng = np.random.default_rng(seed)
    bodies = 4
    size, before, change = 10.0 ** rng.uniform(-3, 1, bodies), rng.normal(size=bodies), rng.normal(size=bodies)
    relative = np.full(2 * bodies, 1e-4)
    n = 2 * bodies
    at = memory(
        {"n": n, "stop": 50.0}, y=np.r_[np.zeros(bodies), before], u=np.r_[np.zeros(bodies), change],
        weight=np.r_[size * 1e-4, np.ones(bodies)], relative=relative,
        position_of=[*[-1] * bodies, *range(bodies)],
    )  # fmt: skip
    room("events.impulse_load.find_own_time", ("problem", "run", "point", "events.settling"))(at)
    fastest = np.maximum(np.abs(before), np.abs(before + change))
    assert at.number["own_time"] == pytest.approx(min(50.0, np.min(size / fastest)), rel=1e-12)


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("supports", [False, True])
def test_energy_before_and_after_an_impact_differs_by_what_is_lost_and_what_supports_give(seed, supports):
    """T after - T before = supplied - dissipated; an impact with e returns e^2 of what the one without takes."""
    rng = np.random.default_rng(seed)
    bodies, e = 4, rng.uniform(0.0, 0.9)
    root = rng.normal(size=(bodies, bodies))
    masses = root @ root.T + np.eye(bodies)
    n = bodies + 3  # a row that takes the impulse, what is dissipated, what is supplied
    M = np.zeros((n, n))
    M[:bodies, :bodies] = masses
    given, sizes = along("mass", M)
    v, dv = rng.normal(size=bodies), rng.normal(size=bodies)
    full = np.r_[(1.0 + e) * dv, np.zeros(3)]
    b, r = np.zeros(n), np.zeros(n)
    b[bodies], r[bodies] = 2.0, -1.0
    at = memory(
        {"n": n, "dissipated_at": n - 2, "supplied_at": n - 1, **sizes}, y=np.r_[v, np.zeros(3)], u=full, b=b, v=r,
        y_probe=np.full(n, e), lost=np.zeros(n), differential=np.ones(n), **given,
    )  # fmt: skip
    change = room("events.impulse_changes.change_speeds", ("problem", "point", "linear.matrices"), "ib")
    change(at, 1, supports)
    after = v + (1.0 + e) * dv
    gained = 0.5 * (after @ masses @ after - v @ masses @ v)
    lost = 0.5 * (1.0 - e**2) * dv @ masses @ dv if supports else -gained
    y = at.array["y"]
    np.testing.assert_allclose(y[:bodies], after, rtol=1e-14)
    assert y[n - 2] == pytest.approx(lost, rel=1e-11)
    assert y[n - 1] - y[n - 2] == pytest.approx(gained, rel=1e-11)
    assert at.array["lost"][bodies] == pytest.approx(lost, rel=1e-11)


def test_only_what_is_struck_changes_its_speed():
    at = memory({"n": 3}, b=[1.0, -4.0, 2.0], u=np.zeros(3), struck=[1, 0, 1], weight=[1.0, 1.0, 0.5],
                unweighed=np.zeros(3))  # fmt: skip
    size = room("events.impulse_changes.find_change_of_speed", ("problem", "point"), "", "d")(at)
    assert at.array["u"].tolist() == [1.0, 0.0, 2.0]
    assert size == 4.0


@pytest.mark.parametrize("e", [0.0, 0.4])
def test_the_integral_of_the_power_of_a_force_takes_in_the_work_of_its_impulse(e):
    """z' = F v. An impulse (1 + e) P takes a body from v to v + (1 + e) P/m: z grows by its kinetic energy."""
    mass, v, P = 3.0, 1.5, -2.0
    after = v + (1.0 + e) * P / mass
    at = memory(
        {"n": 3, "n_jacobian": 2, "n_mass": 3, "own_time": 1.0}, y=[after, 0.0, 10.0], b=[0.0, P, 0.0],
        u=[after - v, 0.0, 0.0], y_probe=[0.0, e, 0.0], speed_of=[0, 1, 2], differential=[1, 0, 1],
        integral=[0, 0, 1], takes_impulse=[0, UNLIMITED, 0], circle=np.zeros(3), jacobian=np.zeros(2),
        jacobian_starts=[0, 1, 2, 2], jacobian_rows=[2, 2], mass=[mass, 0.0, 1.0], diagonal_mass=[0, 1, 2],
        x=np.zeros(3),
    )  # fmt: skip

    def slopes(_t, y, J):
        J[:] = y[1], y[0]  # of F v by v and by F

    kept = fields(at, 3, jacobian=(slopes, 2))
    room("events.impulse_changes.integrate_impulses", ("problem", "point", "linear.matrices", "events.settling"))(at)
    assert at.array["y"][2] - 10.0 == pytest.approx(0.5 * mass * (after**2 - v**2), rel=1e-12)
    assert kept


def impact(rng, bodies, rows):
    """Bodies and rows that join two of them each, in a matrix of entries (body, row); which rows take an impulse."""
    joins = np.zeros((bodies, rows))
    for k in range(rows):
        joins[rng.choice(bodies, 2, replace=False), k] = 1.0, -1.0
    return joins, rng.random(rows) < 0.7


@pytest.mark.parametrize("seed", range(20))
def test_all_that_an_impulse_joins_gives_back_by_the_least_coefficient_that_meets_in_it(seed):
    rng = np.random.default_rng(seed)
    bodies, rows = 8, 6
    joins, takes = impact(rng, bodies, rows)
    n, impulse = bodies + rows, np.where(takes, 1.0, 1e-13)
    J = np.zeros((n, n))
    J[:bodies, bodies:] = joins
    given, sizes = along("jacobian", J)
    own, dv = rng.uniform(0.1, 0.9, rows), rng.uniform(0.5, 2.0, bodies)
    mass, mass_sizes = along("mass", np.diag(np.r_[np.ones(bodies), np.zeros(rows)]))
    at = memory(
        {"n": n, **sizes, **mass_sizes}, b=np.r_[np.zeros(bodies), impulse], u=np.r_[dv, np.zeros(rows)],
        v=np.r_[np.zeros(bodies), np.ones(rows)], y_probe=np.zeros(n), x=np.zeros(n), weight=np.full(n, 1e-9),
        rebound=np.r_[np.zeros(bodies), own], takes_impulse=np.r_[np.zeros(bodies), np.full(rows, UNLIMITED)],
        differential=np.r_[np.ones(bodies), np.zeros(rows)], speed_of=np.arange(n), unweighed=np.zeros(n),
        not_given_back=np.zeros(n), **given, **mass,
    )  # fmt: skip
    found = room("events.rebound.find_rebound", ("problem", "point", "linear.matrices"), "d", "i")(at, 1e-10)
    edges = np.argwhere((joins != 0) & takes)
    graph = coo_array((np.ones(len(edges)), (edges[:, 0], bodies + edges[:, 1])), shape=(n, n))
    _, group = connected_components(graph, directed=False)
    wanted = np.zeros(n)
    for one in set(group):
        inside = np.flatnonzero(group == one)
        those = [own[k - bodies] for k in inside if k >= bodies and takes[k - bodies]]
        wanted[inside] = min(those) if those else 0.0
    assert found == (1 if takes.any() else 0)
    if takes.any():
        np.testing.assert_array_equal(at.array["y_probe"], wanted)


@pytest.mark.parametrize(("size", "gives"), [(1.0, 1), (1e-8, 0)])
def test_a_rebound_below_ten_weights_is_none_and_what_it_would_have_been_is_kept(size, gives):
    """Weights are 1e-9: of 1e-8 half is given back, five weights, which is more than their error."""
    J = np.zeros((2, 2))
    J[0, 1] = 1.0
    given, sizes = along("jacobian", J)
    mass, mass_sizes = along("mass", np.diag([1.0, 0.0]))
    at = memory(
        {"n": 2, **sizes, **mass_sizes}, b=[0.0, size], u=[size, 0.0], v=[0.0, -size], y_probe=np.zeros(2),
        x=np.zeros(2), weight=[1e-9, 1.0], rebound=[0.0, 0.5], takes_impulse=[0, UNLIMITED], differential=[1, 0],
        speed_of=[0, 1], unweighed=np.zeros(2), not_given_back=np.zeros(2), **given, **mass,
    )  # fmt: skip
    assert room("events.rebound.find_rebound", ("problem", "point", "linear.matrices"), "d", "i")(at, 0.0) == gives
    assert at.array["not_given_back"][1] == (-1.0 if gives else size)


@functools.cache
def slips(values):
    """A callback (context, t, y, r) -> 0 that writes these slips."""
    kind = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_int64, ctypes.c_double, ctypes.c_int64, ctypes.c_int64)

    def written(_c, _t, _y, out):
        np.ctypeslib.as_array((ctypes.c_double * len(values)).from_address(out))[:] = values
        return 0

    return kind(written)


@pytest.mark.parametrize("seed", range(10))
def test_how_far_rigid_rows_of_a_circle_move_apart_counts_in_weights_of_the_speeds_they_join(seed):
    rng = np.random.default_rng(seed)
    bodies, rows = 5, 4
    joins, _ = impact(rng, bodies, rows)
    n = bodies + rows
    J = np.zeros((n, n))
    J[:bodies, bodies:] = joins * rng.uniform(0.5, 2.0, rows)
    weight, slip = rng.uniform(0.1, 1.0, bodies), rng.normal(size=rows)
    circle, takes = rng.integers(0, 2, rows), rng.choice([LIMITED, UNLIMITED], rows)
    given, sizes = along("jacobian", J)
    at = memory(
        {"n": n, **sizes}, x=np.zeros(n), weight=np.r_[weight, np.ones(rows)], speed_of=np.arange(n),
        takes_impulse=np.r_[np.zeros(bodies), takes], circle=np.r_[np.zeros(bodies), circle],
        differential=np.r_[np.ones(bodies), np.zeros(rows)], **given,
    )  # fmt: skip
    call = slips((*[0.0] * bodies, *slip))
    at.number["call_slip"], at.number["worst"] = ctypes.cast(call, ctypes.c_void_p).value, -1
    slip_of = room("events.given_apart.slip_of_given", ("problem", "point", "linear.matrices"), "di", "d")
    found = slip_of(at, 0.0, np.ones(n))
    counts = (circle > 0) & (takes == UNLIMITED)
    sizes = np.where(counts, np.abs(slip) / (np.abs(J[:bodies, bodies:]).T @ weight), 0.0)
    assert found == pytest.approx(sizes.max(), rel=1e-12)
    assert at.number["worst"] == (bodies + sizes.argmax() if counts.any() else -1)


def test_a_contact_that_slides_against_its_zone_turns_before_its_law_is_asked_and_no_other():
    """Its guard is above its tolerance, it has an inertia, and it has not fired yet."""
    g = np.array([1.0, 1.0, 1.0, -1.0])

    def guards(_t, _y, out):
        out[:] = g

    at = memory(
        {"n": 1, "n_guards": 4, "n_fired": 1, "own_time": 1.0, "t_release": 1e308}, y=[0.0], y_probe=[0.0], b=[0.0],
        differential=[1], takes_impulse=[0], circle=[0], g_probe=np.zeros(4), guard_inertia=[2.0, 0.0, 2.0, 2.0],
        guard_tolerance=np.full(4, 1e-9), guard_machine=np.arange(4), fired=[2, 0, 0, 0],
    )  # fmt: skip
    kept = fields(at, 1, guards=(guards, 4))
    room("events.impulse_zones.turn_round", ("",))(at)
    assert at.array["fired"][: int(at.number["n_fired"])].tolist() == [2, 0]
    assert kept


def test_guards_are_asked_a_millionth_of_the_own_time_later_of_what_no_impulse_moves_along_its_forces():
    """A body that the impulse does not move falls on with f/m; the way of the fastest change till then is told."""
    mass, force, own_time = 4.0, 6.0, 0.5
    seen = {}

    def rhs(_t, _y, f):
        f[:] = force

    def guards(t, y, g):
        seen["t"], seen["y"] = t, y.copy()
        g[0] = y[0]

    given, sizes = along("mass", np.diag([mass, mass]))
    at = memory(
        {"n": 2, "n_guards": 1, "t": 0.0, "own_time": own_time, "t_release": 1e308, **sizes}, y_probe=[1.0, 2.0],
        u=[0.0, -3.0], x=np.zeros(2), f=np.zeros(2), differential=[1, 1], quadrature=[0, 0], wrong=[0.0], **given,
    )  # fmt: skip
    kept = fields(at, 2, rhs=(rhs, 2), guards=(guards, 1))
    later = 1e-6 * own_time
    assert room("events.impulse_zones.move_on", ("",), "", "d")(at) == pytest.approx(3.0 * later)
    assert seen["t"] == later
    assert seen["y"].tolist() == [1.0 + later * force / mass, 2.0]
    assert at.array["wrong"][0] == seen["y"][0]
    assert kept
