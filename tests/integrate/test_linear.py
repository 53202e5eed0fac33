"""The linear solver: random patterns, zones and step sizes over nine decades, against numpy."""

from __future__ import annotations

import functools
from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.integrate import Run, integrate
from fairlead.integrate.codes import DONE, INACCURATE
from fairlead.integrate.linear import condensing, ordering
from fairlead.integrate.linear.condensing import columns_of, starts_of
from fairlead.integrate.linear.replan import fresh_plan
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.memory.layout import INDICES, VECTORS
from fairlead.integrate.problem import Pattern
from fairlead.integrate.textbook import textbook
from tests.integrate.rooms import machine_code

NOTHING_KEPT = np.zeros((0, 3), dtype=np.int64)


@functools.cache
def solver():
    """(address of the struct, scale, address of b) -> status: assemble, factorise, solve with the check."""
    from fairlead.integrate.linear.systems import factorise_consistent, factorise_step, solve_checked
    from fairlead.integrate.memory.foreign import memory_at

    def run(address, scale, at_x):
        linear = memory_at(address).linear
        status = factorise_step(linear, scale) if scale > 0.0 else factorise_consistent(linear)
        return status if status != DONE else solve_checked(linear, at_x)

    return machine_code("assemble, factorise, solve", "idi", "i", lambda: run)


def pattern_of(mask):
    columns, rows = np.nonzero(mask.T)
    return Pattern(starts_of(columns, len(mask)), rows.astype(np.int64))


def mechanical_network(rng, bodies, contacts):
    """Random network: positions and speeds of bodies, springs along a tree, contacts between random bodies.

    Returns patterns over all zones, and a maker of (J, M) for random zones: held, sliding or off.
    """
    n = 2 * bodies + contacts + 1
    x, v = np.arange(bodies), bodies + np.arange(bodies)
    force, ledger = 2 * bodies + np.arange(contacts), n - 1
    springs = [(int(rng.integers(0, k)), k) for k in range(1, bodies)] + [(0, 0)]
    pairs = [tuple(rng.choice(bodies, 2, replace=False)) for _ in range(contacts)]
    masses = 10.0 ** rng.uniform(-2, 2, bodies)

    def matrices(zones, stiffness):
        J, M = np.zeros((n, n)), np.zeros((n, n))
        M[x, x], M[v, v], M[ledger, ledger] = 1.0, masses, 1.0
        J[x, v] = 1.0
        for a, b in springs:
            for i, j, sign in ((a, a, -1), (b, b, -1), (a, b, 1), (b, a, 1)):
                J[v[i], x[j]] += sign * stiffness * (0.5 if a == b else 1.0)
                J[v[i], v[j]] += sign * 0.002 * stiffness * (0.5 if a == b else 1.0)
        for c, (a, b) in enumerate(pairs):
            J[v[a], force[c]] += 1.0
            J[v[b], force[c]] -= 1.0
            if zones[c] == 0:
                M[force[c], v[a]], M[force[c], v[b]] = -1.0, 1.0
                J[force[c], v[a]], J[force[c], v[b]] = 1e3, -1e3
            else:
                J[force[c], force[c]] = 1.0
                J[force[c], v[a]], J[force[c], v[b]] = rng.uniform(-1, 1, 2)
        J[ledger, v] = rng.uniform(-1, 1, bodies)
        return J, M

    held, slid = matrices(np.zeros(contacts), 1.0), matrices(np.ones(contacts), 1.0)
    J_mask = (held[0] != 0) | (slid[0] != 0)
    M_mask = (held[1] != 0) | (slid[1] != 0)
    problem = SimpleNamespace(
        initial=np.zeros(n), pattern=pattern_of(J_mask), mass_pattern=pattern_of(M_mask),
        differential=~np.isin(np.arange(n), force), quadrature=np.arange(n) == ledger, moves=NOTHING_KEPT,
    )  # fmt: skip
    return problem, matrices


