"""The impulse that a switch inside a step misses: where the switch is (`t_cut`), and whether its error counts.

A step has the zones of its end for all of it. The place s h of a switch in it is that of its guard's zero between the
start and the end the step would have without it. The speed is wrong by what is missed, from then on. A step that ends
at the switch misses nothing, so where the error counts the step is taken again up to there.

    turned round    A contact that slid with the force F, and whose slip comes to zero, ends the step held or sliding
                    the other way, under a mean force p. Had it turned, the mean would be F s - F (1 - s). Where that
                    lies beyond p, seen from F, the contact cannot have held: more than F pulls, and h times the
                    difference is missed.
    another force   A law without a force of its own among the unknowns (a stop, a rope, a contact that binds, a relay
                    that commands a motor) says other forces after the switch. Straight on either side of s, it misses
                    h s (f_old - f_new)/2, both at the start of the step; one that jumps misses twice that, also in the
                    first hundredth of the step, where a continuous one misses nothing that counts.
    a latch         A part that only tells signals and remembers that it switched (a relay, a state machine) counts
                    always: when it switched is what one asks of it. Just before that the step is settled, and steps end
                    at the next switch (repeated.find_latch_ahead).

Laws that jump are in jump_at_end.py and jump_inside.py, what has risen and fallen again by the end of a step in
passed_over.py. `find_missed_impulse` leaves the place in `t_cut`, and that of a kink in `t_kink`; what it asks returns
a share of the step, 1 where nothing is found. The unknown that is due to it goes to `worst`.

The log (`log_inside`) has each machine at its instant, in the order of these. The zones of a step are those of its end,
and its motion knows no instants. Guards do: the zero of one on the chord of the step, or of the limit of a force on the
line through the middles of two steps, is right to order two. A contact that was let go because others around it were
(slip_fronts.py) has no guard above zero; its load is followed from the two middles before.
"""

from __future__ import annotations

from fairlead.integrate.events.settling import log_change
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.point.controller import smallest_step
from fairlead.integrate.stepping.jump_at_end import zero_of_guard
from fairlead.integrate.stepping.other_zones import forces_before_switches, state_off
from fairlead.integrate.stepping.response import error_of_speed

AT_ONCE = 1e-2
"""A switch within this share s of a step happens at its start. A turn misses (a - b) s h, a hundredth of what one
misses at the end; a stop (k u h^2/2m) s^2, a ten-thousandth. The chord does not tell the place more closely."""
SHORT_OF = AT_ONCE
"""Share of a step by which it ends short of a stop or a rope: right there no zone is the right one, and they cycle.
What is left of the way counts as none in the next step."""
NOT_SEEN = 2.0
"""As the share of a step after which a machine left its zone: no guard of it was above zero."""
NOTHING = 1e-6
"""Share of a step so near its start that what follows a table there by a stiff law has no difference to follow. At a
thousandth the speeds of line on the two pieces of a drum's radius differ by 1e-5 m/s, which a bond of 1e9 N s/m shows
as 10 kN; at a millionth as 10 N."""


@compiled
def forget_switches(contacts):
    """Before a step: nothing has switched in it."""
    switched = indices(contacts.at_switched, contacts.n_machines)
    after = reals(contacts.at_switched_after, contacts.n_machines)
    reals(contacts.at_left_at, contacts.n_machines)[:] = NOT_SEEN
    for k in range(contacts.n_switched):
        after[switched[k]] = 0.0
    contacts.n_switched = 0


@compiled
def note_switches(guards, stepping, h):
    """Of the machines whose guards are in `fired` those that leave their zone for the first time, and when.

    A force is at its limit where the line through the middles of two steps has it there: that only tells the instant.
    """
    exchange, contacts = stepping.exchange, stepping.contacts
    fired, machine, hold_row = (
        indices(guards.at_fired, guards.n_guards), indices(guards.at_guard_machine, guards.n_guards),
        indices(contacts.at_hold_row, exchange.n_machines),
    )  # fmt: skip
    zones, before, holds = (
        indices(exchange.at_zones, exchange.n_machines), indices(contacts.at_zones_at_start, exchange.n_machines),
        indices(exchange.at_holds, exchange.n),
    )  # fmt: skip
    switched = indices(contacts.at_switched, exchange.n_machines)
    after = reals(contacts.at_switched_after, exchange.n_machines)
    left = reals(contacts.at_left_at, exchange.n_machines)
    limit, gap = indices(contacts.at_limit_guard, guards.n_guards), stepping.rule.gap / h
    for k in range(guards.n_fired):
        i, z = fired[k], machine[fired[k]]
        if z < 0 or after[z] > 0.0 or zones[z] != before[z]:
            continue
        s = zero_of_guard(guards, i)
        left[z] = min(left[z], max(s * (gap + 0.5) - gap, 0.0) if limit[i] == 1 else s)
        if hold_row[z] >= 0 and holds[hold_row[z]] == 1:
            continue
        if 0.0 < s < 1.0:
            switched[contacts.n_switched] = z
            after[z] = s
            contacts.n_switched += 1


@compiled
def find_missed_impulse(m, h):
    """True if a switch inside the step makes an error that counts; where the step should end, in `t_cut`."""
    point, rule = m.point, m.stepping.rule
    turn = find_turn(point, m.linear.matrices, m.stepping.contacts, h)
    other, kink = find_other_force(m, h)
    first = min(turn, other)
    rule.t_cut = point.t + first * h
    if other <= turn and kink < 1.0:
        rule.t_kink = point.t + kink * h
        if kink < AT_ONCE:
            rule.t_cut = point.t + 2.0 * kink * h
    return first < 1.0


