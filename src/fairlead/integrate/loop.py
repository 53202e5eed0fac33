"""The loop of a run, compiled once for all problems.

    START    point = (start, y0); at_time; settle it (staged)
    while point.t < stop:
        TRY      h = propose(point)                        # clipped to land on time events
                 trial = step(point, h)                    # zones, M and J frozen: the minor step
                 if not accepted: shrink h; TRY again
                 crossing = first_crossing(trial)
                 if companion: settle the point at the start of the step; TRY again
        RECORD   grid points of the piece up to the crossing, or the end
        ARRIVE   point = end of the piece                  # the major step
                 if crossing: SETTLE on the guards that fired
                 if time event: at_time, and SETTLE if anything changed
        SETTLE   switch zones until no guard fires; choose the next step; TRY

The loop returns to Python with a status when a slice is used up, a buffer is full, the planned
pivots fail, or the run ends, and goes on where it was when called again: `phase` and the struct
hold all there is to know.
"""

from __future__ import annotations

from math import inf, isfinite

from fairlead.integrate.controller import (
    estimate_error,
    restart,
    step_after_acceptance,
    step_after_rejection,
    weigh,
    weighted_norm,
)
from fairlead.integrate.crossing import COMPANION, CROSSING, first_crossing
from fairlead.integrate.foreign import at_time_at, compiled, copy, field_at, indices, memory_at, next_time_at, reals
from fairlead.integrate.interpolant import interpolate, prepare_interpolant
from fairlead.integrate.linear import DONE, INACCURATE, SINGULAR
from fairlead.integrate.record import AFTER, BEFORE, ORDINARY, record_piece, there_is_room, write_row
from fairlead.integrate.rosenbrock import midpoint_defect, take_step
from fairlead.integrate.settling import NO_ROOM, NOT_SETTLED, begin_settling, block, settle
from fairlead.integrate.start import NOT_CONSISTENT

START, TRY, RECORD, ARRIVE, SETTLE = 0, 1, 2, 3, 4
# The numbers of protocol.Status, spelled out because compiled code knows no enumerations.
FINISHED, PAUSED, BUFFER_FULL, REPLAN = 0, -1, -2, -3
STEP_FLOOR, NOT_FINITE, UNSETTLED, INCONSISTENT, SINGULAR_MATRIX, CHATTER, MAX_STEPS, MAX_EVENTS = 1, 2, 3, 4, 5, 6, 7, 8
GO_ON = 100

STALL_LIMIT = 5
"""Switches in a row, each within a progress floor of the one before, that earn a machine a dwell."""
START_ITERATIONS, SETTLE_ITERATIONS = 40, 12


def advance(address, attempts):
    """Run on for at most `attempts` trial steps; the status to return to Python."""
    m = memory_at(address)
    while True:
        if m.phase == TRY:
            if m.t >= m.stop:
                return FINISHED
            if not there_is_room(m):
                return BUFFER_FULL
            if attempts <= 0:
                return PAUSED
            attempts -= 1
            status = attempt(m)
        elif m.phase == RECORD:
            status = record(m)
        elif m.phase == ARRIVE:
            status = arrive(m)
        elif m.phase == SETTLE:
            status = settle_here(m)
        else:
            status = start(m)
        if status != GO_ON:
            return status


@compiled
def start(m):
    """Sample inputs at the start, then settle there."""
    if m.call_at_time != 0:
        at_time_at(m.call_at_time, (m.context, m.t, m.at_y))
    find_next_time(m)
    m.n_fired = 0
    begin_settling(m)
    m.phase = SETTLE
    return GO_ON


@compiled
def attempt(m):
    """One trial step: rejected, given up for a settlement at its start, or accepted up to `t_piece`."""
    if m.steps >= m.max_steps:
        return MAX_STEPS
    if m.total_events >= m.max_events:
        return MAX_EVENTS
    h = propose(m)
    m.h = h
    status = take_step(m, h)
    if status == INACCURATE:
        return REPLAN
    if status == SINGULAR:
        m.error = inf
    else:
        m.error = estimate_error(m)
    if m.error <= 1.0 or m.adaptive == 0:
        prepare_interpolant(m)
        if m.n_algebraic > 0 and m.adaptive == 1:
            midpoint_defect(m, h)
            m.error = max(m.error, weighted_norm(m, m.at_error_vector))
    if not isfinite(m.error) or (m.adaptive == 1 and m.error > 1.0):
        return reject(m, h, status)
    found = first_crossing(m, h)
    if found == COMPANION:
        m.rejected_companion += 1
        m.companion = 1
        write_row(m, m.t, m.at_y, BEFORE)
        begin_settling(m)
        m.phase = SETTLE
        return GO_ON
    accept(m, h, found == CROSSING)
    return GO_ON


@compiled
def propose(m):
    """The next step size: what control wants, clipped to land on the next time event or the stop."""
    m.t_land = min(m.stop, min(m.t_next, m.t_release))
    rest = m.t_land - m.t
    h = min(m.h_next, m.max_step)
    m.h_wanted = h
    m.landing = 0
    if h >= rest * (0.99 if m.adaptive == 1 else 1.0 - 1e-9):
        m.landing = 1
        return rest
    if m.adaptive == 1 and h > 0.5 * rest:
        return 0.5 * rest
    return h


@compiled
def smallest_step(m):
    """The step floor here: what was set, but not below what t can resolve."""
    return max(m.step_floor, 4e-15 * abs(m.t))