def memory_for(problem, plan, perturbed=0):
    n, reduced = len(problem.initial), plan.lengths["n_reduced"]
    lengths = dict.fromkeys([*VECTORS.values(), *INDICES.values()], 1) | {
        "n": n, "n_plus_1": n + 1, "three_n": 3 * n, "n_jacobian": len(problem.pattern.rows), **plan.lengths,
        "n_reduced_plus_1": reduced + 1, "n_quadrature_rows_plus_1": plan.lengths["n_quadrature_rows"] + 1,
        "most_perturbed": perturbed, "perturbed_square": perturbed**2, "perturbed_reduced": perturbed * reduced,
        "n_mass": len(problem.mass_pattern.rows), "n_matrix": plan.size,
        "n_lower": len(plan.arrays.get("lower_rows", ())),
        "n_upper": len(plan.arrays.get("upper_rows", ())),
    }  # fmt: skip
    given = {
        "jacobian_starts": problem.pattern.starts, "jacobian_rows": problem.pattern.rows,
        "mass_starts": problem.mass_pattern.starts,
        "mass_rows": problem.mass_pattern.rows, "column_scale": np.ones(n),
        "differential": problem.differential.astype(np.int64),
        "quadrature": problem.quadrature.astype(np.int64), **plan.arrays,
    }  # fmt: skip
    memory = Memory(lengths, given)
    for name in ("n", "n_jacobian", "n_mass", "n_matrix", "most_perturbed", *plan.lengths):
        memory.number[name] = lengths[name]
    memory.number["dense"] = int(plan.dense)
    memory.spread()
    return memory


def planned(problem, backwards=False):
    """The sparse plan, in its own order or in the opposite one."""
    layout = condensing.lay_out(problem)
    entries = condensing.reduced_entries(problem, layout)
    order = ordering.elimination_order(problem, layout, entries)
    order = order[::-1].copy() if backwards else order
    return ordering.sparse_plan(problem, layout, entries, order, order)


def solve_with(memory, problem, J, M, scale, b):
    memory.array["jacobian"][:] = J[problem.pattern.rows, columns_of(problem.pattern)]
    memory.array["mass"][:] = M[problem.mass_pattern.rows, columns_of(problem.mass_pattern)]
    memory.array["b"][:] = b
    x = b.copy()
    return solver()(memory.address, scale, x.ctypes.data), x


@pytest.mark.parametrize("make_plan", ["dense", "sparse"])
@pytest.mark.parametrize("seed", range(6))
def test_one_plan_serves_every_zone_and_step_sizes_over_nine_decades(make_plan, seed):
    rng = np.random.default_rng(seed)
    # Fewer contacts than bodies on a random tree: held contacts that close no loop in most draws.
    problem, matrices = mechanical_network(rng, bodies=20, contacts=6)
    if make_plan == "dense":
        plan = ordering.dense_plan(problem)
    else:
        plan = planned(problem)
    memory = memory_for(problem, plan)
    for exponent in range(-9, 1):
        for _ in range(4):
            zones = rng.integers(0, 2, 6)
            J, M = matrices(zones, 10.0 ** rng.uniform(0, 5))
            scale = 10.0**-exponent
            W = scale * M - J
            b = rng.standard_normal(len(W))
            status, x = solve_with(memory, problem, J, M, scale, b)
            if np.linalg.cond(W / np.abs(W).max(axis=1, keepdims=True)) > 1e14:
                continue  # a loop of held contacts: redundant, no solver has an answer
            assert status == DONE
            scaled = np.abs(W) @ np.abs(x) + np.abs(b)
            # The watch lets a backward error of 1e-9 pass; partial pivoting stays below 1e-12.
            assert np.max(np.abs(W @ x - b)) / np.max(scaled) < 1e-9


