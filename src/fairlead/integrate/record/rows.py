"""What the loop writes down: rows of outputs and zone changes, into buffers that Python empties."""

from __future__ import annotations

from math import inf

from fairlead.integrate.codes import GRID, INSIDE, INSIDE_PASSED, ORDINARY, PARABOLA, PASSED, QUARTIC
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.point.interpolant import interpolate, interpolate_one
from fairlead.integrate.record.between import balance_stiff, take_slip_away, zones_inside, zones_of_end


@compiled
def write_row(problem, recorder, t, at_y, side):
    """One row: time, outputs in the zones in force (y itself where there are none), side of an event."""
    row = recorder.rows
    reals(recorder.at_row_t, recorder.row_capacity)[row] = t
    indices(recorder.at_row_side, recorder.row_capacity)[row] = side
    at_values = recorder.at_row_values + 8 * row * problem.n_outputs
    if problem.call_outputs != 0:
        field_at(problem.call_outputs, (problem.context, t, at_y, at_values))
    else:
        copy(reals(at_y, problem.n_outputs), reals(at_values, problem.n_outputs))
    recorder.rows = row + 1
    recorder.t_row = t


@compiled
def write_event(point, settling, recorder, machine, before, after, guard):
    """One zone change at the point, in the pass now running."""
    k = recorder.events
    reals(recorder.at_event_t, recorder.event_capacity)[k] = point.t
    indices(recorder.at_event_machine, recorder.event_capacity)[k] = machine
    indices(recorder.at_event_before, recorder.event_capacity)[k] = before
    indices(recorder.at_event_after, recorder.event_capacity)[k] = after
    indices(recorder.at_event_guard, recorder.event_capacity)[k] = guard
    indices(recorder.at_event_position, recorder.event_capacity)[k] = settling.passes
    recorder.events = k + 1
    recorder.total_events += 1


@compiled
def keep_last_event(point, recorder, machine, before):
    """Of the changes of a machine at the point keep the last, as one from the zone `before`; none if that is its zone.

    Returns how many go. What has been emptied from the buffer meanwhile stays.
    """
    times = reals(recorder.at_event_t, recorder.event_capacity)
    machines = indices(recorder.at_event_machine, recorder.event_capacity)
    befores = indices(recorder.at_event_before, recorder.event_capacity)
    afters = indices(recorder.at_event_after, recorder.event_capacity)
    guards = indices(recorder.at_event_guard, recorder.event_capacity)
    positions = indices(recorder.at_event_position, recorder.event_capacity)
    last = -1
    for k in range(recorder.events):
        last = k if machines[k] == machine and times[k] == point.t else last
    kept = 0
    for k in range(recorder.events):
        mine = machines[k] == machine and times[k] == point.t
        if mine and (k != last or afters[k] == before):
            continue
        times[kept], machines[kept], guards[kept], positions[kept] = times[k], machines[k], guards[k], positions[k]
        befores[kept], afters[kept] = before if mine else befores[k], afters[k]
        kept += 1
    gone = recorder.events - kept
    recorder.total_events -= gone
    recorder.events = kept
    return gone


@compiled
def there_is_room(problem, recorder):
    """True if the next pass of a settlement fits whatever happens in it, and the rows around it."""
    events = recorder.events + problem.n_machines + problem.n_guards
    return recorder.rows + 4 <= recorder.row_capacity and events <= recorder.event_capacity


@compiled
def record_piece(m):
    """Rows inside the accepted piece (t, t_piece], by the dense output; False when the buffer is full.

    The point at an event itself is not interpolated: its two sides are written on arrival.
    """
    problem, run, point, recorder = m.problem, m.run, m.point, m.recorder
    if recorder.inside_next == 0:
        recorder.inside = rows_inside(run, point, m.events.settling, recorder)
        recorder.inside_next = 1
    if recorder.inside > 0 and recorder.inside_next == 1 and recorder.t_row < point.t:
        if recorder.rows + 4 > recorder.row_capacity:
            return False
        write_row(problem, recorder, point.t, point.at_y, PASSED)
    end = run.t_piece - 1e-12 * max(abs(run.t_piece), recorder.every)
    reach = run.t_piece + 1e-12 * max(abs(run.t_piece), recorder.every)
    while True:
        t = run.start + recorder.grid_next * recorder.every if recorder.on_grid == 1 else inf
        t_inside = inf
        if recorder.inside_next <= recorder.inside:
            t_inside = point.t + (run.t_piece - point.t) * (recorder.inside_next / (recorder.inside + 1))
        if t > reach and t_inside == inf:
            recorder.inside_next = 0
            return True
        if recorder.rows + 4 > recorder.row_capacity:
            return False
        if t_inside < t:
            write_between(m, t_inside, INSIDE if recorder.on_grid == 0 else INSIDE_PASSED)
            recorder.inside_next += 1
            continue
        if t >= end:
            write_row(problem, recorder, min(t, run.t_piece), shown_end(m), ORDINARY)  # never later than an event there
        else:
            write_between(m, t, ORDINARY if recorder.between == 0 else GRID)
        recorder.grid_next += 1


