"""What compiled code and Python both know: phases of the loop, statuses, limits.

Phases and statuses are numbers, the latter those of problem.Status: compiled code knows no enumerations.
"""

from __future__ import annotations

START, TRY, RECORD, ARRIVE, SETTLE, WAKE = 0, 1, 2, 3, 4, 5

NONE_DUE, SAMPLE_DUE, SETTLING_FOR_IT = 0, 1, 2
"""Of the first sample (first_sample.py): there is none any more, it is due, the point is being settled for it."""

GO_ON = 100
"""Not a status of a run: the loop takes the next phase."""
FINISHED, PAUSED, BUFFER_FULL, REPLAN, NARROW, WIDEN = 0, -1, -2, -3, -4, -5
STEP_FLOOR, NOT_FINITE, UNSETTLED, INCONSISTENT, SINGULAR_MATRIX = 1, 2, 3, 4, 5
CHATTER, MAX_STEPS, MAX_EVENTS, REBOUND_RUBS, GIVEN_APART = 6, 7, 8, 11, 13

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

NEVER = 1e308
"""A time that does not come; minus that, one that has never been."""

MIDDLE = 0.5
"""The theta of the midpoint rule: the one whose error is taken away (third_order.py)."""
