"""The line search of a step: a move that raises the residual is taken back by halves.

Where laws bend sharply, as friction regularised over a speed far below that of the motion, a full Newton move goes
beyond the bend, the next one back, and so on for ever. Its direction is still that in which the residual falls. So
within one set of zones, with s the share of the move that is left and r the size of the residual,

    r(s) <= (1 - ARMIJO s) r(0)

is asked of a full move by halves (Armijo 1966), where that has not lowered r: elsewhere nothing is done, and no law is
evaluated more than once. J is evaluated anew then: only its own direction is sure to descend. The size is the one that
judges when a step is solved: each row over its largest entry in error weights, so that a share has the same meaning
whatever the units.

Not searched is where friction falls with speed faster than the step can follow, or may: its equations have more than
one solution there, and full moves that find none ask rightly for a shorter step. (Searched, stick-slip of a block on a
spring with exact hold came to errors that did not follow the accuracy.)
"""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, copy, indices, reals
from fairlead.integrate.meters import inertia_of
from fairlead.integrate.step_residual import PASSED, residual_of_step, scaled_residual

ARMIJO, LEAST_SHARE = 1e-4, 1e-3
"""Share of the promised fall that is asked for; below the least share of a move the next J has to tell."""
FALLING = 0.5
"""Share of the inertia that falling friction may take away over half a step."""
MOST_SEARCHED = 40
"""Solves before a step in which moves were taken back counts as not converging."""
SEARCHED, GIVEN_UP = 1, 2
"""What `searched` says: moves were taken back; and that did not help."""


@compiled
def remember_move(m):
    """Keep the solution in b, which `y_end` is about to be moved by."""
    copy(reals(m.at_b, m.n), reals(m.at_move, m.n))


@compiled
def search_line(m, h, before):
    """Leave the residual after the last move, of which as much is taken back as raises it above `before`."""
    residual_of_step(m, h, True)
    size, share = scaled_residual(m), 1.0
    if size <= max(before, PASSED):
        return
    fresh = m.searched == SEARCHED
    if falls(m, h):
        if fresh:
            m.searched = GIVEN_UP
        return
    m.searched = SEARCHED
    m.linearised = 0
    y_end, move, differential = reals(m.at_y_end, m.n), reals(m.at_move, m.n), indices(m.at_differential, m.n)
    ahead = 1.0 / m.theta_now
    while not size <= (1.0 - ARMIJO * share) * before and share > LEAST_SHARE:
        share *= 0.5
        for k in range(m.n):
            y_end[k] -= share * (ahead * move[k] if differential[k] == 1 else move[k])
        residual_of_step(m, h, True)
        size = scaled_residual(m)
    if fresh and not size <= (1.0 - ARMIJO * share) * before:
        m.searched = GIVEN_UP


@compiled
def falls(m, h):
    """True if friction falls with speed by more than the step can follow; that of a contact that may hold might."""
    row, holds = indices(m.at_hold_mass_row, m.n_hold_mass), indices(m.at_holds, m.n)
    for e in range(m.n_hold_mass):
        if holds[row[e]] == 0:
            return True
    slopes = reals(m.at_jacobian, m.n_jacobian)
    starts, rows = indices(m.at_jacobian_starts, m.n + 1), indices(m.at_jacobian_rows, m.n_jacobian)
    differential, controlled = indices(m.at_differential, m.n), indices(m.at_controlled, m.n)
    for k in range(m.n):
        if differential[k] == 1 and controlled[k] == 0:
            for p in range(starts[k], starts[k + 1]):
                if rows[p] == k and h * m.theta_now * slopes[p] > FALLING * inertia_of(m, k):
                    return True
    return False
