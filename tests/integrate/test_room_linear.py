"""The room `linear` alone: products along patterns, full factors, and pivots that vanish; against numpy."""

from __future__ import annotations

import functools
from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.integrate.codes import DONE, INACCURATE, SINGULAR
from fairlead.integrate.linear import condensing, ordering
from fairlead.integrate.linear.condensing import columns_of
from tests.integrate.rooms import entry, memory
from tests.integrate.test_linear import NOTHING_KEPT, memory_for, pattern_of, solve_with


@functools.cache
def product(name, kinds):
    from fairlead.integrate.linear import products

    return entry(getattr(products, name), ("linear.matrices",), kinds)


def sparse_matrix(rng, n, filled=0.3):
    """A random matrix with empty rows and columns, values over six decades."""
    mask = rng.random((n, n)) < filled
    mask[rng.integers(n)] = mask[:, rng.integers(n)] = False
    return np.where(mask, rng.normal(size=(n, n)) * 10.0 ** rng.uniform(-3, 3, (n, n)), 0.0)


def matrices(rng, n):
    """J, M, who is differential, and a memory with them."""
    J, M, differential = sparse_matrix(rng, n), sparse_matrix(rng, n), rng.integers(0, 2, n)
    of_j, of_m = pattern_of(J != 0), pattern_of(M != 0)
    at = memory(
        {"n": n, "n_jacobian": len(of_j.rows), "n_mass": len(of_m.rows)}, jacobian=J[of_j.rows, columns_of(of_j)],
        jacobian_starts=of_j.starts, jacobian_rows=of_j.rows, mass=M[of_m.rows, columns_of(of_m)],
        mass_starts=of_m.starts, mass_rows=of_m.rows, mass_columns=columns_of(of_m), differential=differential,
    )  # fmt: skip
    return J, M, differential, at


@pytest.mark.parametrize("seed", range(5))
def test_products_along_a_pattern_are_those_of_the_full_matrices(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 12))
    J, M, differential, at = matrices(rng, n)
    v, b = rng.normal(size=n) * rng.integers(0, 2, n), rng.normal(size=n)
    wanted = {
        ("add_mass_times", "ii", ()): b + M @ v,
        ("add_jacobian_times", "dii", (1.0,)): b + J @ v,
        ("add_jacobian_times", "dii", (-1.0,)): b - J @ v,
        ("add_slopes_times", "ii", ()): b + J @ (differential * v),
    }
    for (name, kinds, sign), value in wanted.items():
        found = b.copy()
        product(name, kinds)(at, *sign, v, found)
        np.testing.assert_allclose(found, value, rtol=1e-12, atol=1e-12 * np.abs(J).max(), err_msg=name)


@pytest.mark.parametrize("seed", range(5))
def test_how_far_a_product_may_be_rounded_is_that_of_the_sizes_whatever_stood_there(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(3, 12))
    J, _, _, at = matrices(rng, n)
    v, b = np.abs(rng.normal(size=n)), np.full(n, np.nan)
    product("sizes_through_jacobian", "ii")(at, v, b)
    np.testing.assert_allclose(b, np.abs(J) @ v, rtol=1e-13)


def algebraic(n, mask, dense):
    """A problem whose matrix of the step is -J, with this pattern, and a plan: full, or pivots on the diagonal."""
    problem = SimpleNamespace(
        initial=np.zeros(n), pattern=pattern_of(mask), mass_pattern=pattern_of(np.zeros((n, n), bool)),
        differential=np.zeros(n, bool), quadrature=np.zeros(n, bool), moves=NOTHING_KEPT,
    )  # fmt: skip
    if dense:
        return problem, ordering.dense_plan(problem)
    layout = condensing.lay_out(problem)
    order = np.arange(n)
    return problem, ordering.sparse_plan(problem, layout, condensing.reduced_entries(problem, layout), order, order)


def solved(W, b, dense=True, perturbed=0, units=None):
    """(status, x, memory) of W x = b; the pattern has the whole diagonal, whatever stands there."""
    problem, plan = algebraic(len(W), (W != 0) | np.eye(len(W), dtype=bool), dense)
    at = memory_for(problem, plan, perturbed)
    if units is not None:
        at.array["column_scale"][:] = units
    return *solve_with(at, problem, -W, np.zeros_like(W), 1.0, b), at


