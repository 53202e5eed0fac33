"""The error of one step of `stepping`, in weights.

    mean slopes    k_n of this step; k_n-1 and k_n-2 of the two before: `mean_slope`, `slope_before`, `slope_earlier`
    distances      gap + h/2 from the middle of the step before to that of this one, `gap` being half of the step
                   before (0 after a settlement); `gap_before` between the two middles before. [ ] divides by them
    bulge          h^2/8 times the second derivative [k_n, k_n-1]: how far rows inside are off the chord
    difference     h^3/6 [k_n, k_n-1, k_n-2] = h^3 y'''/12, the error of the midpoint rule
    the largest    of these differences and of what they do not show

Values are known to a few ulps, so that their differences say nothing below what `find_rounding` makes of these. Third
differences of a position of 3000 km are rounding alone in steps of a nanosecond, and a shorter step has no less of it.

The error of the midpoint rule is taken away before (third_order.py): what is controlled is the error of the step
without that, which is more than what is left of it.
With a theta above 1/2 nothing is taken away, and the step misses (theta - 1/2) h^2 y'' besides: that comes on top.
Controlled are all differential unknowns but speeds of bodies that have a position (prepare.controlled); these too
where a step ends at its switch, by located_step.py, which counts ten times the error. A contact that starts
or stops inside a step bends the motion there: the speed at the end of the step is then still right to
order 2, while a difference of accelerations sees a jump; the position it leads to is wrong by order
h^2 times the jump, which is what the difference of speeds says.

What differences do not show: limits that are passed inside (limit_violation.py), and what holds while nothing moves.
"""

from __future__ import annotations

from math import inf, isfinite

from fairlead.integrate.codes import MIDDLE
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.controller import weigh, weighted_norm
from fairlead.integrate.stepping.limit_violation import unseen_force, unseen_slip
from fairlead.integrate.stepping.located_step import add_error_of_forces, error_of_located
from fairlead.integrate.stepping.residual import CHANGE_KNOWN

NOTHING_MOVES = 1e-2
"""Where no position changes by more than this share of its weight, HOLD_SHARE of the second difference of a holding
force counts as its error: what is recorded of a force that swings while nothing moves would else be a few means."""
SHORTEST = 0.25
"""Share of a step that those before it count as, at least, for the rounding of its differences: steps at most double
(history.MOST_GROWTH), so that the two before are half and a quarter of it."""
UNEVEN = 4.0
"""The second derivative c of the parabola that rows inside a step lie on is at most so many times the one before, and
none where it turns round: what is stiff rings at its steps, and a parabola through that shows motions that never were.
The bulge of the parabola is h^2 c/8, the error of the step h^2 (c - c_before)/12. Where c is four times c_before that
is half the bulge, and a larger c then says nothing. It is a bound and no switch: of two neighbours on a line one would
else lie on the parabola and one on the chord, and the force between them would be that difference."""


@compiled
def find_error(m, h):
    """Size of the error of the step in weights, its place in `worst`; leaves slopes and bulges of the step."""
    point, stepping = m.point, m.stepping
    weigh(point, point.at_y_end)
    if not end_is_finite(point):
        return inf - inf
    find_slopes(point, stepping.rule, h)
    find_bulges(point, stepping.rule, h)
    if stepping.rule.locates == 1:
        take_bulges(point)
    find_differences(point, stepping.rule, h)
    if stepping.rule.locates == 1:
        return error_of_located(m, h)
    return error_inside(m, h)


@compiled
def end_is_finite(point):
    """True if all unknowns at the end of the step are finite; else `worst` is the first that is not."""
    y_end, others = reals(point.at_y_end, point.n), 0
    for k in range(point.n):
        others += 0 if abs(y_end[k]) < inf else 1  # no way out of the loop: so it goes by vectors
    if others == 0:
        return True
    for k in range(point.n - 1, -1, -1):
        if not isfinite(y_end[k]):
            point.worst = k
    return False


@compiled
def find_slopes(point, rule, h):
    """Into `mean_slope`: the mean slope of the step; of a mean, as a force is, from the middle before to this one."""
    y, y_end, slope = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(rule.at_mean_slope, point.n)
    differential = indices(point.at_differential, point.n)
    y_is_mean = rule.locates == 0 or rule.gap == 0.0
    mean = y if y_is_mean else reals(rule.at_mean_before, point.n)
    per_step, per_near = 1.0 / h, 1.0 / (rule.gap + 0.5 * h)
    for k in range(point.n):
        slope[k] = (y_end[k] - y[k]) * per_step if differential[k] == 1 else (y_end[k] - mean[k]) * per_near


