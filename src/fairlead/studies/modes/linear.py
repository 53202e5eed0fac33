"""A model linearised at an instant, with its zones frozen: M dy' = J dy + b du.

Of the unknowns y some have a derivative (d) and some have none (a: forces of contacts, nodes without inertia). M is
constant inside a zone, and the equations have index 1, so

    [M_d  -J_a] [dd'; da] = J_d dd + b du      gives   dd' = A dd + B du,   da = G dd + H du

by one solution of linear equations; no infinite eigenvalue remains. A contact that holds has a row C dd' = 0 in M, and
its slip C dd is 0 itself. So dd stays in the null space of C: with an orthonormal basis Q of the null space of C S^-1,
S^2 = M_d (the d'Alembert projection), q = Q' S dd are the states, and

    q' = (Q' S A S^-1 Q) q + Q' S B du

A relation of positions g(x) = 0, as of a crank, is kept as an acceleration, so that C has no row of it. Its states keep
the relation and its rate: two rows more, g_x dx = 0 and g_x dv + (g_x v)_x dx = 0.

Quadratures (the ledger of energy) have no say in what happens and are left out. The Jacobians are those of the traced
laws, by which the engine itself takes its steps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import FairleadError
from fairlead.system.compiled.asking import call, mass_of
from fairlead.system.compiled.named_parts import kept_positions
from fairlead.system.compiled.system import Instance
from fairlead.system.start.places import ratios_at

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
MOST = 3000
"""States of a model; their eigenvalues take some minutes."""
SMALLEST = 1e-13
"""Reciprocal condition, rows and columns scaled, below which equations are singular."""
BEND = 1e-4
"""How far a position is moved to see how the rate of a relation changes, relative to it or in its unit. The error of
the difference is 1e-8 of what bends, and rounding 1e-12."""
RANK = 1e-10
"""Slip of a contact, beside those before it, that is none of its own: contacts that hold in a circle."""


class SingularError(FairleadError):
    """In these zones the equations have no solution, or many."""


@dataclass(frozen=True)
class Equations:
    """J and M at an instant without quadratures, dense, [n, n]; `at` are the places of their unknowns in y."""

    at: Integers
    names: tuple[str, ...]
    j: Floats
    m: Floats
    differential: NDArray[np.bool_]
    relations: Floats
    """Of positions and their rates, [2 relations, n]: what the states keep at zero beside the rows of M."""


@dataclass(frozen=True)
class Linear:
    """States q: dd = basis q, y = spread q; `matrix` is that of q', `onto` gives q from dd."""

    equations: Equations
    matrix: Floats
    basis: Floats
    onto: Floats
    spread: Floats
    held: int
    """Contacts that hold, rows that always do, and relations of positions."""
    pace: float
    """Of what has a derivative, as if nothing held [1/s]: what is far below it is rounding."""


def equations(instance: Instance, t: float, y: Floats, zones: Integers) -> Equations:
    """J and M at (t, y) in these zones; those of the instance stay as they are."""
    before = instance.zones.copy()
    instance.zones[:] = zones
    try:
        values, drift = np.zeros(len(instance.pattern.rows)), np.zeros(instance.n)
        call(instance, "jacobian", t, y, values, drift)
        masses, relations = mass_of(instance), _relations(instance, t, y)
    finally:
        instance.zones[:] = before
    at = np.flatnonzero(~instance.quadrature)
    take = np.ix_(at, at)
    names = tuple(instance.unknown_names[k] for k in at)
    return Equations(at, names, _dense(instance.pattern, values)[take], _dense(instance.mass_pattern, masses)[take],
                     instance.differential[at], relations[:, at])  # fmt: skip