@compiled
def reject(m, h, status):
    """Shrink the step, and say whom it is due to; end the run at the step floor."""
    indices(m.at_rejections_by_unknown, m.n)[m.worst] += 1
    if isfinite(m.error):
        m.rejected_error += 1
    else:
        m.rejected_nan += 1
    m.h_next = step_after_rejection(m, h)
    m.retried += 1
    if m.adaptive == 1 and m.h_next >= smallest_step(m):
        return GO_ON
    if status == SINGULAR:
        return not_finite_here(m, SINGULAR_MATRIX)
    return STEP_FLOOR if isfinite(m.error) else not_finite_here(m, NOT_FINITE)


@compiled
def not_finite_here(m, otherwise):
    """NOT_FINITE, with the unknown in `worst`, if f is not finite at the point or a step later; else `otherwise`.

    The trial itself does not tell whose law it was: one nan spreads to all unknowns in the first solve.
    """
    for fraction in range(2):
        field_at(m.call_rhs, (m.context, m.t + fraction * m.h, m.at_y, m.at_f))
        f = reals(m.at_f, m.n)
        for k in range(m.n):
            if not isfinite(f[k]):
                m.worst = k
                return NOT_FINITE
    return otherwise


@compiled
def accept(m, h, crossed):
    """Set the piece of the trial that is accepted: up to the crossing, or to the end."""
    m.steps += 1
    if m.adaptive == 1:
        m.h_next = step_after_acceptance(m, h)
        if h < m.h_wanted:
            m.h_next = max(m.h_next, m.h_wanted)
    m.last_error = max(m.error, 1e-4)
    m.retried = 0
    m.crossed = 1 if crossed else 0
    if crossed and m.theta < 1.0:
        m.landing = 0
        m.t_piece = m.t + m.theta * h
        interpolate(m, m.theta, m.at_y_piece)
    else:
        m.t_piece = m.t_land if m.landing == 1 else m.t + h
        copy(reals(m.at_y_end, m.n), reals(m.at_y_piece, m.n))
    m.phase = RECORD


@compiled
def record(m):
    """Write the grid points of the piece."""
    if not record_piece(m):
        return BUFFER_FULL
    m.phase = ARRIVE
    return GO_ON


@compiled
def arrive(m):
    """Move to the end of the piece; settle there if guards fired or a time event changed anything."""
    m.t = m.t_piece
    copy(reals(m.at_y_piece, m.n), reals(m.at_y, m.n))
    m.jacobian_fresh = 0
    if m.rows + 4 > m.row_capacity:
        return BUFFER_FULL
    m.phase = TRY
    event_due = m.landing == 1 and (m.t < m.stop and m.t >= min(m.t_next, m.t_release))
    if m.crossed == 1:
        m.located += 1
        write_row(m, m.t, m.at_y, BEFORE)
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
        copy(reals(m.at_g_end, m.n_guards), reals(m.at_g, m.n_guards))
        if m.on_grid == 0:
            write_row(m, m.t, m.at_y, ORDINARY)
        elif m.t >= m.stop and m.start + (m.grid_next - 1) * m.every < m.stop - 1e-9 * m.every:
            write_row(m, m.t, m.at_y, ORDINARY)
    return GO_ON


@compiled
def time_event(m):
    """Tell the problem that its time event is here, release machines whose dwell is over; True if that matters."""
    changed = False
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
    watch_progress(m)
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
def watch_progress(m):
    """Count switches that do not advance; when there are too many, hold the machines that fired for a dwell."""
    if m.passes > 0 or m.n_fired == 0:
        return
    m.stalls = m.stalls + 1 if m.t - m.t_last_switch < m.progress_floor else 0
    m.t_last_switch = m.t
    if m.stalls >= STALL_LIMIT:
        fired, machine = indices(m.at_fired, m.n_guards), indices(m.at_guard_machine, m.n_guards)
        chatters = indices(m.at_chatters, m.n_zones)
        for k in range(m.n_fired):
            z = machine[fired[k]]
            if z >= 0:
                block(m, z)
                chatters[z] += 1


@compiled
def finish_settling(m, starting):
    """Choose the step after a settlement, and write the right-hand row."""
    if m.adaptive == 1:
        weigh(m, m.at_y)
        keep_differential(m, m.at_slope, m.at_u)
        speed = weighted_norm(m, m.at_u)
        keep_differential(m, m.at_curvature, m.at_u)
        m.h_next = restart(m, speed, weighted_norm(m, m.at_u))
        if starting and m.first_step > 0.0:
            m.h_next = m.first_step
        m.h_next = max(min(m.h_next, 0.1 * (m.stop - m.start)), 4.0 * smallest_step(m))
    m.last_error = 0.0
    m.retried = 0
    m.jacobian_fresh = 0
    m.factored_h = 0.0
    m.companion = 0
    m.crossed = 0
    if not starting or m.on_grid == 0 or m.grid_next == 0:
        write_row(m, m.t, m.at_y, ORDINARY if starting else AFTER)
    if starting:
        m.grid_next = 1
    m.phase = TRY


@compiled
def keep_differential(m, at_v, at_u):
    """u = v where y_i is differential, else 0."""
    v, u, differential = reals(at_v, m.n), reals(at_u, m.n), indices(m.at_differential, m.n)
    for k in range(m.n):
        u[k] = v[k] if differential[k] == 1 else 0.0
