"""The factors of the room `linear`: what they multiply to, who is done anew, how wrong a solution is; by numpy."""

from __future__ import annotations

import functools

import numpy as np
import pytest
from scipy import linalg

from fairlead.integrate.codes import DONE, INACCURATE
from fairlead.integrate.linear.condensing import columns_of
from tests.integrate.rooms import entry, memory, room
from tests.integrate.test_linear import mechanical_network, memory_for, planned


def factorise():
    return room("linear.condensed.factorise_reduced", ("linear",), "db", "i")


@functools.cache
def capacitance_factors():
    """call(memory, c, count) -> status of `eliminate` of the full matrix c."""
    from fairlead.integrate.linear.perturbed_pivots import eliminate
    from fairlead.integrate.memory.foreign import compiled, reals

    @compiled
    def eliminated(factors, at_c, count):
        return eliminate(factors, reals(at_c, count * count), count)

    return entry(eliminated, ("linear.factors",), "ii", "i")


class Network:
    """Bodies, springs and contacts at random, all of which slide, with a plan of pivots."""

    def __init__(self, seed, bodies=20, contacts=6):
        self.rng = np.random.default_rng(seed)
        self.problem, self.matrices = mechanical_network(self.rng, bodies, contacts)
        self.at = memory_for(self.problem, planned(self.problem))
        self.put(*self.matrices(np.ones(contacts, np.int64), 1e3))

    def put(self, J, M):
        self.J, self.M = J, M
        self.at.array["jacobian"][:] = J[self.problem.pattern.rows, columns_of(self.problem.pattern)]
        self.at.array["mass"][:] = M[self.problem.mass_pattern.rows, columns_of(self.problem.mass_pattern)]

    def by_columns(self, values, rows, starts):
        """A full matrix of entries that stand by columns."""
        n = int(self.at.number["n_reduced"])
        full = np.zeros((n, n))
        for k in range(n):
            for p in range(starts[k], starts[k + 1]):
                full[rows[p], k] += values[p]
        return full

    def part(self, name):
        """The matrix of the pivots' order, or its factor `lower` or `upper`, without their diagonals."""
        array = self.at.array
        return self.by_columns(array[name], array[f"{name}_rows"], array[f"{name}_starts"])

    def factors(self):
        return [self.at.array[name].copy() for name in ("lower", "upper", "pivot")]


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("consistent", [False, True])
def test_lower_times_upper_is_the_matrix_in_the_order_of_its_pivots(seed, consistent):
    network = Network(seed)
    assert factorise()(network.at, 1e3, consistent) == DONE
    n = int(network.at.number["n_reduced"])
    L, U = network.part("lower") + np.eye(n), network.part("upper") + np.diag(1.0 / network.at.array["pivot"])
    A = network.part("matrix")
    np.testing.assert_allclose(L @ U, A, atol=1e-13 * np.max(np.abs(L) @ np.abs(U)))
    assert np.array_equal(np.triu(L, 1), np.zeros((n, n)))
    assert np.array_equal(np.tril(U, -1), np.zeros((n, n)))


@pytest.mark.parametrize("seed", range(5))
def test_rows_are_scaled_by_their_largest_entry_in_units_of_the_weights(seed):
    network = Network(seed)
    units = network.at.array["column_scale"]
    units[:] = 10.0 ** network.rng.uniform(-3, 3, len(units))
    assert factorise()(network.at, 1e3, False) == DONE
    room("linear.sparse.scale_rows", ("linear.factors",))(network.at)
    A = np.abs(network.part("matrix")) * units[network.at.array["column_order"]]
    np.testing.assert_allclose(network.at.array["row_scale"][: len(A)], 1.0 / A.max(axis=1), rtol=1e-15)


@pytest.mark.parametrize("seed", range(5))
def test_who_uses_a_column_is_who_is_reached_along_the_upper_factor(seed):
    """Column k uses j if U has an entry (j, k); those that use it, and so on."""
    network = Network(seed)
    at = network.at
    assert factorise()(at, 1e3, False) == DONE
    n = int(at.number["n_reduced"])
    begin = int(network.rng.integers(n))
    uses = network.by_columns(np.ones(len(at.array["upper_rows"])), at.array["upper_rows"], at.array["upper_starts"])
    reached = np.linalg.matrix_power(np.eye(n) + (uses > 0), n)[begin] > 0  # walks of any length, by squaring
    at.array["dirty"][:] = 0
    at.array["dirty"][begin] = 1
    at.array["waiting"][0] = begin
    room("linear.sparse.mark_users", ("linear.factors",), "i")(at, 1)
    np.testing.assert_array_equal(at.array["dirty"][:n] == 1, reached)


