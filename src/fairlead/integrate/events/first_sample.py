"""The first sample of controllers: taken where the scene has settled without it, as every later one is.

    settle with what controllers give before their first sample; nothing of it is logged
    sample there                                    # what was set in time before the start is in force, no jump at it
    give back the values and zones of the start, and settle with the samples in force

So a sample knows forces, and on what piece of a route a line lies, where nothing but start values is given. The second
settlement begins with the zones given: a contact that let go for want of a command would else go on sliding. Where
nothing settles without a command, the sample is taken where the settlement gave up.
"""

from __future__ import annotations

from fairlead.integrate.codes import NONE_DUE, SETTLING_FOR_IT
from fairlead.integrate.events.settling import begin_settling
from fairlead.integrate.memory.foreign import at_time_at, compiled, copy, indices, reals

JUST_BEFORE, OF_TIME = 1e-15, 8e-15
"""Shares of the span and of the time of the start that lie between it and what is before it: no more than time
resolves, and more than the few digits of the last place within which what is due counts as due."""


@compiled
def settle_for_sample(problem, run, point, events):
    """Keep what is given at the start, and have it settled as it is just before."""
    settling = events.settling
    before = point.t - max(JUST_BEFORE * (run.stop - run.start), OF_TIME * abs(point.t))
    at_time_at(problem.call_at_time, (problem.context, before, point.at_y))
    copy(reals(point.at_y, problem.n), reals(point.at_begun, problem.n))
    copy(indices(problem.at_zones, problem.n_machines), indices(settling.at_zones_given, problem.n_machines))
    run.first_sample = SETTLING_FOR_IT


@compiled
def take_first_sample(problem, run, point, events):
    """Sample at the settled point, then begin from the values given."""
    zones = indices(problem.at_zones, problem.n_machines)
    at_time_at(problem.call_at_time, (problem.context, point.t, point.at_y))
    copy(reals(point.at_begun, problem.n), reals(point.at_y, problem.n))
    copy(indices(events.settling.at_zones_given, problem.n_machines), zones)
    at_time_at(problem.call_at_time, (problem.context, point.t, point.at_y))
    slope, lost = reals(point.at_slope, problem.n), reals(point.at_lost, problem.n)
    not_given_back, joined = reals(point.at_not_given_back, problem.n), reals(point.at_joined, problem.n)
    for k in range(problem.n):
        slope[k] = lost[k] = not_given_back[k] = joined[k] = 0.0
    run.first_sample = NONE_DUE
    events.guards.n_fired = 0
    begin_settling(problem, run, point, events)
    events.loads.nothing_before = 1
