"""What makes a step of order three: its end is moved by the error of the midpoint rule, found with its own factors.

The step solves M (y1 - y0)/h = f(u), u = (y0 + y1)/2. The formula of Lobatto, of order four, has instead

    (f0 + 4 f(u - (h/8) y'' h) + f1)/6  =  f(u) + q/3 - J e/12 + ...      q = (f0 + f1)/2 - f(u),  e = h^2 y''

with f0 and f1 at the ends, in the zones and with the forces the step has come to. One step of Newton takes the
difference away, and e comes from the difference of the ends by another, both through the factors of W = 2M/h - J:

    W (e/2) = f1 - f0          W (d/2) = q/3 - J e/12          y1 <- y1 + d

The step reads motions that are given on their chord. What that makes of f, c = f(u) - f(u at the time of its middle),
is not in the formula, and h^2 times the second derivative of such a motion is not in e:

    W (e/2) = f1 - f0 + 4 c            W (d/2) = q/3 - J e/12 - 2 c/3

In `move_by_error`: e/2 is what the first solve leaves in b, e/12 is `twelfth`, c is `chord_defect`, f0 and f1 are `f0`
and `f1`; f(u) is not evaluated again, since it is M (y1 - y0)/h + `kick` once the step is solved (`kick`, `first` and
`second` are of laws that jump, jump_inside.py). d/2 is what the last solve leaves in b. b, u, v, x and f are scratch of
point.

f is linear enough for that inside a step, whose zones are frozen; q tells what depends on time or is curved. Contacts
that hold have no slip in e and d. For y' = z y/h the step multiplies by (1 + z/2)/(1 - z/2) - (z/(1 - z/2))^3/12: never
by more than one in the left half plane, by -1/3 where z is large. So what is stiff for a step dies away, where the
midpoint rule leaves it ringing for ever; a wave of h omega = 0.3 gets out of phase by 7e-5 in a step for 2e-3. Where
friction falls and switches are inside steps (`damps`), a third solve (`damp_end`) adds w^4/48 with w = z/(1 - z/2): the
factor is then zero where z is large (jump_inside.py).

The solve for e is a filter, (1 - h J/(2 M))^-1: e has a share of h J/2 too much. What is driven by a load that changes
slowly, through something stiff for which the step is still short, has a small y''' and a large J y'', and a step misses
h J/2 of h J y''/12 that no difference of its ends sees. Where steps end at every switch a third solve takes half of
what the filter has added away (`sharpen`):

    W (g/2) = J e/2 + 4 c            e <- e - g/2

The factor is then the same (1 + z/2)/(1 - z/2) - w^3/12 + w^4/48: its error is half of the one above, and what is stiff
is gone with the step. All of it would leave no error of that order, and of what is stiff a third. The half of g that
is left in e is in `minus_slip` until the error of the step is known (`located_step.add_lag`), as g/4 with e/2 in b.

(Deferred correction: Fox, Proc. R. Soc. A 190:31, 1947; Pereyra, Numer. Math. 8:376, 1966. With the matrix of the step
in place of differences over several steps, so that it survives a switch: of our own.)
"""

from __future__ import annotations

from fairlead.integrate.linear.products import add_jacobian_times, add_mass_times
from fairlead.integrate.linear.systems import solve_motion
from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals
from fairlead.integrate.stepping.residual import differs, read_at_instant, read_on_chord, weigh_ends


@compiled
def refine_end(problem, point, linear, stepping, h):
    """Move the end of a step of the midpoint rule by its error; forces stay the means over the step they are."""
    move_by_error(problem, point, linear, stepping, h)
    if problem.n_quadratures > 0:
        add_rise_of_quadratures(problem, point, h)


