"""A step of `stepping` in the zones of its start, cut at the first switch inside: while there are few machines.

What a switch inside a step makes wrong is written in docs/stepping.md. A step that ends at the switch has none of it,
and costs a settlement. So steps of the same rule (theta_step.py, third_order.py) are taken with frozen zones, guards
are judged on the dense output as `rodas` judges them (crossing.py), and what fires is settled.

    forces     means over the step, so those of its middle; at its end the line through this middle and the one
               before says what they are, and between its ends a straight line
    error      the third difference of all differential unknowns, speeds among them; of a force that holds the bend
    energy     from the states at the nodes of Gauss (meters.py)
"""

from __future__ import annotations

from fairlead.integrate.codes import BEFORE, SETTLE
from fairlead.integrate.controller import weigh, weighted_norm
from fairlead.integrate.crossing import COMPANION, CROSSING, first_crossing
from fairlead.integrate.foreign import compiled, field_at, indices, reals
from fairlead.integrate.linear import add_mass_times, solve
from fairlead.integrate.pace import DOUBT, smallest_step
from fairlead.integrate.record import write_row
from fairlead.integrate.release import remember
from fairlead.integrate.rows_between import STIFF, take_slip_away
from fairlead.integrate.settling import all_fall, begin_settling

CAREFUL = 10.0
"""A step is allowed a tenth of a weight: errors of one sign add up, and energy is to be right to ten accuracies of what
passed. With one weight one in ten random networks of springs missed that (tests/hard, random networks)."""
HOLD_SHARE = 0.025
"""Share of the bend of a holding force that counts as its error."""
LITTLE = 0.1
"""Weights of a force that the stop of a slip that counts as none may seem to be."""
FOLLOWED = 0.1
"""Share of the way to the balance that is left as error where it was gone."""
JUDGED, ACCEPTED, CUT = 0, 1, 2


@compiled
def stops_little(m):
    """True if contacts that hold begin the step with a slip that counts as none: it is taken away, by an impulse.

    A step would take it away by a mean force m v/h, which says nothing about what holds.
    """
    if m.call_drift == 0:
        return False
    slip, holder = reals(m.at_residual, m.n), indices(m.at_holder, m.n)
    holds, weight, inertia = indices(m.at_holds, m.n), reals(m.at_weight, m.n), reals(m.at_held_inertia, m.n_zones)
    field_at(m.call_drift, (m.context, m.t, m.at_y, m.at_residual))
    weigh(m, m.at_y)
    found = False
    for k in range(m.n):
        if holds[k] == 1 and holder[k] >= 0:
            found = found or inertia[holder[k]] * abs(slip[k]) > LITTLE * m.h * weight[k]
    if found:
        take_slip_away(m, m.t, m.at_y)
        m.n_fired = 0
    return found


@compiled
def error_of_located(m, h):
    """Size of the error of a step in weights, from the differences in `error_vector` and the slopes of forces."""
    error, slope, before = reals(m.at_error_vector, m.n), reals(m.at_mean_slope, m.n), reals(m.at_slope_before, m.n)
    holds, differential = indices(m.at_holds, m.n), indices(m.at_differential, m.n)
    for k in range(m.n):
        if holds[k] == 1 and differential[k] == 0:
            error[k] = HOLD_SHARE * h * (slope[k] - before[k])
    return CAREFUL * weighted_norm(m, m.at_error_vector)


@compiled
def balance_end(m, h):
    """Put what follows at once where the laws of the end balance; the error, in weights, of what may follow in a step.

    Algebraic unknowns are on the line through this middle and the one before, and an unknown with a stiff law rings
    about its balance by a third of the bend of what it follows. The residual f - M y' at the end, through the factors
    of the step, says how far they are off; y' there is the mean slope and half the change from the one before.
    """
    n = m.n
    y_end, slope, before = reals(m.at_y_end, n), reals(m.at_mean_slope, n), reals(m.at_slope_before, n)
    b, v, error = reals(m.at_b, n), reals(m.at_v, n), reals(m.at_error_vector, n)
    differential, holds, watched = indices(m.at_differential, n), indices(m.at_holds, n), indices(m.at_watched, n)
    ahead = 0.5 * h / (m.gap + 0.5 * h)
    for k in range(n):
        v[k] = -slope[k] - ahead * (slope[k] - before[k]) if differential[k] == 1 else 0.0
        if differential[k] == 0:
            y_end[k] += 0.5 * h * slope[k]
    field_at(m.call_rhs, (m.context, m.t + h, m.at_y_end, m.at_b))
    m.rhs += 1
    add_mass_times(m, m.at_v, m.at_b)
    for k in range(n):
        error[k] = 0.0
        if holds[k] == 1:
            b[k] = 0.0
    solve(m, m.at_b)
    for k in range(n):
        if differential[k] == 0:
            y_end[k] += b[k]
        elif watched[k] == 1:
            error[k] = b[k]
            if follows(m, k, h):
                y_end[k] += b[k]
                error[k] *= FOLLOWED
    return weighted_norm(m, m.at_error_vector)


@compiled
def follows(m, k, h):
    """True if unknown k follows what drives it within the step h."""
    place, mass = indices(m.at_diagonal_slope, m.n)[k], indices(m.at_diagonal_mass, m.n)[k]
    if place < 0 or mass < 0:
        return False
    inertia = reals(m.at_mass, m.n_mass)[mass]
    return -reals(m.at_jacobian, m.n_jacobian)[place] * h > STIFF * inertia > 0.0


@compiled
def remember_middle(m, h):
    """Algebraic unknowns in the middle of a step that is accepted."""
    y, slope, differential = reals(m.at_y, m.n), reals(m.at_mean_slope, m.n), indices(m.at_differential, m.n)
    mean = reals(m.at_mean_before, m.n)
    for k in range(m.n):
        if differential[k] == 0:
            start = y[k] if m.gap == 0.0 else mean[k]
            mean[k] = start + slope[k] * (m.gap + 0.5 * h)


@compiled
def judge_guards(m, h):
    """JUDGED where the point at the start is settled instead, or the step made shorter; else ACCEPTED or CUT."""
    found = first_crossing(m, h)
    if found != COMPANION:
        return CUT if found == CROSSING else ACCEPTED
    m.rejected_companion += 1
    if m.judged == 1 and DOUBT * h >= smallest_step(m) and all_fall(m):
        m.n_fired = 0
        m.h_next = DOUBT * h
        m.retried += 1
        return JUDGED
    settle_start(m)
    return JUDGED


@compiled
def settle_start(m):
    """Settle the point at the start of a step that is given up; guards in `fired` fire."""
    m.companion = 1
    write_row(m, m.t, m.at_y, BEFORE)
    remember(m)
    begin_settling(m)
    m.phase = SETTLE