def _relations(instance: Instance, t: float, y: Floats) -> Floats:
    """Relations of positions in force, linearised: those of the positions, then those of their rates."""
    ratios = ratios_at(instance, y) if kept_positions(instance) else np.zeros((0, 0))
    rows, numbering = np.flatnonzero(ratios.any(axis=1)), instance.numbering
    made = np.zeros((2, len(rows), instance.n))
    for k, index in enumerate(numbering.accelerated if len(rows) else ()):
        x, v = numbering.position[index], numbering.rate[index]
        step, rates = BEND * max(1.0, abs(y[x])), []
        for side in (-1.0, 1.0):
            moved, slip = y.copy(), np.zeros(instance.n)
            moved[x] += side * step
            call(instance, "slip", t, moved, slip)
            rates.append(-slip[rows])
        made[0, :, x] = made[1, :, v] = ratios[rows, k]
        made[1, :, x] = (rates[1] - rates[0]) / (2.0 * step)
    return made.reshape(-1, instance.n)


def linear(found: Equations) -> Linear:
    """States and their matrix. Raises SingularError, and FairleadError for a model with too many states."""
    d = found.differential
    if int(d.sum()) > MOST:
        raise FairleadError(f"The model has {int(d.sum())} states, and modes takes {MOST}. Give a coarser mesh.")
    rates = _solved(np.hstack([found.m[:, d], -found.j[:, ~d]]), found.j[:, d])
    count = int(d.sum())
    roots = np.sqrt(np.diag(found.m[np.ix_(d, d)]))
    held = found.m[~d][:, d]
    held = np.vstack([held[np.abs(held).any(axis=1)], found.relations[:, d]]) / roots
    q = _null_space(held)
    basis, onto = q / roots[:, None], (q * roots[:, None]).T
    spread = np.zeros((len(d), q.shape[1]))
    spread[d], spread[~d] = basis, rates[count:] @ basis
    pace = np.linalg.norm(_balanced(found.j[np.ix_(d, d)] / np.outer(roots, roots)), 1) if count else 0.0
    kept = len(held) - len(found.relations) // 2
    return Linear(found, onto @ rates[:count] @ basis, basis, onto, spread, kept, float(pace))


def _balanced(matrix: Floats) -> Floats:
    from scipy.linalg import matrix_balance

    made: Floats = matrix_balance(matrix, permute=False)[0]
    return made


def shares(found: Linear, column: Floats) -> tuple[Floats, Floats]:
    """What acts by this column b of f: B of dd', and H of da."""
    given, d = found.equations, found.equations.differential
    both = _solved(np.hstack([given.m[:, d], -given.j[:, ~d]]), column[:, None])[:, 0]
    return both[: int(d.sum())], both[int(d.sum()) :]


def _dense(pattern: object, values: Floats) -> Floats:
    from scipy import sparse

    starts, rows = pattern.starts, pattern.rows  # type: ignore[attr-defined]
    n = len(starts) - 1
    made: Floats = sparse.csc_matrix((values, rows, starts), shape=(n, n)).toarray()
    return made


def _solved(k: Floats, b: Floats) -> Floats:
    """Solution of k x = b, rows and columns scaled: a pressure is no speed. Raises SingularError."""
    from scipy.linalg import lapack, lu_factor, lu_solve

    rows = np.abs(k).max(axis=1, initial=0.0)
    if not rows.all():
        raise SingularError(SINGULAR)
    columns = np.abs(k / rows[:, None]).max(axis=0, initial=0.0)
    if not columns.all():
        raise SingularError(SINGULAR)
    scaled = k / rows[:, None] / columns
    factors = lu_factor(scaled, check_finite=False) if len(scaled) else None
    if factors is None:
        return np.zeros((0, b.shape[1]))
    condition, _ = lapack.dgecon(factors[0], np.abs(scaled).sum(axis=0).max())
    if not condition > SMALLEST:
        raise SingularError(SINGULAR)
    x: Floats = lu_solve(factors, b / rows[:, None]) / columns[:, None]
    return x


SINGULAR = "the equations are singular in these zones: parts that hold leave no motion free, or a force undetermined"


def _null_space(rows: Floats) -> Floats:
    """An orthonormal basis of what is orthogonal to the rows, shape (columns, rest)."""
    from scipy.linalg import qr

    n = rows.shape[1]
    if not len(rows):
        return np.eye(n)
    q, r, _ = qr(rows.T, pivoting=True)
    sizes = np.abs(np.diag(r))
    rank = int((sizes > RANK * sizes[0]).sum())
    found: Floats = q[:, rank:]
    return found
