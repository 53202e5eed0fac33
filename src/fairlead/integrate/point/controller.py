"""Step size: the error norm, the PI control of accepted and rejected steps, the restart after a switch.

Contested choices, numbered:

1. Norm. Largest weighted error over the unknowns, not the root mean square: one hundred idle blocks
   must not loosen the error of the one that slips, and the invariant between creep and weight holds
   for each contact. (Hairer, Wanner II, eq. IV.8.21, take the mean.)
2. Control. PI with exponents 0.7/q and 0.4/q, q = error_order + 1 (Gustafsson, ACM TOMS 17:533, 1991);
   pure I (1/q) after a switch or a rejection, where the last error says nothing about the next.
3. Restart. A one-step method may keep its step across a switch, but the time scale may have changed
   altogether (a stuck block takes any step, a slipping one a tenth of its period). See `restart`.
"""

from __future__ import annotations

from math import inf, isfinite, sqrt

from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.even_steps import COARSE, COARSER, root_of_power, rounded

SAFETY, SHRINK_LIMIT, GROW_LIMIT = 0.9, 0.2, 8.0
AFTER_ERROR, AFTER_NAN = 0.8, 0.25
"""Of a step that is rejected the next one has this share at most; and that, where its error is no number."""
RESTART_ERROR = 1e-5
"""Error constant assumed for the first step after a switch. The embedded error of an oscillator with
amplitude A is about 1e-5 A (h omega)^5 for Rodas5P; 1e-6 cost the belt three rejections per slip, 1e-4
a step more per slip at tight tolerances."""
STRAIGHT = 1e3
"""A suggestion this much longer than the last step means that nothing bends any more: a contact caught
what moved, and what is left of y'' is rounding."""
GONE = 1e-3
"""A step of which less than this share was left, at a crossing, does not tell how short the next may be at least: a
belt carries a block along for a step of days, of which a second is left and whose error is rounding."""
UNMOVED = 1e-3
"""What would not move by this share of a weight in the whole run is at rest, and its y' and y'' rounding."""
NO_AMPLITUDE = 1e-6
"""A motion from rest: in its time scale it moves by less than this share of a weight."""
NO_LIMIT_BELOW = (GROW_LIMIT / SAFETY) ** -5.0
"""Of an error below this little more is known than that it is small: the step grows by all it may."""
SURELY = 1.0 - 4.0 * 2.0**-52
"""What is at most this share of a number by its product with a weight is no more than that by its quotient."""
IDLE_ERROR = 1e-3
"""Below this a step was not limited by its error, and says nothing about the time scale."""


@compiled
def smallest_step(run, point):
    """The step floor here: what was set, but not below what t can resolve."""
    return max(run.step_floor, 4e-15 * abs(point.t))


@compiled
def weigh(point, at_other):
    """weight_i = min(absolute_i + relative_i max(|y_i|, |other_i|), cap_i)."""
    y, other, weight = reals(point.at_y, point.n), reals(at_other, point.n), reals(point.at_weight, point.n)
    absolute, relative = reals(point.at_absolute, point.n), reals(point.at_relative, point.n)
    cap = reals(point.at_cap, point.n)
    for k in range(point.n):
        weight[k] = min(absolute[k] + relative[k] * max(abs(y[k]), abs(other[k])), cap[k])


@compiled
def weighted_norm(point, at_v):
    """Largest |v_i| / weight_i without quadratures and gauges; nan if any v_i is. Its place goes to `worst`."""
    v, weight, unweighed = reals(at_v, point.n), reals(point.at_weight, point.n), indices(point.at_unweighed, point.n)
    largest = below = 0.0
    for k in range(point.n):
        if abs(v[k]) <= below * weight[k]:  # no larger, whatever the rounding: most are, and a product is no division
            continue
        size = abs(v[k]) / weight[k]
        if not isfinite(v[k]):
            point.worst = k
            return v[k] - v[k]
        if unweighed[k] == 0 and size > largest:
            largest, below = size, SURELY * size
            point.worst = k
    return largest


