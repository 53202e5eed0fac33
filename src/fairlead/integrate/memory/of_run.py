"""The structs of a run, whatever its method: where it is, what it records; a field, or a few of one kind, a line."""

from __future__ import annotations

from fairlead.integrate.memory.struct import Struct

RUN = Struct(
    integers=(
        "max_passes", "max_steps", "max_events",
        "adaptive",  # 0: a fixed step, without error control
        "on_chatter",  # chatter.HOLD, STOP, or only told
        "phase",  # of the loop: codes.TRY, ...
        "crossed",  # the piece ends where zones are to be settled: guards fired, or a method asks for it
        "inconsistent_start",  # the settlement is of the start of a step that was given up
        "judged",  # zones were settled at the point
        "landing",  # the step ends on a time event or the stop
        "retried",  # times the step was tried and too long; 0 once one is accepted
        "reinitialised",  # the point was made consistent after many rejections, once until a step is accepted
        "stop_asked",  # a machine chatters, and the run is to end for it
        "dropped",  # crossings in a row that a better point undid (arrival.judge_again)
        "first_sample",  # codes.NONE_DUE, SAMPLE_DUE, SETTLING_FOR_IT
        "restrict_at",  # the step at which to look whether a part of the problem would do
        "is_part",  # this is the memory of a part
        "boundary_switched",  # a machine at the boundary of the part has changed: the whole is to be settled
        "dwell_given", "step_floor_given",  # a user gave them: they count as they are then (chatter.py)
        # counters, see counters.py
        "steps", "rejected_error", "rejected_nan", "rejected_inconsistent", "rejected_switch", "rejected_cycling",
        "rejected_diverged", "rejected_singular", "located", "time_events", "partial_steps",
    ),
    numbers=(
        "start", "stop",
        "max_step", "first_step", "step_floor",
        "progress_floor",  # [s] what several switches in a row must advance
        "dwell",
        "error_exponent",  # the next step goes with error^-error_exponent
        "h",  # [s] the trial step
        "h_wanted",  # [s] what it would be without time events
        "h_next",  # [s] the next step as control wants it
        "error",  # of the trial step, in weights
        "last_error",  # of the step before; 0: nothing is known of it
        "cut_at",  # the place s at which the step is cut; 1: at its end
        "t_piece",  # the end of the piece that is accepted
        "t_land",  # the time event or the stop that comes next
        "t_next",  # the next time event of the problem
        "t_release",  # when the first machine that is kept in its zone is let go
        "growth", "t_growth",  # [1/s] how fast a slip grows from nothing, and until when steps heed that (growth.py)
        "fixed_step",
        "swing_step",  # [s] how long a step of `ida` should be for the angles it turns
    ),
    indices={
        "rejections_by_unknown": "n",
    },
)  # fmt: skip
"""The settings of a run, the trial step [t, t + h] and what has become of it, and counts."""

POINT = Struct(
    copies=("n", "differential", "quadrature",),
    integers=(
        "worst",  # the unknown that the last norm, or the last error that was found, is due to; -1: none
        "projections",  # counter: ends of steps brought back to relations of positions
    ),
    numbers=(
        "t",
        "moved", "most_moved",  # in weights, how far an end was brought back; the farthest
    ),
    reals={
        # the point: y, y', y'' (y' of what is algebraic), df/dt of the last J
        "y": "n", "slope": "n", "curvature": "n", "ft": "n",
        # its error weights min(absolute + relative |y|, cap), and what they are made of
        "weight": "n", "absolute": "n", "relative": "n", "cap": "n",
        "y_end": "n",  # the end of the step from it
        "y_piece": "n",  # the end of the piece that is accepted
        "D": "three_n",  # of interpolant.py
        "error_vector": "n",  # of the step
        # scratch, see below
        "y_probe": "n", "f": "n", "b": "n", "x": "n", "u": "n", "v": "n", "minus_slip": "n", "asked": "n",
        "y_kept": "n", "slope_kept": "n",  # the point and its slopes before updates that may be taken back,
        "y_unsettled": "n", "slope_unsettled": "n",  # and before forces are looked for in zones that may have none
        "lost": "n",  # [J] energy lost in impacts, by the row that held
        "not_given_back": "n",  # by row, the fastest meeting too slow to give anything back; -1: one gave before
        "joined": "n", "first_joined": "n",  # by row: impulses that stops took together, and when the first was
        "begun": "n",  # the point as it was settled at the start
    },
    indices={
        "unweighed": "n",  # 1 for unknowns that no norm counts: quadratures, and what only a gauge tells
    },
)  # fmt: skip
"""The point t, y that a run has reached, the end of the step from it, weights, and vectors to work with.

Scratch holds nothing from one call by the loop to the next, and a function that calls another finds it overwritten.
Whoever uses one gives it a local name that says what it holds there. Any room may use all of them, for

    y_probe      unknowns at another place than the point or the end: laws and guards are asked there
    f            f(t, y) of the last evaluation; of the stage before, while `rodas` takes a step
    b            a right-hand side, and after `solve` the solution
    x            a right-hand side, then the solution, of a point: of Newton's method, of a way on which load comes in
    u            the theta point while `stepping` solves; else what a norm is wanted of, as a change of speed
    v            what M is multiplied by, mostly -y'
    minus_slip   what the callback `drift` gives: minus the slip of rows that hold
    asked        how far a solve said before that unknowns are off (quadratures.py)

`error_vector` is scratch too until the error of a step is estimated.
"""

RECORDER = Struct(
    integers=(
        "row_capacity", "event_capacity",
        "on_grid",  # rows are on a grid; else at the ends of steps
        "between",  # rows inside steps are handed over as well
        "most_inside",  # rows inside a step at most: codes.PARABOLA, QUARTIC
        "quadratures_off",  # quadratures of the step are to be integrated again (quadratures.py)
        "rows", "events",  # how many are in the buffers
        "total_events",
        "grid_next",  # number of the next point of the grid
        "inside", "inside_next",  # rows inside the piece; the next of them, 0: not asked yet
        "rows_slip",  # what holds is given no slip in every row, not once for the step (dense_output.py)
        "any_stiff",  # what the step has of `is_stiff`: 0, stiff.OF_SPEEDS or OF_BALANCES
        "shown_apart",  # `apart` counts at this event: as `any_stiff`
        "n_asked_stiff",
    ),
    numbers=(
        "every",  # [s] of the grid
        "t_row",  # of the last row
    ),
    reals={
        "apart": "n",  # at an event, how far from y it is shown
        "row_t": "row_capacity", "row_values": "rows_outputs", "event_t": "event_capacity",
    },
    indices={
        "is_stiff": "n",  # 1 for unknowns that are shown where their law balances (stiff.py)
        "asked_stiff": "n_asked_stiff",  # those that may be
        "row_side": "row_capacity",  # codes.ORDINARY, BEFORE, ...
        "event_machine": "event_capacity", "event_before": "event_capacity", "event_after": "event_capacity",
        "event_guard": "event_capacity",
        "event_position": "event_capacity",  # the pass of the settlement
    },
)  # fmt: skip
"""What is to be recorded, what was, and the buffers for it."""
