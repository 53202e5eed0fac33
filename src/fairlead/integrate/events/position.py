"""Back to the relations of positions that are kept: projection of positions and speeds after every step.

    0 = J a + (dJ/dt) v        is solved with every stage; g(x) = 0 and J v = 0 follow but for the error of a step
    C (dV, Lambda) = r         r = -g on the rows of relations, else 0; C of the consistent point (consistent.py)
    x += dV                    for every position x and its speed: positions move as an impulse would move speeds,
                               the least way by the kinetic energy, and what holds goes along
    v += dV                    the same with r = -J v, and once more the algebraic unknowns

(Eich, SIAM J. Numer. Anal. 30:1467, 1993; Lubich, Impact Comput. Sci. Eng. 3:212, 1991.) Twice in all: the first move
leaves what is of second order. The size of the move is that of the error of one step. Before a step is accepted it is
asked with the factors of that step, W dK = r, how far its end is off: beyond an error weight the step is shorter.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import DONE
from fairlead.integrate.linear.systems import solve, solve_checked
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.point.controller import weigh, weighted_norm

MOST_CORRECTIONS = 4
"""Moves at most; two do, and after four what is left is what the positions are known to."""
LAST_CORRECTION = 1e-6
"""A move below this, in error weights, is the last."""


@compiled
def way_back(problem, point, linear, h):
    """How far, in error weights, the positions at the end of a trial step are off what is kept."""
    n = problem.n
    off, to_weigh = reals(point.at_b, n), reals(point.at_u, n)
    field_at(problem.call_gap, (problem.context, point.t + h, point.at_y_end, point.at_b))
    solve(linear, point.at_b)
    position = indices(problem.at_move_position, problem.n_moves)
    acceleration = indices(problem.at_move_acceleration, problem.n_moves)
    to_weigh[:] = 0.0
    for k in range(problem.n_moves):
        if acceleration[k] >= 0:
            to_weigh[position[k]] = off[acceleration[k]]
    return weighted_norm(point, point.at_u)


@compiled
def off_place(problem, point):
    """True if a row that holds knows that positions are off, by however little."""
    if problem.n_moves == 0:
        return False
    field_at(problem.call_gap, (problem.context, point.t, point.at_y, point.at_b))
    off = False
    for gap in reals(point.at_b, problem.n):
        off = off or gap != 0.0
    return off


@compiled
def in_units_of_light(problem, matrices, at_values, at_r):
    """Set r in rows that hold nodes without inertia to values that a change of their speeds by as much would give.

    Of several entries of a row the last counts; they give the same.
    """
    light, column = indices(problem.at_light, problem.n_light), indices(matrices.at_mass_columns, matrices.n_mass)
    row, masses = indices(matrices.at_mass_rows, matrices.n_mass), reals(matrices.at_mass, matrices.n_mass)
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    slopes = reals(matrices.at_jacobian, matrices.n_jacobian)
    r, values = reals(at_r, problem.n), reals(at_values, problem.n)
    for e in light:
        if masses[e] != 0.0:
            for p in range(starts[column[e]], starts[column[e] + 1]):
                if rows[p] == row[e]:
                    r[row[e]] = values[row[e]] * (1.0 - slopes[p] / masses[e])


@compiled
def project_positions(problem, point, linear):
    """Move positions to where all relations are kept, with the factors of C; DONE or why not.

    `moved` is then how far they moved, in error weights.
    """
    n = problem.n
    change, y, way = reals(point.at_b, n), reals(point.at_y, n), reals(point.at_v, n)
    moved_in_all = reals(point.at_u, n)
    position = indices(problem.at_move_position, problem.n_moves)
    speed = indices(problem.at_move_speed, problem.n_moves)
    weigh(point, point.at_y)
    moved_in_all[:] = 0.0
    for move in range(MOST_CORRECTIONS):
        field_at(problem.call_gap, (problem.context, point.t, point.at_y, point.at_v))
        copy(way, change)
        if problem.n_light > 0:
            in_units_of_light(problem, linear.matrices, point.at_v, point.at_b)
        if move == 0:
            status = solve_checked(linear, point.at_b)
            if status != DONE:
                return status
        else:
            solve(linear, point.at_b)
        way[:] = 0.0
        for k in range(problem.n_moves):
            way[position[k]] = change[speed[k]]
        size = weighted_norm(point, point.at_v)
        if not isfinite(size):
            break
        for k in range(problem.n_moves):
            y[position[k]] += way[position[k]]
            moved_in_all[position[k]] += way[position[k]]
        if size <= LAST_CORRECTION:
            break
    point.moved = weighted_norm(point, point.at_u)
    return DONE
