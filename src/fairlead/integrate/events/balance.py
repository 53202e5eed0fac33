"""Nodes without inertia are brought to where their forces balance: what rounding leaves of it, and jumps of release.

Where nothing holds such a node its row is  0 = g + tau dg/dt  (Facts.balanced), so that g dies out. At a settled point
it is zero at once instead:

    C (dV, ...) = tau g        on those rows, else 0, with C of the consistent point
    x += dV                    for the positions of these nodes

Newton for g(x) = 0, since v stands in the row as tau dg/dx v. What is below the error weights is the error of the dense
output. More is a jump: friction has fallen, or nothing held the node from the start on. Whether a contact lets it go
that way is decided before, with g in the row: against its slip it holds. The energy that springs give in a jump is
dissipated: in friction, and in a damper too small to be seen, which is what makes the node stop where it does.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.linear.systems import solve
from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals
from fairlead.integrate.point.controller import weigh, weighted_norm

BALANCED = 1e-9
"""A way below this, in error weights, is none: a guard on a force is known far better than a position is."""
MOST_JUMPS = 20
"""Jumps at one instant at most; of a stiff spring that bends, Newton takes a few."""
ROUNDS = 2
"""Moves by the error of the dense output; the second is rounding, which may not get less."""


@compiled
def find_way_to_balance(problem, point, linear):
    """Set v to the way of every position to where the forces balance; the largest, in error weights."""
    n = problem.n
    change, way, to_weigh = reals(point.at_b, n), reals(point.at_v, n), reals(point.at_u, n)
    field_at(problem.call_gap, (problem.context, point.t, point.at_y, point.at_b))
    solve(linear, point.at_b)
    position = indices(problem.at_balanced_position, problem.n_balanced)
    speed = indices(problem.at_balanced_speed, problem.n_balanced)
    weigh(point, point.at_y)
    way[:] = 0.0
    to_weigh[:] = 0.0
    for k in range(problem.n_balanced):
        way[position[k]] = change[speed[k]]
        to_weigh[position[k]] = change[speed[k]]
    return weighted_norm(point, point.at_u)


@compiled
def close_balance(problem, point, linear):
    """Take away what is left of balances by the error of the dense output; True if there was any."""
    size = find_way_to_balance(problem, point, linear)
    if not (BALANCED < size <= 1.0):
        return False
    move(problem, point)
    return True


@compiled
def jump_to_balance(m):
    """Move nodes to where their forces balance, at once, and book what that takes; True if they moved."""
    problem, point, recorder = m.problem, m.point, m.recorder
    size = find_way_to_balance(problem, point, m.linear) if problem.n_balanced > 0 else 0.0
    if not isfinite(size) or size <= 1.0:
        return False
    before = stored_energy(problem, point, recorder)
    move(problem, point)
    if problem.dissipated_at >= 0 and point.t > m.run.start:
        reals(point.at_y, problem.n)[problem.dissipated_at] += before - stored_energy(problem, point, recorder)
    return True


@compiled
def move(problem, point):
    """Add the way in v to the positions."""
    way, y = reals(point.at_v, problem.n), reals(point.at_y, problem.n)
    position = indices(problem.at_balanced_position, problem.n_balanced)
    for k in range(problem.n_balanced):
        y[position[k]] += way[position[k]]


@compiled
def stored_energy(problem, point, recorder):
    """The energy that the problem says is stored, at the point; the last of its outputs."""
    if problem.call_outputs == 0:
        return 0.0
    # The room of the next row, which arrival.py has seen to.
    out = recorder.at_row_values + 8 * recorder.rows * problem.n_outputs
    field_at(problem.call_outputs, (problem.context, point.t, point.at_y, out))
    return reals(out, problem.n_outputs)[problem.n_outputs - 1]
