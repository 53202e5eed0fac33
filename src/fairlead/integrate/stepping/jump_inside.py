"""A law that jumps inside a step: its impulse is put right there (docs/stepping.md, "A law that jumps").

A contact slides from s h on, and the row of its law is r = 0 from there on. Before, while it held, r was not zero: it
came to J, the jump, at s h. The step has the zone of its end for all of it. So of its row is asked

    r(u) = s J

the mean of r over the step but for what grows from zero, and the end is moved besides. With w = z/(1 - z/2), z as h
times an eigenvalue, a motion that is held until s h and decays then is multiplied by

    e^(z (1 - s)) = R - s w - s (1 - s)/2 w^2 + s^2/4 w^3 + s/12 w^3 (1 - w/4) + O(z^3)

with R = 1 + w - w^3/12 + w^4/48 = e^z + O(z^4). At w = -2, where z is large, that is -s: what is stiff for the step has
lost more than half of its speed at the end, and all of it a step later, since R is zero there. The term -s w is the one
above. The next two come with the two solves of third_order.py and a third one, by the weights of `ask_of_rows`: of a
row its `kick` is s J, `kick_first` and `kick_second` are what goes into the right-hand sides of these solves. The last
comes since the first of them sees f at the end as the impulse has moved it.

s is told by the line through two middles of steps, as long as the force is not at its limit in the middle of a step the
contact holds. So s is above -1/2 for steps of one length, and below 1/2: negative where the limit was reached in the
second half of the step before.

A contact whose friction jumps stays where it is once it is captured, until its load is at stiction again. The midpoint
rule rings, 2 u - y0, and would catch what only slows down. So it is captured for a slip that its moved end still has.

One that comes to rest inside the step and goes on at once, the other way, was not held: nothing is missed by a jump.

This is of rows that a machine is known to hold (`holder`). For others the step ends at the jump (jump_at_end.py).
"""

from __future__ import annotations

from fairlead.integrate.codes import MIDDLE
from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.stepping.jump_at_end import note_kind, zero_of_guard
from fairlead.integrate.stepping.third_order import move_by_error

STAYED, NO_LIMIT = -2, -1
"""What `jump_at` says, but for where a limit was reached, of machines that stay in their zone and that leave it by a
guard that is no limit."""
EARLIEST = -1.0
"""A limit was reached at most so many steps before this one; further back the step before was more than twice as long,
and of its impulse so much is put right as is this step's."""


@compiled
def forget_jumps(rule):
    """Before a step: no law has jumped in it."""
    kick, first, second = (
        reals(rule.at_kick, rule.n), reals(rule.at_kick_first, rule.n), reals(rule.at_kick_second, rule.n),
    )  # fmt: skip
    for k in range(rule.n):
        kick[k] = 0.0
        first[k] = 0.0
        second[k] = 0.0


@compiled
def remember_before_switch(guards, contacts):
    """Before the zones switch: the guards in `fired`, and all zones."""
    copy(indices(guards.at_fired, guards.n_guards), indices(contacts.at_suspects, guards.n_guards))
    copy(indices(contacts.at_zones, contacts.n_machines), indices(contacts.at_zones_probed, contacts.n_machines))
    contacts.n_suspects = guards.n_fired


@compiled
def find_limits(guards, contacts):
    """After the zones have switched: of every machine that has, where between two middles its limit was reached."""
    n = guards.n_guards
    suspects, machine = indices(contacts.at_suspects, n), indices(guards.at_guard_machine, n)
    at, may_jump = reals(contacts.at_jump_at, contacts.n_machines), indices(contacts.at_may_jump, n)
    zones, old = indices(contacts.at_zones, contacts.n_machines), indices(contacts.at_zones_probed, contacts.n_machines)
    start = indices(contacts.at_zones_at_start, contacts.n_machines)
    for z in range(contacts.n_machines):
        at[z] = STAYED if zones[z] == old[z] else NO_LIMIT
    for k in range(contacts.n_suspects):
        i, z = suspects[k], machine[suspects[k]]
        if z >= 0 and at[z] != STAYED and may_jump[i] == 1 and old[z] == start[z]:
            at[z] = zero_of_guard(guards, i)


@compiled
def put_jumps_right(m, h):
    """After the zones have switched: what is asked of the rows of machines that have, by their jumps."""
    contacts = m.stepping.contacts
    find_limits(m.events.guards, contacts)
    if any_falls(m.problem, contacts):
        ask_of_rows(m, h)
    note_kinds(m.events.guards, contacts, m.events.settling.passes == 1 and m.stepping.rule.gap > 0.0)


@compiled
def any_falls(problem, contacts):
    """True if the friction of a machine that has switched falls as it lets go: no other law jumps in its row."""
    falls, at = indices(problem.at_falls, problem.n_machines), reals(contacts.at_jump_at, contacts.n_machines)
    found = False
    for z in range(problem.n_machines):
        found = found or (falls[z] == 1 and at[z] != STAYED)
    return found


