"""Which unknowns follow their law within a step: it brings them to its balance, whatever they were at the start."""

from __future__ import annotations

from fairlead.integrate.codes import PARABOLA
from fairlead.integrate.memory.foreign import compiled, indices, reals

STIFF = 100.0
"""An unknown follows its law within a step when h |df/dy| is so many times its inertia."""
FURTHEST = 10.0
"""Times that a law may be less stiff at a place in the step than the factors of the step have it; beyond, it counts as
none. So many times the move that they give is made at most."""
OF_SPEEDS, OF_BALANCES = 1, 2
"""What is shown in balance: speeds alone, or unknowns without inertia too."""


@compiled
def follows_within(matrices, k, h):
    """True if unknown k follows its law within the step h."""
    place, mass = indices(matrices.at_diagonal_slope, matrices.n)[k], indices(matrices.at_diagonal_mass, matrices.n)[k]
    if place < 0 or mass < 0:
        return False
    inertia = reals(matrices.at_mass, matrices.n_mass)[mass]
    return -reals(matrices.at_jacobian, matrices.n_jacobian)[place] * h > STIFF * inertia > 0.0


@compiled
def mark_stiff(problem, matrices, recorder, h):
    """Mark in `is_stiff` what is shown where its law balances; 0 if there is nothing, else OF_SPEEDS or OF_BALANCES.

    Of what has inertia the speeds that follow a stiff law within the step: what they hold of the energy is nothing. A
    pressure that is shown elsewhere has another energy. Without inertia all that a balance gives: the error that it is
    allowed may be large in what flows. Of 1e-4 of 325 V on 1 mohm are left 30 A. A sum drives nothing, so that it is as
    exact as it is allowed to be, but for `stepping`, which knows it as a mean over the step. Speeds are less exact
    there, too: the equations of bodies beside are in the balance.
    """
    means = recorder.most_inside == PARABOLA
    stiff, position, found = indices(recorder.at_is_stiff, problem.n), indices(problem.at_position_of, problem.n), 0
    balances, slope = indices(matrices.at_of_balance, problem.n), indices(matrices.at_diagonal_slope, problem.n)
    values = reals(matrices.at_jacobian, matrices.n_jacobian)
    for k in range(problem.n):
        stiff[k] = 0
    for k in indices(recorder.at_asked_stiff, recorder.n_asked_stiff):
        if balances[k] > 0 and (balances[k] == 1 or means) and values[slope[k]] != 0.0:
            stiff[k] = 1
            found = OF_BALANCES
        elif position[k] >= 0 and follows_within(matrices, k, h):
            stiff[k] = 1
            found = max(found, OF_SPEEDS)
            if means:
                mark_beside(problem, matrices, stiff, k, h)
    return found


@compiled
def mark_beside(problem, matrices, stiff, k, h):
    """Mark the speeds that the law of unknown k moves within the step too: what they are decides where it balances."""
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    values, masses = reals(matrices.at_jacobian, matrices.n_jacobian), reals(matrices.at_mass, matrices.n_mass)
    position, diagonal = indices(problem.at_position_of, problem.n), indices(matrices.at_diagonal_mass, matrices.n)
    for p in range(starts[k], starts[k + 1]):
        j = rows[p]
        if stiff[j] == 0 and position[j] >= 0 and diagonal[j] >= 0 and abs(values[p]) * h > masses[diagonal[j]]:
            stiff[j] = 1
