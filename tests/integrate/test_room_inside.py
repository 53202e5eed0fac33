"""Inside a step: residuals of the dense output, laws that fade, brackets, slip taken away, Rosenbrock stages."""

from __future__ import annotations

import functools
import itertools

import numpy as np
import pytest

from fairlead.integrate.codes import DONE
from fairlead.integrate.linear import ordering
from fairlead.integrate.linear.condensing import columns_of
from fairlead.integrate.rodas.tableau import RODAS3P, RODAS5P
from tests.integrate.rooms import entry, factorise, fields, memory, room
from tests.integrate.test_linear import memory_for
from tests.integrate.test_room_linear import algebraic

FURTHEST = 10.0


INDEX = (
    "differential", "quadrature", "monitored", "fades", "diagonal_slope", "diagonal_mass", "position_of", "holds",
    "hold_mass", "hold_mass_row", "hold_mass_column", "is_stiff", "of_balance", "unweighed",
)  # fmt: skip


def system(J, M, numbers, **given):
    """A memory with J and M in full patterns; arrays as given."""
    n = len(J)
    problem, _ = algebraic(n, np.ones((n, n), bool), True)
    problem.mass_pattern, problem.differential = problem.pattern, np.asarray(given.get("differential", np.ones(n))) == 1
    at = memory_for(problem, ordering.dense_plan(problem))
    for name, matrix in (("jacobian", J), ("mass", M)):
        at.array[name][:] = matrix[problem.pattern.rows, columns_of(problem.pattern)]
    at.array["mass_columns"][:] = columns_of(problem.pattern)
    at.point("weight", np.ones(n), np.float64)
    for place in ("diagonal_slope", "diagonal_mass"):
        at.point(place, np.arange(n) * (n + 1), np.int64)
    for name, value in numbers.items():
        at.number[name] = value
    for name, values in given.items():
        at.point(name, np.asarray(values), np.int64 if name in INDEX else np.float64)
    at.spread()
    return at


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("s", [0.0, 0.3, 0.5, 1.0])
def test_the_defect_of_a_dense_output_is_its_residual_through_the_factors(seed, s):
    """y(s) = chord + s (1 - s)(D0 + s D1 + s^2 D2) by numpy's polynomials."""
    rng = np.random.default_rng(seed)
    n, h, t = 3, 0.2, 1.5
    J, M = rng.normal(size=(n, n)), rng.normal(size=(n, n))
    y, y_end, D = rng.normal(size=n), rng.normal(size=n), rng.normal(size=(3, n))
    at = system(J, M, {"t": t}, y=y, y_end=y_end, D=D.ravel(), monitored=[1, 0, 1])

    def law(time, place):
        return np.sin(place) + time

    def rhs(time, place, f):
        f[:] = law(time, place)

    kept = fields(at, n, rhs=(rhs, n))
    inner = [np.polynomial.Polynomial([*D[:, k]]) for k in range(n)]
    bulge = np.polynomial.Polynomial([0.0, 1.0, -1.0])
    inside = [np.polynomial.Polynomial([y[k], y_end[k] - y[k]]) + bulge * inner[k] for k in range(n)]
    place, rate = np.array([p(s) for p in inside]), np.array([p.deriv()(s) / h for p in inside])
    wanted = np.linalg.solve(7.0 * M - J, law(t + s * h, place) - M @ rate)
    factorise(at, 7.0)
    room("point.defect.find_defect", ("problem", "point", "linear"), "dd")(at, h, s)
    np.testing.assert_allclose(at.array["error_vector"], wanted, rtol=1e-10, atol=1e-12)
    if s == 0.5:
        room("point.defect.find_midpoint_defect", ("problem", "point", "linear", "method"), "d")(at, h)
        np.testing.assert_allclose(at.array["error_vector"], wanted * [1, 0, 1], rtol=1e-10, atol=1e-12)
    assert kept