@pytest.mark.parametrize("seed", range(8))
def test_after_a_change_of_a_few_entries_the_factors_are_to_the_bit_those_of_the_whole_matrix(seed):
    network, whole = Network(seed, bodies=60, contacts=3), Network(seed, bodies=60, contacts=3)
    assert factorise()(network.at, 1e3, False) == DONE
    J, M = (matrix.copy() for matrix in (network.J, network.M))
    k = int(network.rng.choice(np.flatnonzero(J)))
    J.flat[k] *= 1.5
    for other in (network, whole):
        other.put(J, M)
        assert factorise()(other.at, 1e3, False) == DONE
    n = network.at.number["n_reduced"]
    assert whole.at.number["n_redone"] == n
    assert network.at.number["n_redone"] < n
    for kept, anew in zip(network.factors(), whole.factors(), strict=True):
        np.testing.assert_array_equal(kept, anew)


@pytest.mark.parametrize("seed", range(5))
def test_the_backward_error_is_the_largest_scaled_residual_over_the_largest_scaled_size(seed):
    network = Network(seed)
    at, rng = network.at, network.rng
    assert factorise()(at, 1e3, False) == DONE
    A = network.part("matrix")
    scale = at.array["row_scale"][: len(A)]
    b = rng.normal(size=len(A))
    x = np.linalg.solve(A, b) * (1.0 + 1e-6 * rng.normal(size=len(A)))
    at.array["reduced_x"][:], at.array["reduced_b"][:] = x, b
    left = b - A @ x
    wanted = np.max(scale * np.abs(left)) / np.max(scale * (np.abs(b) + np.abs(A) @ np.abs(x)))
    assert room("linear.sparse.backward_error", ("linear",), "", "d")(at) == pytest.approx(wanted, rel=1e-6)
    np.testing.assert_allclose(at.array["reduced_residual"], left, atol=1e-12 * np.max(np.abs(A) @ np.abs(x)))


@pytest.mark.parametrize("seed", range(5))
def test_a_solution_without_its_quadratures_has_all_else_to_the_bit(seed):
    network = Network(seed)
    at = network.at
    assert factorise()(at, 1e3, False) == DONE
    b = network.rng.normal(size=len(network.problem.initial))
    found = []
    for quadratures in (True, False):
        x = b.copy()
        room("linear.condensed.solve_reduced", ("linear",), "ibd", "d")(at, x, quadratures, 0.0)
        found.append(x)
    motion = ~network.problem.quadrature
    W = (1e3 * network.M - network.J)[np.ix_(motion, motion)]
    np.testing.assert_allclose(found[1][motion], np.linalg.solve(W, b[motion]), rtol=1e-8, atol=1e-11)
    np.testing.assert_array_equal(found[0][motion], found[1][motion])


@pytest.mark.parametrize("seed", range(10))
def test_what_perturbed_pivots_have_in_common_is_eliminated_with_the_pivots_of_lapack(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 7))
    C = rng.normal(size=(count, count))
    at = memory({"most_perturbed": count, "n_reduced": 1}, capacitance_order=np.zeros(count), perturbed=np.zeros(count))
    c = C.copy()
    assert capacitance_factors()(at, c, count) == DONE
    wanted, order = linalg.lu_factor(C)
    np.testing.assert_array_equal(at.array["capacitance_order"], order)
    np.testing.assert_allclose(c, wanted, rtol=1e-10, atol=1e-12)


def test_perturbed_pivots_of_a_singular_matrix_name_the_unknown_where_that_shows():
    C = np.array([[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [1.0, 0.0, 1.0]])
    at = memory({"most_perturbed": 3, "n_reduced": 9}, capacitance_order=np.zeros(3), perturbed=[2, 5, 7],
                column_order=10 + np.arange(9))  # fmt: skip
    assert capacitance_factors()(at, C.copy(), 3) == INACCURATE
    assert at.number["culprit"] == 17
