"""What the loop writes down: rows of outputs and zone changes, into buffers that Python empties."""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.interpolant import interpolate
from fairlead.integrate.rows_between import take_slip_away

ORDINARY, BEFORE, AFTER = 0, 1, 2


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
    """Grid points of the accepted piece (t, t_piece], by the dense output; False when the buffer is full.

    The point at an event itself is not interpolated: its two sides are written on arrival.
    """
    if m.on_grid == 0:
        return True
    reach = m.t_piece + 1e-12 * max(abs(m.t_piece), m.every)
    while m.start + m.grid_next * m.every <= reach:
        if m.rows + 4 > m.row_capacity:
            return False
        t = m.start + m.grid_next * m.every
        theta = (t - m.t) / m.h
        if t >= m.t_piece - 1e-12 * max(abs(m.t_piece), m.every):
            write_row(m, min(t, m.t_piece), m.at_y_piece, ORDINARY)  # never later than an event there
        else:
            interpolate(m, theta, m.at_y_probe)
            if m.rows_slip == 1:
                take_slip_away(m, t, m.at_y_probe)
            write_row(m, t, m.at_y_probe, ORDINARY)
        m.grid_next += 1
    return True