@compiled
def estimate_error(point):
    """Error of the trial step in its norm; nan if the trial is not finite anywhere."""
    weigh(point, point.at_y_end)
    y_end = reals(point.at_y_end, point.n)
    for k in range(point.n):
        if not isfinite(y_end[k]):
            point.worst = k
            return y_end[k] - y_end[k]
    return weighted_norm(point, point.at_error_vector)


@compiled
def step_after_rejection(run, h):
    """A smaller step: by the error if it is a number, else a quarter."""
    if isfinite(run.error):
        factor = SAFETY * run.error**-run.error_exponent
        return rounded(h * min(max(factor, SHRINK_LIMIT), AFTER_ERROR), COARSE)
    return AFTER_NAN * h


@compiled
def step_after_acceptance(run, h):
    """The next step by PI control; never longer right after a rejection."""
    error = max(run.error, 1e-10)
    if error < NO_LIMIT_BELOW and run.retried == 0:
        return GROW_LIMIT * h
    if run.last_error > 0.0 and run.retried == 0:
        factor = SAFETY * error ** (-0.7 * run.error_exponent) * run.last_error ** (0.4 * run.error_exponent)
    else:
        factor = SAFETY * error**-run.error_exponent
    upper = 1.0 if run.retried > 0 else GROW_LIMIT
    return rounded(h * min(max(factor, SHRINK_LIMIT), upper), COARSER)


@compiled
def is_straight(run, curvature_size):
    """True if a second derivative of this weighted norm bends nothing in the whole run."""
    span = run.stop - run.start
    return curvature_size * span * span <= UNMOVED


@compiled
def restart(run, slope_size, curvature_size, force_size):
    """The first step after a switch, from the weighted norms s of y' and c of y'', and a of y' of the algebraic.

    s/c is the time scale T of the motion, s T its amplitude A (over the weight); a smooth motion of
    that scale has a leading error RESTART_ERROR A (h/T)^q, and h makes it one. A straight motion
    (c = 0) takes any step. In any case s h, c h^2 and a h may come near one: where all is held, y' and y'' are
    rounding, and their ratio a time scale of nothing. Where the last step was set by its error, and not idle,
    the time scale is known better than two derivatives tell: the step is at most what it would have been, and, unless
    that was cut at its very start, at least a third of that. Letting it be twice as long cost a chain of 100 blocks 0.4
    rejections a switch. Where switches follow each other closely, most steps are cut at their very start: without the
    upper bound for these `long_deployment` took 2.5 rejections a switch, with it 0.3.
    """
    if is_straight(run, curvature_size):
        return inf
    if slope_size * slope_size <= NO_AMPLITUDE * curvature_size:
        suggested = sqrt(1.0 / curvature_size)
    else:
        scale = slope_size / curvature_size
        amplitude = slope_size * scale
        suggested = scale * max(RESTART_ERROR * amplitude, 1e-30) ** -run.error_exponent
    suggested = max(suggested, 0.5 / max(sqrt(curvature_size), max(slope_size, 0.03 * force_size)))
    gone = run.cut_at if run.crossed == 1 else 1.0
    if run.error > IDLE_ERROR and suggested < STRAIGHT * run.h_next:
        suggested = min(max(suggested, run.h_next / 3.0 if gone > GONE else 0.0), run.h_next)
    return root_of_power(suggested)


@compiled
def longest_first_step(run, slope_size, curvature_size, share, order):
    """The step after a switch at which the leading error of a method, A (h/T)^order / share, is one weight.

    A and T as in `restart`. What is straight, or begins at rest, has no such bound.
    """
    if slope_size * slope_size <= NO_AMPLITUDE * curvature_size or is_straight(run, curvature_size):
        return inf
    scale = slope_size / curvature_size
    return root_of_power(scale * (share / (slope_size * scale)) ** (1.0 / order))
