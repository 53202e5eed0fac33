"""Arriving at a point: settle there if guards fired or a time event changed something; the step after."""

from __future__ import annotations

from fairlead.integrate.codes import (
    AFTER,
    BEFORE,
    BUFFER_FULL,
    CHATTER,
    GO_ON,
    INCONSISTENT,
    ORDINARY,
    PASSED,
    REBOUND_RUBS,
    REPLAN,
    SETTLE,
    SINGULAR_MATRIX,
    TRY,
    UNSETTLED,
)
from fairlead.integrate.controller import restart, weigh, weighted_norm
from fairlead.integrate.curvature import bend_beyond_rounding
from fairlead.integrate.foreign import at_time_at, compiled, copy, indices, next_time_at, reals
from fairlead.integrate.growth import watch_growth
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.impulse import RUBBED
from fairlead.integrate.limits import ROUNDING
from fairlead.integrate.linear import INACCURATE, SINGULAR
from fairlead.integrate.pace import DOUBT, not_finite_here, smallest_step
from fairlead.integrate.record import shown_end, write_row
from fairlead.integrate.release import remember
from fairlead.integrate.settling import NO_ROOM, NOT_SETTLED, begin_settling, distance_to_look, move_ahead, settle
from fairlead.integrate.start import NOT_CONSISTENT, correct_forces, keep_positions

START_ITERATIONS, SETTLE_ITERATIONS = 40, 12
"""Newton iterations allowed from the guess of a user, and from a point consistent before a switch."""


MOST_DROPPED = 4
"""Crossings in a row that a better point may undo: steps between them become short at once."""

EARLY = 4.0
"""The look ahead, in the time by which a crossing is early: after twice that time the mean load is at its limit."""
FARTHER = 100.0
"""How much farther than else that may be: a tenth of an error weight, with the bend of the motion taken along."""


@compiled
def start(m):
    """Sample inputs at the start, then settle there."""
    if m.call_at_time != 0:
        at_time_at(m.call_at_time, (m.context, m.t, m.at_y))
    find_next_time(m)
    m.n_fired = 0
    begin_settling(m)
    m.nothing_before = 1
    m.phase = SETTLE
    return GO_ON


@compiled
def arrive(m, located):
    """Move to the end of the piece; settle there if guards fired or a time event changed anything.

    `located`: crossings are places on the interpolant of the step.
    """
    if m.rows + 4 > m.row_capacity:
        return BUFFER_FULL
    recorded = m.on_grid == 0 or (m.between == 1 and (m.inside > 0 or m.t_piece - m.t_row >= m.least_gap))
    entered_again = m.t == m.t_piece  # for other pivots; the start of the step is gone
    at_shown = shown_end(m) if (recorded or m.crossed == 1) and not entered_again else m.at_y_piece
    if m.crossed == 1 and not entered_again:
        remember_shown(m, at_shown)
    m.t = m.t_piece
    m.judged = 0
    copy(reals(m.at_y_piece, m.n), reals(m.at_y, m.n))
    m.jacobian_fresh = 0
    kept = m.n_moves > 0 or (m.n_balanced > 0 and m.crossed == 1)
    better = kept or (located and m.crossed == 1 and asks_for_forces(m))
    if better:
        if (keep_positions(m) if kept else correct_forces(m)) == INACCURATE:
            return REPLAN
        judge_again(m)
        at_shown = as_shown(m, m.at_y)
    m.phase = TRY
    event_due = m.landing == 1 and (m.t < m.stop and m.t >= min(m.t_next, m.t_release))
    if m.crossed == 1:
        m.located += 1
        # On the interpolant a force is at its limit; the equations have it beyond by the error of the instant.
        write_row(m, m.t, as_shown(m, m.at_y if m.n_moves > 0 else m.at_y_piece), BEFORE)
        remember(m)
        begin_settling(m)
        m.phase = SETTLE
    elif event_due:
        write_row(m, m.t, m.at_y, BEFORE)
        if time_event(m):
            m.n_fired = 0
            begin_settling(m)
            m.phase = SETTLE
        else:
            m.rows -= 1
    if m.phase == TRY:
        if not better:
            copy(reals(m.at_g_end, m.n_guards), reals(m.at_g, m.n_guards))
        # The stop is recorded even when it is no point of the grid.
        off_grid = m.t >= m.stop and m.start + (m.grid_next - 1) * m.every < m.stop - 1e-9 * m.every
        if m.on_grid == 0 or off_grid:
            write_row(m, m.t, at_shown, ORDINARY)
        elif recorded:
            write_row(m, m.t, at_shown, PASSED)
        m.shown_apart = 0
    return GO_ON


