"""Impacts: the impulses that bring to rest what is to hold and slips, and who may pass them on.

    C (dV, P) = r        r = -slip on the rows that hold; C of the consistent point

dV is what the speeds change by, P the impulse in every row. A rigid row takes any impulse. Friction is limited by a
force, and an impulse is a force beyond all limits for no time. So the guards of what may hold are asked once more, with

    speed = v + dV        force = P / SHORT

A contact whose normal force is finite lets go. One whose normal force is an impulse itself holds while |P_t| <= mu P_n,
and slides with P_t = mu P_n beyond that, because C has the slopes of the law; it is caught if that would turn its slip
round. Losses that follow a load have the slopes that they have under the impulse, not those of no load. A stop that
would have to pull opens. One that touches at that instant, and that the speeds v + dV would close, closes: all impacts
of an instant are one problem, whichever stop was found first. Who changes changes C, so all is asked again until
nobody does. Then the speeds change by dV: momentum is conserved, and every row that holds is at rest.
What was let go slips, and is caught later as any contact is. Where stops rebound the speeds change by
(1 + e) dV, and those that part again open (rebound.py).

Contacts that close a circle share an impulse as they share a force, by one number a body (redundancy.py). Where
friction in a circle takes an impulse, its limit is mu P_n, and its guard compares shares of impulses with it. Where
none does, its limit is a force, of which shares of impulses say nothing: the guard sees the shares of forces. Circles
that have no body in common are judged apart.

A slip whose dV is below the error weights is no impact but rounding, and so is one that a contact says it may take
(`within`): `project` takes these away.

The loss of energy goes into the ledger, and by row into `lost`. With dV the change of speed,

    loss = dV M dV / 2 = -(change of kinetic energy) + (work of supports that move)

Source: the impulse problem of rigid bodies with set-valued laws, F. Pfeiffer, C. Glocker, Multibody Dynamics with
Unilateral Contacts, 1996, chapter 8.
"""

from __future__ import annotations

from math import inf

from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.least_index import keep_first
from fairlead.integrate.events.rebound import NO_REBOUND, REBOUND, RUBS, rebound
from fairlead.integrate.linear.systems import DONE, factorise_consistent, solve, solve_watched
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, jacobian_at, reals, slip_at
from fairlead.integrate.point.controller import weigh, weighted_norm

RELEASED, RUBBED = 6, 7
CONTRADICTS = 3
"""No impulse is that under which the laws have the slopes it follows from: as where no values are consistent."""
LIMITED, UNLIMITED = 1, 2
"""What a row that may hold takes: an impulse as small as rounding leaves it, or any."""
SHORT = 1e-12
"""Share of the span during which an impulse acts as a force: less than time can resolve in a run."""
ROUNDED = 1.0
"""Change of speed, in error weights, below which a slip is no impact."""
LEAST_IMPULSE = 1e-10
"""Share of the largest impulse below which one is rounding: that row keeps the force it has."""
SOLVES, SAME = 12, 1e-9
"""How often it is solved with the slopes under the load at most, and the change of impulses that ends it."""
LATER = 1e-6
"""Share of the span after which it is asked which stops come nearer: long enough to be more than rounding of places."""
LEAST_APPROACH = 1e-8
"""Share of the largest change of speed at which stops that touch must approach to take part: less is rounding."""


@compiled
def impact(m):
    """DONE when there is no impact, or it is over; RELEASED with the guards in `fired` of those who change first."""
    problem, point, matrices, guards = m.problem, m.point, m.linear.matrices, m.events.guards
    if problem.call_slip == 0 or problem.takes_impulses == 0 or not slip_to_stop(problem, point):
        return DONE
    status = solve_to_rounding(problem, point, m.linear)
    if status != DONE:
        return status
    weigh(point, point.at_y)
    if change_of_speed(problem, point) <= ROUNDED:
        return DONE
    status = solve_under_load(m)
    if status != DONE:
        return status
    change_zones_for(m)
    if guards.n_fired > 0:
        return RELEASED
    supports = any_support_moves(problem, point)
    back = NO_REBOUND if problem.rebounds == 0 else rebound(problem, point, matrices, least_impulse(problem, point))
    if back == RUBS:
        return RUBBED
    if back == REBOUND:
        throw_back(problem, m.run, point, guards)
    change_speeds(problem, point, matrices, back, supports)
    turn_round(problem, m.run, point, guards)
    return RELEASED if guards.n_fired > 0 else factors_at(problem, point, m.linear, point.at_y, point.at_ft)


