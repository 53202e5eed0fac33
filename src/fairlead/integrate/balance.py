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

from fairlead.integrate.controller import weigh, weighted_norm
from fairlead.integrate.foreign import compiled, field_at, indices, reals
from fairlead.integrate.linear import solve

CLOSE = 1e-9
"""A way below this, in error weights, is none: a guard on a force is known far better than a position is."""
MOVES = 20
"""Jumps at one instant at most; of a stiff spring that bends, Newton takes a few."""
ROUNDS = 2
"""Moves by the error of the dense output; the second is rounding, which may not get less."""


@compiled
def off_balance(m):
    """Set v to the way of every position to where the forces balance; the largest, in error weights."""
    n = m.n
    r, way, u = reals(m.at_b, n), reals(m.at_v, n), reals(m.at_u, n)
    field_at(m.call_gap, (m.context, m.t, m.at_y, m.at_b))
    solve(m, m.at_b)
    position, speed = indices(m.at_balanced_position, m.n_balanced), indices(m.at_balanced_speed, m.n_balanced)
    weigh(m, m.at_y)
    way[:] = 0.0
    u[:] = 0.0
    for k in range(m.n_balanced):
        way[position[k]] = r[speed[k]]
        u[position[k]] = r[speed[k]]
    return weighted_norm(m, m.at_u)


@compiled
def close_balance(m):
    """Take away what is left of balances by the error of the dense output; True if there was any."""
    size = off_balance(m)
    if not (CLOSE < size <= 1.0):
        return False
    move(m)
    return True


@compiled
def jump_to_balance(m):
    """Move nodes to where their forces balance, at once, and book what that takes; True if they moved."""
    size = off_balance(m) if m.n_balanced > 0 else 0.0
    if not isfinite(size) or size <= 1.0:
        return False
    before = stored_energy(m)
    move(m)
    if m.dissipated_at >= 0 and m.t > m.start:
        reals(m.at_y, m.n)[m.dissipated_at] += before - stored_energy(m)
    return True


@compiled
def move(m):
    """Add the way in v to the positions."""
    way, y, position = reals(m.at_v, m.n), reals(m.at_y, m.n), indices(m.at_balanced_position, m.n_balanced)
    for k in range(m.n_balanced):
        y[position[k]] += way[position[k]]


@compiled
def stored_energy(m):
    """The energy that the problem says is stored, at the point; the last of its outputs."""
    if m.call_outputs == 0:
        return 0.0
    out = m.at_row_values + 8 * m.rows * m.n_outputs  # room of the next row, which arrival.py has seen to
    field_at(m.call_outputs, (m.context, m.t, m.at_y, out))
    return reals(out, m.n_outputs)[m.n_outputs - 1]
