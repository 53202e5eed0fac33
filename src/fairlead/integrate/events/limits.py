"""Where a guard is at its limit: so near zero that only rounding tells on which side; and what a tie at a limit is.

A contact carries loads up to its stiction and that load itself: a load that comes to its limit and goes no further is
held. So the guard of such a limit (`limit_guard`) fires where it goes on beyond its tolerance. At zero within the
tolerance at the end of a step it does not: what goes on from there fires in the next step, at this point.

    the top of a load inside a step is known to the error of the dense output; the equations tell the error at the
    crossing, where the dense output has the guard at zero: what is found there is taken off the height of the top
"""

from __future__ import annotations

from fairlead.integrate.memory.foreign import compiled, indices, reals

AT_LIMIT = 1e-3
"""How far below zero, in guard tolerances, a guard still counts as at its limit: further down it is inside
its zone and will cross by itself. A contact at rest just inside a border would else be sent to and fro."""

OF_LIMIT = 1e-8
"""Tolerance of the guard of a limit, as a share of the force that comes to it: what a load at its limit is known to."""
OF_OTHERS = 1e-14
"""The same as a share of the largest force that holds anything: the rounding of a solve."""
UNBOUNDED = 1e300
ERROR_OF_TOP = 0.1
"""Share of the height of a top inside a step by which the dense output may be off where it shows the crossing: it is
off as much at the top. In a shorter step it is off by less, with the third power of its length at least."""


@compiled
def weigh_limits(problem, guards, at_y):
    """Set the tolerances of limits of held forces by the forces in y."""
    limit, bounded = indices(guards.at_limit_guard, guards.n_guards), indices(problem.at_bounded_row, guards.n_guards)
    tolerance, y = reals(guards.at_guard_tolerance, guards.n_guards), reals(at_y, problem.n)
    largest = 0.0
    for i in range(guards.n_guards):
        if limit[i] == 1 and bounded[i] >= 0:
            largest = max(largest, abs(y[bounded[i]]))
    if not 0.0 < largest < UNBOUNDED:
        return
    for i in range(guards.n_guards):
        if limit[i] == 1 and bounded[i] >= 0:
            tolerance[i] = max(OF_LIMIT * abs(y[bounded[i]]), OF_OTHERS * largest)


@compiled
def goes_no_further(guards, i):
    """True if the load of guard i, which fired, tops out at its limit, or may do; `g` is what the equations give there.

    `g_late` is how high the guard rises after that on the dense output, which has it at zero there.
    """
    if indices(guards.at_limit_guard, guards.n_guards)[i] == 0:
        return False
    g, height = reals(guards.at_g, guards.n_guards)[i], reals(guards.at_g_late, guards.n_guards)[i]
    turns = reals(guards.at_g_end, guards.n_guards)[i] < 0.0
    return g + height <= reals(guards.at_guard_tolerance, guards.n_guards)[i] or (turns and -g > ERROR_OF_TOP * height)
