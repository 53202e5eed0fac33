"""Rows inside a step of the stepping engine show its end zones: what holds at the end is shown without slip.

It would else seem to creep: a body that is caught in the step has a slip at its start, bodies that hold on to each
other have parabolas of their own, and one that is carried along has another than the surface, which follows its law.
A rope or a stop that came into force inside the step is shown in the zone it had before as long as a guard of its end
zone says so (`zones_inside`).

The slip r of held contacts, whatever network they form, is taken away by an impulse spread over the step,

    (M/(h theta) - J) (dv, Lambda) = r/(h theta)    r = -slip in the rows that hold

with the factors the step has left; dv is added, Lambda dropped. Where surfaces keep their speed that was done for the
whole step at its end (stepping/dense_output.py), else it is done in every row.
"""

from __future__ import annotations

from fairlead.integrate.linear.products import add_mass_times
from fairlead.integrate.linear.systems import solve, solve_motion
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.point.stiff import FURTHEST, OF_BALANCES

MOST_MOVES = 12
"""Moves behind the first, at most. Where laws are linear one is enough; a flow through orifices that turns round, whose
slope changes many times on the way, took no more than this on `rodas` and `stepping` (test_shown_in_balance.py)."""
MOST_FURTHER = 6
"""Moves that each go FURTHEST times as far as the one before, at most: a law a millionth as stiff is none."""
LAST_MOVE = 1e-6
"""Share of the first move that the last one may have: what is left of the error of an unknown that was to be shown in
balance, and of what flows."""
SHOWN_ROUNDING = 32 * 2.2e-16
"""What is moved by less than this share of its scale, the weight by its relative part, is moved by rounding."""


@compiled
def zones_inside(m, t, at_y):
    """Put laws without a force of their own that switched in the step in the zone they have at (t, y) inside it.

    The zone of the end, unless a guard of it is above zero there: then that of the start. A rope that came taut later
    would else push. `zones_probed` keeps the zones of the end (`zones_of_end`).
    """
    problem, guards, contacts = m.problem, m.events.guards, m.stepping.contacts
    zones = indices(problem.at_zones, problem.n_machines)
    before = indices(contacts.at_zones_at_start, problem.n_machines)
    hold_row = indices(contacts.at_hold_row, problem.n_machines)
    first = indices(contacts.at_first_guard, problem.n_machines)
    switched, g = indices(contacts.at_switched, problem.n_machines), reals(guards.at_g_probe, guards.n_guards)
    machine = indices(problem.at_guard_machine, guards.n_guards)
    copy(zones, indices(contacts.at_zones_probed, problem.n_machines))
    field_at(problem.call_guards, (problem.context, t, at_y, guards.at_g_probe))
    problem.guards += 1
    for k in range(contacts.n_switched):
        z = switched[k]
        i = first[z]
        while hold_row[z] < 0 and i < guards.n_guards and machine[i] == z:
            if g[i] > 0.0:
                zones[z] = before[z]
            i += 1


@compiled
def zones_of_end(problem, contacts):
    """Take back what `zones_inside` did."""
    copy(indices(contacts.at_zones_probed, problem.n_machines), indices(problem.at_zones, problem.n_machines))


@compiled
def take_slip_away(problem, point, linear, exchange, t, at_y):
    """Correct the speeds at (t, y) by the slip of contacts that hold."""
    field_at(problem.call_drift, (problem.context, t, at_y, point.at_minus_slip))
    remove_slip(point, linear, exchange, at_y)


@compiled
def remove_slip(point, linear, exchange, at_v):
    """Add to the speeds in v what takes away the slip in `minus_slip`, in rows that hold."""
    factors = linear.factors
    row, holds = indices(exchange.at_hold_mass_row, exchange.n_hold_mass), indices(exchange.at_holds, point.n)
    minus_slip, b, found = reals(point.at_minus_slip, point.n), reals(point.at_b, point.n), False
    for k in range(point.n):
        b[k] = 0.0
    for e in range(exchange.n_hold_mass):
        if holds[row[e]] == 1 and minus_slip[row[e]] != 0.0:
            b[row[e]] = minus_slip[row[e]] * factors.mass_factor
            found = True
    if not found:
        return
    solve(linear, point.at_b)
    v, speeds = reals(at_v, point.n), indices(exchange.at_hold_mass_column, exchange.n_hold_mass)
    for e in range(exchange.n_hold_mass):
        v[speeds[e]] += b[speeds[e]]
        b[speeds[e]] = 0.0


