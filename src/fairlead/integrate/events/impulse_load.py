"""The load of an impulse: impulses as forces that act for no time, and which of them are rounding.

    force = P / (SHORT T)

T is the time in which the fastest body goes as far as it is from zero, or as the least size of its place that counts
(`nominal`): how long a run lasts says nothing of an impact. So the zones that a law has under an impulse are asked of
it as under any force (impulse_zones.py).
"""

from __future__ import annotations

from math import inf

from fairlead.integrate.memory.foreign import compiled, indices, reals

LIMITED, UNLIMITED = 1, 2
"""What a row that may hold takes: an impulse as small as rounding leaves it, or any."""
SHORT = 1e-12
"""Share of T during which an impulse acts as a force: beside it, all other forces do nothing in that time."""
LEAST_IMPULSE = 1e-10
"""Share of the largest impulse below which one is rounding: that row keeps the force it has."""


@compiled
def load(problem, settling, point):
    """Set `y_probe` to the point under the impulses in b, as forces that act for no time; speeds are those before."""
    n = problem.n
    y, loaded = reals(point.at_y, n), reals(point.at_y_probe, n)
    for k in range(n):
        loaded[k] = y[k]
    load_forces(problem, settling, point)


@compiled
def find_own_time(problem, run, point, settling):
    """Set T, with the speeds before and after u = dV; the span where nothing moves that has a place."""
    n = problem.n
    y, dv, weight = reals(point.at_y, n), reals(point.at_u, n), reals(point.at_weight, n)
    relative, position = reals(point.at_relative, n), indices(problem.at_position_of, n)
    own = run.stop - run.start
    for v in range(n):
        x = position[v]
        if x >= 0 and relative[x] > 0.0:
            fastest = max(abs(y[v]), abs(y[v] + dv[v]))
            if fastest * own * relative[x] > weight[x]:
                own = weight[x] / (relative[x] * fastest)
    settling.own_time = own


@compiled
def load_forces(problem, settling, point):
    """Put the impulses in b into `y_probe` as forces, and the shares of circles whose friction takes one."""
    n = problem.n
    b, loaded, differential = reals(point.at_b, n), reals(point.at_y_probe, n), indices(problem.at_differential, n)
    circle, of_circle = indices(problem.at_circle, n), reals(problem.at_least_share, n)
    force = least_impulse(problem, point)
    find_least_shares(problem, point, force)
    for k in range(n):
        least = force if takes_any(problem, k) else (of_circle[circle[k] - 1] if circle[k] > 0 else inf)
        if differential[k] == 0 and abs(b[k]) > least:
            loaded[k] = b[k] / (SHORT * settling.own_time)


@compiled
def least_impulse(problem, point):
    """The impulse below which one is rounding."""
    b, takes, largest = reals(point.at_b, problem.n), indices(problem.at_takes_impulse, problem.n), 0.0
    for k in range(problem.n):
        if takes[k] > 0:
            largest = max(largest, abs(b[k]))
    return LEAST_IMPULSE * largest


@compiled
def find_least_shares(problem, point, least):
    """Set `least_share`: by circle, below what its shares are rounding; all are, where no friction takes an impulse.

    `least` is the impulse below which one is rounding.
    """
    n = problem.n
    b, circle, takes = reals(point.at_b, n), indices(problem.at_circle, n), indices(problem.at_takes_impulse, n)
    of_circle = reals(problem.at_least_share, n)
    for k in range(n):
        of_circle[k] = inf
    for k in range(n):
        if circle[k] > 0 and takes[k] == LIMITED and abs(b[k]) > least:
            of_circle[circle[k] - 1] = 0.0
    for k in range(n):
        if circle[k] > 0 and takes[k] == 0 and of_circle[circle[k] - 1] < inf:
            of_circle[circle[k] - 1] = max(of_circle[circle[k] - 1], LEAST_IMPULSE * abs(b[k]))


@compiled
def takes_any(problem, k):
    """True if row k may take an impulse."""
    return indices(problem.at_takes_impulse, problem.n)[k] > 0