@compiled
def move_by_error(problem, point, linear, stepping, h):
    """Move the end of a step by its error, in all unknowns but the quadratures."""
    matrices, exchange = linear.matrices, stepping.exchange
    n = problem.n
    kick, first, second = (
        reals(stepping.rule.at_kick, n), reals(stepping.rule.at_kick_first, n), reals(stepping.rule.at_kick_second, n),
    )  # fmt: skip
    f0, f1, b, minus_rate_third = reals(point.at_x, n), reals(point.at_f, n), reals(point.at_b, n), reals(point.at_v, n)
    y, y_end, twelfth = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_u, n)
    holds, quadrature = indices(exchange.at_holds, n), indices(problem.at_quadrature, n)
    moving, chord_defect = indices(problem.at_differential, n), reals(stepping.rule.at_chord_defect, n)
    find_chord_defect(problem, point, stepping.rule, h)
    find_forces_at_ends(problem, point, stepping.rule, h)
    for k in range(n):
        b[k] = f1[k] - f0[k] + 4.0 * chord_defect[k] - first[k] if holds[k] == 0 and quadrature[k] == 0 else 0.0
    if exchange.support_accelerates == 1:
        follow_surfaces(problem, point, exchange, h)
    solve_motion(linear, point.at_b)
    if stepping.rule.locates == 1:
        sharpen(problem, point, linear, stepping)
    for k in range(n):
        moves = moving[k] == 1 and quadrature[k] == 0
        twelfth[k] = b[k] / 6.0 if moves else 0.0
        minus_rate_third[k] = (y[k] - y_end[k]) / (3.0 * h) if moves else 0.0
        b[k] = (f0[k] + f1[k]) / 6.0 - chord_defect[k] / 1.5 - kick[k] / 3.0 - second[k]
    add_mass_times(matrices, point.at_v, point.at_b)
    add_jacobian_times(matrices, -1.0, point.at_u, point.at_b)
    for k in range(n):
        if holds[k] == 1 or quadrature[k] == 1:
            b[k] = 0.0
    solve_motion(linear, point.at_b)
    if stepping.rule.damps == 1 and stepping.rule.locates == 0:
        damp_end(problem, point, linear, stepping)
    for k in range(n):
        if moving[k] == 1 and quadrature[k] == 0:
            y_end[k] += 2.0 * b[k]


@compiled
def sharpen(problem, point, linear, stepping):
    """Take from e/2 in b half of what the filter of its solve has too much, to first order: W (g/2) = J e/2 + 4 c."""
    n = problem.n
    b, half, chord_defect = reals(point.at_b, n), reals(point.at_v, n), reals(stepping.rule.at_chord_defect, n)
    holds, quadrature = indices(stepping.exchange.at_holds, n), indices(problem.at_quadrature, n)
    moving, kept = indices(problem.at_differential, n), reals(point.at_u, n)
    left = reals(point.at_minus_slip, n)
    for k in range(n):
        kept[k] = b[k]
        half[k] = b[k] if moving[k] == 1 and quadrature[k] == 0 else 0.0
        b[k] = 4.0 * chord_defect[k]
    add_jacobian_times(linear.matrices, 1.0, point.at_v, point.at_b)
    for k in range(n):
        if holds[k] == 1 or quadrature[k] == 1:
            b[k] = 0.0
    solve_motion(linear, point.at_b)
    for k in range(n):
        left[k] = 0.5 * b[k] if moving[k] == 1 and quadrature[k] == 0 else 0.0
        b[k] = kept[k] - 0.5 * b[k]


@compiled
def damp_end(problem, point, linear, stepping):
    """Add g to b, W g = -J b/2 and what jumps need besides: by this no end keeps what is stiff (jump_inside.py)."""
    n = problem.n
    b, moved, half_move = reals(point.at_b, n), reals(point.at_v, n), reals(stepping.rule.at_half_move, n)
    holds, quadrature = indices(stepping.exchange.at_holds, n), indices(problem.at_quadrature, n)
    moving, second = indices(problem.at_differential, n), reals(stepping.rule.at_kick_second, n)
    for k in range(n):
        half_move[k] = b[k]
        moved[k] = b[k] if moving[k] == 1 and quadrature[k] == 0 else 0.0
        b[k] = second[k]
    add_jacobian_times(linear.matrices, -0.5, point.at_v, point.at_b)
    for k in range(n):
        if holds[k] == 1 or quadrature[k] == 1:
            b[k] = 0.0
    solve_motion(linear, point.at_b)
    for k in range(n):
        b[k] += half_move[k]