@compiled
def write_between(m, t, side):
    """One row of the dense output."""
    problem, run, point, recorder = m.problem, m.run, m.point, m.recorder
    interpolate(point, (t - point.t) / run.h, point.at_y_probe)
    if recorder.rows_slip == 1:
        take_slip_away(problem, point, m.linear, m.stepping.exchange, t, point.at_y_probe)
    if recorder.any_stiff > 0:
        balance_stiff(m, t, (t - point.t) / run.h, point.at_y_probe)
    if m.stepping.contacts.n_switched == 0:
        write_row(problem, recorder, t, point.at_y_probe, side)
        return
    zones_inside(m, t, point.at_y_probe)
    write_row(problem, recorder, t, point.at_y_probe, side)
    zones_of_end(problem, m.stepping.contacts)


@compiled
def shown_end(m):
    """Address of the end of the piece as it is recorded."""
    run, point, recorder = m.run, m.point, m.recorder
    if recorder.any_stiff == 0:
        return point.at_y_piece
    copy(reals(point.at_y_piece, point.n), reals(point.at_y_probe, point.n))
    whole = recorder.most_inside == PARABOLA and m.stepping.rule.locates == 0
    s = 1.0 if whole else (run.t_piece - point.t) / run.h
    balance_stiff(m, run.t_piece, s, point.at_y_probe)
    return point.at_y_probe


@compiled
def rows_inside(run, point, settling, recorder):
    """How many rows the piece has inside that are no grid points: those that its curve goes through, or none.

    Without a grid all steps have them; with one, steps in the middle of which an unknown is off the straight line by
    more than its weight: a single one where no unknown is off the parabola through it by as much. A step of `stepping`
    in which something switched has none: it has the laws of its end.
    """
    if recorder.between == 0 or run.t_piece <= point.t or (recorder.most_inside == PARABOLA and settling.passes > 0):
        return 0
    if recorder.on_grid == 0:
        return recorder.most_inside
    if not off_chord(run, point):
        return 0
    if recorder.most_inside == QUARTIC:
        interpolate(point, 0.5 * ((run.t_piece - point.t) / run.h), point.at_x)
        if off_parabola(run, point, 0.25) or off_parabola(run, point, 0.75):
            return QUARTIC
    return PARABOLA


@compiled
def off_chord(run, point):
    """True if an unknown is off the straight line in the middle of the piece by its weight."""
    y, end = reals(point.at_y, point.n), reals(point.at_y_piece, point.n)
    middle = 0.5 * ((run.t_piece - point.t) / run.h)
    weight, unweighed = reals(point.at_weight, point.n), indices(point.at_unweighed, point.n)
    for k in range(point.n):
        off = abs(interpolate_one(point, middle, k) - 0.5 * (y[k] + end[k]))
        if off > weight[k] and unweighed[k] == 0:
            return True
    return False


@compiled
def off_parabola(run, point, place):
    """True if an unknown is off the parabola through start, middle (in `x`) and end of the piece by its weight."""
    y, end, middle = reals(point.at_y, point.n), reals(point.at_y_piece, point.n), reals(point.at_x, point.n)
    weight, unweighed = reals(point.at_weight, point.n), indices(point.at_unweighed, point.n)
    curve, off = reals(point.at_y_probe, point.n), False
    interpolate(point, place * (run.t_piece - point.t) / run.h, point.at_y_probe)
    for k in range(point.n):
        bend = 4.0 * (middle[k] - 0.5 * (y[k] + end[k]))
        parabola = y[k] + place * (end[k] - y[k] + (1.0 - place) * bend)
        off = off or (unweighed[k] == 0 and abs(curve[k] - parabola) > weight[k])
    return off
