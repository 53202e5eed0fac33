"""What goes along when the loop turns from a problem to a part of it, and what is made anew for either."""

from fairlead.integrate.counters import COUNTS
from fairlead.integrate.memory.layout import INTEGERS, NUMBERS
from fairlead.integrate.parts import CARRIED

OF_THE_PROBLEM = {
    *(name for name in INTEGERS if name.startswith("n_")), "n", "stages", "dense", "linear",
    "most_perturbed", "most_inside", "has_limits", "has_circles", "weighs_guards", "rebounds", "takes_impulses",
    "rigid_circles",
    "falling", "dissipated_at", "supplied_at", "samples", "first_sample", "mean_at", "max_passes",
    "gamma", "error_exponent",
}  # fmt: skip
OF_THE_RUN = {
    "row_capacity", "event_capacity", "max_steps", "max_events", "adaptive", "on_grid", "between", "on_chatter",
    "start", "stop", "every", "max_step", "first_step", "step_floor", "progress_floor", "dwell", "dwell_given",
    "step_floor_given",
    "least_theta", "fixed_step", "most_solves",
}  # fmt: skip
OF_THE_PLACE = {"restrict_at", "is_part", "boundary_switched", "rows", "events"}
"""Set by parts.py itself, or emptied before."""
OF_A_SETTLEMENT = {
    "n_fired", "passes", "one_by_one", "stage", "stage_from", "fewest", "waited", "lookahead",
    "least_lookahead", "nearness", "own_time", "culprit", "worst", "ordered", "levels",
    "level_due", "nothing_before", "fastest", "without_answer", "no_pivots",
}  # fmt: skip
OF_A_STEP = {
    "jacobian_fresh", "algebraic_speeds", "linearised", "any_captured", "unchecked", "expecting", "rows_slip",
    "reduced_kind", "reduced_valid", "reduced_scale", "factored_h", "factored_theta", "mass_factor", "zones_differ",
    "rows_alone", "assumed", "invalidated",
    "captured_by_row", "time_dependent_limits", "inside", "inside_next", "any_stiff", "shown_apart", "moved",
    "searched", "frozen", "instant", "midway", "replanned", "theta_now", "solves_had",
}  # fmt: skip
"""Evaluations and factors: what is not carried is evaluated again."""


def test_every_number_of_a_run_is_carried_or_made_anew():
    """A number added to the struct has to be put in one of these sets: carried when it says where a run is."""
    anew = OF_THE_PROBLEM | OF_THE_RUN | OF_THE_PLACE | OF_A_SETTLEMENT | OF_A_STEP
    assert anew.isdisjoint(CARRIED)
    assert set(COUNTS) <= set(CARRIED)
    assert anew | set(CARRIED) == {*INTEGERS, *NUMBERS}