@pytest.mark.parametrize("seed", range(4))
def test_the_matrix_of_the_consistent_point_is_factored_along_the_same_plan(seed):
    rng = np.random.default_rng(100 + seed)
    problem, matrices = mechanical_network(rng, bodies=25, contacts=5)
    memory = memory_for(problem, planned(problem))
    for _ in range(10):
        J, M = matrices(rng.integers(0, 2, 5), 1e3)
        C = np.where(problem.differential, M, -J)
        if np.linalg.cond(C) > 1e12:
            continue
        b = rng.standard_normal(len(C))
        status, x = solve_with(memory, problem, J, M, 0.0, b)
        assert status == DONE
        np.testing.assert_allclose(x, np.linalg.solve(C, b), rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize("size", [0.0, 1e-300, 1e-209, 1e-190])
def test_a_right_side_that_has_all_but_vanished_is_no_failure_of_the_factors(size):
    """The solution is dropped below 1e-200, so that its residual is as large as the right side itself."""
    problem, matrices = mechanical_network(np.random.default_rng(5), bodies=20, contacts=4)
    J, M = matrices(np.ones(4), 1e3)
    status, x = solve_with(memory_for(problem, planned(problem)), problem, J, M, 1e3, np.full(len(J), size))
    assert status == DONE
    assert np.abs(x).max() <= 1e3 * size


def test_pivots_that_vanish_are_noticed_and_fresh_ones_solve_the_matrix():
    rng = np.random.default_rng(7)
    problem, matrices = mechanical_network(rng, bodies=20, contacts=4)
    # The worst order: multipliers first, where their diagonal is zero while they hold.
    bad_plan = planned(problem, backwards=True)
    memory = memory_for(problem, bad_plan)
    J, M = matrices(np.zeros(4), 1e3)
    b = rng.standard_normal(len(J))
    status, _ = solve_with(memory, problem, J, M, 1e3, b)
    assert status == INACCURATE
    plan = fresh_plan(memory, problem)
    assert plan is not None
    fresh = memory_for(problem, plan)
    status, x = solve_with(fresh, problem, J, M, 1e3, b)
    assert status == DONE
    np.testing.assert_allclose(x, np.linalg.solve(1e3 * M - J, b), rtol=1e-8)


@pytest.mark.parametrize("size", [1.0, 1e-20])
def test_a_small_column_does_not_make_a_matrix_singular_and_one_that_follows_from_others_does(size):
    """In a step of a nanosecond all that a force does is small beside what a place does."""
    problem, matrices = mechanical_network(np.random.default_rng(4), bodies=20, contacts=4)
    memory = memory_for(problem, planned(problem, backwards=True))
    J, M = matrices(np.ones(4, int), 1e3)
    solve_with(memory, problem, J, M, 1e3, np.ones(len(J)))
    starts = memory.array["matrix_starts"]
    memory.array["matrix"][starts[3] : starts[4]] *= size
    assert fresh_plan(memory, problem) is not None
    memory.array["matrix"][starts[3] : starts[4]] = 0.0
    assert fresh_plan(memory, problem) is None


@pytest.mark.parametrize("seed", range(8))
def test_pivots_that_vanish_are_perturbed_and_the_solution_is_that_of_the_matrix_without(seed):
    """In the worst order the multipliers that hold have none; which do, changes from one matrix to the next."""
    rng = np.random.default_rng(200 + seed)
    problem, matrices = mechanical_network(rng, bodies=20, contacts=6)
    memory, solved = memory_for(problem, planned(problem, backwards=True), perturbed=6), 0
    for _ in range(30):
        zones, scale = rng.integers(0, 2, 6), 10.0 ** rng.uniform(0, 4)
        J, M = matrices(zones, 10.0 ** rng.uniform(0, 4))
        W, b = scale * M - J, rng.standard_normal(len(J))
        if np.linalg.cond(W / np.abs(W).max(axis=1, keepdims=True)) > 1e10:
            continue
        status, x = solve_with(memory, problem, J, M, scale, b)
        assert status == DONE
        assert memory.number["n_perturbed"] >= np.count_nonzero(zones == 0)
        size = np.abs(W) @ np.abs(x) + np.abs(b)
        assert np.max(np.abs(W @ x - b)) < 1e-9 * np.max(size)
        solved += 1
    assert solved > 5


def test_with_more_of_them_than_may_be_other_pivots_are_asked_for_and_a_singular_matrix_is_told():
    rng = np.random.default_rng(7)
    problem, matrices = mechanical_network(rng, bodies=20, contacts=4)
    plan = planned(problem, backwards=True)
    J, M = matrices(np.zeros(4), 1e3)
    b = rng.standard_normal(len(J))
    assert solve_with(memory_for(problem, plan, perturbed=3), problem, J, M, 1e3, b)[0] == INACCURATE
    assert solve_with(memory_for(problem, plan, perturbed=4), problem, J, M, 1e3, b)[0] == DONE
    J[:, -2], M[:, -2] = 0.0, 0.0  # nothing depends on the last force
    assert solve_with(memory_for(problem, plan, perturbed=8), problem, J, M, 1e3, b)[0] == INACCURATE


def test_an_order_eliminates_multipliers_after_the_speeds_they_act_on():
    problem, _ = mechanical_network(np.random.default_rng(3), bodies=15, contacts=8)
    order = planned(problem).arrays["row_order"]
    position = ordering.inverse(order, len(problem.initial))
    assert sorted(order) == list(range(15, 38))  # positions and the ledger are condensed out
    W = np.zeros((len(problem.initial),) * 2, bool)
    for pattern in (problem.pattern, problem.mass_pattern):
        W[pattern.rows, columns_of(pattern)] = True
    for k in np.flatnonzero(~problem.differential):
        touched = np.flatnonzero((W[k] | W[:, k]) & problem.differential & ~problem.quadrature)
        assert np.all(position[touched] < position[k])


def test_condensed_positions_cause_no_fill_in_a_chain():
    bodies = 200
    n = 2 * bodies
    J = np.zeros((n, n), bool)
    x, v = np.arange(bodies), bodies + np.arange(bodies)
    J[x, v] = True
    for shift in (-1, 0, 1):
        k = np.arange(max(0, -shift), bodies - max(0, shift))
        J[v[k], x[k + shift]] = J[v[k], v[k + shift]] = True
    problem = SimpleNamespace(
        initial=np.zeros(n), pattern=pattern_of(J), mass_pattern=pattern_of(np.eye(n, dtype=bool)),
        differential=np.ones(n, bool), quadrature=np.zeros(n, bool), moves=NOTHING_KEPT,
    )  # fmt: skip
    plan = ordering.plan(problem)
    # The reduced matrix is tridiagonal in the speeds; eliminated by rounds, each touches two others.
    assert plan.lengths["n_reduced"] == bodies
    assert len(plan.arrays["lower_rows"]) + len(plan.arrays["upper_rows"]) <= 4 * bodies


def chain(bodies, accuracy=1e-6):
    """Blocks joined by springs and dampers, the first one pushed by cos t: y = x0, v0, x1, v1, ..."""
    n, k, c = 2 * bodies, 100.0, 1.0
    stiffness = np.zeros((bodies, bodies))
    for i in range(bodies - 1):
        stiffness[i : i + 2, i : i + 2] += [[1, -1], [-1, 1]]
    A = np.zeros((n, n))
    A[0::2, 1::2] = np.eye(bodies)
    A[1::2, 0::2], A[1::2, 1::2] = -k * stiffness, -c * stiffness
    pattern = pattern_of(A != 0)
    values = A[pattern.rows, columns_of(pattern)]

    def rhs(t, y, z, f):
        f[:] = A @ y
        f[1] += np.cos(t)

    def jacobian(t, y, z, J, ft):
        J[:] = values
        ft[1] = -np.sin(t)

    return textbook(np.zeros(n), rhs, jacobian, pattern=pattern, absolute=accuracy, relative=accuracy)


def test_dense_and_sparse_runs_of_one_problem_agree(monkeypatch):
    sparse = integrate(chain(25), Run(stop=3.0, fixed_step=0.02))
    monkeypatch.setattr(ordering, "DENSE_LIMIT", 1000)
    dense = integrate(chain(25), Run(stop=3.0, fixed_step=0.02))
    np.testing.assert_allclose(sparse.y, dense.y, rtol=1e-9, atol=1e-12)


def test_a_sparse_run_keeps_the_momentum_that_the_push_gives():
    outcome = integrate(chain(100, accuracy=1e-8), Run(stop=3.0))
    assert outcome.ok, outcome.sentence
    assert outcome.y[1::2].sum() == pytest.approx(np.sin(3.0), abs=1e-6)
    assert outcome.counters.replans == 0


def test_columns_that_did_not_change_are_kept_and_the_factors_are_those_of_a_full_factorisation():
    rng = np.random.default_rng(11)
    problem, _ = mechanical_network(rng, bodies=60, contacts=8)
    plan = planned(problem)
    kept, zones = memory_for(problem, plan), rng.integers(0, 2, 8)
    for _ in range(12):
        zones[rng.integers(8)] ^= 1
        _, matrices = mechanical_network(np.random.default_rng(11), bodies=60, contacts=8)
        J, M = matrices(zones, 1e3)
        b = rng.standard_normal(len(J))
        if np.linalg.cond(1e3 * M - J) > 1e12:
            continue
        fresh = memory_for(problem, plan)
        answers = [solve_with(memory, problem, J, M, 1e3, b) for memory in (kept, fresh)]
        assert answers[0][0] == answers[1][0] == DONE
        np.testing.assert_array_equal(kept.array["pivot"], fresh.array["pivot"])
        np.testing.assert_array_equal(answers[0][1], answers[1][1])
        np.testing.assert_allclose(answers[0][1], np.linalg.solve(1e3 * M - J, b), rtol=1e-7, atol=1e-12)
    assert 0 < kept.number["n_redone"] < len(kept.array["pivot"]) / 2
