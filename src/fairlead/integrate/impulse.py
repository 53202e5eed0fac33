"""Impacts: the impulses that bring to rest what is to hold and slips, and who may pass them on.

    C (dV, P) = r        r = -slip on the rows that hold; C of the consistent point

dV is what the speeds change by, P the impulse in every row. A rigid row takes any impulse. Friction is limited by a
force, and an impulse is a force beyond all limits for no time. So the guards of what may hold are asked once more, with

    speed = v + dV        force = P / SHORT

A contact whose normal force is finite lets go. One whose normal force is an impulse itself holds while |P_t| <= mu P_n,
and slides with P_t = mu P_n beyond that, because C has the slopes of the law; it is caught if that would turn its slip
round. A stop that would have to pull opens. One that touches at that instant, and that the speeds v + dV would close,
closes: all impacts of an instant are one problem, whichever stop was found first. Who changes changes C, so all is
asked again until nobody does. Then the speeds change by dV: momentum is conserved, and every row that holds is at rest.
What was let go slips, and is caught later as any contact is. Where stops rebound the speeds change by
(1 + e) dV, and those that part again open (rebound.py).

A slip whose dV is below the error weights is no impact but rounding, and so is one that a contact says it may take
(`within`): `project` takes these away.

The loss of energy goes into the ledger, and by row into `lost`. With dV the change of speed,

    loss = dV M dV / 2 = -(change of kinetic energy) + (work of supports that move)

Source: the impulse problem of rigid bodies with set-valued laws, F. Pfeiffer, C. Glocker, Multibody Dynamics with
Unilateral Contacts, 1996, chapter 8.
"""

from __future__ import annotations

from fairlead.integrate.controller import weigh, weighted_norm
from fairlead.integrate.foreign import compiled, copy, field_at, indices, reals, slip_at
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.least_index import keep_first
from fairlead.integrate.linear import DONE, solve_watched
from fairlead.integrate.rebound import NO_REBOUND, REBOUND, RUBS, rebound

RELEASED, RUBBED = 6, 7
LIMITED, UNLIMITED = 1, 2
"""What a row that may hold takes: an impulse as small as rounding leaves it, or any."""
SHORT = 1e-12
"""Share of the span during which an impulse acts as a force: less than time can resolve in a run."""
ROUNDED = 1.0
"""Change of speed, in error weights, below which a slip is no impact."""
LEAST_IMPULSE = 1e-10
"""Share of the largest impulse below which one is rounding: that row keeps the force it has."""
LATER = 1e-6
"""Share of the span after which it is asked which stops come nearer: long enough to be more than rounding of places."""
LEAST_APPROACH = 1e-8
"""Share of the largest change of speed at which stops that touch must approach to take part: less is rounding."""


@compiled
def impact(m):
    """DONE when there is no impact, or it is over; RELEASED with the guards in `fired` of those who change first."""
    if m.call_slip == 0 or m.takes_impulses == 0 or not slip_to_stop(m):
        return DONE
    status = solve_watched(m, m.at_b)
    if status != DONE:
        return status
    weigh(m, m.at_y)
    if change_of_speed(m) <= ROUNDED:
        return DONE
    change_zones_for(m)
    if m.n_fired > 0:
        return RELEASED
    supports = any_support_moves(m)
    back = NO_REBOUND if m.rebounds == 0 else rebound(m, least_impulse(m))
    if back == RUBS:
        return RUBBED
    if back == REBOUND:
        throw_back(m)
    change_speeds(m, back, supports)
    return RELEASED if m.n_fired > 0 else DONE


@compiled
def least_impulse(m):
    """The impulse below which one is rounding."""
    b, takes, largest = reals(m.at_b, m.n), indices(m.at_takes_impulse, m.n), 0.0
    for k in range(m.n):
        if takes[k] > 0:
            largest = max(largest, abs(b[k]))
    return LEAST_IMPULSE * largest