@compiled
def turn_round(problem, run, point, guards):
    """Fire the guards of contacts that slide against the direction of their zones now, before a law is asked there.

    What friction is behind rest means nothing, and need not be finite: some laws are exponential in the speed. One that
    slides in name, as others hold its sides, is judged by what it shares of the impulses.
    """
    g, inertia = reals(guards.at_g_probe, guards.n_guards), reals(guards.at_guard_inertia, guards.n_guards)
    tolerance, fired = reals(guards.at_guard_tolerance, guards.n_guards), indices(guards.at_fired, guards.n_guards)
    copy(reals(point.at_y, problem.n), reals(point.at_y_probe, problem.n))
    load_forces(problem, run, point)
    evaluate_guards(problem, run, guards, point.t, point.at_y_probe, guards.at_g_probe)
    before = guards.n_fired
    for i in range(guards.n_guards):
        new = inertia[i] > 0.0 and g[i] > tolerance[i]
        for k in range(before):
            new = new and fired[k] != i
        if new:
            fired[guards.n_fired] = i
            guards.n_fired += 1


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
    takes, is_speed = indices(problem.at_takes_impulse, n), indices(problem.at_is_speed, n)
    status = solve_watched(linear, point.at_b)
    if status != DONE:
        return status
    for k in range(n):
        after[k] = y[k] + (b[k] if is_speed[k] == 1 else 0.0)
    field_at(problem.call_drift, (problem.context, point.t, point.at_y_probe, point.at_f))
    for k in range(n):
        if takes[k] < UNLIMITED and r[k] == 0.0:
            missed[k] = 0.0
    solve(linear, point.at_f)
    for k in range(n):
        b[k] += missed[k]
    return DONE


@compiled
def solve_under_load(m):
    """Solve again with the slopes that laws have under the impulse, until it is that under which they are taken.

    A loss that follows a load has a corner at no load, where it is rounded off: there it has no slope, and under an
    impulse that of one side. Sets u = dV as well.
    """
    problem, point, linear = m.problem, m.point, m.linear
    n = problem.n
    b, r, before = reals(point.at_b, n), reals(point.at_v, n), reals(point.at_x, n)
    settled = False
    for _ in range(SOLVES):
        load(m)
        status = factors_at(problem, point, linear, point.at_y_probe, point.at_x)
        if status != DONE:
            return status
        copy(b, before)
        copy(r, b)
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
    change_of_speed(problem, point)
    return DONE if settled else CONTRADICTS


@compiled
def factors_at(problem, point, linear, at_y, at_drift):
    """The slopes at y and the factors of C with them."""
    jacobian_at(problem.call_jacobian, (problem.context, point.t, at_y, linear.matrices.at_jacobian, at_drift))
    problem.jacobians += 1
    return factorise_consistent(linear)


@compiled
def takes_any(problem, k):
    """True if row k may take an impulse."""
    return indices(problem.at_takes_impulse, problem.n)[k] > 0


@compiled
def load(m):
    """Set `y_probe` to the point under the impulses in b, as forces that act for no time; speeds are those before."""
    n = m.problem.n
    y, loaded = reals(m.point.at_y, n), reals(m.point.at_y_probe, n)
    for k in range(n):
        loaded[k] = y[k]
    load_forces(m.problem, m.run, m.point)


@compiled
def load_forces(problem, run, point):
    """Put the impulses in b into `y_probe` as forces, and the shares of circles whose friction takes one."""
    n = problem.n
    b, loaded, differential = reals(point.at_b, n), reals(point.at_y_probe, n), indices(problem.at_differential, n)
    circle, of_circle = indices(problem.at_circle, n), reals(problem.at_least_share, n)
    force = least_impulse(problem, point)
    find_least_shares(problem, point, force)
    for k in range(n):
        least = force if takes_any(problem, k) else (of_circle[circle[k] - 1] if circle[k] > 0 else inf)
        if differential[k] == 0 and abs(b[k]) > least:
            loaded[k] = b[k] / (SHORT * (run.stop - run.start))


