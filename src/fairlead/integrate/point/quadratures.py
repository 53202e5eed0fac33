"""Quadratures, as the energy ledger, of steps in which the method does them badly: once more, from the states.

In a method with stages a quadrature follows a stiff unknown no better than the stages do, and its dense output
worse: where a bound contact had crept for a tenth of a second and then broke away, it was off by a hundred times
what had passed meanwhile. The method knows: its own error estimate of the quadrature is large then. Nothing
depends on a quadrature, so it may as well be had from the states inside the accepted piece,

    q(t_piece) = q(t0) + piece * sum_k w_k f_q(t_k, y_k)

by the rule of Gauss with three nodes (order 6). The y_k are not those of the dense output: a slip of 1e-5 m/s that is
known to a thousandth gives a force of 10 N to no more than 0.01 N, and each step the same way, where the slope of the
dense output gives it to five digits and more. So the dense output is moved by its residual through the factors of W,

    W delta = f(t_k, y) - M y',

which takes a stiff unknown to where it goes with the slopes of the others, and others by less than their error. No node
is an end of the piece, since there the slope of the dense output is rough. Elsewhere the stages do better.

W is of the start of the step. A bond that takes hold of a node grows by several times within a step, and a move by W
then goes so many times too far, each further off than the one before. So each unknown goes by the secant of its own
last two moves: exact after one of them where a law is linear in its speed, whatever its strength has become. One whose
residual a move hardly changes follows no law within the step: it stays where it is, since it would be asked for the
same move for ever.
"""

from __future__ import annotations

from fairlead.integrate.linear.products import add_mass_times, inertia_of
from fairlead.integrate.linear.systems import solve
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.point.interpolant import interpolate
from fairlead.integrate.point.stiff import FURTHEST

OFF = 10.0
"""In weights for all of the run so far, of which a step may miss its share by time: then the ledger is off by some ten
accuracies after however many steps that all err the same way. The method finds itself worse than it is where nothing
is stiff; at one, such runs would pay for nothing."""
LEAST_PASSED = 0.1
"""What has passed, in the unit of the quadrature, below which the error is no longer measured by it."""
TURNS = 4
"""Most moves at a node; after the second the secants have met what is linear in its speed."""
NODE_DISTANCE = 0.5 * 0.6**0.5
"""Distance of the outer nodes from the middle of the piece, in pieces."""


@compiled
def integrate_quadratures(m, h):
    """Write the quadratures at the end of the piece [t, t + cut h] into `y_piece`, and follow it inside.

    Inside the piece the dense output becomes the cubic with the rates of the three nodes.
    """
    problem, point, linear, stepping = m.problem, m.point, m.linear, m.stepping
    n, cut = point.n, m.run.cut_at
    quadrature = indices(point.at_quadrature, n)
    y, piece, y_end = reals(point.at_y, n), reals(point.at_y_piece, n), reals(point.at_y_end, n)
    D = reals(point.at_D, 3 * n)
    first, middle, last = reals(point.at_u, n), reals(point.at_v, n), reals(point.at_f, n)
    share = share_of(m.run, point)
    find_rates_inside(problem, point, linear, stepping, cut * (0.5 - NODE_DISTANCE), h, share)
    copy(last, first)
    find_rates_inside(problem, point, linear, stepping, cut * 0.5, h, share)
    copy(last, middle)
    find_rates_inside(problem, point, linear, stepping, cut * (0.5 + NODE_DISTANCE), h, share)
    for k in range(n):
        if quadrature[k] == 1:
            size = cut * h / inertia_of(m.linear.matrices, k)
            slope = size * (last[k] - first[k]) / (2.0 * NODE_DISTANCE)
            curve = size * (last[k] - 2.0 * middle[k] + first[k]) / (2.0 * NODE_DISTANCE**2)
            # The integral of middle + slope (s - 1/2) + curve (s - 1/2)^2 is a s + b s^2 + c s^3, s = 1 at the end.
            a = size * middle[k] - 0.5 * slope + 0.25 * curve
            b = 0.5 * (slope - curve)
            c = curve / 3.0
            piece[k] = y[k] + a + b + c
            a, b, c = a / cut, b / cut**2, c / cut**3
            y_end[k] = y[k] + a + b + c
            D[k], D[n + k], D[2 * n + k] = -b - c, -c, 0.0


