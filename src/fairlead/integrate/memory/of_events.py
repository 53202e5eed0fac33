"""The structs of events: guards, settlements, the order of release."""

from __future__ import annotations

from fairlead.integrate.memory.struct import Struct

GUARDS = Struct(
    copies=("n_guards", "guard_machine", "limit_guard",),
    integers=(
        "n_fired",
    ),
    reals={
        # at the point, at the end of the step
        "g": "n_guards", "g_end": "n_guards",
        # scratch: at both ends of a bracket, where they are asked now, shortly after the start and before the end of a
        # step (g_late: also how high they rise behind a crossing), a little later than the point, and the place from
        # which on they count in a step
        "g_left": "n_guards", "g_right": "n_guards", "g_probe": "n_guards", "g_early": "n_guards",
        "g_late": "n_guards", "g_later": "n_guards", "g_since": "n_guards",
        "guard_tolerance": "n_guards", "guard_inertia": "n_guards", "blocked_until": "n_zones",
        # guards whose tops are looked for: three places, what they have there, the next place (bumps.py)
        "bump_left": "n_guards", "bump_left_g": "n_guards", "bump_top": "n_guards", "bump_top_g": "n_guards",
        "bump_right": "n_guards", "bump_right_g": "n_guards", "bump_asks": "n_guards",
        "bump_rise": "n_guards", "bump_fall": "n_guards",
    },
    indices={
        "fired": "n_guards", "bump_guard": "n_guards", "bump_places": "n_guards",
    },
)  # fmt: skip
"""Guards at the point, along a step and at its end; which of them fired.

Scratch holds nothing from one trial step or pass to the next, but `g_late` from a crossing to the settlement there.
"""

SETTLING = Struct(
    copies=("n_guards", "n_zones", "guard_machine", "zones",),
    integers=(
        "passes", "one_by_one", "stalls",
        # which violators change, since which pass, the fewest there were, passes since
        "stage", "stage_from", "fewest", "waited", "switches", "settling_passes",
        # passes in which zones changed that have no answer
        "without_answer",
    ),
    numbers=(
        "t_last_switch", "look", "least_look", "nearness", "own_time",
    ),
    reals={
        "wrong": "n_guards", "last_toggle": "n_zones", "held_for": "n_zones", "rank": "n_zones",
        "patterns_met": "passes",
    },
    indices={
        "rim": "n_zones", "zones_before": "n_zones", "zones_given": "n_zones", "zones_history": "passes_zones",
        "streak": "n_zones", "chatters": "n_zones", "switches_by_machine": "n_zones",
    },
)  # fmt: skip
"""A settlement: which violators change, since which pass, who chatters.

`wrong` is by how much guards are violated; impulse_zones.py and the order of release keep guards there that they ask
meanwhile. `zones_before` are the zones before the pass, `zones_given` those of the start, `zones_history` all since.
"""

LOADS = Struct(
    integers=(
        # whether the order was asked for in this settlement, levels of load that are still out, whether zones have
        # changed since the last of them, whether there was nothing before
        "ordered", "levels", "level_due", "nothing_before",
    ),
    numbers=(
        "fastest",
    ),
    reals={
        # the point just before, loads that are out and the shares that are left, rates of guards by slips at both ends
        # of a way, slips in the time of a level
        "y_before": "n", "f_before": "n", "out": "levels_n", "left": "levels", "rate": "n_guards",
        "rate_end": "n_guards", "fast_slip": "n_guards",
    },
    indices={
        # the level in which a slip began, guards that it has brought back to zero
        "born": "n_guards", "came_back": "n_guards", "zones_just_before": "n_zones",
        # by circle: 1 if one of its contacts has changed its zone since the last level
        "circle_changed": "n",
    },
)  # fmt: skip
"""The order of release at a jump of load (release.py)."""