@compiled
def least_impulse(problem, point):
    """The impulse below which one is rounding."""
    b, takes, largest = reals(point.at_b, problem.n), indices(problem.at_takes_impulse, problem.n), 0.0
    for k in range(problem.n):
        if takes[k] > 0:
            largest = max(largest, abs(b[k]))
    return LEAST_IMPULSE * largest


@compiled
def find_least_shares(problem, point, least):
    """Set `least_share`: by circle, below what its shares are rounding; all are, where no friction takes an impulse.

    `least` is the impulse below which one is rounding.
    """
    n = problem.n
    b, circle, takes = reals(point.at_b, n), indices(problem.at_circle, n), indices(problem.at_takes_impulse, n)
    of_circle = reals(problem.at_least_share, n)
    for k in range(n):
        of_circle[k] = inf
    for k in range(n):
        if circle[k] > 0 and takes[k] == LIMITED and abs(b[k]) > least:
            of_circle[circle[k] - 1] = 0.0
    for k in range(n):
        if circle[k] > 0 and takes[k] == 0 and of_circle[circle[k] - 1] < inf:
            of_circle[circle[k] - 1] = max(of_circle[circle[k] - 1], LEAST_IMPULSE * abs(b[k]))


@compiled
def throw_back(problem, run, point, guards):
    """Set u = (1 + e) dV, and fill `fired` with the guards of the stops that part again."""
    n, ng = problem.n, problem.n_guards
    y, b, r, e = reals(point.at_y, n), reals(point.at_b, n), reals(point.at_v, n), reals(point.at_y_probe, n)
    dv, parting = reals(point.at_u, n), reals(point.at_x, n)
    takes, least = indices(problem.at_takes_impulse, n), least_impulse(problem, point)
    for k in range(n):
        dv[k] *= 1.0 + e[k]
        parting[k] = y[k] + dv[k]
        if takes[k] == UNLIMITED and r[k] != 0.0 and e[k] > 0.0 and abs(b[k]) > least:
            parting[k] = -b[k] / (SHORT * (run.stop - run.start))
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


@compiled
def change_of_speed(problem, point):
    """Set u = dV and tell its weighted norm; the ledger has its own account of an impact, and positions stand still."""
    b, u, is_speed = reals(point.at_b, problem.n), reals(point.at_u, problem.n), indices(problem.at_is_speed, problem.n)
    for k in range(problem.n):
        u[k] = b[k] if is_speed[k] == 1 else 0.0
    return weighted_norm(point, point.at_u)


@compiled
def change_zones_for(m):
    """Fill `fired` with the guards of contacts and stops that the impulse sends into another zone.

    All at once; once a pattern of zones has recurred in this settlement, the one of least index.
    """
    problem, run, point, guards, settling = m.problem, m.run, m.point, m.events.guards, m.events.settling
    n, ng = problem.n, problem.n_guards
    y, b, loaded = reals(point.at_y, n), reals(point.at_b, n), reals(point.at_y_probe, n)
    is_speed = indices(problem.at_is_speed, n)
    for k in range(n):
        loaded[k] = y[k] + (b[k] if is_speed[k] == 1 else 0.0)
    load_forces(problem, run, point)
    evaluate_guards(problem, run, guards, point.t, point.at_y, guards.at_g)
    evaluate_guards(problem, run, guards, point.t, point.at_y_probe, guards.at_g_probe)
    least = LEAST_APPROACH * move_on(m)
    g, under, tolerance = reals(guards.at_g, ng), reals(guards.at_g_probe, ng), reals(guards.at_guard_tolerance, ng)
    ahead = reals(settling.at_wrong, ng)
    may_hold, fired = indices(problem.at_may_hold, ng), indices(guards.at_fired, ng)
    guards.n_fired = 0
    for i in range(ng):
        changes = may_hold[i] > 0 and under[i] > tolerance[i] and under[i] != g[i]
        touches = may_hold[i] == UNLIMITED and abs(under[i]) <= tolerance[i]
        if changes or (touches and ahead[i] - under[i] > least):
            fired[guards.n_fired] = i
            guards.n_fired += 1
    if settling.stage > 0 and guards.n_fired > 1:
        keep_first(m.events)


