"""f in other zones than those in force: what a law that switches inside a step says instead, and whether that counts.

The zones in force are kept in `zones_probed` meanwhile, and are the same afterwards.
"""

from __future__ import annotations

from fairlead.integrate.linear.products import inertia_of
from fairlead.integrate.linear.systems import solve_motion
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals, switch_at
from fairlead.integrate.stepping.response import response_of


@compiled
def switch_for_now(problem, guards, contacts, t, at_y, count):
    """Switch on the first `count` guards in `fired`, until `switch_back`; the switch may change y."""
    zones = indices(problem.at_zones, problem.n_machines)
    copy(zones, indices(contacts.at_zones_probed, problem.n_machines))
    switch_at(problem.call_switch, (problem.context, t, at_y, guards.at_fired, count))


@compiled
def switch_back(problem, contacts):
    """The zones that were in force before `switch_for_now`."""
    copy(indices(contacts.at_zones_probed, problem.n_machines), indices(problem.at_zones, problem.n_machines))


@compiled
def forces_if_switched(problem, point, guards, contacts, t, at_y, at_switched, count):
    """Into `x` f at (t, y), into `f` the same after the first `count` guards in `fired` have switched.

    `at_switched` is the address of the unknowns that the switch is given, and may change.
    """
    field_at(problem.call_forces, (problem.context, t, at_y, point.at_x))
    switch_for_now(problem, guards, contacts, t, at_switched, count)
    field_at(problem.call_forces, (problem.context, t, at_y, point.at_f))
    switch_back(problem, contacts)
    problem.rhs += 2


@compiled
def forces_before_switches(problem, point, contacts, most):
    """Into `x` f at the start of the step, into `f` the same in the zones that machines had there.

    All of them, or where `most` is below one those that hold no row and left their zone in that first share of it.
    """
    zones, kept = indices(problem.at_zones, problem.n_machines), indices(contacts.at_zones_probed, problem.n_machines)
    before, hold_row = (
        indices(contacts.at_zones_at_start, problem.n_machines), indices(contacts.at_hold_row, problem.n_machines),
    )  # fmt: skip
    after = reals(contacts.at_switched_after, problem.n_machines)
    field_at(problem.call_forces, (problem.context, point.t, point.at_y, point.at_x))
    copy(zones, kept)
    for z in range(problem.n_machines):
        if most >= 1.0 or (hold_row[z] < 0 and 0.0 < after[z] < most):
            zones[z] = before[z]
    field_at(problem.call_forces, (problem.context, point.t, point.at_y, point.at_f))
    copy(kept, zones)
    problem.rhs += 2


@compiled
def state_off(m, h, lasting, per_mean):
    """The first state that is off by more than a weight where forces are `x` instead of `f` for that time; -1: none.

    Their difference is `per_mean` times its mean over the time. What a row with inertia gets changes its state at once;
    what one without gets reaches states by the factors of the step. A speed and the position that follows from it have
    to be off: the lesser error counts (response.py). Quadratures go by the states.
    """
    problem, point, matrices = m.problem, m.point, m.linear.matrices
    n = problem.n
    one, other, off = reals(point.at_x, n), reals(point.at_f, n), reals(point.at_b, n)
    weight, position = reals(point.at_weight, n), indices(problem.at_position_of, n)
    differential, quadrature = indices(problem.at_differential, n), indices(problem.at_quadrature, n)
    holder = indices(problem.at_holder, n)
    share, passed_on, any_off = lasting / (per_mean * h), False, False
    for k in range(n):
        off[k] = 0.0
        if one[k] != other[k] and quadrature[k] == 0:
            any_off = True
            if differential[k] == 0 and holder[k] < 0:
                off[k] = share * (other[k] - one[k])
                passed_on = True
    if not any_off:
        return -1
    if passed_on:
        solve_motion(m.linear, point.at_b)
        for v in range(n):
            if position[v] >= 0:
                off[position[v]] = 0.0
    for v in range(n):
        if differential[v] == 0 or quadrature[v] == 1:
            continue
        inertia, x = inertia_of(matrices, v), position[v]
        if inertia <= 0.0:
            continue
        error = abs(off[v] / m.stepping.rule.theta_now + h * share * (other[v] - one[v]) / inertia)
        if x >= 0:
            error = min(error / weight[v], error * response_of(matrices, x, v, inertia) / weight[x])
        else:
            error /= weight[v]
        if error > 1.0:
            return v
    return -1
