"""The active set of a step: which contacts hold, slide, pull or are apart at its end.

    each guard is judged where its law is read: slips and places at the end, forces and their limits at the theta
    point (docs/stepping.md)
    all whose guards are violated switch at once, and with them those that will be handed too much (slip_fronts.py)
    if a pattern of zones recurs, those at least half as wrong as the worst, by the force each is wrong by
    if one recurs again, the one of least index, one per pass (least_index.py); all again, once fewer are
    violated than ever before in the step
"""

from __future__ import annotations

from fairlead.integrate.events.guards import evaluate_guards, latches_wait
from fairlead.integrate.events.least_index import keep_first, keep_worst, number_machines
from fairlead.integrate.events.patterns import note_pattern, remember_pattern
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals, switch_at
from fairlead.integrate.stepping.jump_inside import doubt_captures
from fairlead.integrate.stepping.residual import find_theta_point, read_at_instant, read_on_chord
from fairlead.integrate.stepping.slip_fronts import note_released, redistribute_load

LOOK_AT_LIMITS = 8
"""Steps from one look at whether limits vary with time to the next."""


@compiled
def begin_set(run, settling, stepping):
    """Remember the zones at the start of the step."""
    rule, exchange = stepping.rule, stepping.exchange
    settling.passes = 0
    settling.one_by_one = 0
    settling.fewest = settling.n_guards + 1
    settling.stage_from = 0
    exchange.any_captured = 0
    captured, row = indices(exchange.at_captured, rule.n), indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    for e in range(exchange.n_hold_mass):
        captured[row[e]] = 0
    nz = settling.n_machines
    copy(indices(settling.at_zones, nz), indices(stepping.contacts.at_zones_at_start, nz))
    remember_pattern(run, settling)


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
    constant = problem.linear == 1 and contacts.time_dependent_limits == 0
    seldom = constant and settling.one_by_one == 0 and (settling.passes > 0 or run.steps % LOOK_AT_LIMITS != 0)
    if exchange.algebraic_speeds == 0 and (contacts.has_limits == 0 or seldom):
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
                contacts.time_dependent_limits = 1
            g[i] = g_at_theta[i]
    if exchange.algebraic_speeds == 1:
        machine = indices(problem.at_guard_machine, problem.n_guards)
        hold_row = indices(contacts.at_hold_row, problem.n_machines)
        of_algebraic_speed = indices(exchange.at_of_algebraic_speed, problem.n)
        for i in range(problem.n_guards):
            if machine[i] >= 0 and hold_row[machine[i]] >= 0 and of_algebraic_speed[hold_row[machine[i]]] == 1:
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


@compiled
def follow_guards(m, h, cascade):
    """Switch on `fired`, all, those half as wrong as the worst, or one; True if that changes unknowns (a rebound)."""
    problem, run, point, events, guards = m.problem, m.run, m.point, m.events, m.events.guards
    settling, contacts = m.events.settling, m.stepping.contacts
    if settling.passes >= run.max_passes:
        settling.passes += 1
        return False
    if guards.n_fired < settling.fewest:
        settling.fewest = guards.n_fired
        settling.one_by_one = 0
    if settling.one_by_one == 2:
        keep_first(events)
    elif settling.one_by_one == 1:
        find_how_wrong(events, contacts, h)
        keep_worst(events, True)
    elif cascade:
        redistribute_load(guards, contacts)
    note_released(run, guards, m.stepping)
    y, after = reals(point.at_y_end, problem.n), reals(point.at_y_probe, problem.n)
    copy(y, after)
    switch_at(problem.call_switch, (problem.context, point.t + h, point.at_y_probe, guards.at_fired, guards.n_fired))
    m.stepping.exchange.zones_differ = 1
    settling.passes += 1
    settling.settling_passes += 1
    if settling.one_by_one < 2 and note_pattern(run, settling):
        settling.one_by_one += 1
        number_machines(events, guards.at_g_end)
        settling.stage_from = settling.passes
    changed = False
    for k in range(problem.n):
        changed = changed or y[k] != after[k]
    return changed


@compiled
def find_how_wrong(events, contacts, h):
    """Set `wrong` of the guards in `fired`: the force that each is wrong by."""
    guards = events.guards
    fired, is_limit = indices(guards.at_fired, guards.n_guards), indices(contacts.at_limit_guard, guards.n_guards)
    g, inertia = reals(guards.at_g_end, guards.n_guards), reals(guards.at_guard_inertia, guards.n_guards)
    wrong = reals(events.settling.at_wrong, guards.n_guards)
    for k in range(guards.n_fired):
        i = fired[k]
        wrong[i] = g[i] if is_limit[i] == 1 else g[i] * max(inertia[i], 1e-30) / h