@compiled
def find_chord_defect(problem, point, rule, h):
    """Into `chord_defect`: f with given motions on their chord, less f with them where they are in the middle.

    Only the laws that follow a given motion are evaluated, so that this counts as no evaluation of f.
    """
    y, y_end, u = reals(point.at_y, problem.n), reals(point.at_y_end, problem.n), reals(point.at_u, problem.n)
    chord_defect, moving = reals(rule.at_chord_defect, problem.n), indices(problem.at_differential, problem.n)
    for k in range(problem.n):
        chord_defect[k] = 0.0
        u[k] = 0.5 * (y[k] + y_end[k]) if moving[k] == 1 else y_end[k]
    if not differs(problem):
        return
    read_on_chord(problem, point, 0.5, h)
    field_at(problem.call_ahead, (problem.context, point.t + 0.5 * h, point.at_u, rule.at_chord_defect))
    read_at_instant(problem)


@compiled
def follow_surfaces(problem, point, exchange, h):
    """Into b, what holds on a surface that is accelerated has its second derivative: h^2 v'' = 8 slips on the chord.

    At both ends of the step it goes as the surface does, in the middle of the chord by h^2 v''/8 faster.
    """
    y, y_end, chord = reals(point.at_y, problem.n), reals(point.at_y_end, problem.n), reals(point.at_y_probe, problem.n)
    minus_slip = reals(point.at_minus_slip, problem.n)
    holds, captured = indices(exchange.at_holds, problem.n), indices(exchange.at_captured, problem.n)
    of_algebraic_speed = indices(exchange.at_of_algebraic_speed, problem.n)
    moving, b = indices(problem.at_differential, problem.n), reals(point.at_b, problem.n)
    for k in range(problem.n):
        chord[k] = 0.5 * (y[k] + y_end[k]) if moving[k] == 1 else y_end[k]
    field_at(problem.call_drift, (problem.context, point.t + 0.5 * h, point.at_y_probe, point.at_minus_slip))
    for k in range(problem.n):
        if holds[k] == 1 and captured[k] == 0 and of_algebraic_speed[k] == 0:
            b[k] = -8.0 * minus_slip[k] / h


@compiled
def find_forces_at_ends(problem, point, rule, h):
    """Into `x` and `f`: f at the start and at the end of the step, in its zones and with its forces.

    Forces are means over the step. Where steps end at every switch, those of the start balance there, and so the end
    has as much more than the mean as the start has less. A law that is curved in both a force and a motion asks for
    that: its cross term is of the order of q.
    """
    n = problem.n
    y, y_end = reals(point.at_y, n), reals(point.at_y_end, n)
    start, end = reals(point.at_y_probe, n), reals(point.at_u, n)
    moving = indices(problem.at_differential, n)
    for k in range(n):
        known = moving[k] == 1 or rule.locates == 1
        start[k] = y[k] if known else y_end[k]
        end[k] = y_end[k] if moving[k] == 1 else 2.0 * y_end[k] - start[k]
    field_at(problem.call_forces, (problem.context, point.t, point.at_y_probe, point.at_x))
    field_at(problem.call_forces, (problem.context, point.t + h, point.at_u, point.at_f))
    problem.rhs += 2


@compiled
def add_rise_of_quadratures(problem, point, h):
    """The rise of the quadratures, from the rates at the mean of the way taken, (y0 + y1)/2 - e/12.

    The mean of a motion that is given is a sixth of what it is at the ends and two thirds of what it is in the middle.
    Forces are means over the step already; b is half of what moved its end, and all of what it does to them.
    """
    n = problem.n
    y, y_end, mean = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_y_probe, n)
    rate = reals(point.at_f, n)
    b, twelfth = reals(point.at_b, n), reals(point.at_u, n)
    moving, quadrature = indices(problem.at_differential, n), indices(problem.at_quadrature, n)
    for k in range(n):
        mean[k] = 0.5 * (y[k] + y_end[k]) - twelfth[k] if moving[k] == 1 else y_end[k] + b[k]
    weigh_ends(problem, point, h, 1.0 / 6.0, 1.0 / 6.0)
    field_at(problem.call_rhs, (problem.context, point.t + 0.5 * h, point.at_y_probe, point.at_f))
    read_at_instant(problem)
    problem.rhs += 1
    for k in range(n):
        if quadrature[k] == 1:
            y_end[k] = y[k] + h * rate[k]
