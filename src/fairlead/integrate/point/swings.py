"""Sines that no error of a step knows: a step is short against what they are taken of.

A limit switch at sin(angle), or a relay behind a swept sine, changes no unknown until it switches. The error of a step
is then that of the angle, which drifts evenly and is right after a step of any length, while its sine goes round many
times. The problem tells those angles (`swings`), and a step that turns one of them by more than TURN has an error above
one, as the size

    (largest turn/TURN)^(1/p),    the step goes with error^-p

so that it is repeated, and the next one chosen, as by any other error.
"""

from __future__ import annotations

from math import isfinite, pi

from fairlead.integrate.memory.foreign import compiled, field_at, reals

TURN = pi / 4.0
"""An eighth of a period [rad], as of what swings in time (`longest_step` in facts.py): tops between are still found."""


@compiled
def judge_swings(problem, run, point, h):
    """The error of the trial step is at least what it is by the angles of sines; one that is no number stays."""
    if problem.n_swings > 0 and run.adaptive == 1 and isfinite(run.error):
        run.error = max(run.error, largest_turn(problem, point, h) ** (1.0 / run.error_exponent))


@compiled
def largest_turn(problem, point, h):
    """By how much, in TURN, the step [t, t + h] turns the angle that it turns most."""
    n = problem.n_swings
    before, after = reals(problem.at_swing, n), reals(problem.at_swing_end, n)
    field_at(problem.call_swings, (problem.context, point.t, point.at_y, problem.at_swing))
    field_at(problem.call_swings, (problem.context, point.t + h, point.at_y_end, problem.at_swing_end))
    most = 0.0
    for k in range(n):
        turn = abs(after[k] - before[k])
        if isfinite(turn) and turn > most:
            most = turn
    return most / TURN