@compiled
def find_bulges(point, rule, h):
    """Into the first part of `D`: the parabola of the step less its chord, bounded where the step is uneven."""
    n = point.n
    slope, before = reals(rule.at_mean_slope, n), reals(rule.at_slope_before, n)
    earlier = reals(rule.at_slope_earlier, n)
    bulge, differential = reals(point.at_D, n), indices(point.at_differential, n)
    per_near, per_far = 1.0 / (rule.gap + 0.5 * h), 1.0 / rule.gap_before
    for k in range(n):
        curve, curve_before = (slope[k] - before[k]) * per_near, (before[k] - earlier[k]) * per_far
        bounded = curve if abs(curve) <= UNEVEN * abs(curve_before) else UNEVEN * curve_before
        bulge[k] = -0.5 * h * h * bounded if (differential[k] == 1) & (curve * curve_before > 0.0) else 0.0


@compiled
def take_bulges(point):
    """Into the first part of `D` the same where steps end at every switch: a half of e, of which `u` has a twelfth.

    That is the second derivative in the middle of the step, and of what is stiff its filter leaves no more than the
    laws do. The difference of two slopes is that at the start. Where a speed dies away within a step, as of a contact
    that creeps and has just come off its limit, it is many times larger, and rows inside would go beyond both ends.
    """
    bulge, twelfth = reals(point.at_D, point.n), reals(point.at_u, point.n)
    differential, quadrature = indices(point.at_differential, point.n), indices(point.at_quadrature, point.n)
    for k in range(point.n):
        if differential[k] == 1 and quadrature[k] == 0:
            bulge[k] = -6.0 * twelfth[k]


@compiled
def find_differences(point, rule, h):
    """Into `error_vector`: the third difference, and what theta misses, of the unknowns that are controlled."""
    n = point.n
    slope, before = reals(rule.at_mean_slope, n), reals(rule.at_slope_before, n)
    earlier = reals(rule.at_slope_earlier, n)
    error, differential = reals(point.at_error_vector, n), indices(point.at_differential, n)
    controlled, quadrature = indices(rule.at_controlled, n), indices(point.at_quadrature, n)
    near, far, located = rule.gap + 0.5 * h, rule.gap_before, rule.locates == 1
    per_near, per_far = 1.0 / near, 1.0 / far
    third = h * h * h / 6.0 / (near + far)
    second = (rule.theta_now - MIDDLE) * h * h
    known, y_end = find_rounding(rule, third, second, h), reals(point.at_y_end, n)
    for k in range(n):
        curve, curve_before = (slope[k] - before[k]) * per_near, (before[k] - earlier[k]) * per_far
        missed = max(abs(third * (curve - curve_before)) + abs(second * curve) - known * abs(y_end[k]), 0.0)
        judged = (controlled[k] == 1) | (located & (quadrature[k] == 0))
        error[k] = missed if (differential[k] == 1) & judged else 0.0


@compiled
def find_rounding(rule, third, second, h):
    """Share of a value that rounding makes of third [k_n, k_n-1, k_n-2] and second [k_n, k_n-1], at most.

    A slope over a step is known to CHANGE_KNOWN of the value over that step; after a settlement there is none before,
    and after the first step only one: those are slopes at a point. A step before counts as SHORTEST of this one
    at least: of the rounding of a shorter one less is seen if this one is shortened too, so it stays in the error.
    """
    before, near, far = 2.0 * rule.gap, rule.gap + 0.5 * h, rule.gap_before
    earlier = 2.0 * far - before
    slope, slope_before = 1.0 / h, 1.0 / max(before, SHORTEST * h) if before > 0.0 else 0.0
    slope_earlier = 1.0 / max(earlier, SHORTEST * h) if before > 0.0 and earlier > 0.0 else 0.0
    curve, curve_before = (slope + slope_before) / near, (slope_before + slope_earlier) / max(far, SHORTEST * h)
    return CHANGE_KNOWN * (third * (curve + curve_before) + abs(second) * curve)


@compiled
def error_inside(m, h):
    """The largest error of a step with switches inside: of its differences, and of what they do not show."""
    point, stepping, switched = m.point, m.stepping, m.events.settling.passes > 0
    size = weighted_norm(point, point.at_error_vector)
    worst = point.worst
    size = keep_larger(point, size, worst, unseen_slip(point, m.linear.matrices, m.events.guards, stepping, h))
    worst = point.worst
    if switched:
        return keep_larger(point, size, worst, unseen_force(m, h))
    if anything_moves(point, stepping.rule):
        return size
    add_error_of_forces(m, h)
    return keep_larger(point, size, worst, weighted_norm(point, point.at_error_vector))


@compiled
def keep_larger(point, size, worst, other):
    """The larger of two sizes, its place in `worst`, where the second has left its own."""
    if other <= size:
        point.worst = worst
    return max(size, other)


@compiled
def anything_moves(point, rule):
    """True if a controlled unknown changes in the step by more than NOTHING_MOVES of its weight."""
    y, y_end, weight = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_weight, point.n)
    controlled = indices(rule.at_controlled, point.n)
    for k in range(point.n):
        way = abs(y_end[k] - y[k])
        if controlled[k] == 1 and way > NOTHING_MOVES * weight[k]:
            return True
    return False
