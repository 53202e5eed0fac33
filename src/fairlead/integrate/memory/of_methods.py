"""The structs of the methods: a field, or a few of one kind, a line, with what it says.

A flag is 0 or 1. Arrays go by the name of their length: n unknowns, machines and guards of a problem. Where a field is
set and read by one file alone, that is named.
"""

from __future__ import annotations

from fairlead.integrate.memory.struct import Struct

TABLEAU = Struct(
    copies=("n",),
    integers=(
        "n_monitored",  # how many are `monitored`
        "stages",
    ),
    numbers=(
        "gamma",  # W = M/(h gamma) - J
    ),
    reals={
        "K": "stages_n",  # the stages of a step; or what a method of one's own keeps of earlier steps
        "a": "stages_stages", "C": "stages_stages", "c": "stages", "d": "stages",  # of the stages (rodas/tableau.py)
        "m": "stages", "e": "stages", "H": "three_stages",  # weights of the end, its error, and of D
        "slope_seen": "n",  # entries of J of unknowns by themselves, one J ago (faded.py)
    },
    indices={
        "monitored": "n",  # unknowns that may be right at both ends of a step and wrong in between
        "fades": "n",  # speeds whose law may fade in the step (faded.py)
    },
)  # fmt: skip
"""A method of one step with its stages: a tableau, or what a method keeps there. `stepping` reads `monitored` too."""

RULE = Struct(
    copies=("n", "quadrature",),
    integers=(
        "locates",  # steps end at every switch, and have the zones of their start
        "always_locates",  # they do in the whole run (engine.py)
        "locates_for",  # settlements until they no longer do (repeated.find_latch_ahead)
        "linearised",  # J and M are those of the zones they were last evaluated in; 0: evaluate them anew
        "failed",  # above 0 for some steps after one that was not solved: no fronts are expected. Fixed: halves to go
        "localising",  # tries so far to end the step where a law jumps
        "frozen",  # the step in hand ends at such a jump, and keeps the zones of its start
        "block_steps",  # steps of the block that `allowed` is of (history.py)
        "searched",  # moves were taken back in this step: residual.SEARCHED, GIVEN_UP
        "midway",  # the matrix is that of zones or values met on the way
        "replanned",  # other pivots were tried for a matrix met midway
        "damps",  # what is stiff is at rest at the end of a step, since friction falls somewhere (jump_inside.py)
        "instant",  # no step was taken: the next time event is this instant
        # a run in real time (frames.py)
        "most_solves",  # what a step may have; 0: the run is none
        "solves_had",  # what the step in hand has had
        "trying",  # the step in hand was tried before
        "over",  # it counts as an overrun already
        "overruns",  # counter: steps that met the cap, or were taken again
        "overrun_how", "overrun_at",  # of the first: codes.UNSETTLED and a guard, UNSOLVED and an unknown, or REPEATED
    ),
    numbers=(
        "least_theta",  # the theta that the run asks for
        "theta_raise",  # by how much it was raised as zones cycled
        "theta_now",  # the theta of the step in hand
        "gap",  # [s] from the middle of the last step to now, half of it; 0 right after a settlement
        "gap_before",  # [s] between the middles of the two steps before
        "t_cut",  # the time at which the step is to end instead, where something was found
        "t_kink",  # the last kink of a table that a step ended short of, passed or not; -NEVER before the first
        "allowed", "allowed_before",  # [s] the least that this block of steps, and the one before, allowed
        "t_overrun",  # when the first overrun began; NEVER without one
    ),
    reals={
        "mean_slope": "n",  # slopes of this step: of the chord; of a mean, as a force is, from middle to middle
        "slope_before": "n", "slope_earlier": "n",  # those of the step before, and of the one before that
        "mean_before": "n",  # algebraic unknowns in the middle of the last step, where steps end at every switch
        "move": "n",  # the last solution, for the line search (residual.py)
        "chord_end": "n",  # scratch: the end before it is moved to judge captures (jump_inside.py)
        "chord_defect": "n",  # c of third_order.py: f with motions that are given on their chord, less f
        "half_move": "n",  # scratch: d/2 of third_order.py while g is solved for
        "kick": "n",  # by row, of a law that jumps: what its mean is asked to be
        "kick_first": "n", "kick_second": "n",  # and what it adds in the two solves that move the end (third_order.py)
    },
    indices={
        "controlled": "n",  # 1 for unknowns whose third difference sets the step: differential, no speed of a body
    },
)  # fmt: skip
"""`stepping`: the theta rule and its steps."""

