"""One step of nonsmooth time stepping: the zones are unknowns of the step (after Moreau 1988).

    rows with mass     M (y1 - y0)/h = f(t0 + theta h, u, a)
    algebraic rows                 0 = f(t0 + theta h, u, a)        u = y0 + theta (y1 - y0)
    held contacts                  0 = slip(t0 + h, y1)

y are the differential unknowns, a the algebraic ones: forces of contacts, means over the step. theta = 1/2 is the
implicit midpoint rule, of order two, which third_order.py makes one of order three that damps what is stiff; theta
above 1/2, of order one, is taken where zones cycle (repeated.py), over the kink of a table (trial.step_over_kink), and
where a run asks for it (`Run.theta`). A guard reads what its law reads: slips at the end of the step, forces and their
limits at the point u. So a contact that holds and one that slides are the two branches of |force| <= limit, slip at the
end = 0 or against the force: a complementarity problem. It is solved by an active set (active_set.py): solve with the
zones frozen, switch those whose guards are violated, solve again. Smooth nonlinearity is taken up by the same
iteration, which ends when no guard is violated and the residual passes. Where f is linear as long as the zones are
frozen one solve is exact, and the residual is looked at once per factorisation. Where steps end at every switch
(`rule.locates`), the zones are those of the start of the step, and only the smooth iteration is left.

The matrix is the W of the Rosenbrock methods with gamma = theta, for theta (y1 - y0), so that one plan of pivots serves
`rodas` and `stepping`; the row of a held contact is M/(h theta), and its share of other forces where it closes a
circle. The speed of a node without mass is algebraic, a mean over the step like a force: a contact on such a node holds
that, its slip is zero at the point u.

`take_theta_step` is one loop: a solve (`solve_once`), then guards (`find_violators`), then switches (`switch_zones`).
What steers it, where that is set and read; it is in `rule` (R), `exchange` (E), `settling` (S), or local to the loop:

    solves             solves since zones switched last      the loop                   judge_residual, the residual
    solved             one in this step at all               the loop                   solve_once
    size               the residual before the last move     approach_laws              judge_residual, search_line
    R midway           the matrix is met on the way          solve_once                 halve_or_replan, underway.py
    R searched         moves were taken back, or in vain     search_line                judge_residual
    R linearised       J and M are evaluated                 forget_jacobian            linearise_step
    R solves_had       all solves of the step               solve_once, approach_laws  is_spent
    R locates          zones never change in a step          engine.py, trial.py        find_violators
    R frozen           they do not in this one               solve_in_zones             find_violators, predict_fronts
    E zones_differ     zones may not be those of J and M     whoever switches zones     linearise_step
    E n_exchanged      machines whose rows were exchanged    linearise_step             learn_constants, rows_are_known
    E rows_alone       that is all that has changed          linearise_step             solve_once
    E unchecked        the residual was not looked at        linearise_step             the loop, where f is linear
    E any_captured     rows hold that did not before         find_holds, exchange_rows  find_residual_of_step
    E captured_by_row  a row of the cache began to hold      exchange_rows              approach_laws
    E assumed          what the step relies on of the cache  update_row, solve_exchanged  approach_laws, switch_zones
    S passes           switches of zones in this step        follow_guards              switch_zones
    S one_by_one       how few violators switch              follow_guards              solve_once, active_set.py
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import AFRESH, CAPPED, CYCLES, DIVERGES, DONE, INACCURATE, JUMPS, MIDDLE, ONCE_MORE
from fairlead.integrate.linear.systems import solve_motion
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.stepping.active_set import begin_set, find_violators, follow_guards
from fairlead.integrate.stepping.jump_at_end import all_continuous, find_jumping_law, find_means, place_jump
from fairlead.integrate.stepping.jump_inside import forget_jumps, put_jumps_right, remember_before_switch
from fairlead.integrate.stepping.linearise import linearise_step
from fairlead.integrate.stepping.residual import (
    GIVEN_UP,
    MOST_SEARCHED,
    SEARCHED,
    SOLVED,
    find_residual_of_step,
    find_theta_point,
    move_end,
    read_at_instant,
    read_on_chord,
    remember_move,
    scaled_residual,
    search_line,
)
from fairlead.integrate.stepping.row_cache import (
    forget_jacobian,
    invalidate_assumed,
    learn_constants,
    rows_are_known,
    solve_exchanged,
    watch_surfaces,
)
from fairlead.integrate.stepping.slip_fronts import learn_from_neighbours, predict_fronts
from fairlead.integrate.stepping.switch_inside import forget_switches, note_switches

SLOW = 0.01
"""A residual that shrinks by less than this in an iteration asks for a new Jacobian."""
MOST_SOLVES, MOST_LINEAR_SOLVES = 10, 3
"""Solves without a switch before the step counts as not converging; a linear one needs no more than a refinement."""


@compiled
def take_theta_step(m, h):
    """Compute `y_end` and the zones that go with it.

    Returns DONE, SINGULAR, INACCURATE, CYCLES, DIVERGES, JUMPS (a switch with a jump, at `t_cut`) or CAPPED.
    """
    problem, exchange, guards = m.problem, m.stepping.exchange, m.events.guards
    begin_step(m, h)
    solves, solved, size = 0, False, 1e300
    while True:
        verdict, size = solve_once(m, h, solves, solved, size)
        if verdict == AFRESH:
            solves = 0
            continue
        if verdict != ONCE_MORE:
            return verdict
        solved = True
        solves += 1
        exchange.any_captured = 0
        find_violators(m, h)
        if guards.n_fired > 0:
            solves = 0
            verdict = CAPPED if is_spent(m.stepping.rule) else switch_zones(m, h)
            if verdict != ONCE_MORE:
                return verdict
        elif problem.linear == 1 and exchange.unchecked == 0:
            add_quadratures(problem, m.point, m.stepping.rule, h)
            return DONE


@compiled
def begin_step(m, h):
    """Guess the end and the zones, and forget what was found in the step before.

    J too, where laws are not linear and the step ends at its switch: the end of order three is solved with the factors
    of the step (third_order.py), and by those of an earlier one it would be off by the change of J, to first order.
    """
    stepping, exchange = m.stepping, m.stepping.exchange
    predict(m.point, stepping.rule, h)
    forget_switches(stepping.contacts)
    forget_jumps(stepping.rule)
    begin_set(m.run, m.events.settling, stepping)
    predict_fronts(m, h)
    exchange.assumed, exchange.captured_by_row, stepping.rule.searched = 0, 0, 0
    stepping.rule.solves_had = 0
    if m.problem.linear == 0 and stepping.rule.locates == 1:
        forget_jacobian(stepping.rule)


@compiled
def solve_once(m, h, solves, solved, previous):
    """Move the end by one solve for the zones in force: ONCE_MORE, or what `approach_laws` says; the residual before.

    Where rows of the cache are all that has changed, the residual is known, and laws are not evaluated.
    """
    problem, point, linear, stepping = m.problem, m.point, m.linear, m.stepping
    exchange = stepping.exchange
    stepping.rule.midway = 1 if solved or problem.linear == 0 else 0
    if problem.linear == 0 and solves > 0:
        search_line(problem, point, linear, stepping, h, previous)
    status = linearise_step(problem, point, linear, stepping, h)
    if status != DONE:
        return status, previous
    alone = solved and exchange.rows_alone == 1 and m.events.settling.one_by_one == 0
    if alone and rows_are_known(problem, exchange):
        solve_exchanged(problem, point, linear, stepping, h)
        stepping.rule.solves_had += 1
        return ONCE_MORE, previous
    return approach_laws(problem, point, linear, stepping, h, solves, previous)


@compiled
def approach_laws(problem, point, linear, stepping, h, solves, previous):
    """Judge the residual after `solves` without a switch, solve for it: DONE, ONCE_MORE, AFRESH or why not; its size.

    Where f is not linear `search_line` has left the residual after a solve.
    """
    matrices, rule, exchange = linear.matrices, stepping.rule, stepping.exchange
    exchange.any_captured |= exchange.captured_by_row
    size = previous
    if problem.linear == 1:
        find_residual_of_step(problem, point, matrices, stepping, h, solves > 0)
    elif solves == 0:
        find_residual_of_step(problem, point, matrices, stepping, h, False)
        size = scaled_residual(point, linear, h)
    if solves > 0:
        verdict, size = judge_residual(problem, point, linear, stepping, h, solves, previous)
        if verdict == DONE:
            move_quadratures(point, h)
            if exchange.captured_by_row == 1:
                watch_surfaces(problem, point, matrices, exchange)
        elif exchange.assumed > 0:
            invalidate_assumed(stepping)
            return AFRESH, size
        if verdict == ONCE_MORE and is_spent(rule):
            verdict = CAPPED
        if verdict != ONCE_MORE:
            return verdict, size
    rule.solves_had += 1
    if exchange.n_exchanged > 0 and problem.linear == 1:
        learn_constants(point, matrices, stepping)
    solve_motion(linear, point.at_b)
    if problem.linear == 0:
        remember_move(point, rule)
    move_end(point, rule)
    return ONCE_MORE, size


@compiled
def is_spent(rule):
    """True if the step has had all the solves that it may have, which is bounded in a run in real time (frames.py)."""
    return rule.solves_had >= rule.most_solves > 0


@compiled
def switch_zones(m, h):
    """Switch the zones whose guards are violated: ONCE_MORE, CYCLES, or JUMPS where a law jumps."""
    run, point, guards, settling, rule = m.run, m.point, m.events.guards, m.events.settling, m.stepping.rule
    contacts = m.stepping.contacts
    note_switches(guards, m.stepping, h)
    if settling.passes > 0:
        learn_from_neighbours(run, guards, contacts)
    known = all_continuous(guards, contacts)
    if settling.passes == 0 and not known and rule.gap > 0.0 and find_jumping_law(m, h):
        find_means(m, h)
        place_jump(point, guards, contacts, rule, h)
        return JUMPS
    remember_before_switch(guards, contacts)
    if follow_guards(m, h, known):
        copy(indices(contacts.at_zones_probed, contacts.n_machines), indices(contacts.at_zones, contacts.n_machines))
        find_means(m, h)
        place_jump(point, guards, contacts, rule, h)
        return JUMPS
    if not known:
        put_jumps_right(m, h)
    if settling.passes <= run.max_passes:
        return ONCE_MORE
    if m.stepping.exchange.assumed > 0:
        invalidate_assumed(m.stepping)
    return CYCLES


@compiled
def judge_residual(problem, point, linear, stepping, h, solves, previous):
    """DONE, ONCE_MORE with another solve, or why not; and the size of the residual."""
    rule = stepping.rule
    size = scaled_residual(point, linear, h)
    if not isfinite(size):
        return DIVERGES, size
    if size <= SOLVED:
        stepping.exchange.unchecked = 0
        if solves > 2:
            forget_jacobian(rule)
        return DONE, size
    if problem.linear == 1 and solves >= MOST_LINEAR_SOLVES:
        forget_jacobian(rule)
        return INACCURATE, size
    if rule.searched == GIVEN_UP or solves >= (MOST_SEARCHED if rule.searched == SEARCHED else MOST_SOLVES):
        return DIVERGES, size
    if solves > 1 and size > SLOW * previous:
        forget_jacobian(rule)
    return ONCE_MORE, size


@compiled
def predict(point, rule, h):
    """First guess of the end: on along the last slope, forces as they were."""
    y, y_end, slope = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(rule.at_slope_before, point.n)
    differential = indices(point.at_differential, point.n)
    for k in range(point.n):
        y_end[k] = y[k] + h * slope[k] if differential[k] == 1 else y[k]


@compiled
def add_quadratures(problem, point, rule, h):
    """The rise of the quadratures over the step that was taken; the iteration leaves them out."""
    if problem.n_quadratures > 0 and rule.theta_now != MIDDLE:
        find_theta_point(point, rule)
        read_on_chord(problem, point, rule.theta_now, h)
        field_at(problem.call_rhs, (problem.context, point.t + rule.theta_now * h, point.at_u, point.at_f))
        read_at_instant(problem)
        problem.rhs += 1
        move_quadratures(point, h)


@compiled
def move_quadratures(point, h):
    """The quadratures at the end, from f at the theta point."""
    y, y_end, f = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_f, point.n)
    quadrature = indices(point.at_quadrature, point.n)
    for k in range(point.n):
        if quadrature[k] == 1:
            y_end[k] = y[k] + h * f[k]


@compiled
def give_back_zones(guards, stepping):
    """The zones of the start of the step; M and J are then not theirs."""
    exchange = stepping.exchange
    nz = exchange.n_machines
    copy(indices(stepping.contacts.at_zones_at_start, nz), indices(exchange.at_zones, nz))
    exchange.zones_differ = 1
    guards.n_fired = 0
