"""The struct of a problem in the memory of a run."""

from __future__ import annotations

from fairlead.integrate.memory.struct import Struct

PROBLEM = Struct(
    calls=(
        "context", "call_rhs", "call_jacobian", "call_mass", "call_guards", "call_switch", "call_slip",
        "call_next_time", "call_at_time", "call_outputs", "call_forces", "call_drift", "call_slopes", "call_gap",
        "call_ahead", "call_swings",
    ),
    integers=(
        # sizes; every machine has one zone in force (`zones`)
        "n", "n_algebraic", "n_guards", "n_machines", "n_outputs",
        # whether contacts share what they hold
        "has_circles",
        # whether guards have inertias
        "weighs_guards",
        # impacts: whether any row takes impulses, and any such is in a circle; unknowns of the energy ledger (-1: none)
        "takes_impulses", "rigid_circles", "rebounds", "n_integrals", "n_balanced", "n_light", "dissipated_at",
        "supplied_at",
        # positions that move back to relations, and those of which the acceleration is an unknown, as of relations that
        # hold for ever
        "n_moves", "n_accelerated",
        # guards of places at which stops are met
        "n_met_guards",
        # guards that are the least of several values, which is remembered
        "n_least",
        # what sines are taken of that no error of a step knows
        "n_swings",
        # rows whose force other laws read
        "n_pressing",
        # whether friction of a contact falls as it lets go
        "falling", "linear", "n_quadratures", "samples",
        # address of what the callbacks read of means of given motions, 0 where none is given
        "mean_at",
        # how often it was asked
        "rhs", "jacobians", "guards",
    ),
    reals={
        "rebound": "n",
        # by circle: below it, what bodies share of an impulse is none (impulse.py)
        "least_share": "n",
        # an impulse that is taken in parts, and the point before it
        "impulse": "n", "before": "n",
        # the angles of `n_swings` at both ends of a trial step
        "swing": "n_swings", "swing_end": "n_swings",
        # by rows whose force other laws read: what each answers to pushes at all, and what is left in an elimination
        "pressing_answer": "pressing_square", "pressing_left": "pressing_square",
    },
    indices={
        # relations of positions: a position, its speed, and its acceleration where that is an unknown
        "move_position": "n_moves", "move_speed": "n_moves", "move_acceleration": "n_moves",
        # nodes without inertia: their positions and speeds
        "balanced_position": "n_balanced", "balanced_speed": "n_balanced",
        "met_guard": "n_met_guards",
        # rows whose force other laws read, and the sign with which that answers a push
        "pressing_row": "n_pressing", "pressing_sign": "n_pressing",
        # which of them have a force that no rigid part has
        "pressing_wrong": "n_pressing",
        # entries of M in columns of speeds without inertia
        "light": "n_light",
        # the speed of an acceleration that is an unknown; of others they themselves
        "speed_of": "n", "differential": "n", "quadrature": "n", "takes_impulse": "n",
        # the position of each speed (-1: none)
        "position_of": "n", "kink_guard": "n_guards", "least_guard": "n_guards", "may_hold": "n_guards",
        "limit_guard": "n_guards", "bounded_row": "n_guards", "blow_guard": "n_guards", "latch_guard": "n_guards",
        # by row who decides whether it holds, the number of the circle in which forces are shared (0: none), and with
        # which sign a force there would grow with the slip
        "holder": "n", "circle": "n", "grows_with_slip": "n",
        "falls": "n_machines", "is_speed": "n", "struck": "n", "integral": "n",
        "zones": "n_machines",
        "guard_machine": "n_guards",
    },
)  # fmt: skip
"""What a problem is: sizes, the addresses of its functions, facts about its unknowns; and how often it was asked.

It is the largest struct, and one all the same: of its single values compiled code writes the last three alone, so that
nobody is coupled to another through the rest.
"""
