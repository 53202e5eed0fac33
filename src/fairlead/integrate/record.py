"""What the loop writes down: rows of outputs and zone changes, into buffers that Python empties."""

from __future__ import annotations

from math import inf

from fairlead.integrate.codes import GRID, INSIDE, INSIDE_PASSED, ORDINARY, PARABOLA, PASSED
from fairlead.integrate.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.interpolant import interpolate
from fairlead.integrate.rows_between import balance_stiff, take_slip_away


@compiled
def write_row(m, t, at_y, side):
    """One row: time, outputs in the zones in force (y itself where there are none), side of an event."""
    row = m.rows
    reals(m.at_row_t, m.row_capacity)[row] = t
    indices(m.at_row_side, m.row_capacity)[row] = side
    at_values = m.at_row_values + 8 * row * m.n_outputs
    if m.call_outputs != 0:
        field_at(m.call_outputs, (m.context, t, at_y, at_values))
    else:
        copy(reals(at_y, m.n_outputs), reals(at_values, m.n_outputs))
    m.rows = row + 1
    m.t_row = t


@compiled
def write_event(m, machine, before, after, guard):
    """One zone change at the point, in the pass now running."""
    k = m.events
    reals(m.at_event_t, m.event_capacity)[k] = m.t
    indices(m.at_event_machine, m.event_capacity)[k] = machine
    indices(m.at_event_before, m.event_capacity)[k] = before
    indices(m.at_event_after, m.event_capacity)[k] = after
    indices(m.at_event_guard, m.event_capacity)[k] = guard
    indices(m.at_event_position, m.event_capacity)[k] = m.passes
    m.events = k + 1
    m.total_events += 1


@compiled
def there_is_room(m):
    """True if the next pass of a settlement fits whatever happens in it, and the rows around it."""
    return m.rows + 4 <= m.row_capacity and m.events + m.n_zones + m.n_guards <= m.event_capacity


@compiled
def record_piece(m):
    """Rows inside the accepted piece (t, t_piece], by the dense output; False when the buffer is full.

    The point at an event itself is not interpolated: its two sides are written on arrival.
    """
    if m.inside_next == 0:
        m.inside = rows_inside(m)
        m.inside_next = 1
    if m.inside > 0 and m.inside_next == 1 and m.t_row < m.t:
        if m.rows + 4 > m.row_capacity:
            return False
        write_row(m, m.t, m.at_y, PASSED)
    end = m.t_piece - 1e-12 * max(abs(m.t_piece), m.every)
    reach = m.t_piece + 1e-12 * max(abs(m.t_piece), m.every)
    while True:
        t = m.start + m.grid_next * m.every if m.on_grid == 1 else inf
        t_inside = m.t + (m.t_piece - m.t) * (m.inside_next / (m.inside + 1)) if m.inside_next <= m.inside else inf
        if t > reach and t_inside == inf:
            m.inside_next = 0
            return True
        if m.rows + 4 > m.row_capacity:
            return False
        if t_inside < t:
            write_between(m, t_inside, INSIDE if m.on_grid == 0 else INSIDE_PASSED)
            m.inside_next += 1
            continue
        if t >= end:
            write_row(m, min(t, m.t_piece), shown_end(m), ORDINARY)  # never later than an event there
        else:
            write_between(m, t, ORDINARY if m.between == 0 else GRID)
        m.grid_next += 1


@compiled
def write_between(m, t, side):
    """One row of the dense output."""
    interpolate(m, (t - m.t) / m.h, m.at_y_probe)
    if m.rows_slip == 1:
        take_slip_away(m, t, m.at_y_probe)
    if m.any_stiff == 1:
        balance_stiff(m, t, (t - m.t) / m.h, m.at_y_probe)
    write_row(m, t, m.at_y_probe, side)


@compiled
def shown_end(m):
    """Address of the end of the piece as it is recorded."""
    if m.any_stiff == 0:
        return m.at_y_piece
    copy(reals(m.at_y_piece, m.n), reals(m.at_y_probe, m.n))
    theta = 1.0 if m.most_inside == PARABOLA and m.locates == 0 else (m.t_piece - m.t) / m.h
    balance_stiff(m, m.t_piece, theta, m.at_y_probe)
    return m.at_y_probe


@compiled
def rows_inside(m):
    """How many rows the piece has inside that are no grid points: those that its curve goes through, or none.

    Without a grid all steps have them; with one, long steps in the middle of which an unknown is off the straight line
    by more than its weight. A step of `stepping` in which something switched has none: it has the laws of its end.
    """
    if m.between == 0 or m.t_piece <= m.t or (m.most_inside == PARABOLA and m.passes > 0):
        return 0
    if m.on_grid == 0:
        return m.most_inside
    if m.t_piece - m.t < 2.0 * m.least_gap:
        return 0
    interpolate(m, 0.5 * (m.t_piece - m.t) / m.h, m.at_y_probe)
    y, end, middle = reals(m.at_y, m.n), reals(m.at_y_piece, m.n), reals(m.at_y_probe, m.n)
    weight, unweighed = reals(m.at_weight, m.n), indices(m.at_unweighed, m.n)
    curved = False
    for k in range(m.n):
        off = abs(middle[k] - 0.5 * (y[k] + end[k]))
        curved = curved or (unweighed[k] == 0 and off > weight[k])
    return m.most_inside if curved else 0
