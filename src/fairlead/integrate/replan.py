"""Fresh pivots when the planned ones lose accuracy: SuperLU chooses, the loop replays its choice."""

from __future__ import annotations

import warnings

import numpy as np

from fairlead.integrate.memory import Memory
from fairlead.integrate.ordering import inverse, sparse_plan
from fairlead.integrate.protocol import Integers, Problem


def replan(memory: Memory, problem: Problem) -> bool:
    """Give the loop fresh pivots for the matrix it could not factorise; False if that matrix is singular."""
    plan = fresh_plan(memory, problem)
    if plan is None:
        return False
    for name, values in plan.items():
        memory.point(name, values, np.int64)
    memory.point("lower", np.zeros(len(plan["lower_rows"])), np.float64)
    memory.point("upper", np.zeros(len(plan["upper_rows"])), np.float64)
    memory.number["replans"] += 1
    return True


def fresh_plan(memory: Memory, problem: Problem) -> dict[str, Integers] | None:
    """Arrays of a plan with the pivots that partial pivoting takes for the matrix in memory, or None.

    The matrix is the one whose factorisation failed, in the units of the error weights, so that the
    comparison of pivots does not depend on units. None means that it is singular.
    """
    import scipy.sparse
    import scipy.sparse.linalg

    array = memory.array
    n = len(problem.initial)
    matrix = scipy.sparse.csc_array(
        (array["matrix"], array["matrix_rows"], array["matrix_starts"]), shape=(n, n)
    )
    if not np.all(np.isfinite(array["matrix"])):
        return None
    row_order, column_order = array["row_order"], array["column_order"]
    scaled = matrix * array["row_scale"][:, None] * array["column_scale"][column_order][None, :]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            factors = scipy.sparse.linalg.splu(scipy.sparse.csc_array(scaled), permc_spec="COLAMD")
        except RuntimeError:
            return None
    pivots = np.abs(factors.U.diagonal())
    if not pivots.min() > 1e-14:
        return None
    new_rows = row_order[inverse(factors.perm_r.astype(np.int64))]
    new_columns = column_order[inverse(factors.perm_c.astype(np.int64))]
    made = sparse_plan(problem.pattern, problem.mass_pattern, new_rows, new_columns)
    return made.arrays | {"jacobian_place": made.jacobian_place, "mass_place": made.mass_place}
