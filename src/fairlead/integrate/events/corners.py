"""Guards that touch zero inside a trial step where a force that presses passes through zero.

What rubs by the size of a force has a corner there, as the normal force of the flanks of a screw: it falls to zero and
rises again, and no parabola finds that (bumps.py). Behind it the zones of the start may have no answer (right_root.py).
"""

from __future__ import annotations

from fairlead.integrate.events.bumps import floor_of
from fairlead.integrate.events.guards import guards_at
from fairlead.integrate.events.limits import AT_LIMIT
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.illinois import LEFT, RIGHT, shares_of_ends
from fairlead.integrate.point.interpolant import interpolate_one

CLOSE = 4e-16
"""Share of a step to which the zero of a force is known."""
MOST_SECANTS = 60
"""Places at most: twice as many as of the slowest force, whose zero each second one halves."""


@compiled
def find_corner(m, h, before):
    """The first place s below `before` where a force that presses is zero and guards touch zero, else `before`.

    These are marked in `in_corner`, also for the settlement there.
    """
    problem, point, guards = m.problem, m.point, m.events.guards
    indices(guards.at_in_corner, guards.n_guards)[:] = 0
    rows = indices(problem.at_pressing_row, problem.n_pressing)
    y, y_end = reals(point.at_y, point.n), reals(point.at_y_end, point.n)
    found = before
    for k in range(problem.n_pressing):
        row = rows[k]
        if y[row] * y_end[row] < 0.0:
            s = zero_of(point, row)
            if s < found:
                guards_at(m, s, h, guards.at_g_probe)
                found = s if any_touches(guards) else found
    return found


@compiled
def any_touches(guards):
    """True if a guard below zero at both ends has reached it in `g_probe`; these are marked then."""
    ng = guards.n_guards
    corner = indices(guards.at_in_corner, ng)
    g, end = reals(guards.at_g, ng), reals(guards.at_g_end, ng)
    probe, tolerance = reals(guards.at_g_probe, ng), reals(guards.at_guard_tolerance, ng)
    touches = False
    for i in range(ng):
        if g[i] <= AT_LIMIT * tolerance[i] and end[i] < 0.0 and probe[i] >= floor_of(guards, i):
            corner[i], touches = 1, True
    return touches


@compiled
def zero_of(point, row):
    """Where unknown `row`, whose ends have opposite signs, is zero on the interpolant."""
    a, b = 0.0, 1.0
    left, right = reals(point.at_y, point.n)[row], reals(point.at_y_end, point.n)[row]
    of_left, of_right, last = 1.0, 1.0, 0
    for _ in range(MOST_SECANTS):
        ga, gb = of_left * left, of_right * right
        x = b - (b - a) * (gb / (gb - ga))
        if b - a <= CLOSE or not a < x < b:
            break
        value = interpolate_one(point, x, row)
        if value == 0.0:
            return x
        moved = LEFT if (value < 0.0) == (left < 0.0) else RIGHT
        if moved == LEFT:
            a, left = x, value
        else:
            b, right = x, value
        of_left, of_right = shares_of_ends(of_left, of_right, last, moved)
        last = moved
    return x
