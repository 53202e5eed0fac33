"""Guards at the end of a step that is being solved, each where its law is read, and those that are violated.

Slips and places are read at the end, forces and their limits at the theta point (docs/stepping.md).
"""

from __future__ import annotations

from fairlead.integrate.events.guards import evaluate_guards, latches_wait
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.stepping.jump_inside import doubt_captures
from fairlead.integrate.stepping.residual import find_theta_point, read_at_instant, read_on_chord

LOOK_AT_LIMITS = 8
"""Steps from one look at whether limits vary with time to the next."""


@compiled
def find_violators(m, h):
    """Fill `fired` with the guards that are violated, as far as zones may change in the step."""
    rule, guards = m.stepping.rule, m.events.guards
    if rule.locates == 0:
        evaluate_guards_of_step(m, h)
        fire_violators_of_step(guards)
        doubt_captures(m, h)
        latches_wait(m.problem, guards)
    if rule.locates == 1 or rule.frozen == 1:
        guards.n_fired = 0


@compiled
def evaluate_guards_of_step(m, h):
    """Into `g_end` every guard where its law is read: limits of forces at the theta point, others at the end.

    Of contacts on nodes without mass all are read at the theta point.

    A limit that varies (a normal force that follows a tension) would else let a contact go that, sliding, is
    held back by more than it was let go for. Where f is linear no limit varies with the unknowns; whether one varies
    with time is looked at now and then, and where zones cycle.
    """
    problem, run, point, guards, settling = m.problem, m.run, m.point, m.events.guards, m.events.settling
    rule, exchange, contacts = m.stepping.rule, m.stepping.exchange, m.stepping.contacts
    evaluate_guards(problem, run, guards, point.t + h, point.at_y_end, guards.at_g_end)
    constant = problem.linear == 1 and contacts.limits_vary == 0
    seldom = constant and settling.one_by_one == 0 and (settling.passes > 0 or run.steps % LOOK_AT_LIMITS != 0)
    if exchange.massless == 0 and (contacts.has_limits == 0 or seldom):
        return
    find_theta_point(point, rule)
    read_on_chord(problem, point, rule.theta_now, h)
    evaluate_guards(problem, run, guards, point.t + rule.theta_now * h, point.at_u, guards.at_g_probe)
    read_at_instant(problem)
    g, g_at_theta, is_limit = (
        reals(guards.at_g_end, problem.n_guards), reals(guards.at_g_probe, problem.n_guards),
        indices(contacts.at_limit_guard, problem.n_guards),
    )  # fmt: skip
    tolerance = reals(guards.at_guard_tolerance, problem.n_guards)
    for i in range(problem.n_guards):
        if is_limit[i] == 1:
            if abs(g[i] - g_at_theta[i]) > tolerance[i]:
                contacts.limits_vary = 1
            g[i] = g_at_theta[i]
    if exchange.massless == 1:
        machine = indices(problem.at_guard_machine, problem.n_guards)
        hold_row = indices(contacts.at_hold_row, problem.n_machines)
        of_massless = indices(exchange.at_of_massless, problem.n)
        for i in range(problem.n_guards):
            if machine[i] >= 0 and hold_row[machine[i]] >= 0 and of_massless[hold_row[machine[i]]] == 1:
                g[i] = g_at_theta[i]


@compiled
def fire_violators_of_step(guards):
    """Fill `fired` with the guards above their tolerance at the end of the step."""
    g, tolerance = reals(guards.at_g_end, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards)
    fired = indices(guards.at_fired, guards.n_guards)
    guards.n_fired = 0
    for i in range(guards.n_guards):
        if g[i] > tolerance[i]:
            fired[guards.n_fired] = i
            guards.n_fired += 1
