"""Impacts: the impulses that bring to rest what is to hold and slips, and who may pass them on.

    C (dV, P) = r        r = -slip on the rows that hold; C of the consistent point

dV is what the speeds change by, P the impulse in every row. A rigid row takes any impulse. Friction is limited by a
force, and an impulse is a force beyond all limits for no time. So the guards of what may hold are asked once more, with

    speed = v + dV        force = P in almost no time (impulse_load.py)

A contact whose normal force is finite lets go. One whose normal force is an impulse itself holds while |P_t| <= mu P_n,
and slides with P_t = mu P_n beyond that, because C has the slopes of the law; it is caught if that would turn its slip
round. Losses that follow a load have the slopes that they have under the impulse, not those of no load; where they
follow the speed too, the impulse is taken in parts (`follow_slopes`). A stop that would have to pull opens. One that
touches at that instant, and that the speeds v + dV would close, closes: all impacts of an instant are one problem,
whichever stop was found first. Who changes changes C, so all is asked again until nobody does. Then the speeds change
by dV: momentum is conserved, and every row that holds is at rest. What was let go slips, and is caught later as any
contact is. Where stops rebound the speeds change by (1 + e) dV, and those that part again open (rebound.py).

Contacts that close a circle share an impulse as they share a force, by one number a body (redundancy.py). Where
friction in a circle takes an impulse, its limit is mu P_n, and its guard compares shares of impulses with it. Where
none does, its limit is a force, of which shares of impulses say nothing: the guard sees the shares of forces. Circles
that have no body in common are judged apart.

Where rigid rows of a circle slip after that, what they hold a body to is given and differs (given_apart.py): who would
have to pull opens, though no speed changes, or else who is left behind; if nobody can, the run ends.

A slip whose dV is below the error weights is no impact but rounding, and so is one that a contact says it may take
(`within`): `project` takes these away.

The loss of energy goes into the ledger, and by row into `lost`. With dV the change of speed,

    loss = dV M dV / 2 = -(change of kinetic energy) + (work of supports that move)

Source: the impulse problem of rigid bodies with set-valued laws, F. Pfeiffer, C. Glocker, Multibody Dynamics with
Unilateral Contacts, 1996, chapter 8.
"""

from __future__ import annotations

from math import isfinite, sqrt

from fairlead.integrate.codes import APART, DONE, NOT_CONSISTENT, RELEASED, RUBBED
from fairlead.integrate.events.given_apart import LEAST_APART, leave_behind, slip_of_given
from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.impulse_changes import (
    any_support_moves,
    change_speeds,
    find_change_of_speed,
    integrate_impulses,
)
from fairlead.integrate.events.impulse_load import (
    LIMITED,
    SHORT,
    UNLIMITED,
    find_own_time,
    least_impulse,
    load,
    takes_any,
)
from fairlead.integrate.events.impulse_zones import change_zones_for, turn_round
from fairlead.integrate.events.rebound import NO_REBOUND, REBOUND, RUBS, find_rebound, note_joined
from fairlead.integrate.linear.systems import factorise_consistent, solve, solve_checked
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, jacobian_at, reals, slip_at
from fairlead.integrate.point.controller import weigh

NO_IMPACT = 1.0
"""Change of speed, in error weights, below which a slip is no impact."""
SOLVES, SAME = 12, 1e-9
"""How often it is solved with the slopes under the load at most, and the change of impulses that ends it."""
BENDS, MOST_PARTS = 1e-7, 1000
"""Share of the largest impulse by which impulses differ with the slopes halfway, that makes friction depend on speed
here; also the error left by the parts in which these are followed, of which there are that many at most."""


