"""Of the answers of the forces at a point the one that rigid parts can have.

What rubs by the force of a rigid part, as the flanks of a screw do, makes its equation one of two branches: with a the
acceleration by which everything else pushes its sides together, and T its force,

    0 = a - A+ T  for T > 0,        0 = a - A- T  for T < 0

Without friction A+ = A- = 1/m1 + 1/m2. With it they differ, and A- falls below zero where a gear locks itself and its
load is heavy. Then both branches have an answer if a > 0, and none has if a < 0. A rigid part is the limit of a stiff
one, whose force grows as its sides approach. So an answer on a branch with A < 0 is none: there, more approach asks for
less force, and a part with ever so little give leaves it at once. Newton finds either one, by where it begins.

Of several parts, as two hoists on one shaft, T and a are vectors and A a matrix by the signs of all forces. Whatever
give each part has, springs of their own or none, more approach must ask for more force: no principal minor of A is
below zero (a P0-matrix), and so none of its inverse. Its columns are how much T answers pushes by one, those of the
inverse of C (consistent.py), of a sign that is known without friction (`Problem.pressing`). Each part by itself may
have the right sign while they are wrong together.

Where a minor is wrong, or Newton finds no answer, it begins once more from forces of other signs. Where no answer is
right, as where a screw jams, the first one stays, and the settlement goes on with it.

Source: of the part with give that decides, Dupont and Yamajako 1997, Stability of frictional contact in constrained
rigid-body dynamics, IEEE Transactions on Robotics and Automation 13, 230; of screws, Vahid-Araghi and Golnaraghi 2011,
Friction-Induced Vibration in Lead Screw Drives; of P-matrices, Fiedler and Ptak 1962, On matrices with non-positive
off-diagonal elements and positive principal minors, Czechoslovak Mathematical Journal 12, 382.
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE, INACCURATE, NOT_CONSISTENT
from fairlead.integrate.events.consistent import give_back, keep, make_consistent, newton, prepare_consistent
from fairlead.integrate.linear.systems import solve
from fairlead.integrate.memory.foreign import compiled, indices, reals

MOST_COMBINED = 6
"""Parts of which all subsets are asked, and all signs tried. Of more, single ones, all but one, and the first k are
asked, and the signs of those are turned that are wrong."""
ANSWER_ROUNDING = 1e-12
"""Share of an answer below which what is left of it is rounding."""


@compiled
def find_consistent(m, iterations):
    """Make the point consistent (consistent.py) by an answer that rigid parts can have, where there is one."""
    status = make_consistent(m, iterations)
    if m.problem.n_pressing == 0 or (status != DONE and status != NOT_CONSISTENT):
        return status
    if status == DONE and are_rigid(m.problem, m.point, m.linear):
        return status
    return try_signs(m.problem, m.point, m.linear, iterations, status)


@compiled
def try_signs(problem, point, linear, iterations, first):
    """Begin Newton from forces of other signs until rigid parts can have its answer; else the first one, as it was."""
    count = problem.n_pressing
    keep(point)
    few = count <= MOST_COMBINED
    for trial in range(1, 1 << count if few else count + 1):
        if few:
            give_back(point)
            mark(problem, trial)
        turn_marked(problem, point)
        status = solved_here(problem, point, linear, iterations)
        if status == INACCURATE or (status == DONE and are_rigid(problem, point, linear)):
            return status
    give_back(point)
    return solved_here(problem, point, linear, iterations) if first == DONE else first


@compiled
def mark(problem, bits):
    """Mark the forces of these bits."""
    count = problem.n_pressing
    wrong = indices(problem.at_pressing_wrong, count)
    for k in range(count):
        wrong[k] = (bits >> k) & 1


@compiled
def turn_marked(problem, point):
    """Turn the forces that are marked, and give all of them at least their nominal size."""
    count = problem.n_pressing
    rows, wrong = indices(problem.at_pressing_row, count), indices(problem.at_pressing_wrong, count)
    y = reals(point.at_y, point.n)
    absolute, relative = reals(point.at_absolute, point.n), reals(point.at_relative, point.n)
    for k in range(count):
        row = rows[k]
        size = max(abs(y[row]), absolute[row] / relative[row])
        forward = (y[row] < 0.0) == (wrong[k] == 1)
        y[row] = size if forward else -size


@compiled
def solved_here(problem, point, linear, iterations):
    """Newton from here, with J of where it begins; its status."""
    status = prepare_consistent(problem, point, linear)
    return newton(problem, point, linear, iterations) if status == DONE else status


@compiled
def are_rigid(problem, point, linear):
    """True if rigid parts can have the forces of this point. If not, of many those are marked that are wrong."""
    find_answers(problem, point, linear)
    count = problem.n_pressing
    wrong = indices(problem.at_pressing_wrong, count)
    wrong[:] = 0
    if count > MOST_COMBINED:
        return are_rigid_in_turn(problem)
    bits, rigid = 1, True
    while rigid and bits < 1 << count:
        rigid = last_pivot(problem, bits) >= 0.0
        bits += 1
    return rigid


@compiled
def find_answers(problem, point, linear):
    """Set answer[i, k]: how much force i answers a push by one at part k, in the sense of rigid parts."""
    count = problem.n_pressing
    rows, signs = indices(problem.at_pressing_row, count), indices(problem.at_pressing_sign, count)
    answer, pushed = reals(problem.at_pressing_answer, count * count), reals(point.at_x, point.n)
    for k in range(count):
        pushed[:] = 0.0
        pushed[rows[k]] = signs[k]
        solve(linear, point.at_x)
        for i in range(count):
            answer[i * count + k] = pushed[rows[i]]


@compiled
def last_pivot(problem, bits):
    """Of the answers of these parts: the pivot of the last one, their minor over that without it.

    Of subsets in numeric order the one without its last part has passed before: no pivot is below zero.
    """
    count = problem.n_pressing
    begin_elimination(problem)
    pivot = 0.0
    for k in range(count):
        if (bits >> k) & 1 == 1:
            pivot = eliminate(problem, k)
    return pivot


@compiled
def begin_elimination(problem):
    """Set what is left of the answers to all of them."""
    square = problem.n_pressing**2
    answer, left = reals(problem.at_pressing_answer, square), reals(problem.at_pressing_left, square)
    for place in range(square):
        left[place] = answer[place]


@compiled
def eliminate(problem, k):
    """Take part k out of the equations of the others; its pivot.

    Zero, and nothing is taken out, where it is rounding: as of parts side by side of which any share is right.
    """
    count = problem.n_pressing
    answer = reals(problem.at_pressing_answer, count * count)
    left = reals(problem.at_pressing_left, count * count)
    pivot = left[k * count + k]
    if not abs(pivot) > ANSWER_ROUNDING * abs(answer[k * count + k]):
        return 0.0
    for i in range(count):
        factor = left[i * count + k] / pivot
        if i != k:
            for j in range(count):
                left[i * count + j] -= factor * left[k * count + j] if j != k else 0.0
    return pivot


@compiled
def are_rigid_in_turn(problem):
    """Ask each part by itself and after all others, then after those before it; mark those that are wrong.

    After all others its pivot is one over the A of this part alone: the answers of all hide it if there are many.
    """
    count = problem.n_pressing
    wrong, answer = indices(problem.at_pressing_wrong, count), reals(problem.at_pressing_answer, count * count)
    rigid = True
    for k in range(count):
        begin_elimination(problem)
        for other in range(count):
            if other != k:
                eliminate(problem, other)
        if answer[k * count + k] < 0.0 or eliminate(problem, k) < 0.0:
            wrong[k] = 1
            rigid = False
    if not rigid:
        return False
    begin_elimination(problem)
    for k in range(count):
        if eliminate(problem, k) < 0.0:
            wrong[k] = 1
            rigid = False
    return rigid
