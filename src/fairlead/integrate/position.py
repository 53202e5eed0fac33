"""Back to the relations of positions that are kept: projection of positions and speeds after every step.

    0 = J a + (dJ/dt) v        is solved with every stage; g(x) = 0 and J v = 0 follow but for the error of a step
    C (dV, Lambda) = r         r = -g on the rows of relations, else 0; C of the consistent point (start.py)
    x += dV                    for every position x and its speed: positions move as an impulse would move speeds,
                               the least way by the kinetic energy, and what holds goes along
    v += dV                    the same with r = -J v, and once more the algebraic unknowns

(Eich, SIAM J. Numer. Anal. 30:1467, 1993; Lubich, Impact Comput. Sci. Eng. 3:212, 1991.) Twice in all: the first move
leaves what is of second order. The size of the move is that of the error of one step. Before a step is accepted it is
asked with the factors of that step, W dK = r, how far its end is off: beyond an error weight the step is shorter.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.controller import weigh, weighted_norm
from fairlead.integrate.foreign import compiled, field_at, indices, reals
from fairlead.integrate.linear import DONE, solve, solve_watched

MOVES = 4
"""Moves at most; two do, and after four what is left is what the positions are known to."""
CLOSE = 1e-6
"""A move below this, in error weights, is the last."""


@compiled
def way_back(m, h):
    """How far, in error weights, the positions at the end of a trial step are off what is kept."""
    n = m.n
    off, u = reals(m.at_b, n), reals(m.at_u, n)
    field_at(m.call_gap, (m.context, m.t + h, m.at_y_end, m.at_b))
    solve(m, m.at_b)
    position, acceleration = indices(m.at_move_position, m.n_moves), indices(m.at_move_acceleration, m.n_moves)
    u[:] = 0.0
    for k in range(m.n_moves):
        if acceleration[k] >= 0:
            u[position[k]] = off[acceleration[k]]
    return weighted_norm(m, m.at_u)


@compiled
def project_positions(m):
    """Move positions to where all relations are kept, with the factors of C; DONE or why not.

    `moved` is then how far they moved, in error weights.
    """
    n = m.n
    r, y, way, u = reals(m.at_b, n), reals(m.at_y, n), reals(m.at_v, n), reals(m.at_u, n)
    position, speed = indices(m.at_move_position, m.n_moves), indices(m.at_move_speed, m.n_moves)
    weigh(m, m.at_y)
    u[:] = 0.0
    for move in range(MOVES):
        field_at(m.call_gap, (m.context, m.t, m.at_y, m.at_b))
        if move == 0:
            status = solve_watched(m, m.at_b)
            if status != DONE:
                return status
        else:
            solve(m, m.at_b)
        way[:] = 0.0
        for k in range(m.n_moves):
            way[position[k]] = r[speed[k]]
        size = weighted_norm(m, m.at_v)
        if not isfinite(size):
            break
        for k in range(m.n_moves):
            y[position[k]] += way[position[k]]
            u[position[k]] += way[position[k]]
        if size <= CLOSE:
            break
    m.moved = weighted_norm(m, m.at_u)
    return DONE