@compiled
def find_turn(point, matrices, contacts, h):
    """The share of the step after which a slip turned round, of the first whose error counts; 1 without one."""
    switched = indices(contacts.at_switched, contacts.n_machines)
    after = reals(contacts.at_switched_after, contacts.n_machines)
    hold_row = indices(contacts.at_hold_row, contacts.n_machines)
    inertia = reals(contacts.at_held_inertia, contacts.n_machines)
    y, y_end = reals(point.at_y, point.n), reals(point.at_y_end, point.n)
    first = 1.0
    for k in range(contacts.n_switched):
        z = switched[k]
        s = after[z]
        if hold_row[z] < 0 or inertia[z] <= 0.0 or s >= first or s < AT_ONCE:
            continue
        force, mean = y[hold_row[z]], y_end[hold_row[z]]
        missed = force * (2.0 * s - 1.0) - mean
        if missed * force > 0.0 and error_of_speed(point, matrices, contacts, h, z, 2.0 * abs(missed), h) > 1.0:
            first = s
            point.worst = hold_row[z]
    return first


@compiled
def find_kink(stepping):
    """The share of the step after which a table first went on in its next piece; 1 without one.

    A step that goes over a kink on purpose (trial.step_over_kink) has none, for it is implicit.
    """
    contacts = stepping.contacts
    switched = indices(contacts.at_switched, contacts.n_machines)
    after = reals(contacts.at_switched_after, contacts.n_machines)
    hold_row = indices(contacts.at_hold_row, contacts.n_machines)
    kinks = indices(contacts.at_only_kinks, contacts.n_machines)
    first = 1.0
    for k in range(contacts.n_switched):
        z = switched[k]
        if hold_row[z] < 0 and kinks[z] == 1 and stepping.rule.theta_now < 1.0 and after[z] >= NOTHING:
            first = min(first, after[z])
    return first


@compiled
def find_other_force(m, h):
    """The share of the step after which a law without a force of its own first switched, if the error counts; or 1.

    And the place of that switch if it is the kink of a table, else 1.
    """
    contacts, kink = m.stepping.contacts, find_kink(m.stepping)
    first, last = free_switches(contacts, AT_ONCE, 1.0)
    if kink < 1.0:
        first, last = min(first, kink), max(last, kink)
    if last > 0.0:
        forces_before_switches(m.problem, m.point, contacts, 1.0)
        off = state_off(m, h, last * h, 2.0)
        if off >= 0 or latch_switched(contacts, 1.0):
            m.point.worst = off
            return (1.0 - SHORT_OF) * first, kink if first == kink else 1.0
    first, last = free_switches(contacts, 0.0, AT_ONCE)
    if last > 0.0 and first * h > smallest_step(m.run, m.point):
        forces_before_switches(m.problem, m.point, contacts, AT_ONCE)
        off = state_off(m, h, last * h, 1.0)
        if off >= 0:
            m.point.worst = off
            return (1.0 - SHORT_OF) * first, 1.0
    return 1.0, 1.0


@compiled
def free_switches(contacts, least, most):
    """Between which shares of the step, from `least` to `most`, machines that hold no row switched; (1, 0): none."""
    nz = contacts.n_machines
    switched, after = indices(contacts.at_switched, nz), reals(contacts.at_switched_after, nz)
    hold_row = indices(contacts.at_hold_row, nz)
    first, last = 1.0, 0.0
    for k in range(contacts.n_switched):
        s = after[switched[k]]
        if hold_row[switched[k]] < 0 and least <= s < most:
            first, last = min(first, s), max(last, s)
    return first, last


@compiled
def latch_switched(contacts, most):
    """True if a part that only tells signals and remembers, as a relay, switched before this share of the step."""
    nz = contacts.n_machines
    switched, after = indices(contacts.at_switched, nz), reals(contacts.at_switched_after, nz)
    latches, found = indices(contacts.at_latches, nz), False
    for k in range(contacts.n_switched):
        found = found or (latches[switched[k]] == 1 and after[switched[k]] < most)
    return found


@compiled
def log_inside(m):
    """Write the events of machines that changed in the step."""
    point, settling, contacts = m.point, m.events.settling, m.stepping.contacts
    nz, start = settling.n_machines, m.point.t
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    left, in_order, count = reals(contacts.at_left_at, nz), indices(contacts.at_in_order, nz), 0
    copy(indices(contacts.at_zones_at_start, nz), before)
    m.events.guards.n_fired = 0
    settling.passes = 0
    for z in range(nz):
        if zones[z] != before[z]:
            if left[z] == NOT_SEEN:
                left[z] = load_at_limit(m.run, m.events.guards, m.stepping, z)
            k = count
            while k > 0 and left[in_order[k - 1]] > left[z]:
                in_order[k] = in_order[k - 1]
                k -= 1
            in_order[k] = z
            count += 1
    for k in range(count):
        z = in_order[k]
        point.t = start + left[z] * (m.run.t_piece - start)
        log_change(m, z)
    point.t = start


@compiled
def load_at_limit(run, guards, stepping, z):
    """The share of the step after which the force of machine z is at its limit as its load went before; 1: never."""
    rule, contacts = stepping.rule, stepping.contacts
    machine, limit = indices(guards.at_guard_machine, guards.n_guards), indices(guards.at_limit_guard, guards.n_guards)
    g, earlier = reals(guards.at_g, guards.n_guards), reals(contacts.at_g_before, guards.n_guards)
    first, i = 1.0, indices(contacts.at_first_guard, contacts.n_machines)[z]
    while rule.gap > 0.0 and 0 <= i < guards.n_guards and machine[i] == z:
        if limit[i] == 1 and g[i] > earlier[i]:
            to_limit = -g[i] * rule.gap_before / (g[i] - earlier[i])
            first = min(first, max(to_limit - rule.gap, 0.0) / run.h)
        i += 1
    return first
