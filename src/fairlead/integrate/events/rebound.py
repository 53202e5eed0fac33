"""Rebound: what an impact gives back, by Moreau's law with one coefficient for all that takes part.

    v+ = v- + (1 + e) dV        dV of the impact without rebound (impulse.py); all impulses grow by 1 + e

Bodies that an impulse joins take part in one impact. Its e is the least of the stops that meet in it; stops that
touched before, and links, have none of their own. So no kinetic energy is created, however many impacts an instant has
and whatever is redundant: with D = dV M dV

    kinetic energy lost = (1 - e^2) D / 2 >= 0        (Moreau, Unilateral contact and dry friction, 1988, section 8)

Several coefficients in one impact have no such proof (Newton's law may create energy then), which is why the least is
taken. A stop that meets parts again at e times the speed; one that touched before, and links, stay at rest. A rebound
below the error weights is none: a ball comes to rest. Friction under an impulsive normal force would be thrown back
along the surface by this law; that is refused.

Stops that an impulse joins take it together, and give it back together. One after the other they would pass it on,
each with a rebound of its own, and may end elsewhere: neither order is more right than the other, where nothing tells
which is first. A rebound below the error weights leaves a stop that touches and would have parted; a gap within the
tolerance of a guard is none. `note_joined` keeps who took an impulse so.
"""

from __future__ import annotations

from fairlead.integrate.events.impulse_load import LIMITED, UNLIMITED
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.controller import weighted_norm

OPEN = 2.0
"""The coefficient of what nothing meets; larger than any."""
NO_REBOUND, REBOUND, RUBS = 0, 1, 2
REST = 10.0
"""Rebound, in error weights, below which there is none."""
KNOWN = 1.0
"""Rebound, in error weights, above which it is more than its error."""
SLIP_ROUNDING = 1e-9
"""Share of the largest slip of an instant below which a row did not meet, but held: that much is rounding."""


@compiled
def find_rebound(problem, point, matrices, floor):
    """Set `y_probe` = e of every unknown, and say whether anything rebounds; RUBS if friction takes part in that.

    b holds dV and P, u holds dV, v the slip that is taken, of which rounding is struck out; `floor` is the least
    impulse that counts.
    """
    n = problem.n
    b, r, e = reals(point.at_b, n), reals(point.at_v, n), reals(point.at_y_probe, n)
    given, takes = reals(problem.at_rebound, n), indices(problem.at_takes_impulse, n)
    some, most = False, 0.0
    for k in range(n):
        most = max(most, abs(r[k])) if takes[k] == UNLIMITED else most
    for k in range(n):
        e[k] = OPEN
        if takes[k] == UNLIMITED and abs(r[k]) <= SLIP_ROUNDING * most:
            r[k] = 0.0
        elif takes[k] == UNLIMITED and abs(b[k]) > floor:
            e[k] = given[k]
            some = some or given[k] > 0.0
    if not some:
        return NO_REBOUND
    while spread(problem, point, matrices, floor, point.at_y_probe, False):
        pass
    dv, back = reals(point.at_u, n), reals(point.at_x, n)
    rubs = False
    for k in range(n):
        if e[k] == OPEN:
            e[k] = 0.0
        back[k] = e[k] * dv[k]
        rubs = rubs or (takes[k] == LIMITED and abs(b[k]) > floor and e[k] > 0.0)
    size = weighted_norm(point, point.at_x)
    note(problem, point, floor, size)
    if size <= REST:
        return NO_REBOUND
    return RUBS if rubs else REBOUND


@compiled
def note(problem, point, floor, size):
    """Keep the slip of rows that give nothing back though the rebound is above its error, unless they did before."""
    n = problem.n
    b, r, e = reals(point.at_b, n), reals(point.at_v, n), reals(point.at_y_probe, n)
    takes, kept = indices(problem.at_takes_impulse, n), reals(point.at_not_given_back, n)
    for k in range(n):
        if takes[k] == UNLIMITED and r[k] != 0.0 and e[k] > 0.0 and abs(b[k]) > floor:
            if size <= REST and size > KNOWN and kept[k] >= 0.0:
                kept[k] = max(kept[k], abs(r[k]))
            elif size > REST and kept[k] == 0.0:
                kept[k] = -1.0


@compiled
def note_joined(problem, point, matrices, floor):
    """Count, for stops that give something back, the impulses that they took together, and keep when the first was."""
    n = problem.n
    b, label, many = reals(point.at_b, n), reals(point.at_x, n), reals(point.at_f, n)
    given, takes = reals(problem.at_rebound, n), indices(problem.at_takes_impulse, n)
    times, first = reals(point.at_joined, n), reals(point.at_first_joined, n)
    for k in range(n):
        label[k], many[k] = float(k), 0.0
    while spread(problem, point, matrices, floor, point.at_x, True):
        pass
    for k in range(n):
        if takes[k] == UNLIMITED and given[k] > 0.0 and abs(b[k]) > floor:
            many[int(label[k])] += 1.0
    for k in range(n):
        if takes[k] == UNLIMITED and given[k] > 0.0 and abs(b[k]) > floor and many[int(label[k])] > 1.0:
            first[k] = point.t if times[k] == 0.0 else first[k]
            times[k] += 1.0


@compiled
def spread(problem, point, matrices, floor, at_least, by_rest):
    """Give the least of these numbers to all that an impulse or an inertia joins; True if any changed.

    `by_rest`: also by a body whose speed does not change, as one that is struck from both sides.
    """
    n = problem.n
    e, b, dv = reals(at_least, n), reals(point.at_b, n), reals(point.at_u, n)
    takes, differential = indices(problem.at_takes_impulse, n), indices(problem.at_differential, n)
    starts, rows = indices(matrices.at_jacobian_starts, n + 1), indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    values, speed_of = reals(matrices.at_jacobian, matrices.n_jacobian), indices(problem.at_speed_of, n)
    changed = False
    for k in range(n):
        if takes[k] > 0 and abs(b[k]) > floor:
            for p in range(starts[k], starts[k + 1]):
                i = speed_of[rows[p]]
                joined = by_rest or dv[i] != 0.0 if differential[i] == 1 else takes[i] > 0 and abs(b[i]) > floor
                if joined and values[p] != 0.0 and e[i] != e[k]:
                    e[i] = e[k] = min(e[i], e[k])
                    changed = True
    mass, i_of = reals(matrices.at_mass, matrices.n_mass), indices(matrices.at_mass_rows, matrices.n_mass)
    j_of = indices(matrices.at_mass_columns, matrices.n_mass)
    for p in range(matrices.n_mass):
        i, j = i_of[p], j_of[p]
        moves = by_rest or (dv[i] != 0.0 and dv[j] != 0.0)
        if mass[p] != 0.0 and differential[i] == 1 and moves and e[i] != e[j]:
            e[i] = e[j] = min(e[i], e[j])
            changed = True
    return changed