@pytest.mark.parametrize("left", [1.0, 1e-3, 1e-5])
def test_a_speed_whose_bond_has_faded_within_the_step_is_off_by_all_its_slip_and_one_whose_bond_is_there_is_not(left):
    """m v' = -c (v - drum), c known as 1e9 and `left` of that at the end: what a move of W changes tells the rest.

    The end has v - drum = 1e-3 and stands, so that it is behind by that, but for m gain beside c.
    """
    c, m, slip, h, gain = 1e9, 2.0, 1e-3, 0.01, 500.0
    at = system(np.array([[-c]]), np.array([[m]]), {"n": 1}, y=[slip], y_end=[slip], D=np.zeros(3), position_of=[0],
                slope_seen=[0.5 * c], fades=[0], monitored=[0])  # fmt: skip

    def rhs(_t, y, f):
        f[0] = -left * c * y[0]

    kept = fields(at, 1, rhs=(rhs, 1))
    factorise(at, gain)
    found = room("point.faded.error_of_faded", ("",), "d", "d")(at, h)
    assert found == pytest.approx(0.0 if left == 1.0 else slip * left * c / (left * c + m * gain), rel=1e-6)
    assert kept


@pytest.mark.parametrize(
    ("slope", "seen", "monitored", "position", "asked"),
    [
        (-1e6, -9e5, 0, 0, 1),
        (-1e6, -1e6, 0, 0, 0),
        (-1e6, -9e5, 1, 0, 0),
        (-1e6, -9e5, 0, -1, 0),
        (-1e2, -9e1, 0, 0, 0),
    ],
)
def test_asked_are_speeds_that_follow_a_law_which_has_changed_and_are_watched_by_nobody(
    slope, seen, monitored, position, asked
):
    at = system(np.array([[slope]]), np.array([[1.0]]), {"t": 1.0}, position_of=[position], slope_seen=[seen],
                fades=[0], monitored=[monitored])  # fmt: skip
    assert room("point.faded.ask_faded", ("",), "d", "b")(at, 0.01) == bool(asked)
    assert at.array["fades"][0] == asked


@functools.cache
def zero_of_power():
    """call(memory, power, tolerance, illinois) -> how many secants find the zero of s^power - 1/2 in [0, 1]."""
    from fairlead.integrate.memory.foreign import compiled
    from fairlead.integrate.point.illinois import LEFT, RIGHT, shares_of_ends

    @compiled
    def secants(power, tolerance, illinois):
        a, b, left, right, last = 0.0, 1.0, 1.0, 1.0, 0
        ga, gb = -0.5, 0.5
        for count in range(1, 200):
            s = (a * right * gb - b * left * ga) / (right * gb - left * ga)
            g = s**power - 0.5
            if abs(g) < tolerance:
                return count
            moved = LEFT if g < 0.0 else RIGHT
            if moved == LEFT:
                a, ga = s, g
            else:
                b, gb = s, g
            if illinois == 1:
                left, right = shares_of_ends(left, right, last, moved)
            last = moved
        return 200

    return entry(secants, (), "idi", "i")


@pytest.mark.parametrize("power", [3, 6, 10])
def test_the_rule_of_illinois_closes_a_bracket_on_a_curved_value_that_secants_alone_creep_up_to(power):
    """Of order 1.44 an evaluation: ten digits in some six to twelve, where one end would stay for ever."""
    rule, plain = (zero_of_power()(memory(), power, 1e-12, illinois) for illinois in (1, 0))
    assert rule <= 14
    assert plain > 2 * rule


@pytest.mark.parametrize(
    ("last", "moved", "shares"),
    [(0, 1, (1.0, 1.0)), (1, 1, (0.25, 1.0)), (-1, 1, (1.0, 1.0)), (-1, -1, (1.0, 0.125)), (1, -1, (1.0, 1.0))],
)
def test_an_end_that_stays_again_counts_half_of_what_it_did(last, moved, shares):
    """Before, the left end counted half, the right one a quarter."""
    assert ends()(memory(), last, moved) == shares[0] + 10.0 * shares[1]


@functools.cache
def ends():
    from fairlead.integrate.memory.foreign import compiled
    from fairlead.integrate.point.illinois import shares_of_ends

    @compiled
    def both(last, moved):
        left, right = shares_of_ends(0.5, 0.25, last, moved)
        return left + 10.0 * right

    return entry(both, (), "ii", "d")


