"""Of two answers of the forces at a point the one that a rigid part can have.

What rubs by the force of a rigid part, as the flanks of a screw do, makes its equation one of two branches: with a the
acceleration by which everything else pushes its sides together, and T its force,

    0 = a - A+ T  for T > 0,        0 = a - A- T  for T < 0

Without friction A+ = A- = 1/m1 + 1/m2. With it they differ, and A- falls below zero where a gear locks itself and its
load is heavy. Then both branches have an answer if a > 0, and none has if a < 0. A rigid part is the limit of a stiff
one, whose force grows as its sides approach. So an answer on a branch with A < 0 is none: there, more approach asks for
less force, and a part with ever so little give leaves it at once. Newton finds either one, by where it begins.

1/A is how much T answers a push by one: a column of the inverse of C (consistent.py), of a sign that is known without
friction (`Problem.pressing`). Where the sign is wrong, Newton begins once more with the opposite force. Where no answer
is right, as where a screw jams, the first one stays, and the settlement goes on with it.

Source: of the part with give that decides, Dupont and Yamajako 1997, Stability of frictional contact in constrained
rigid-body dynamics, IEEE Transactions on Robotics and Automation 13, 230; of screws, Vahid-Araghi and Golnaraghi 2011,
Friction-Induced Vibration in Lead Screw Drives.
"""

from __future__ import annotations

from fairlead.integrate.events.consistent import give_back, keep, make_consistent, newton, prepare_consistent
from fairlead.integrate.linear.systems import DONE, solve
from fairlead.integrate.memory.foreign import compiled, indices, reals


@compiled
def find_consistent(m, iterations):
    """Make the point consistent (consistent.py) by an answer that rigid parts can have, where there is one."""
    status = make_consistent(m, iterations)
    if status == DONE:
        choose_root(m, iterations)
    return status


@compiled
def choose_root(m, iterations):
    """Leave answers that no rigid part can have, where there are others."""
    problem, point = m.problem, m.point
    count = problem.n_pressing
    rows, signs = indices(problem.at_pressing_row, count), indices(problem.at_pressing_sign, count)
    for k in range(count):
        if answers(m, rows[k], signs[k]):
            continue
        keep(point)
        reals(point.at_y, point.n)[rows[k]] *= -1.0
        if not (solved_here(m, iterations) and answers(m, rows[k], signs[k])):
            give_back(point)
            solved_here(m, iterations)


@compiled
def answers(m, row, sign):
    """True if the force of a row answers a push with the sign of a rigid part."""
    pushed = reals(m.point.at_x, m.point.n)
    pushed[:] = 0.0
    pushed[row] = 1.0
    solve(m.linear, m.point.at_x)
    return pushed[row] * sign >= 0.0


@compiled
def solved_here(m, iterations):
    """True if Newton finds an answer, with J of where it begins."""
    return prepare_consistent(m.problem, m.point, m.linear) == DONE and newton(m, iterations) == DONE