@compiled
def balance_stiff(m, t, s, at_y):
    """Give unknowns in y that follow a stiff law, at s of the step, the values at which it balances: f(y) = M y'.

    The midpoint rule leaves a third of a difference ringing in them, and the dense output inside a step knows
    nothing of the law: nothing as a speed, and much as a force. y' is that of the dense output, and what moves by d
    gains r d in it, with W = r M - J: bodies that follow each other would else show the error of their acceleration.
    How far to go along the move that the factors of the step give follows from the residuals before and after it. What
    has no inertia is moved together, and further (`balance_on`). A move is that of all bodies, also of those that do
    not follow within the step: a light one beside them balances where they are.
    """
    problem, point = m.problem, m.point
    n, per_step, gain = problem.n, 1.0 / m.run.h, m.linear.factors.mass_factor
    start, end, D, y = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_D, 3 * n), reals(at_y, n)
    f, minus_rate, move, inert, before = (
        reals(point.at_f, n), reals(point.at_v, n), reals(point.at_b, n), reals(point.at_x, n),
        reals(point.at_u, n),
    )  # fmt: skip
    stiff, differential = indices(m.recorder.at_is_stiff, n), indices(problem.at_differential, n)
    weight, relative = reals(point.at_weight, n), reals(point.at_relative, n)
    position = indices(problem.at_position_of, n)
    for k in range(n):
        inner = D[k] + s * (D[n + k] + s * D[2 * n + k])
        inner_slope = D[n + k] + 2.0 * s * D[2 * n + k]
        slope = end[k] - start[k] + (1.0 - 2.0 * s) * inner + s * (1.0 - s) * inner_slope
        minus_rate[k] = -slope * per_step if differential[k] == 1 else 0.0
        inert[k] = 0.0
    add_mass_times(m.linear.matrices, point.at_v, point.at_x)
    field_at(problem.call_forces, (problem.context, t, at_y, point.at_f))
    for k in range(n):
        move[k] = f[k] + inert[k] if stiff[k] == 1 else 0.0
    copy(move, before)
    solve_motion(m.linear, point.at_b)
    for k in range(n):
        inert[k] = 0.0
        if stiff[k] == 1 or position[k] >= 0:
            y[k] += move[k]
            minus_rate[k] -= gain * move[k]
        if stiff[k] == 1 and differential[k] == 0:
            before[k] = move[k]
    add_mass_times(m.linear.matrices, point.at_v, point.at_x)
    field_at(problem.call_forces, (problem.context, t, at_y, point.at_f))
    problem.rhs += 2
    further = False
    for k in range(n):
        mine = stiff[k] == 1 and differential[k] == 1
        left = f[k] + inert[k]
        gone = before[k] - left
        if mine and before[k] * gone > 0.0:
            share = before[k] / gone
            if share > FURTHEST and abs(move[k]) * relative[k] <= SHOWN_ROUNDING * weight[k]:
                share = 1.0
            further = further or share > FURTHEST
            move[k] = (min(share, FURTHEST) - 1.0) * move[k]
            before[k] = left if share > FURTHEST else 0.0
            y[k] += move[k]
        elif mine:
            y[k] -= move[k]
            before[k] = move[k] = 0.0
        else:
            move[k] = 0.0
    if further:
        go_further(m, t, at_y, gain)
    if m.recorder.any_stiff == OF_BALANCES:
        balance_on(m, t, at_y)


