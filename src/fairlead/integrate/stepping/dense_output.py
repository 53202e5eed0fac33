"""The end of an accepted step and its dense output: what holds at the end has no slip there, nor inside the step.

Contacts that hold would else seem to creep: a body that is captured in the step has a slip at its start, bodies that
hold on to each other have parabolas of their own, and one that is carried along has another than the surface, which
follows its law. Slip is linear in the speeds. So where surfaces keep their speed it is taken away once for the start of
the step and once for its second difference, else at every place that is asked for (`rows_slip`, record/between.py).
"""

from __future__ import annotations

from fairlead.integrate.linear.systems import solve
from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals
from fairlead.integrate.record.between import remove_slip, take_slip_away
from fairlead.integrate.record.rows import rows_inside


@compiled
def end_algebraic_speeds(problem, point, linear, exchange, h):
    """Give nodes without mass that are held the speed they have at the end of a step, for their mean over it."""
    factors = linear.factors
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    column = indices(exchange.at_hold_mass_column, exchange.n_hold_mass)
    holds, of_algebraic_speed, differential = (
        indices(exchange.at_holds, problem.n), indices(exchange.at_of_algebraic_speed, problem.n),
        indices(problem.at_differential, problem.n),
    )  # fmt: skip
    field_at(problem.call_drift, (problem.context, point.t + h, point.at_y_end, point.at_minus_slip))
    minus_slip, b = reals(point.at_minus_slip, problem.n), reals(point.at_b, problem.n)
    y_end = reals(point.at_y_end, problem.n)
    found = False
    for k in range(problem.n):
        b[k] = 0.0
    for e in range(exchange.n_hold_mass):
        k = row[e]
        if holds[k] == 1 and of_algebraic_speed[k] == 1 and minus_slip[k] != 0.0:
            b[k] = minus_slip[k] * factors.mass_factor
            found = True
    if not found:
        return
    solve(linear, point.at_b)
    for e in range(exchange.n_hold_mass):
        if differential[column[e]] == 0:
            y_end[column[e]] += b[column[e]]
            b[column[e]] = 0.0


@compiled
def show_inside(m):
    """How many rows the accepted step has inside, and what its dense output needs."""
    recorder = m.recorder
    if recorder.on_grid == 1 or recorder.between == 1:
        recorder.inside, recorder.inside_next = rows_inside(m.run, m.point, m.events.settling, recorder), 1
        prepare_dense_output(m)


@compiled
def prepare_dense_output(m):
    """Of an accepted step with rows inside: take slip out of its start and its bulge; see `rows_slip`."""
    run, recorder = m.run, m.recorder
    recorder.rows_slip = 0
    beyond = run.t_piece - 1e-12 * max(abs(run.t_piece), recorder.every)
    gridless = recorder.on_grid == 0 or run.start + recorder.grid_next * recorder.every >= beyond
    if not gridless or recorder.inside > 0:
        hold_inside(m)


@compiled
def hold_inside(m):
    """Take slip out of the start and the bulge of a step, or have every point inside it done (`rows_slip`).

    The start has slip in contacts that a settlement has just captured, by rounding: what is more was
    settled (located_step.py). A step that is taken again from there begins without it.
    """
    point, linear, matrices, recorder = m.point, m.linear, m.linear.matrices, m.recorder
    exchange = m.stepping.exchange
    recorder.rows_slip = 0
    row, captured = indices(exchange.at_hold_mass_row, exchange.n_hold_mass), indices(exchange.at_captured, point.n)
    holds, any_holds, any_captured = indices(exchange.at_holds, point.n), False, False
    for e in range(exchange.n_hold_mass):
        if holds[row[e]] == 1:
            any_holds = True
            any_captured = any_captured or captured[row[e]] == 1
    if not any_holds:
        return
    if exchange.support_accelerates == 1 or exchange.algebraic_speeds == 1:
        recorder.rows_slip = 1
        return
    if any_captured:
        take_slip_away(m.problem, point, linear, exchange, point.t, point.at_y)
    entry = indices(exchange.at_hold_mass, exchange.n_hold_mass)
    column = indices(exchange.at_hold_mass_column, exchange.n_hold_mass)
    values, bulge = reals(matrices.at_mass, matrices.n_mass), reals(point.at_D, point.n)
    minus_slip = reals(point.at_minus_slip, point.n)
    for k in range(point.n):
        minus_slip[k] = 0.0
    for e in range(exchange.n_hold_mass):
        minus_slip[row[e]] -= values[entry[e]] * bulge[column[e]]
    remove_slip(point, linear, exchange, point.at_D)
