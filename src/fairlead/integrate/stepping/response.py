"""What a force that a step misses does to the body behind it, in weights.

A wrong speed is a wrong position later: by as much as 1/omega of what holds it back, k = m omega^2. Where nothing does,
it is measured by the weight of the speed itself.
"""

from __future__ import annotations

from math import sqrt

from fairlead.integrate.memory.foreign import compiled, indices, reals

FREE = 1e300
"""The response time of what nothing holds back."""


@compiled
def response_of(matrices, x, v, inertia):
    """1/omega of what holds back the position x with the speed v and this inertia; FREE without one."""
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    slopes = reals(matrices.at_jacobian, matrices.n_jacobian)
    for p in range(starts[x], starts[x + 1]):
        if rows[p] == v and slopes[p] < 0.0:
            return sqrt(-inertia / slopes[p])
    return FREE


@compiled
def error_of_peak(point, matrices, contacts, h, z, over):
    """What an excess force inside the step may move, in weights; of an unknown inertia: the force itself.

    Of several bodies that machine z holds the one that is moved most counts: which is named first is chance.
    """
    weight, inertia = reals(point.at_weight, point.n), reals(contacts.at_held_inertia, contacts.n_machines)[z]
    bodies = indices(contacts.at_body_starts, contacts.n_machines + 1)
    position = indices(contacts.at_body_position, contacts.n_body_speed)
    speed, largest = indices(contacts.at_body_speed, contacts.n_body_speed), 0.0
    if bodies[z] == bodies[z + 1] or position[bodies[z]] < 0 or inertia <= 0.0:
        return over / weight[indices(contacts.at_hold_row, contacts.n_machines)[z]]
    for e in range(bodies[z], bodies[z + 1]):
        time = min(h, response_of(matrices, position[e], speed[e], inertia))
        largest = max(largest, over * time * time / (inertia * weight[position[e]]))
    return largest


@compiled
def error_of_speed(point, matrices, contacts, h, z, most, lasting):
    """What a missed force that rises to `most` in the time `lasting` means, in weights, for the speed or the position.

    Where a stiffness holds back, it takes the force up within the response time. Of several bodies as above.
    """
    weight, inertia = reals(point.at_weight, point.n), reals(contacts.at_held_inertia, contacts.n_machines)[z]
    bodies = indices(contacts.at_body_starts, contacts.n_machines + 1)
    position = indices(contacts.at_body_position, contacts.n_body_speed)
    speed, largest = indices(contacts.at_body_speed, contacts.n_body_speed), 0.0
    if bodies[z] == bodies[z + 1] or inertia <= 0.0:
        return 0.5 * most * lasting / (h * weight[indices(contacts.at_hold_row, contacts.n_machines)[z]])
    for e in range(bodies[z], bodies[z + 1]):
        x, error = position[e], 0.5 * most * lasting / (inertia * weight[speed[e]])
        if x >= 0:
            time = response_of(matrices, x, speed[e], inertia)
            error = min(error, 0.5 * most * min(lasting, time) * time / (inertia * weight[x]))
        largest = max(largest, error)
    return largest