@compiled
def remember_shown(m, at_shown):
    """Keep how far speeds that follow a stiff law are shown from where the interpolant has them: see balance_stiff.

    Both rows of an event are moved by it, not the motion: a speed that balances to rounding has a y'' of rounding.
    """
    m.shown_apart = m.any_stiff
    if m.any_stiff == 0:
        return
    shown, piece, apart = reals(at_shown, m.n), reals(m.at_y_piece, m.n), reals(m.at_apart, m.n)
    for k in range(m.n):
        apart[k] = shown[k] - piece[k]


@compiled
def as_shown(m, at_y):
    """Address of y as it is recorded at an event: never so that a guard rises by it, nor off the one that fired."""
    if m.shown_apart == 0:
        return at_y
    y, shown, apart = reals(at_y, m.n), reals(m.at_y_probe, m.n), reals(m.at_apart, m.n)
    for k in range(m.n):
        shown[k] = y[k] + apart[k]
    evaluate_guards(m, m.t, m.at_y_probe, m.at_g_probe)
    g, tolerance, rises = reals(m.at_g_probe, m.n_guards), reals(m.at_guard_tolerance, m.n_guards), False
    for i in range(m.n_guards):
        rises = rises or g[i] > tolerance[i]
    fired = indices(m.at_fired, m.n_guards)
    for k in range(m.n_fired):
        rises = rises or abs(g[fired[k]]) > tolerance[fired[k]]
    return at_y if rises else m.at_y_probe


@compiled
def asks_for_forces(m):
    """True if a guard that fired may follow what the equations give at an instant, as the force of a held contact.

    Not the slip of a contact, nor the place in a table: those are unknowns with a past.
    """
    if m.n_algebraic == 0:
        return False
    fired, kink = indices(m.at_fired, m.n_guards), indices(m.at_kink_guard, m.n_guards)
    inertia = reals(m.at_guard_inertia, m.n_guards)
    asks = False
    for k in range(m.n_fired):
        asks = asks or (inertia[fired[k]] == 0.0 and kink[fired[k]] == 0)
    return asks


@compiled
def judge_again(m):
    """Guards at the point as the equations have it, into `g`; drop the fired that are below.

    The interpolant is off what is kept, and off the forces of what holds, by the error of a step, more than a guard is
    known to. A contact that lets go by that too early, by a time tau, would be caught at once: its load is below its
    limit until then. So the settlement looks ahead by `EARLY` times tau, as far as it goes, and what is farther off is
    dropped: it fires in the next step, which begins at the better point and is as short as its guard is near.
    """
    m.least_look = 0.0
    evaluate_guards(m, m.t, m.at_y, m.at_g)
    if m.crossed == 0 or m.dropped >= MOST_DROPPED:
        m.dropped = 0
        return
    g, tolerance = reals(m.at_g, m.n_guards), reals(m.at_guard_tolerance, m.n_guards)
    fired, kept, ahead = indices(m.at_fired, m.n_guards), 0, reals(m.at_g_probe, m.n_guards)
    d = 0.0
    if m.n_moves == 0:
        d = distance_to_look(m)
        move_ahead(m, d, d)
    evaluate_guards(m, m.t + d, m.at_y_probe if d > 0.0 else m.at_y, m.at_g_probe)
    for k in range(m.n_fired):
        i = fired[k]
        near = g[i] >= -ROUNDING * tolerance[i]
        if not near and FARTHER * (ahead[i] - g[i]) >= EARLY * -g[i]:
            near = True
            m.least_look = max(m.least_look, d * EARLY * -g[i] / (ahead[i] - g[i]))
        if near:
            fired[kept] = i
            kept += 1
    if kept > 0:
        m.n_fired, m.dropped = kept, 0
    else:
        m.n_fired, m.crossed, m.dropped = 0, 0, m.dropped + 1
        m.last_error = 0.0  # the point has moved: nothing is known of the step before
        if m.n_balanced > 0 and m.adaptive == 1:
            m.h_next = min(m.h_next, DOUBT * m.h)  # a load that turns at its limit leaves it with no slope


