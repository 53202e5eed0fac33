"""Fresh pivots when the planned ones lose accuracy: SuperLU chooses, the loop replays its choice."""

from __future__ import annotations

import warnings

import numpy as np

from fairlead.integrate.codes import VANISHES
from fairlead.integrate.linear.condensing import lay_out, reduced_entries
from fairlead.integrate.linear.ordering import Plan, inverse, sparse_plan
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.problem import Problem


def replan(memory: Memory, problem: Problem) -> bool:
    """Give the loop fresh pivots for the matrix it could not factorise; False if that matrix is singular."""
    plan = None if memory.number["dense"] else fresh_plan(memory, problem)  # a full matrix has all pivots to choose
    if plan is None:
        return False
    factors = {name: np.zeros(len(plan.arrays[f"{name}_rows"])) for name in ("lower", "upper")}
    memory.replace(plan.arrays | factors)
    memory.number["reduced_valid"] = 0
    memory.number["replans"] += 1
    return True


def fresh_plan(memory: Memory, problem: Problem) -> Plan | None:
    """The plan with the pivots that partial pivoting takes for the reduced matrix in memory, or None.

    That is the matrix whose factorisation failed, in the units of the error weights, so that the comparison of pivots
    does not depend on units. None means that it is singular: a pivot is rounding of what it is the difference of.
    """
    import scipy.sparse
    import scipy.sparse.linalg

    array = memory.array
    row_order, column_order = array["row_order"], array["column_order"]
    reduced = len(row_order)
    matrix = scipy.sparse.csc_array(
        (array["matrix"], array["matrix_rows"], array["matrix_starts"]), shape=(reduced, reduced)
    )
    if not np.all(np.isfinite(array["matrix"])):
        return None
    scaled = matrix * array["row_scale"][:reduced, None] * array["column_scale"][column_order][None, :]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            factors = scipy.sparse.linalg.splu(scipy.sparse.csc_array(scaled), permc_spec="COLAMD")
        except RuntimeError:
            return None
    terms = abs(factors.L).multiply(abs(factors.U).T).sum(axis=1)
    if not np.all(np.abs(factors.U.diagonal()) > VANISHES * terms):
        return None
    new_rows = row_order[inverse(factors.perm_r.astype(np.int64), reduced)[:reduced]]
    new_columns = column_order[inverse(factors.perm_c.astype(np.int64), reduced)[:reduced]]
    layout = lay_out(problem)
    return sparse_plan(problem, layout, reduced_entries(problem, layout), new_rows, new_columns)