@compiled
def throw_back(m):
    """Set u = (1 + e) dV, and fill `fired` with the guards of the stops that part again."""
    n, ng = m.n, m.n_guards
    y, b, r, e = reals(m.at_y, n), reals(m.at_b, n), reals(m.at_v, n), reals(m.at_y_probe, n)
    dv, parting = reals(m.at_u, n), reals(m.at_x, n)
    takes, least = indices(m.at_takes_impulse, n), least_impulse(m)
    for k in range(n):
        dv[k] *= 1.0 + e[k]
        parting[k] = y[k] + dv[k]
        if takes[k] == UNLIMITED and r[k] != 0.0 and e[k] > 0.0 and abs(b[k]) > least:
            parting[k] = -b[k] / (SHORT * (m.stop - m.start))
    evaluate_guards(m, m.t, m.at_x, m.at_g)
    under, g, tolerance = reals(m.at_g_probe, ng), reals(m.at_g, ng), reals(m.at_guard_tolerance, ng)
    may_hold, fired = indices(m.at_may_hold, ng), indices(m.at_fired, ng)
    for i in range(ng):
        if may_hold[i] == UNLIMITED and g[i] > tolerance[i] >= under[i]:
            fired[m.n_fired] = i
            m.n_fired += 1


@compiled
def slip_to_stop(m):
    """Set b = r, with nothing for what a contact takes without an impulse; False if no rigid row slips."""
    n = m.n
    r, little, takes = reals(m.at_b, n), reals(m.at_x, n), indices(m.at_takes_impulse, n)
    slip_at(m.call_slip, (m.context, m.t, m.at_y, m.at_x))
    slips = False
    for k in range(n):
        slips = slips or (takes[k] >= UNLIMITED and little[k] != 0.0)
    if not slips:
        return False
    field_at(m.call_drift, (m.context, m.t, m.at_y, m.at_b))
    for k in range(n):
        if takes[k] == LIMITED and little[k] != 0.0:
            r[k] = 0.0
    copy(r, reals(m.at_v, n))
    return True


@compiled
def change_of_speed(m):
    """Set u = dV and tell its weighted norm; the ledger has its own account of an impact, and positions stand still."""
    b, u, is_speed = reals(m.at_b, m.n), reals(m.at_u, m.n), indices(m.at_is_speed, m.n)
    for k in range(m.n):
        u[k] = b[k] if is_speed[k] == 1 else 0.0
    return weighted_norm(m, m.at_u)


@compiled
def change_zones_for(m):
    """Fill `fired` with the guards of contacts and stops that the impulse sends into another zone.

    All at once; once a pattern of zones has recurred in this settlement, the one of least index.
    """
    n, ng = m.n, m.n_guards
    y, b, loaded = reals(m.at_y, n), reals(m.at_b, n), reals(m.at_y_probe, n)
    takes, differential = indices(m.at_takes_impulse, n), indices(m.at_differential, n)
    least_taken = least_impulse(m)
    for k in range(n):
        loaded[k] = y[k]
        if differential[k] == 1:
            loaded[k] += b[k]
        elif takes[k] > 0 and abs(b[k]) > least_taken:
            loaded[k] = b[k] / (SHORT * (m.stop - m.start))
    evaluate_guards(m, m.t, m.at_y, m.at_g)
    evaluate_guards(m, m.t, m.at_y_probe, m.at_g_probe)
    least = LEAST_APPROACH * move_on(m)
    g, under, tolerance = reals(m.at_g, ng), reals(m.at_g_probe, ng), reals(m.at_guard_tolerance, ng)
    ahead = reals(m.at_wrong, ng)
    may_hold, fired = indices(m.at_may_hold, ng), indices(m.at_fired, ng)
    m.n_fired = 0
    for i in range(ng):
        changes = may_hold[i] > 0 and under[i] > tolerance[i] and under[i] != g[i]
        touches = may_hold[i] == UNLIMITED and abs(under[i]) <= tolerance[i]
        if changes or (touches and ahead[i] - under[i] > least):
            fired[m.n_fired] = i
            m.n_fired += 1
    if m.stage > 0 and m.n_fired > 1:
        keep_first(m)