@compiled
def ask_of_rows(m, h):
    """Of the rows of those whose friction falls, by f at both ends; nothing is asked of others."""
    problem, point, contacts, rule = m.problem, m.point, m.stepping.contacts, m.stepping.rule
    n = problem.n
    holder, at = indices(problem.at_holder, n), reals(contacts.at_jump_at, contacts.n_machines)
    jumped, falls = indices(contacts.at_jumped, contacts.n_machines), indices(problem.at_falls, problem.n_machines)
    field_at(problem.call_forces, (problem.context, point.t, point.at_y, point.at_x))
    field_at(problem.call_forces, (problem.context, point.t + h, point.at_y_end, point.at_f))
    problem.rhs += 2
    f_start, f_end, weight = reals(point.at_x, n), reals(point.at_f, n), reals(m.linear.factors.at_column_scale, n)
    kick, first, second = reals(rule.at_kick, n), reals(rule.at_kick_first, n), reals(rule.at_kick_second, n)
    for k in range(n):
        z = holder[k]
        if z < 0 or at[z] == STAYED or falls[z] == 0:
            continue
        s, jump = max((at[z] * (rule.gap + 0.5 * h) - rule.gap) / h, EARLIEST), 0.0
        if at[z] != NO_LIMIT:
            jump = f_start[k] + at[z] * (f_end[k] - f_start[k])
        if abs(jump) > weight[k]:
            jumped[z] = 1
        else:
            jump = 0.0
        kick[k] = s * jump
        first[k] = -12.0 * s * s * jump
        second[k] = 2.0 * s * (3.0 * s - 1.0) * jump


@compiled
def note_kinds(guards, contacts, sure):
    """Of which kinds laws jump; if `sure`, also which guards need not be asked again in the zone in which they fired.

    Later passes of a step are sure of jumps only: guesses follow from what is continuous (slip_fronts.py), and are good
    for what lets go by itself.
    """
    n = guards.n_guards
    suspects, machine = indices(contacts.at_suspects, n), indices(guards.at_guard_machine, n)
    known, old = indices(contacts.at_continuous, n), indices(contacts.at_zones_probed, contacts.n_machines)
    at, jumped = reals(contacts.at_jump_at, contacts.n_machines), indices(contacts.at_jumped, contacts.n_machines)
    for k in range(contacts.n_suspects):
        z = machine[suspects[k]]
        if z >= 0 and at[z] >= 0.0 and (sure or jumped[z] == 1):
            note_kind(contacts, z, jumped[z] == 1)
            if jumped[z] == 0:
                known[suspects[k]] = old[z] + 1
    for z in range(contacts.n_machines):
        jumped[z] = 0


@compiled
def doubt_captures(m, h):
    """Leave out of `fired` slips, of contacts whose friction falls, that the end will not have as it is moved."""
    problem, point, guards, rule = m.problem, m.point, m.events.guards, m.stepping.rule
    if rule.damps == 0 or rule.theta_now != MIDDLE or not any_doubtful(problem, guards, m.stepping):
        return
    y_end, kept = reals(point.at_y_end, point.n), reals(rule.at_chord_end, point.n)
    copy(y_end, kept)
    move_by_error(problem, point, m.linear, m.stepping, h)
    evaluate_guards(problem, m.run, guards, point.t + h, point.at_y_end, guards.at_g_probe)
    copy(kept, y_end)
    fired, g = indices(guards.at_fired, guards.n_guards), reals(guards.at_g_probe, guards.n_guards)
    tolerance, count = reals(guards.at_guard_tolerance, guards.n_guards), 0
    for k in range(guards.n_fired):
        i = fired[k]
        if g[i] > tolerance[i] or not is_doubtful(problem, guards, m.stepping, i):
            fired[count] = i
            count += 1
    guards.n_fired = count


@compiled
def any_doubtful(problem, guards, stepping):
    """True if one of the guards in `fired` is doubtful (`is_doubtful`)."""
    fired, found = indices(guards.at_fired, guards.n_guards), False
    for k in range(guards.n_fired):
        found = found or is_doubtful(problem, guards, stepping, fired[k])
    return found


@compiled
def is_doubtful(problem, guards, stepping, i):
    """True if guard i is the slip of a contact whose friction falls as it lets go."""
    z, contacts = indices(guards.at_guard_machine, guards.n_guards)[i], stepping.contacts
    if z < 0 or indices(contacts.at_limit_guard, guards.n_guards)[i] == 1:
        return False
    falls = indices(problem.at_falls, problem.n_machines)[z] == 1
    return falls and indices(contacts.at_hold_row, problem.n_machines)[z] >= 0
