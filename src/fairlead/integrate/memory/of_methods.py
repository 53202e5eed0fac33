"""The structs of the methods."""

from __future__ import annotations

from fairlead.integrate.memory.struct import Struct

TABLEAU = Struct(
    copies=("n",),
    integers=(
        "n_watched", "stages",
    ),
    numbers=(
        "gamma",
    ),
    reals={
        "K": "stages_n", "a": "stages_stages", "C": "stages_stages", "c": "stages", "d": "stages", "m": "stages",
        "e": "stages", "H": "three_stages",
        # slopes of unknowns by themselves, one step ago
        "slope_seen": "n",
    },
    indices={
        # right at both ends of a step and wrong in between, perhaps; speeds whose law may fade in it
        "watched": "n", "fades": "n",
    },
)  # fmt: skip
"""A method of one step with its stages: a tableau, or what a method keeps there."""

RULE = Struct(
    copies=("n", "quadrature",),
    integers=(
        # whether it lands on every switch, whether J and M are those of the zones in force, steps failed in a row,
        # tries to end where a law jumps, whether the step in hand, which ends there, keeps the zones of its start
        "locates", "linearised", "failed", "localising", "frozen", "block_steps",
        # whether moves were taken back in this step (residual.py), whether its matrix is that of zones or values
        # met on the way, whether other pivots were tried for that
        "searched", "midway", "replanned",
        # whether what is stiff is at rest at the end of a step, since friction falls somewhere (jump_inside.py)
        "damps",
        # whether no step was taken, since the next time event is this instant
        "instant",
    ),
    numbers=(
        # theta asked for, its rise when zones cycle, theta in force
        "least_theta", "theta_raise", "theta_now",
        # time from the middle of the last step to now, half of it, or 0 right after a settlement; that between the
        # middles of the two before
        "gap", "gap_before", "t_cut", "t_kink",
        # what was allowed in the last steps (history.py)
        "allowed", "allowed_before",
    ),
    reals={
        # slopes of this step, of the one before and of the one before that; algebraic unknowns in its middle
        "mean_slope": "n", "slope_before": "n", "slope_earlier": "n", "mean_before": "n", "move": "n", "chord_end": "n",
        # by row, of a law that jumps: its impulse, and what puts the end right (jump_inside.py)
        "kick": "n", "kick_first": "n", "kick_second": "n",
    },
    indices={
        # unknowns whose error sets the step
        "controlled": "n",
    },
)  # fmt: skip
"""`stepping`: the theta rule and its steps."""

EXCHANGE = Struct(
    copies=("n", "n_zones", "zones",),
    integers=(
        "driven", "massless", "newly_held", "unchecked", "n_hold_mass", "n_hold_slope", "n_hold_share",
        # whether zones may not be those of J and M, in how many machines they differ, if only known rows were
        # exchanged, what was assumed in a step, what has turned out wrong, whether such a row caught
        "zones_differ", "n_exchanged", "rows_alone", "assumed", "invalidated", "caught_by_row", "n_own_slopes",
        "n_own_masses", "n_known",
    ),
    reals={
        "known_slopes": "own_slopes_by_zone", "known_masses": "own_masses_by_zone",
        "known_constants": "machines_by_zone",
    },
    indices={
        # rows that hold now
        "holds": "n", "of_massless": "n", "caught": "n", "hold_mass": "n_hold_mass", "hold_mass_row": "n_hold_mass",
        "hold_mass_column": "n_hold_mass", "hold_slope": "n_hold_slope",
        "hold_slope_row": "n_hold_slope", "hold_share": "n_hold_share", "hold_share_row": "n_hold_share",
        "hold_share_column": "n_hold_share", "own_row": "n_zones", "own_slope_starts": "n_zones_plus_1",
        "own_slopes": "n_own_slopes", "own_slope_columns": "n_own_slopes", "own_mass_columns": "n_own_masses",
        "own_mass_starts": "n_zones_plus_1", "own_masses": "n_own_masses", "known": "machines_by_zone",
        "zones_linearised": "n_zones", "known_of_kind": "machines_by_zone", "exchanged_machines": "n_zones",
    },
)  # fmt: skip
"""`stepping`: rows of J and M that are known for a zone and exchanged without a factorisation (row_cache.py)."""

CONTACTS = Struct(
    copies=("n", "n_guards", "n_zones", "guard_machine", "limit_guard", "zones",),
    integers=(
        "expecting", "has_limits", "n_body_speed", "n_neighbours", "limits_vary", "n_switched", "n_suspects",
        "n_free_guards",
    ),
    reals={
        "switched_after": "n_zones", "jump_at": "n_zones", "held_inertia": "n_zones",
        # guards where the step before began
        "g_before": "n_guards",
    },
    indices={
        "rested": "n", "zones_at_start": "n_zones", "body_starts": "n_zones_plus_1", "body_speed": "n_body_speed",
        "body_position": "n_body_speed", "continuous": "n_guards", "may_jump": "n_guards", "is_mean": "n_guards",
        "suspects": "n_guards", "kind_is_smooth": "n_zones", "zones_probed": "n_zones", "first_guard": "n_zones",
        "met": "n_zones", "hold_row": "n_zones", "released": "n_zones", "released_by": "n_zones",
        "switched": "n_zones", "neighbour_starts": "n_zones_plus_1", "neighbours": "n_neighbours",
        "own_kind": "n_zones", "only_kinks": "n_zones",
    },
)  # fmt: skip
"""`stepping`: who holds what and hands its load to whom (active_set.py), what a step may have missed."""