@compiled
def resolve_impact(m):
    """DONE when there is no impact, or it is over; RELEASED with the guards in `fired` of those who change first."""
    problem, point, matrices, guards = m.problem, m.point, m.linear.matrices, m.events.guards
    if problem.call_slip == 0 or problem.takes_impulses == 0 or not slip_to_stop(problem, point):
        return DONE
    status = solve_to_rounding(problem, point, m.linear)
    if status != DONE:
        return status
    weigh(point, point.at_y)
    moved = find_change_of_speed(problem, point)
    contradicted = problem.rigid_circles == 1 and stays_apart(problem, point, m.linear)
    if moved <= NO_IMPACT and not contradicted:
        return DONE
    find_own_time(problem, m.run, point, m.events.settling)
    status = solve_under_load(problem, point, m.linear, m.events.settling)
    parts = count_parts(problem, point, m.linear, m.events.settling) if status == DONE else 0
    if parts > 0:
        status = follow_slopes(problem, point, m.linear, m.events.settling, parts)
    if status != DONE:
        return status
    change_zones_for(m)
    if guards.n_fired > 0:
        return RELEASED
    if contradicted and stays_apart(problem, point, m.linear):
        if leave_behind(m):
            return RELEASED
        stays_apart(problem, point, m.linear)  # once more, for the row in `worst`
        return APART
    supports = any_support_moves(problem, point)
    back = NO_REBOUND
    if problem.rebounds != 0:
        back = find_rebound(problem, point, matrices, least_impulse(problem, point))
    if back == RUBS:
        return RUBBED
    if back == REBOUND:
        note_joined(problem, point, matrices, least_impulse(problem, point))
        throw_back(m)
    change_speeds(problem, point, matrices, back, supports)
    if problem.n_integrals > 0:
        integrate_impulses(problem, point, matrices, m.events.settling)
    turn_round(m)
    return RELEASED if guards.n_fired > 0 else factorise_at(problem, point, m.linear, point.at_y, point.at_ft)


@compiled
def stays_apart(problem, point, linear):
    """True if rigid rows of a circle still slip after the change of speed in u."""
    y, dv, after = reals(point.at_y, point.n), reals(point.at_u, point.n), reals(point.at_y_probe, point.n)
    for k in range(point.n):
        after[k] = y[k] + dv[k]
    return slip_of_given(problem, point, linear.matrices, point.t, point.at_y_probe) > LEAST_APART


@compiled
def solve_to_rounding(problem, point, linear):
    """Solve C b = r for the r in b, which is in v too, and once more for the slip that the new speeds still have.

    Which way a contact is pressed on, and whether it slips at all then, is asked of speeds that the impulse takes away.
    Numbers by which bodies in circles share it are large beside it, over gears: of 20 rad/s a millionth was left, one
    way or the other. The second solution is as small as what the first one missed, and those numbers with it.
    """
    n = problem.n
    y, b, r = reals(point.at_y, n), reals(point.at_b, n), reals(point.at_v, n)
    after, missed = reals(point.at_y_probe, n), reals(point.at_f, n)
    takes, struck = indices(problem.at_takes_impulse, n), indices(problem.at_struck, n)
    status = solve_checked(linear, point.at_b)
    if status != DONE:
        return status
    for k in range(n):
        after[k] = y[k] + (b[k] if struck[k] == 1 else 0.0)
    field_at(problem.call_drift, (problem.context, point.t, point.at_y_probe, point.at_f))
    for k in range(n):
        if takes[k] < UNLIMITED and r[k] == 0.0:
            missed[k] = 0.0
    solve(linear, point.at_f)
    for k in range(n):
        b[k] += missed[k]
    return DONE


@compiled
def solve_under_load(problem, point, linear, settling):
    """Solve again with the slopes that laws have under the impulse, until it is that under which they are taken.

    A loss that follows a load has a corner at no load, where it is rounded off: there it has no slope, and under an
    impulse that of one side. Sets u = dV as well.
    """
    n = problem.n
    b, taken, before = reals(point.at_b, n), reals(point.at_v, n), reals(point.at_x, n)
    settled = False
    for _ in range(SOLVES):
        load(problem, settling, point)
        status = factorise_at(problem, point, linear, point.at_y_probe, point.at_x)
        if status != DONE:
            return status
        copy(b, before)
        copy(taken, b)
        status = solve_to_rounding(problem, point, linear)
        if status != DONE:
            return status
        most = change = 0.0
        for k in range(n):
            if takes_any(problem, k):
                most, change = max(most, abs(b[k])), max(change, abs(b[k] - before[k]))
        if change <= SAME * most:
            settled = True
            break
    find_change_of_speed(problem, point)
    return DONE if settled else NOT_CONSISTENT


@compiled
def count_parts(problem, point, linear, settling):
    """In how many parts the impulse in b is to be taken; 0 if no law depends on the speeds that it changes.

    One implicit midpoint step whose slopes change by the share d has the error d^2/12, r of them d^2/(12 r^2). b and
    u stay as they are.
    """
    n = problem.n
    b, whole = reals(point.at_b, n), reals(problem.at_impulse, n)
    copy(b, whole)
    most = change = 0.0
    if not factorise_halfway(problem, point, linear, settling, 0.5):
        change = 0.0
    elif slip_to_stop(problem, point) and solve_to_rounding(problem, point, linear) == DONE:
        for k in range(n):
            if takes_any(problem, k):
                most, change = max(most, abs(b[k])), max(change, abs(b[k] - whole[k]))
    found = isfinite(change) and change > BENDS * most
    parts = min(MOST_PARTS, int(change / most / sqrt(12.0 * BENDS)) + 1) if found else 0
    slip_to_stop(problem, point)
    copy(whole, b)
    find_change_of_speed(problem, point)
    return parts


