"""The structs of a run, whatever its method: where it is, and what it records."""

from __future__ import annotations

from fairlead.integrate.memory.struct import Struct

RUN = Struct(
    integers=(
        "max_passes", "max_steps", "max_events",
        # settings
        "adaptive", "on_chatter",
        # where the run is
        "phase", "crossed", "companion", "judged", "landing", "retried", "mended", "stop_asked", "dropped",
        "first_sample",
        # the step at which to look whether less would do, whether this is a part, whether its rim has changed
        "narrow_at", "narrowed", "woken",
        # 1 where a user gave them: they count as they are then (chatter.py)
        "dwell_given", "step_floor_given",
        # counters
        "steps", "rejected_error", "rejected_nan", "rejected_companion", "rejected_switch", "rejected_cycling",
        "rejected_diverged", "rejected_singular", "located", "time_events", "partial_steps",
    ),
    numbers=(
        "start", "stop", "max_step", "first_step", "step_floor", "progress_floor", "dwell", "error_exponent", "h",
        "h_wanted", "h_next", "error", "last_error", "cut_at", "t_piece", "t_land", "t_next", "t_release", "growth",
        "t_growth", "fixed_step", "swing_step",
    ),
    indices={
        "rejections_by_unknown": "n",
    },
)  # fmt: skip
"""The settings of a run, the trial step [t, t + h] and what has become of it, and counts."""

POINT = Struct(
    copies=("n", "differential", "quadrature",),
    integers=(
        "worst", "projections",
    ),
    numbers=(
        "t", "moved", "most_moved",
    ),
    reals={
        # the point: y, y', y'' (y' of what is algebraic), df/dt of the last J; weights
        "y": "n", "slope": "n", "curvature": "n", "ft": "n",
        "weight": "n", "absolute": "n", "relative": "n", "cap": "n",
        # the step from it: its end, the end of the piece that is accepted, the D of interpolant.py, its error
        "y_end": "n", "y_piece": "n", "D": "three_n", "error_vector": "n",
        # scratch, see below
        "y_probe": "n", "f": "n", "b": "n", "x": "n", "u": "n", "v": "n", "minus_slip": "n", "asked": "n",
        # the point and its slopes before updates that may be taken back
        "y_kept": "n", "slope_kept": "n",
        # and before its forces are looked for, in zones that may have none
        "y_unsettled": "n", "slope_unsettled": "n",
        # energy lost in impacts, by the row that held
        "lost": "n",
        # the fastest meeting that gave nothing back since it was slow, by the row; -1 where one did before
        "not_given_back": "n",
        # the point as it was settled at the start
        "begun": "n",
    },
    indices={
        "unweighed": "n",
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
    asked        how far a solve said before that unknowns are off (meters.py)

`error_vector` is scratch too until the error of a step is estimated. `worst` is the unknown that the last norm, or the
last error that was found, is due to.
"""

RECORDER = Struct(
    integers=(
        "row_capacity", "event_capacity", "on_grid", "between", "most_inside", "meters_off", "rows", "events",
        "total_events", "grid_next", "inside", "inside_next", "rows_slip", "any_stiff", "shown_apart",
    ),
    numbers=(
        "every", "t_row",
    ),
    reals={
        # of an event, how far from y it is shown
        "apart": "n", "row_t": "row_capacity", "row_values": "rows_outputs", "event_t": "event_capacity",
    },
    indices={
        "is_stiff": "n", "row_side": "row_capacity", "event_machine": "event_capacity",
        "event_before": "event_capacity", "event_after": "event_capacity", "event_guard": "event_capacity",
        "event_position": "event_capacity",
    },
)  # fmt: skip
"""What is to be recorded, what was, and the buffers for it."""
