"""f in other zones than those in force: what a law that switches inside a step says instead, and whether that counts.

The zones in force are kept in `zones_probed` meanwhile, and are the same afterwards.
"""

from __future__ import annotations

from fairlead.integrate.linear.products import inertia_of
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
def forces_in_zones(problem, point, contacts, t, at_y, at_other):
    """Into `x` f at (t, y), into `f` the same in the zones at `at_other`."""
    zones, kept = (
        indices(problem.at_zones, problem.n_machines), indices(contacts.at_zones_probed, problem.n_machines),
    )  # fmt: skip
    field_at(problem.call_forces, (problem.context, t, at_y, point.at_x))
    copy(zones, kept)
    copy(indices(at_other, problem.n_machines), zones)
    field_at(problem.call_forces, (problem.context, t, at_y, point.at_f))
    copy(kept, zones)
    problem.rhs += 2


@compiled
def speed_off(problem, point, matrices, lasting, per_mean):
    """The first speed that is off by more than a weight where forces are `x` instead of `f` for that time; -1: none.

    Their difference is `per_mean` times its mean over the time. The speed and the position that follows from it have to
    be off: the lesser error counts (response.py).
    """
    one, other = reals(point.at_x, problem.n), reals(point.at_f, problem.n)
    weight, position = reals(point.at_weight, problem.n), indices(problem.at_position_of, problem.n)
    for v in range(problem.n):
        x = position[v]
        inertia = inertia_of(matrices, v) if x >= 0 and one[v] != other[v] else 0.0
        if inertia > 0.0:
            error = lasting * abs(other[v] - one[v]) / (per_mean * inertia)
            if min(error / weight[v], error * response_of(matrices, x, v, inertia) / weight[x]) > 1.0:
                return v
    return -1
