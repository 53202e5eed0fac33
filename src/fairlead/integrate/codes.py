"""What compiled code and Python both know: phases of the loop, what functions return, limits.

All are numbers, as compiled code knows no enumerations. Of what functions return no two have the same number, so that
one is not taken for another: statuses of a run, which leave the loop, and outcomes of a solve, a settlement or a step,
which do not.
"""

from __future__ import annotations

START, TRY, RECORD, ARRIVE, SETTLE, SETTLE_WHOLE = 0, 1, 2, 3, 4, 5

NONE_DUE, SAMPLE_DUE, SETTLING_FOR_IT = 0, 1, 2
"""Of the first sample (first_sample.py): there is none any more, it is due, the point is being settled for it."""

FINISHED = 0
PAUSED, BUFFER_FULL, REPLAN, RESTRICT, REACTIVATE = -1, -2, -3, -4, -5
STEP_FLOOR, NOT_FINITE, NOT_SETTLED, INCONSISTENT, SINGULAR_MATRIX, CHATTER = 1, 2, 3, 4, 5, 6
MAX_STEPS, MAX_EVENTS, MAX_WALL, INTERRUPTED, REBOUND_RUBS, ENDED, GIVEN_APART = 7, 8, 9, 10, 11, 12, 13
"""Statuses: how a run ended, or below zero what Python is to do before it goes on. The loop returns them,
problem.Status has their names (SINGULAR for SINGULAR_MATRIX), and FMUs are compiled with them (fmu/header.py): they
keep their numbers."""
DONE, SINGULAR, INACCURATE = 20, 21, 22
"""Outcomes, of a factorisation or a solve: as it should be; no pivot, `culprit` is open; other pivots are needed."""
NOT_CONSISTENT, TOO_MANY_PASSES, NO_ROOM, RELEASED, RUBBED, APART = 30, 31, 32, 33, 34, 35
"""Outcomes of a settlement, besides: no values, or no impulse, that the equations agree with; zones that change without
end; a full buffer; other zones, so that another pass has to follow; a rebound with friction; motions that are given
part what is to hold together."""
CYCLES, DIVERGES, JUMPS, ONCE_MORE, AFRESH, CAPPED = 40, 41, 42, 43, 44, 45
"""Outcomes of a step of `stepping`, besides: its zones go in a circle; its iteration does not converge; a law jumps in
it, at `t_cut`; it has had all the solves that it may have. Inside its iteration only: another solve is to follow; or
all of them, without the rows of the cache."""
GO_ON = 100
"""The outcome of a phase: the loop takes the next one."""

KNOWN_ZONES = 8
"""Rows of a machine are remembered for so many zones (stepping/row_cache.py); those of more are not."""

MOST_PERTURBED = 16
"""Pivots that `stepping` may perturb at once (perturbed_pivots.py). With more, other pivots are the better way."""

LEVELS = 16
"""Levels of load at most (release.py); one more comes in together with the one it would lie on."""

ORDINARY, BEFORE, AFTER = 0, 1, 2
"""What a recorded row is: a point, or a side of an event."""
INSIDE, PASSED, INSIDE_PASSED, GRID = 3, 4, 5, 6
"""With `between` (rows.py): a row inside a step, on the curve through the rows of that step; an end of a step that is
no grid point, and a row inside one; a grid point inside one."""
PARABOLA, QUARTIC = 1, 3
"""Rows inside a step, evenly spaced, that its dense output goes through: of `stepping`, and of the other engines."""

UNSETTLED, UNSOLVED, REPEATED = 1, 2, 3
"""What had a step of a run in real time overrun (frames.py): zones were to switch once more, its equations were not
solved yet, or it was taken again."""
MOST_IN_FRAME = 16
"""Solves that a step of a run in real time may have: between two of them zones switch, or its equations are bent."""
EVEN = 1e-6
"""Share of such a step by which two instants are one: after 1e9 of them the time is known to 1e-7 of one."""

NEVER = 1e308
"""A time that does not come; minus that, one that has never been."""

MIDDLE = 0.5
"""The theta of the midpoint rule: the one whose error is taken away (third_order.py)."""

VANISHES = 1e-14
"""Share of the numbers that a pivot is the difference of, below which it is rounding. Not of its column: in a step of
1e-12 s all that the force of a brake does to the speed of 100 t is 1e-14 m/s, and still it is known by that alone."""
