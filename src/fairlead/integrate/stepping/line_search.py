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

from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.point.meters import inertia_of
from fairlead.integrate.stepping.step_residual import PASSED, residual_of_step, scaled_residual

ARMIJO, LEAST_SHARE = 1e-4, 1e-3
"""Share of the promised fall that is asked for; below the least share of a move the next J has to tell."""
FALLING = 0.5
"""Share of the inertia that falling friction may take away over half a step."""
MOST_SEARCHED = 40
"""Solves before a step in which moves were taken back counts as not converging."""
SEARCHED, GIVEN_UP = 1, 2
"""What `searched` says: moves were taken back; and that did not help."""


@compiled
def remember_move(point, rule):
    """Keep the solution in b, which `y_end` is about to be moved by."""
    copy(reals(point.at_b, point.n), reals(rule.at_move, point.n))


@compiled
def search_line(problem, point, linear, stepping, h, before):
    """Leave the residual after the last move, of which as much is taken back as raises it above `before`."""
    matrices, rule = linear.matrices, stepping.rule
    residual_of_step(problem, point, matrices, stepping, h, True)
    size, share = scaled_residual(point, linear), 1.0
    if size <= max(before, PASSED):
        return
    fresh = rule.searched == SEARCHED
    if falls(matrices, stepping, h):
        if fresh:
            rule.searched = GIVEN_UP
        return
    rule.searched = SEARCHED
    rule.linearised = 0
    y_end, move = reals(point.at_y_end, point.n), reals(rule.at_move, point.n)
    differential = indices(point.at_differential, point.n)
    ahead = 1.0 / rule.theta_now
    while not size <= (1.0 - ARMIJO * share) * before and share > LEAST_SHARE:
        share *= 0.5
        for k in range(point.n):
            y_end[k] -= share * (ahead * move[k] if differential[k] == 1 else move[k])
        residual_of_step(problem, point, matrices, stepping, h, True)
        size = scaled_residual(point, linear)
    if fresh and not size <= (1.0 - ARMIJO * share) * before:
        rule.searched = GIVEN_UP


@compiled
def falls(matrices, stepping, h):
    """True if friction falls with speed by more than the step can follow; that of a contact that may hold might."""
    rule, exchange = stepping.rule, stepping.exchange
    row, holds = indices(exchange.at_hold_mass_row, exchange.n_hold_mass), indices(exchange.at_holds, matrices.n)
    for e in range(exchange.n_hold_mass):
        if holds[row[e]] == 0:
            return True
    slopes = reals(matrices.at_jacobian, matrices.n_jacobian)
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    differential, controlled = indices(matrices.at_differential, matrices.n), indices(rule.at_controlled, matrices.n)
    for k in range(matrices.n):
        if differential[k] == 1 and controlled[k] == 0:
            for p in range(starts[k], starts[k + 1]):
                if rows[p] == k and h * rule.theta_now * slopes[p] > FALLING * inertia_of(matrices, k):
                    return True
    return False
