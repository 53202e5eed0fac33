"""A trial step that is given up, in every engine: it is taken again with another length, or its start is settled.

Inconsistent start. A guard above its tolerance at the end of a step that never was below zero was not passed over: the
zones at the start were wrong, so the start is settled, by what its guards are there. Where it was settled already and
all such guards fall by the slopes there, the step is too rough at its start, and a much shorter one is tried. So it is
where one neither falls nor rises by them, but is below zero at the end: the interpolant of a long step has a body that
begins to leave a stop by t^3 enter it by more than a guard of places is known to.
"""

from __future__ import annotations

from fairlead.integrate.codes import BEFORE, GO_ON, SETTLE
from fairlead.integrate.events.pace import DOUBT
from fairlead.integrate.events.release import remember
from fairlead.integrate.events.settling import begin_settling
from fairlead.integrate.events.violators import fall_from_start
from fairlead.integrate.memory.foreign import compiled
from fairlead.integrate.point.controller import smallest_step
from fairlead.integrate.record.rows import write_row

TOO_LONG, TOO_FAR = 1, 0
"""Why a step is taken again: it was too long, and the next must not grow; or it only goes on where it should end."""


@compiled
def take_again(run, length, why):
    """Have the next trial be the same step, `length` long; nothing else sets the length of a step that is repeated."""
    run.h_next = length
    run.retried += why
    return GO_ON


@compiled
def take_much_shorter(run, guards, h):
    """Have a tenth of a step tried whose guards say other than the slopes at its start: see pace.DOUBT."""
    guards.n_fired = 0
    return take_again(run, DOUBT * h, TOO_LONG)


@compiled
def settle_at_start(m):
    """Settle at the point, on the guards in `fired`, before another step is tried."""
    problem, run, point = m.problem, m.run, m.point
    run.inconsistent_start = 1
    write_row(problem, m.recorder, point.t, point.at_y, BEFORE)
    remember(problem, point, m.events.loads)
    begin_settling(problem, run, point, m.events)
    run.phase = SETTLE
    return GO_ON


@compiled
def settle_inconsistent_start(m, h):
    """Settle the inconsistent start of the step h, of which the guards in `fired` were above zero from the start."""
    run, point = m.run, m.point
    run.rejected_inconsistent += 1
    if run.adaptive == 1 and DOUBT * h >= smallest_step(run, point) and is_doubtful(m.problem, run, point, m.events):
        return take_much_shorter(run, m.events.guards, h)
    if run.judged == 0:  # not known by the equations yet: a load that tops out at its limit here is held
        m.events.guards.n_fired = 0
    return settle_at_start(m)


@compiled
def is_doubtful(problem, run, point, events):
    """True if the start of the step was settled, and by its slopes the guards in `fired` do not rise there."""
    return run.judged == 1 and fall_from_start(problem, run, point, events)