def held_pair(v, theta_h=0.01):
    """Two bodies of 2 and 6 kg with a row that holds them together; unknowns v1, v2 and its force."""
    masses = np.array([2.0, 6.0])
    J, M = np.zeros((3, 3)), np.zeros((3, 3))
    M[0, 0], M[1, 1] = masses
    J[0, 2], J[1, 2] = 1.0, -1.0
    M[2, 0], M[2, 1] = -1.0, 1.0
    at = system(J, M, {"n_hold_mass": 2}, y=[*v, 0.0], differential=[1, 1, 0], holds=[0, 0, 1], hold_mass_row=[2, 2],
                hold_mass_column=[0, 1], hold_mass=[2, 5])  # fmt: skip
    return at, masses, 1.0 / theta_h


@pytest.mark.parametrize("holds", [0, 1])
def test_slip_of_bodies_that_hold_each_other_is_taken_away_and_their_momentum_stays(holds):
    v = np.array([3.0, -1.0])
    at, masses, scale = held_pair(v)
    at.array["holds"][2] = holds

    def drift(_t, y, out):
        out[:] = 0.0, 0.0, y[0] - y[1]

    kept = fields(at, 3, drift=(drift, 3))
    factorise(at, scale)
    take = room("record.between.take_slip_away", ("problem", "point", "linear", "stepping.exchange"), "di")
    take(at, 0.0, at.array["y"])
    together = masses @ v / masses.sum()
    np.testing.assert_allclose(at.array["y"], [together, together, 0.0] if holds else [*v, 0.0], rtol=1e-12)
    assert kept


@pytest.mark.parametrize(("guard", "shown"), [(0.5, 0), (-0.5, 1)])
@pytest.mark.parametrize("row", [-1, 2])
def test_a_law_that_came_into_force_inside_a_step_is_shown_as_before_while_its_guard_says_so(guard, shown, row):
    """A contact that holds a row keeps the zone of the end; and the zones of the end are put back."""
    zones = np.array([1])
    at = memory(
        {"n": 1, "n_guards": 1, "n_machines": 1, "n_switched": 1}, zones_at_start=[0], hold_row=[row], first_guard=[0],
        switched=[0], g_probe=[0.0], guard_machine=[0], zones_probed=[0],
    )  # fmt: skip
    at.point("zones", zones, np.int64)

    def guards(_t, _y, g):
        g[0] = guard

    kept = fields(at, 1, guards=(guards, 1))
    room("record.between.zones_inside", ("",), "di")(at, 0.0, np.zeros(1))
    assert zones[0] == (shown if row < 0 else 1)
    room("record.between.zones_of_end", ("problem", "stepping.contacts"))(at)
    assert zones[0] == 1
    assert kept


@pytest.mark.parametrize("weaker", [1.0, 0.3, 1e-2])
def test_a_stiff_speed_is_shown_where_its_law_balances_however_much_weaker_that_is_than_the_factors_have_it(weaker):
    """m v' = F - c v with c of the factors 1e6: at rest, v = F/(c weaker) within its error, from a move of F/c each."""
    c, m, force, h = 1e6, 1.0, 30.0, 0.01
    at = system(np.array([[-c]]), np.array([[m]]), {"h": h, "any_stiff": 1}, y=[0.0], y_end=[0.0], D=np.zeros(3),
                is_stiff=[1], differential=[1], position_of=[0], relative=[1e-3])  # fmt: skip

    def forces(_t, y, f):
        f[0] = force - weaker * c * y[0]

    kept = fields(at, 1, forces=(forces, 1))
    shown = np.zeros(1)
    factorise(at, 1.0 / h)
    room("record.between.balance_stiff", ("",), "ddi")(at, 0.0, 0.5, shown)
    inertia = m / h  # what moves by d gains d/h in its slope
    assert shown[0] == pytest.approx(force / (weaker * c + inertia), rel=1e-6)
    assert kept


