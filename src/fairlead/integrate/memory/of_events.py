"""The structs of events: guards, settlements, the order of release; a field, or a few of one kind, a line."""

from __future__ import annotations

from fairlead.integrate.memory.struct import Struct

GUARDS = Struct(
    copies=("n_guards", "guard_machine", "limit_guard",),
    integers=(
        "n_fired",  # how many guards `fired` lists
    ),
    reals={
        "g": "n_guards",  # at the point
        "g_end": "n_guards",  # at the end of the step; of `stepping` with switches inside each where its law is read
        # scratch, in a step:
        "g_left": "n_guards", "g_right": "n_guards",  # at both ends of a bracket
        "g_probe": "n_guards",  # wherever they are asked now
        "g_early": "n_guards",  # shortly after the start
        "g_late": "n_guards",  # shortly before the end; how high they rise behind a crossing; or in the middle
        "g_later": "n_guards",  # a little later than the point
        "g_since": "n_guards",  # the place s from which on they count
        "guard_tolerance": "n_guards",
        "guard_inertia": "n_guards",  # of slips of contacts that may hold: what resists their force; 0 of others
        "blocked_until": "n_machines",  # the time until which a machine keeps its zone (chatter.py)
        # guards whose tops are looked for (bumps.py): by the number of the search, two places with a top in between,
        "bump_left": "n_guards", "bump_left_g": "n_guards", "bump_top": "n_guards", "bump_top_g": "n_guards",
        "bump_right": "n_guards", "bump_right_g": "n_guards",
        "bump_asks": "n_guards",  # the place to ask next,
        "bump_rise": "n_guards", "bump_fall": "n_guards",  # and the slopes at the ends, 0 where an end was cut off
    },
    indices={
        "fired": "n_guards",  # numbers of the guards that fired, or that are asked for
        "bump_guard": "n_guards", "bump_places": "n_guards",  # which guard it is, and at how many places it was asked
        "in_corner": "n_guards",  # 1: it touches zero where a force that presses passes through zero (corners.py)
    },
)  # fmt: skip
"""Guards at the point, along a step and at its end; which of them fired.

Scratch holds nothing from one trial step or pass to the next, but `g_late` from a crossing to the settlement there.
"""

SETTLING = Struct(
    copies=("n_guards", "n_machines", "guard_machine", "zones",),
    integers=(
        "passes",  # of this settlement; of a step of `stepping` how often its zones were switched
        "one_by_one",  # in a step of `stepping`: 0 all violators switch, 1 those half as wrong as the worst, 2 one
        "stalls",  # settlements in a row that did not advance in time (chatter.py)
        "stage",  # which violators change: settling.ALL, HALF_AS_WRONG, the worst alone, LEAST_INDEX and beyond
        "stage_from",  # the pass since which: patterns before it may recur
        "fewest", "waited",  # the fewest violators that there were, passes since
        "switches", "settling_passes",  # counters of the run
        "without_answer",  # passes in which zones changed that have no answer
    ),
    numbers=(
        "t_last_switch",  # the last settlement in which a guard fired
        "lookahead",  # [s] how far ahead guards are judged; 0: not known yet
        "least_lookahead",  # [s] at least so far, after a crossing that was too early (arrival.py)
        "nearness",  # share of the first `lookahead` that is left
        "own_time",  # [s] a time of the bodies in an impact, of which a small part is its own (impulse_load.py)
    ),
    reals={
        "wrong": "n_guards",  # by how much guards are violated; scratch of impulse_zones.py and the order of release
        "last_toggle": "n_machines",  # when a machine switched last
        "held_for": "n_machines",  # [s] for how long it was last kept in its zone
        "rank": "n_machines",  # the order of the least index (least_index.py)
        "patterns_met": "passes",  # a number for the zones after each pass
    },
    indices={
        "boundary": "n_machines",  # of a part: 1 for machines whose change sets more in motion
        "zones_before": "n_machines", "zones_given": "n_machines",  # before the pass; at the start of the run
        "zones_history": "passes_zones",  # after each pass
        "streak": "n_machines", "chatters": "n_machines",  # toggles in a row within a dwell; how often too many
        "switches_by_machine": "n_machines",
    },
)  # fmt: skip
"""A settlement: which violators change, since which pass, who chatters."""

LOADS = Struct(
    integers=(
        "ordered",  # the order was asked for in this settlement
        "levels",  # levels of load that are still out
        "level_due",  # zones have changed since the last of them
        "nothing_before",  # there was nothing before: forces are built up from zero
    ),
    numbers=(
        "fastest",  # the largest rate so far, by which what is rounding is told (fast_way.py)
    ),
    reals={
        "y_before": "n", "f_before": "n",  # the point just before, and f there
        "out": "levels_n", "left": "levels",  # loads that are out, and the shares of them that are left
        "rate": "n_guards", "rate_end": "n_guards",  # of guards by slips, at both ends of a way
        "fast_slip": "n_guards",  # slips in the time of a level
    },
    indices={
        "born": "n_guards",  # the level in which a slip began
        "came_back": "n_guards",  # 1 for guards that it has brought back to zero
        "zones_just_before": "n_machines",
        "circle_changed": "n",  # by circle: 1 if one of its contacts has changed its zone since the last level
    },
)  # fmt: skip
"""The order of release at a jump of load (release.py)."""
