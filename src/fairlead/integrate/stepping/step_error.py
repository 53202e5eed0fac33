"""The error of one step of `stepping`, in weights.

The error of the midpoint rule is h^3 y'''/12, and y''' comes free of charge: it is the second divided difference of
the mean slopes of this step and the two before,

    error = h^3/6 [k_n, k_n-1, k_n-2]

It is taken away before (third_order.py): what is controlled is the error of the step without that.
Controlled are all differential unknowns but speeds that have a position (x' = v). A contact that starts
or stops inside a step bends the motion there: the speed at the end of the step is then still right to
order 2, while a difference of accelerations sees a jump; the position it leads to is wrong by order
h^2 times the jump, which is what the difference of speeds says.
"""

from __future__ import annotations

from math import inf, isfinite

from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.controller import weigh, weighted_norm
from fairlead.integrate.stepping.located_step import HOLD_SHARE, error_of_located
from fairlead.integrate.stepping.overload import unseen_force, unseen_slip

STILL = 1e-2
"""Where no position changes by more than this share of its weight, HOLD_SHARE of the bend of a holding force counts
as its error: what is recorded of a force that swings while nothing moves would else be a few means."""
ROUGH = 4.0
"""Rows inside a step lie on a parabola where the motion is smooth, on the chord where its bend grows faster than this
or turns round: what is stiff rings at its steps, and a parabola through that shows motions that never were."""


@compiled
def error_of_step(m, h):
    """Size of the error of the step in weights; leaves `mean_slope`, and the bend of the step in `D`."""
    point, settling, stepping, rule = m.point, m.events.settling, m.stepping, m.stepping.rule
    n = point.n
    y, y_end, slope = reals(point.at_y, n), reals(point.at_y_end, n), reals(rule.at_mean_slope, n)
    before, earlier = reals(rule.at_slope_before, n), reals(rule.at_slope_earlier, n)
    error = reals(point.at_error_vector, n)
    bend, differential = reals(point.at_D, n), indices(point.at_differential, n)
    controlled = indices(rule.at_controlled, n)
    holds, quadrature = indices(m.stepping.exchange.at_holds, n), indices(point.at_quadrature, n)
    mean = reals(rule.at_mean_before, n)
    settled = rule.locates == 0 or rule.gap == 0.0
    near, far = rule.gap + 0.5 * h, rule.gap_before
    per_step, per_near, per_far = 1.0 / h, 1.0 / near, 1.0 / far
    third = h * h * h / 6.0 / (near + far)
    weigh(point, point.at_y_end)
    for k in range(n):
        error[k] = 0.0
        slope[k] = 0.0
        bend[k] = 0.0
        if not isfinite(y_end[k]):
            point.worst = k
            return inf - inf
        if differential[k] == 1:
            slope[k] = (y_end[k] - y[k]) * per_step
            curve, curve_before = (slope[k] - before[k]) * per_near, (before[k] - earlier[k]) * per_far
            if curve * curve_before > 0.0 and abs(curve) <= ROUGH * abs(curve_before):
                bend[k] = -0.5 * h * h * curve
            if controlled[k] == 1 or (rule.locates == 1 and quadrature[k] == 0):
                error[k] = third * (curve - curve_before)
        else:
            slope[k] = (y_end[k] - (y[k] if settled else mean[k])) * per_near
    if rule.locates == 1:
        return error_of_located(point, stepping, h)
    size = weighted_norm(point, point.at_error_vector)
    size = max(size, unseen_slip(point, m.linear.matrices, m.events.guards, stepping, h))
    if settling.passes > 0:
        size = max(size, unseen_force(m, h))
    if settling.passes > 0 or moves(point, rule):
        return size
    for k in range(n):
        if holds[k] == 1:
            error[k] = HOLD_SHARE * h * (slope[k] - before[k])
    return max(size, weighted_norm(point, point.at_error_vector))


@compiled
def moves(point, rule):
    """True if a controlled unknown changes in the step by more than STILL of its weight."""
    y, y_end, weight = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_weight, point.n)
    controlled = indices(rule.at_controlled, point.n)
    found = False
    for k in range(point.n):
        found = found or (controlled[k] == 1 and abs(y_end[k] - y[k]) > STILL * weight[k])
    return found