@pytest.mark.parametrize(("bend", "stays"), [(0.0, False), (0.1, False), (0.5, False), (2.0, True)])
def test_what_has_no_inertia_is_shown_where_a_law_that_bends_balances_or_is_left_if_a_move_overshoots_tenfold(
    bend, stays
):
    """0 = 10 - c (x + bend x^3), of which the factors have the slope at zero: the first move is 10/c."""
    c = 4.0
    at = system(np.array([[-c]]), np.zeros((1, 1)), {"h": 0.1, "any_stiff": 2}, y=[0.0], y_end=[0.0], D=np.zeros(3),
                is_stiff=[1], differential=[0], position_of=[-1], relative=[1e-3])  # fmt: skip

    def forces(_t, y, f):
        f[0] = 10.0 - c * (y[0] + bend * y[0] ** 3)

    kept = fields(at, 1, forces=(forces, 1))
    shown = np.zeros(1)
    factorise(at, 10.0)
    room("record.between.balance_stiff", ("",), "ddi")(at, 0.0, 0.5, shown)
    root = min(np.roots([-c * bend, 0.0, -c, 10.0]), key=lambda r: abs(r.imag)).real
    overshoots = bend * (10.0 / c) ** 3 > FURTHEST * 10.0 / c
    assert overshoots == stays
    assert shown[0] == pytest.approx(0.0 if stays else root, rel=1e-5)
    assert kept


@pytest.mark.parametrize("tableau", [RODAS3P, RODAS5P], ids=lambda tableau: tableau.name)
def test_a_step_is_that_of_the_formula_in_numpy(tableau):
    """M y' = f(t, y) with a full M, an algebraic equation and a time in f; the interpolant by its weights."""
    rng = np.random.default_rng(7)
    n, h, t, stages = 3, 0.1, 0.4, tableau.stages
    A, M = rng.normal(size=(n, n)), rng.normal(size=(n, n))
    M[2] = 0.0
    y = rng.normal(size=n)

    def law(time, at_y):
        return A @ np.sin(at_y) + np.array([np.cos(time), time**2, 1.0])

    J, ft = A * np.cos(y), np.array([-np.sin(t), 2 * t, 0.0])
    of_stages = {"a": tableau.a.ravel(), "C": tableau.C.ravel(), "c": tableau.c, "d": tableau.d, "m": tableau.m,
                 "e": tableau.e, "H": tableau.H.ravel(), "K": np.zeros(stages * n)}  # fmt: skip
    at = system(J, M, {"stages": stages, "gamma": tableau.gamma, "t": t, "jacobian_fresh": 1}, y=y, ft=ft,
                differential=[1, 1, 0], D=np.zeros(3 * n), **of_stages)  # fmt: skip
    kept = fields(at, n, rhs=(lambda time, at_y, f: f.__setitem__(slice(None), law(time, at_y)), n))
    assert room("rodas.rosenbrock.take_step", ("",), "d", "i")(at, h) == DONE
    K = np.zeros((stages, n))
    for i in range(stages):
        stage = law(t + tableau.c[i] * h, y + tableau.a[i] @ K) + M @ (tableau.C[i] @ K) / h + h * tableau.d[i] * ft
        K[i] = np.linalg.solve(M / (h * tableau.gamma) - J, stage)
    np.testing.assert_allclose(at.array["y_end"], y + tableau.m @ K, rtol=1e-10)
    np.testing.assert_allclose(at.array["error_vector"], tableau.e @ K, rtol=1e-7, atol=1e-12)
    room("rodas.rosenbrock.prepare_interpolant", ("",), "d")(at, h)
    inside = np.zeros(n)
    room("point.interpolant.interpolate", ("point",), "di")(at, 0.3, inside)
    np.testing.assert_allclose(inside, y + tableau.interpolation_weights(0.3) @ K, rtol=1e-9)
    places = [(float(c), *map(float, a)) for c, a in zip(tableau.c, tableau.a, strict=True)]
    assert at.number["rhs"] == 1 + sum(one != before for before, one in itertools.pairwise(places))
    assert kept
