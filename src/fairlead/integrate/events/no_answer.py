"""Zones without an answer for the forces: speeds and places say which ones come next.

A part begins in the first of its zones, however fast it moves. One that creeps (binding) then pulls at full speed as if
that were a creep, with millions of its friction. Where a gear rubs by the force that it passes on, such zones may have
no answer at all, while those of the speeds have one. So where none is found, guards are asked at the point as it was
before: those of speeds, places and time need no forces, and those of forces find the ones from before, none at a start.
Those above zero change their zones. What is wrong by forces then shows as soon as there is an answer.

Where what rubs by the force of a rigid part locks itself, its zones have an answer up to where that force is zero, and
none behind (corners.py). The point may lie behind, by the error of a step. So if no guard is above zero, they are asked
with such forces at zero: the contact lifts off, and lands with forces of the other sign.
"""

from __future__ import annotations

from fairlead.integrate.codes import NOT_CONSISTENT, RELEASED, SINGULAR
from fairlead.integrate.events.guards import evaluate_guards, latches_wait
from fairlead.integrate.events.right_root import find_consistent
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals

MOST_WITHOUT_ANSWER = 8
"""Passes of a settlement in which zones may change without an answer. A contact that creeps takes two to its slide."""


@compiled
def find_answer(m, iterations):
    """Make the point consistent (right_root.py). RELEASED where there is no answer, and guards that are in `fired`."""
    point = m.point
    copy(reals(point.at_y, point.n), reals(point.at_y_unsettled, point.n))
    copy(reals(point.at_slope, point.n), reals(point.at_slope_unsettled, point.n))
    status = find_consistent(m, iterations)
    none = status == NOT_CONSISTENT or (status == SINGULAR and m.events.settling.passes == 0)
    return RELEASED if none and fire_without_answer(m) else status


@compiled
def fire_without_answer(m):
    """Go back to the point as it was kept and fire guards above zero there; False where there is none, or too often."""
    problem, point, guards, settling = m.problem, m.point, m.events.guards, m.events.settling
    if settling.without_answer >= MOST_WITHOUT_ANSWER or guards.n_guards == 0:
        return False
    n = point.n
    copy(reals(point.at_y_unsettled, n), reals(point.at_y, n))
    copy(reals(point.at_slope_unsettled, n), reals(point.at_slope, n))
    evaluate_guards(problem, m.run, guards, point.t, point.at_y, guards.at_g)
    fire_above(guards, guards.at_g)
    if guards.n_fired == 0 and problem.n_pressing > 0:
        without_pressing(problem, point)
        evaluate_guards(problem, m.run, guards, point.t, point.at_y_probe, guards.at_g_probe)
        fire_above(guards, guards.at_g_probe)
    latches_wait(problem, guards)
    settling.without_answer += 1
    return guards.n_fired > 0


@compiled
def fire_above(guards, at_g):
    """Into `fired` the guards of these values that are above zero."""
    ng = guards.n_guards
    g, tolerance, fired = reals(at_g, ng), reals(guards.at_guard_tolerance, ng), indices(guards.at_fired, ng)
    guards.n_fired = 0
    for i in range(ng):
        if g[i] > tolerance[i]:
            fired[guards.n_fired] = i
            guards.n_fired += 1


@compiled
def without_pressing(problem, point):
    """The point with forces of pressing parts at zero, into `y_probe`."""
    probe, rows = reals(point.at_y_probe, point.n), indices(problem.at_pressing_row, problem.n_pressing)
    copy(reals(point.at_y, point.n), probe)
    for k in range(problem.n_pressing):
        probe[rows[k]] = 0.0