EXCHANGE = Struct(
    copies=("n", "n_machines", "zones",),
    integers=(
        "support_accelerates",  # a contact holds on a surface whose speed varies
        "algebraic_speeds",  # a contact has held a node without mass: once 1, it stays, and only costs evaluations
        "any_captured",  # rows hold since the last solve that did not before: their slip is to be evaluated
        "unchecked",  # the residual was not looked at since the factors are those in force
        "n_hold_mass", "n_hold_slope", "n_hold_share",
        "zones_differ",  # zones may not be those of J and M
        "n_exchanged",  # how many machines `exchanged_machines` lists
        "rows_alone",  # rows from the cache are all that J, M and the factors have changed by
        "assumed",  # what this step relies on of the cache: row_cache.CONSTANT, OF_KIND
        "invalidated",  # what of that has turned out wrong in the run
        "captured_by_row",  # a row from the cache began to hold: its surface is to be looked at once the step is solved
        "n_own_slopes", "n_own_masses",
        "n_known",  # zones that are remembered times machines
    ),
    reals={
        # the cache, by zone and then as below: entries of J and M in the row a machine holds; the constant of that row
        "known_slopes": "own_slopes_by_zone", "known_masses": "own_masses_by_zone",
        "known_constants": "machines_by_zone",
    },
    indices={
        # the contacts in the zones in force
        "holds": "n",  # 1 for rows that hold now
        "of_algebraic_speed": "n",  # 1 for rows that have held a node without mass
        "captured": "n",  # 1 for rows that hold now and did not at the start of the step
        # entries of M in rows that may hold: place, row, column; of J to what moves; of J to other forces, in a circle
        "hold_mass": "n_hold_mass", "hold_mass_row": "n_hold_mass", "hold_mass_column": "n_hold_mass",
        "hold_slope": "n_hold_slope", "hold_slope_row": "n_hold_slope",
        "hold_share": "n_hold_share", "hold_share_row": "n_hold_share", "hold_share_column": "n_hold_share",
        # by machine: the one row that it holds, -1 where it holds none or several; entries of J and of M in that row
        "own_row": "n_machines",
        "own_slope_starts": "n_machines_plus_1", "own_slopes": "n_own_slopes", "own_slope_columns": "n_own_slopes",
        "own_mass_columns": "n_own_masses", "own_mass_starts": "n_machines_plus_1", "own_masses": "n_own_masses",
        "known": "machines_by_zone",  # by zone and machine: what the cache has, 0, row_cache.ROW or CONSTANT
        "zones_linearised": "n_machines",  # the zones of J and M
        "known_of_kind": "machines_by_zone",  # by zone and kind: a machine whose row is known, + 1; 0: none
        "exchanged_machines": "n_machines",  # machines whose rows were exchanged, or all that were evaluated
    },
)  # fmt: skip
"""`stepping`: rows of J and M that are known for a zone and exchanged without a factorisation (row_cache.py).

`holds`, `captured`, `of_algebraic_speed`, `support_accelerates` and `algebraic_speeds` say besides what holds now: all
of the room reads them.
"""

CONTACTS = Struct(
    copies=("n", "n_guards", "n_machines", "guard_machine", "limit_guard", "zones",),
    integers=(
        "expecting",  # contacts were let go in this step because fronts are expected to run on
        "has_limits",  # the problem says which guards are limits of held forces
        "n_body_speed", "n_neighbours",
        "time_dependent_limits",  # a limit was seen to vary within a step: once 1, it stays
        "n_switched",  # how many machines `switched` lists
        "n_suspects",  # how many guards `suspects` lists
        "n_free_guards",  # guards of machines that hold nothing
    ),
    reals={
        "switched_after": "n_machines",  # the share of the step after which a machine left its zone; 0: it did not
        "left_at": "n_machines",  # the share at which a machine left its zone, for the log; switch_inside.NOT_SEEN
        "jump_at": "n_machines",  # where between two middles a limit was reached; jump_inside.STAYED, NO_LIMIT
        "held_inertia": "n_machines",  # the inertia that resists the force of a machine; 0: not known
        "g_before": "n_guards",  # guards where the step before began
    },
    indices={
        "rested": "n",  # through how many steps a row has held
        "zones_at_start": "n_machines",
        # by machine: the bodies that it holds, their speeds and positions (-1: none)
        "body_starts": "n_machines_plus_1", "body_speed": "n_body_speed", "body_position": "n_body_speed",
        "continuous": "n_guards",  # the zone, + 1, in which the law was found not to jump at a guard; 0: not known
        "may_jump": "n_guards",  # 1 for guards at which laws are asked whether they jump
        "is_mean": "n_guards",  # 1 for guards that are read in the middle of a step (jump_at_end.py)
        "suspects": "n_guards",  # scratch: guards that fired, while `fired` is used for others
        "kind_is_smooth": "n_machines",  # by kind: 0, jump_at_end.SMOOTH, JUMPS_SOMEWHERE
        # scratch: zones while laws are asked in others; from remember_before_switch on those that a jump puts back
        "zones_probed": "n_machines",
        "first_guard": "n_machines",
        "met": "n_machines",  # scratch, 0 between passes: what a front has come to (slip_fronts.MET)
        "jumped": "n_machines",  # scratch, 0 between passes: 1 for machines whose law has jumped (jump_inside.py)
        "hold_row": "n_machines",  # the first row that a machine is known to hold; -1: none
        "released": "n_machines", "released_by": "n_machines",  # the last step a contact let go in, by which guard
        "switched": "n_machines",  # machines that left their zone in the step, with a place for it
        "neighbour_starts": "n_machines_plus_1", "neighbours": "n_neighbours",  # by machine: who is handed its load
        "in_order": "n_machines",  # scratch: machines that changed, in the order in which they left their zones
        "latches": "n_machines",  # 1 for machines that only tell signals and remember, as a relay
        "own_kind": "n_machines",  # machines of one number have the same laws and rows alike
        "only_kinks": "n_machines",  # 1 for machines that are but pieces of continuous tables
    },
)  # fmt: skip
"""`stepping`: who holds what and hands its load to whom (slip_fronts.py), what a step may have missed."""