@compiled
def find_rates_inside(problem, point, linear, stepping, s, h, share):
    """Into `f`: the rates at s of the step, of the dense output moved by its residual until the rates settle."""
    n = problem.n
    y, y_end, D = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_D, 3 * n)
    probe = reals(point.at_y_probe, n)
    minus_rate, asks, f = reals(point.at_x, n), reals(point.at_b, n), reals(point.at_f, n)
    asked, moved = reals(point.at_asked, n), reals(point.at_error_vector, n)
    holds = indices(stepping.exchange.at_holds, n)
    rest = 1.0 - s
    interpolate(point, s, point.at_y_probe)
    for k in range(n):
        inner = D[k] + s * (D[n + k] + s * D[2 * n + k])
        inner_slope = D[n + k] + 2.0 * s * D[2 * n + k]
        minus_rate[k] = -(y_end[k] - y[k] + (rest - s) * inner + s * rest * inner_slope) / h
    field_at(problem.call_rhs, (problem.context, point.t + s * h, point.at_y_probe, point.at_f))
    problem.rhs += 1
    for turn in range(TURNS):
        copy(f, asks)
        add_mass_times(linear.matrices, point.at_x, point.at_b)
        for k in range(n):
            if holds[k] == 1:
                asks[k] = 0.0
        solve(linear, point.at_b)
        for k in range(n):
            move = asks[k] * (secant(asked[k], asks[k], moved[k]) if turn > 0 else 1.0)
            asked[k], moved[k] = asks[k], move
            probe[k] += move
        copy(f, asks)
        field_at(problem.call_rhs, (problem.context, point.t + s * h, point.at_y_probe, point.at_f))
        problem.rhs += 1
        if rates_settled(point, linear.matrices, h, share):
            break


@compiled
def rates_settled(point, matrices, h, share):
    """Whether the rates `f` of the quadratures give this step what `b`, those before, do, to a share of a weight."""
    quadrature, weight = indices(point.at_quadrature, point.n), reals(point.at_weight, point.n)
    y, f, before = reals(point.at_y_end, point.n), reals(point.at_f, point.n), reals(point.at_b, point.n)
    for k in range(point.n):
        if quadrature[k] == 1:
            change = h * abs(f[k] - before[k]) / inertia_of(matrices, k)
            if not change <= share * weight[k] * max(LEAST_PASSED, abs(y[k])):
                return False
    return True


@compiled
def secant(asked, left, moved):
    """Times the move by W to go: it asked for `asked`, `moved` was made, and it asks for `left` now.

    None where that did not make the residual smaller, or by less than 1/FURTHEST of what W foretold.
    """
    done = asked - left
    if moved * done <= 0.0 or abs(moved) > FURTHEST * abs(done):
        return 0.0
    return moved / done


@compiled
def share_of(run, point):
    """Weights that this step may miss of a quadrature: its share of OFF by time."""
    return OFF * run.h / (point.t + run.h - run.start)


@compiled
def judge_quadratures(run, point, recorder):
    """Set `quadratures_off` if the method itself finds a quadrature wrong in this step by its share of OFF."""
    error, quadrature = reals(point.at_error_vector, point.n), indices(point.at_quadrature, point.n)
    weight = reals(point.at_weight, point.n)
    y = reals(point.at_y_end, point.n)
    share = share_of(run, point)
    recorder.quadratures_off = 0
    for k in range(point.n):
        if quadrature[k] == 1 and abs(error[k]) > share * weight[k] * max(LEAST_PASSED, abs(y[k])):
            recorder.quadratures_off = 1