@compiled
def factorise_halfway(problem, point, linear, settling, share):
    """Factorise C under the impulses in b and with that share of their change of speed; False where it is singular."""
    n = problem.n
    b, loaded, struck = reals(point.at_b, n), reals(point.at_y_probe, n), indices(problem.at_struck, n)
    load(problem, settling, point)
    for k in range(problem.n):
        if struck[k] == 1:
            loaded[k] += share * b[k]
    return factorise_at(problem, point, linear, point.at_y_probe, point.at_x) == DONE


@compiled
def follow_slopes(problem, point, linear, settling, parts):
    """Take the impulse in parts, each with the slopes halfway through its change of speed; b and u are the sums.

    Of r parts that are left, one takes 1/r of what would end the slip. The speeds of the point are those of before.
    """
    n = problem.n
    y, b = reals(point.at_y, n), reals(point.at_b, n)
    whole, before, struck = reals(problem.at_impulse, n), reals(problem.at_before, n), indices(problem.at_struck, n)
    copy(y, before)
    whole[:] = 0.0
    status = DONE
    for left in range(parts, 0, -1):
        for share in (0.0, 0.5 / left):
            if status == DONE and factorise_halfway(problem, point, linear, settling, share):
                slip_to_stop(problem, point)
                status = solve_to_rounding(problem, point, linear)
            else:
                status = NOT_CONSISTENT
        for k in range(n):
            whole[k] += b[k] / left
            if struck[k] == 1:
                y[k] += b[k] / left
    copy(before, y)
    slip_to_stop(problem, point)
    for k in range(n):
        b[k] = whole[k]
    find_change_of_speed(problem, point)
    return status


@compiled
def factorise_at(problem, point, linear, at_y, at_drift):
    """The slopes at y and the factors of C with them."""
    jacobian_at(problem.call_jacobian, (problem.context, point.t, at_y, linear.matrices.at_jacobian, at_drift))
    problem.jacobians += 1
    return factorise_consistent(linear)


@compiled
def throw_back(m):
    """Set u = (1 + e) dV, and fill `fired` with the guards of the stops that part again."""
    problem, run, point, guards = m.problem, m.run, m.point, m.events.guards
    brief = SHORT * m.events.settling.own_time
    n, ng = problem.n, problem.n_guards
    y, b, r, e = reals(point.at_y, n), reals(point.at_b, n), reals(point.at_v, n), reals(point.at_y_probe, n)
    dv, parting = reals(point.at_u, n), reals(point.at_x, n)
    takes, least = indices(problem.at_takes_impulse, n), least_impulse(problem, point)
    for k in range(n):
        dv[k] *= 1.0 + e[k]
        parting[k] = y[k] + dv[k]
        if takes[k] == UNLIMITED and r[k] != 0.0 and e[k] > 0.0 and abs(b[k]) > least:
            parting[k] = -b[k] / brief
    evaluate_guards(problem, run, guards, point.t, point.at_x, guards.at_g)
    under, g, tolerance = reals(guards.at_g_probe, ng), reals(guards.at_g, ng), reals(guards.at_guard_tolerance, ng)
    may_hold, fired = indices(problem.at_may_hold, ng), indices(guards.at_fired, ng)
    for i in range(ng):
        if may_hold[i] == UNLIMITED and g[i] > tolerance[i] >= under[i]:
            fired[guards.n_fired] = i
            guards.n_fired += 1


@compiled
def slip_to_stop(problem, point):
    """Set b = r, with nothing for what a contact takes without an impulse; False if no rigid row slips."""
    n = problem.n
    r, little, takes = reals(point.at_b, n), reals(point.at_x, n), indices(problem.at_takes_impulse, n)
    slip_at(problem.call_slip, (problem.context, point.t, point.at_y, point.at_x))
    slips = False
    for k in range(n):
        slips = slips or (takes[k] >= UNLIMITED and little[k] != 0.0)
    if not slips:
        return False
    field_at(problem.call_drift, (problem.context, point.t, point.at_y, point.at_b))
    for k in range(n):
        if takes[k] == LIMITED and little[k] != 0.0:
            r[k] = 0.0
    copy(r, reals(point.at_v, n))
    return True