@pytest.mark.parametrize("seed", range(10))
def test_full_factors_take_their_pivots_wherever_they_are(seed):
    """Nothing on the diagonal, and every row in another unit."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 20))
    W, x = rng.normal(size=(n, n)), rng.normal(size=n)
    np.fill_diagonal(W, 0.0)
    units = 10.0 ** rng.uniform(-9, 9, n)
    status, found, _ = solved(W * units[:, None], (W @ x) * units)
    assert status == DONE
    np.testing.assert_allclose(found, x, atol=1e-13 * np.linalg.cond(W))


@pytest.mark.parametrize("seed", range(10))
def test_the_choice_of_pivots_does_not_hang_on_the_units_of_unknowns(seed):
    """Numpy, that knows no units, loses most digits of some of these."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 20))
    W, x, units = rng.normal(size=(n, n)), rng.normal(size=n), 10.0 ** rng.uniform(-9, 9, n)
    status, found, _ = solved(W / units, W @ x, units=units)
    assert status == DONE
    np.testing.assert_allclose(found / units, x, atol=1e-13 * np.linalg.cond(W))


@pytest.mark.parametrize("seed", range(5))
def test_a_full_matrix_of_a_step_is_solved_over_nine_decades_of_step_size(seed):
    rng = np.random.default_rng(seed)
    n = 8
    root = rng.normal(size=(n, n))
    M, J = root @ root.T + np.eye(n), rng.normal(size=(n, n)) * 10.0 ** rng.uniform(-2, 2)
    problem, _ = algebraic(n, np.ones((n, n), bool), True)
    problem.mass_pattern, problem.differential = problem.pattern, np.ones(n, bool)
    at = memory_for(problem, ordering.dense_plan(problem))
    for scale in 10.0 ** np.arange(10.0):
        W, x = scale * M - J, rng.normal(size=n)
        status, found = solve_with(at, problem, J, M, scale, W @ x)
        assert status == DONE
        np.testing.assert_allclose(found, x, atol=1e-14 * np.linalg.cond(W) * n)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("fault", ["no equation", "no unknown", "the same twice", "no number"])
def test_a_full_matrix_that_is_singular_names_the_equation_or_the_unknown(seed, fault):
    rng = np.random.default_rng(seed)
    n = 7
    W = rng.normal(size=(n, n))
    first, culprit = sorted(rng.choice(n, 2, replace=False))
    if fault == "no equation":
        W[culprit] = 0.0
    elif fault == "no unknown":
        W[:, culprit] = 0.0
    elif fault == "the same twice":
        W[:, culprit] = W[:, first]
    else:
        W[culprit, first] = np.inf
    status, _, at = solved(W, np.ones(n))
    assert status == SINGULAR
    assert at.number["culprit"] == culprit


def test_along_a_plan_a_pivot_of_zero_is_told_with_its_unknown():
    W = np.array([[0.0, 2.0], [4.0, 0.0]])
    status, _, at = solved(W, np.ones(2), dense=False)
    assert status == INACCURATE
    assert at.number["culprit"] == 0


@pytest.mark.parametrize("pivot", [0.0, 1e-12])
def test_a_pivot_that_is_perturbed_leaves_nothing_of_that_in_the_solution(pivot):
    """2 x1 = 6 and 4 x0 = 20, but for the pivot."""
    status, x, at = solved(np.array([[pivot, 2.0], [4.0, 0.0]]), np.array([6.0, 20.0]), dense=False, perturbed=1)
    assert status == DONE
    assert at.number["n_perturbed"] == 1
    np.testing.assert_allclose(x, [5.0, 3.0 - 2.5 * pivot], rtol=1e-14)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("perturbed", [0, 3])
def test_along_a_plan_an_unknown_that_nothing_depends_on_is_named(seed, perturbed):
    rng = np.random.default_rng(seed)
    n = 6
    W = rng.normal(size=(n, n)) + 10.0 * np.eye(n)
    culprit = int(rng.integers(n))
    W[:, culprit] = 0.0
    status, _, at = solved(W, np.ones(n), dense=False, perturbed=perturbed)
    assert status == INACCURATE
    assert at.number["culprit"] == culprit


@pytest.mark.parametrize("seed", range(8))
def test_as_many_pivots_vanish_as_may_be_perturbed_and_the_rest_of_the_order_serves(seed):
    """Blocks [[0, a], [b, 0]] joined at random: every first pivot of a block vanishes, none of the second ones."""
    rng = np.random.default_rng(seed)
    blocks = 5
    W = np.zeros((2 * blocks, 2 * blocks))
    for k in range(blocks):
        W[2 * k, 2 * k + 1], W[2 * k + 1, 2 * k] = rng.uniform(1, 3, 2)
        for j in range(k):
            W[2 * k + 1, 2 * j + 1] = rng.normal()
    x = rng.normal(size=2 * blocks)
    status, found, at = solved(W, W @ x, dense=False, perturbed=blocks)
    assert status == DONE
    assert at.number["n_perturbed"] == blocks
    np.testing.assert_allclose(found, x, atol=1e-13 * np.linalg.cond(W))
    assert solved(W, W @ x, dense=False, perturbed=blocks - 1)[0] == INACCURATE