@compiled
def time_event(m):
    """Tell the problem of its time event, release machines whose dwell is over; True if that matters."""
    changed = False
    remember(m)
    if m.t >= m.t_next:
        m.time_events += 1
        changed = at_time_at(m.call_at_time, (m.context, m.t, m.at_y)) != 0
        find_next_time(m)
    if m.t >= m.t_release:
        changed = True
        blocked = reals(m.at_blocked_until, m.n_zones)
        m.t_release = 1e308
        for z in range(m.n_zones):
            if blocked[z] > m.t:
                m.t_release = min(m.t_release, blocked[z])
    return changed


@compiled
def find_next_time(m):
    """When the problem wants to be told next."""
    m.t_next = 1e308
    if m.call_next_time != 0:
        m.t_next = next_time_at(m.call_next_time, (m.context, m.t))


@compiled
def settle_here(m):
    """Settle at the point; then any time event of this instant; then the step to begin with."""
    starting = m.steps == 0 and m.companion == 0 and m.crossed == 0
    status = settle(m, START_ITERATIONS if starting else SETTLE_ITERATIONS)
    if status == INACCURATE:
        return REPLAN
    if status == NO_ROOM:
        return BUFFER_FULL
    if status == SINGULAR:
        return not_finite_here(m, SINGULAR_MATRIX)
    if status == NOT_CONSISTENT:
        return not_finite_here(m, INCONSISTENT)
    if status == NOT_SETTLED:
        return UNSETTLED
    if status == RUBBED:
        return REBOUND_RUBS
    if m.stop_asked == 1:
        return CHATTER
    if m.crossed == 1 and m.landing == 1 and m.t < m.stop:
        m.crossed = 0
        if m.t >= min(m.t_next, m.t_release) and time_event(m):
            begin_settling(m)
            return GO_ON
    finish_settling(m, starting)
    return GO_ON


@compiled
def finish_settling(m, starting):
    """Choose the step after a settlement, and write the right-hand row."""
    if m.adaptive == 1:
        weigh(m, m.at_y)
        keep_differential(m, m.at_slope, m.at_u)
        speed = weighted_norm(m, m.at_u)
        bend = bend_beyond_rounding(m)
        keep_algebraic(m, m.at_curvature, m.at_u)
        m.h_next = restart(m, speed, bend, weighted_norm(m, m.at_u))
        if starting and m.first_step > 0.0:
            m.h_next = m.first_step
        m.h_next = max(min(m.h_next, 0.1 * (m.stop - m.start)), 4.0 * smallest_step(m))
        watch_growth(m)
    m.last_error = 0.0
    m.least_look = 0.0
    m.retried = 0
    m.nothing_before = 0
    m.jacobian_fresh = 0
    m.factored_h = 0.0
    m.companion = 0
    m.judged = 1
    m.crossed = 0
    if not starting or m.on_grid == 0 or m.grid_next == 0:
        write_row(m, m.t, as_shown(m, m.at_y), ORDINARY if starting else AFTER)
    m.shown_apart = 0
    if starting:
        m.grid_next = 1
        copy(reals(m.at_y, m.n), reals(m.at_begun, m.n))
    m.phase = TRY


@compiled
def keep_algebraic(m, at_v, at_u):
    """U = v where y_i is algebraic, else 0."""
    v, u, differential = reals(at_v, m.n), reals(at_u, m.n), indices(m.at_differential, m.n)
    for k in range(m.n):
        u[k] = v[k] if differential[k] == 0 else 0.0


@compiled
def keep_differential(m, at_v, at_u):
    """U = v where y_i is differential, else 0."""
    v, u, differential = reals(at_v, m.n), reals(at_u, m.n), indices(m.at_differential, m.n)
    for k in range(m.n):
        u[k] = v[k] if differential[k] == 1 else 0.0