@compiled
def move_on(m):
    """Guards a little later than at `y_probe`, into `wrong`; the largest way of what dV (in u) moves till then."""
    problem, run, point, matrices = m.problem, m.run, m.point, m.linear.matrices
    n = problem.n
    loaded, dv, moved, f = reals(point.at_y_probe, n), reals(point.at_u, n), reals(point.at_x, n), reals(point.at_f, n)
    differential, quadrature = indices(problem.at_differential, n), indices(problem.at_quadrature, n)
    values, rows = reals(matrices.at_mass, matrices.n_mass), indices(matrices.at_mass_rows, matrices.n_mass)
    columns = indices(matrices.at_mass_columns, matrices.n_mass)
    later, most = LATER * (run.stop - run.start), 0.0
    for k in range(n):
        moved[k] = loaded[k]
        most = max(most, abs(dv[k]))
    field_at(problem.call_rhs, (problem.context, point.t, point.at_x, point.at_f))
    for e in range(matrices.n_mass):
        k = rows[e]
        if k == columns[e] and differential[k] == 1 and quadrature[k] == 0 and dv[k] == 0.0 and values[e] != 0.0:
            moved[k] += later * f[k] / values[e]
    evaluate_guards(problem, run, m.events.guards, point.t + later, point.at_x, m.events.settling.at_wrong)
    return later * most


@compiled
def change_speeds(problem, point, matrices, back, supports):
    """Add the change in u to the speeds and book what is lost, and what supports that move have given."""
    n = problem.n
    y, b, r, e = reals(point.at_y, n), reals(point.at_b, n), reals(point.at_v, n), reals(point.at_y_probe, n)
    dv, lost = reals(point.at_u, n), reals(point.at_lost, n)
    for k in range(n if back == NO_REBOUND else 0):
        e[k] = 0.0
    gained, loss = energies(point, matrices)
    weight = 0.0
    for k in range(n):
        weight += abs(b[k] * r[k]) * (1.0 - e[k] ** 2)
    if not supports:
        loss = -gained
    for k in range(n):
        y[k] += dv[k]
        if weight > 0.0:
            lost[k] += loss * abs(b[k] * r[k]) * (1.0 - e[k] ** 2) / weight
    if problem.dissipated_at >= 0:
        y[problem.dissipated_at] += loss
        y[problem.supplied_at] += gained + loss


@compiled
def energies(point, matrices):
    """The change of kinetic energy that u makes, and what is lost: (1 - e^2) dV M dV / 2 with u = (1 + e) dV."""
    y, dv = reals(point.at_y, point.n), reals(point.at_u, point.n)
    differential = indices(point.at_differential, point.n)
    values, rows = reals(matrices.at_mass, matrices.n_mass), indices(matrices.at_mass_rows, matrices.n_mass)
    columns, e = indices(matrices.at_mass_columns, matrices.n_mass), reals(point.at_y_probe, point.n)
    gained = loss = 0.0
    for p in range(matrices.n_mass):
        i, j = rows[p], columns[p]
        if differential[i] == 1:
            loss += 0.5 * values[p] * dv[i] * dv[j] * (1.0 - e[i]) / (1.0 + e[i])
            gained += 0.5 * values[p] * (dv[i] * y[j] + y[i] * dv[j] + dv[i] * dv[j])
    return gained, loss


@compiled
def any_support_moves(problem, point):
    """True if a rigid row slips though all that the impulse moves is at rest: what it leans on moves."""
    n = problem.n
    y, dv, still = reals(point.at_y, n), reals(point.at_u, n), reals(point.at_y_probe, n)
    for k in range(n):
        still[k] = 0.0 if dv[k] != 0.0 else y[k]
    slip_at(problem.call_slip, (problem.context, point.t, point.at_y_probe, point.at_x))
    r, takes = reals(point.at_x, n), indices(problem.at_takes_impulse, n)
    moves = False
    for k in range(n):
        moves = moves or (takes[k] >= UNLIMITED and r[k] != 0.0)
    return moves