@compiled
def move_on(m):
    """Guards a little later than at `y_probe`, into `wrong`; the largest way of what dV (in u) moves till then."""
    n = m.n
    loaded, dv, moved, f = reals(m.at_y_probe, n), reals(m.at_u, n), reals(m.at_x, n), reals(m.at_f, n)
    differential, quadrature = indices(m.at_differential, n), indices(m.at_quadrature, n)
    values, rows = reals(m.at_mass, m.n_mass), indices(m.at_mass_rows, m.n_mass)
    columns = indices(m.at_mass_columns, m.n_mass)
    later, most = LATER * (m.stop - m.start), 0.0
    for k in range(n):
        moved[k] = loaded[k]
        most = max(most, abs(dv[k]))
    field_at(m.call_rhs, (m.context, m.t, m.at_x, m.at_f))
    for e in range(m.n_mass):
        k = rows[e]
        if k == columns[e] and differential[k] == 1 and quadrature[k] == 0 and dv[k] == 0.0 and values[e] != 0.0:
            moved[k] += later * f[k] / values[e]
    evaluate_guards(m, m.t + later, m.at_x, m.at_wrong)
    return later * most


@compiled
def change_speeds(m, back, supports):
    """Add the change in u to the speeds and book what is lost, and what supports that move have given."""
    n = m.n
    y, b, r, e = reals(m.at_y, n), reals(m.at_b, n), reals(m.at_v, n), reals(m.at_y_probe, n)
    dv, lost = reals(m.at_u, n), reals(m.at_lost, n)
    for k in range(n if back == NO_REBOUND else 0):
        e[k] = 0.0
    gained, loss = energies(m)
    weight = 0.0
    for k in range(n):
        weight += abs(b[k] * r[k]) * (1.0 - e[k] ** 2)
    if not supports:
        loss = -gained
    for k in range(n):
        y[k] += dv[k]
        if weight > 0.0:
            lost[k] += loss * abs(b[k] * r[k]) * (1.0 - e[k] ** 2) / weight
    if m.dissipated_at >= 0:
        y[m.dissipated_at] += loss
        y[m.supplied_at] += gained + loss


@compiled
def energies(m):
    """The change of kinetic energy that u makes, and what is lost: (1 - e^2) dV M dV / 2 with u = (1 + e) dV."""
    y, dv, differential = reals(m.at_y, m.n), reals(m.at_u, m.n), indices(m.at_differential, m.n)
    values, rows = reals(m.at_mass, m.n_mass), indices(m.at_mass_rows, m.n_mass)
    columns, e = indices(m.at_mass_columns, m.n_mass), reals(m.at_y_probe, m.n)
    gained = loss = 0.0
    for p in range(m.n_mass):
        i, j = rows[p], columns[p]
        if differential[i] == 1:
            loss += 0.5 * values[p] * dv[i] * dv[j] * (1.0 - e[i]) / (1.0 + e[i])
            gained += 0.5 * values[p] * (dv[i] * y[j] + y[i] * dv[j] + dv[i] * dv[j])
    return gained, loss


@compiled
def any_support_moves(m):
    """True if a rigid row slips though all that the impulse moves is at rest: what it leans on moves."""
    n = m.n
    y, dv, still = reals(m.at_y, n), reals(m.at_u, n), reals(m.at_y_probe, n)
    for k in range(n):
        still[k] = 0.0 if dv[k] != 0.0 else y[k]
    slip_at(m.call_slip, (m.context, m.t, m.at_y_probe, m.at_x))
    r, takes = reals(m.at_x, n), indices(m.at_takes_impulse, n)
    moves = False
    for k in range(n):
        moves = moves or (takes[k] >= UNLIMITED and r[k] != 0.0)
    return moves