@compiled
def go_further(m, t, at_y, gain):
    """Move speeds in y on whose laws have become weaker by orders than the factors of the step have them.

    Where a line leaves a drum its bond falls from 1e9 N s/m to nothing within a step, and what it carries stays. `move`
    is the last move and `before` what was left over before it, zero for speeds that are there. Each move tells the
    slope to the next one, which goes at most FURTHEST times as far.
    """
    problem, point = m.problem, m.point
    n = problem.n
    y, f, minus_rate, move, inert, before = (
        reals(at_y, n), reals(point.at_f, n), reals(point.at_v, n), reals(point.at_b, n), reals(point.at_x, n),
        reals(point.at_u, n),
    )  # fmt: skip
    stiff, differential = indices(m.recorder.at_is_stiff, n), indices(problem.at_differential, n)
    for _ in range(MOST_FURTHER):
        for k in range(n):
            if stiff[k] == 1 and differential[k] == 1:
                minus_rate[k] -= gain * move[k]
            inert[k] = 0.0
        add_mass_times(m.linear.matrices, point.at_v, point.at_x)
        field_at(problem.call_forces, (problem.context, t, at_y, point.at_f))
        problem.rhs += 1
        further = False
        for k in range(n):
            if before[k] == 0.0 or stiff[k] == 0 or differential[k] == 0:
                move[k] = 0.0
                continue
            left = f[k] + inert[k]
            gone = before[k] - left
            share = min(left / gone, FURTHEST) if before[k] * gone > 0.0 else 0.0
            move[k] *= share
            before[k] = left if share == FURTHEST else 0.0
            y[k] += move[k]
            further = further or share == FURTHEST
        if not further:
            break
    for k in range(n):
        move[k] = 0.0


@compiled
def balance_on(m, t, at_y):
    """Further moves of what has no inertia, behind the first, which is in `u`; f are the forces after it.

    Unknowns that depend on each other have residuals that say nothing of one of them. So they are moved together, each
    time by the move d that the factors of the step give, less the part of it that the last two moves tell to be
    overdone or missing (Anderson's method with one move remembered; Walker, Ni, SIAM J. Numer. Anal. 49:1715, 2011),

        y <- y + d - g (s + d - d_before)    g = <d - d_before, d>/|d - d_before|^2,  s the last change of y

    in weights: of one unknown that is the secant method, and where laws are linear the second move is rounding. Where
    they come neither to LAST_MOVE of the first nor to SHOWN_ROUNDING, all are taken back. That is known when a move is
    FURTHEST times the first, or when it leaves the next as it was but for a part in FURTHEST: a law without a slope
    there has no such balance, and where unknowns that follow would have to move no moves of these come to one.
    """
    problem, point = m.problem, m.point
    n = problem.n
    y, f, move, before, change, start, weight, relative = (
        reals(at_y, n), reals(point.at_f, n), reals(point.at_b, n), reals(point.at_u, n), reals(point.at_v, n),
        reals(point.at_x, n), reals(point.at_weight, n), reals(point.at_relative, n),
    )  # fmt: skip
    stiff, differential = indices(m.recorder.at_is_stiff, n), indices(problem.at_differential, n)
    first, done = 0.0, True
    for k in range(n):
        mine = stiff[k] == 1 and differential[k] == 0
        before[k] = before[k] if mine else 0.0
        change[k], start[k] = before[k], y[k] - before[k]
        first += (before[k] / weight[k]) ** 2
        done = done and abs(before[k]) * relative[k] <= SHOWN_ROUNDING * weight[k]
    for pass_ in range(MOST_MOVES if not done else 0):
        if pass_ > 0:
            field_at(problem.call_forces, (problem.context, t, at_y, point.at_f))
            problem.rhs += 1
        for k in range(n):
            move[k] = f[k] if stiff[k] == 1 and differential[k] == 0 else 0.0
        solve_motion(m.linear, point.at_b)
        size, product, square, done = 0.0, 0.0, 0.0, True
        for k in range(n):
            if stiff[k] == 1 and differential[k] == 0:
                now, apart = move[k] / weight[k], (move[k] - before[k]) / weight[k]
                size, product, square = size + now * now, product + now * apart, square + apart * apart
                done = done and abs(now) * relative[k] <= SHOWN_ROUNDING
        done = done or size <= LAST_MOVE * LAST_MOVE * first
        share = product / square if square > 0.0 and not done else 0.0
        if not done and size > FURTHEST * FURTHEST * min(first, square):
            break
        for k in range(n):
            if stiff[k] == 1 and differential[k] == 0:
                step = move[k] - share * (change[k] + move[k] - before[k])
                y[k] += step
                before[k], change[k] = move[k], step
            move[k] = 0.0
        if done:
            break
    for k in range(n):
        if not done and stiff[k] == 1 and differential[k] == 0:
            y[k] = start[k]
