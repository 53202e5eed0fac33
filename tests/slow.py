"""Tests that `make test` leaves to `make test-all`: they take long, and others of their file show the mechanism.

Patterns of test names as pytest prints them (`*` stands for anything), beside those that their files mark themselves.
"""

from __future__ import annotations

import re

LEFT_TO_TEST_ALL = (
    # hard cases: other treatments than `hold` on ida and the method of order three; rodas and stepping play them
    "tests/hard/*_/_rodas3p_/_*",
    "tests/hard/*_/_ida_/_lugre*",
    "tests/hard/*_/_ida_/_binding*",
    # hard cases: of a parameter the ends and one between are played, of pairs of cases one on ida
    "tests/hard/*[stiff_core_in_a_soft_hose,_1e4_/_*",
    "tests/hard/*[stiff_core_in_a_soft_hose,_1e6_/_*",
    "tests/hard/*[steep_falling_curve,_*_over_1e-05_m/s_/_*",
    "tests/hard/*[steep_falling_curve,_tustin_over_*_/_ida_/_*",
    "tests/hard/*[stick_slip_at_accuracy,_1e-5_/_*",
    "tests/hard/*[stick_slip_at_accuracy,_1e-7_/_*",
    "tests/hard/*[stick_slip_at_accuracy,_1e-8_/_*",
    "tests/hard/*[stick_slip_at_accuracy,_1e-9_/_*",
    "tests/hard/*[two_blocks_on_a_belt_that_are_shaken,_1e-9_/_*",
    "tests/hard/*[time_shifted,_1_s_/_*",
    "tests/hard/*[unit_rescaled,_forces_and_masses_*_/_ida_/_*",
    "tests/hard/*[unit_rescaled,_other_words_*_/_ida_/_*",
    "tests/hard/*[unit_rescaled,_other_words_*_/_stepping_/_*",
    "tests/hard/*[mirrored_blocks_stay_mirrored,_falling_curve_/_ida_/_*",
    "tests/hard/*_pulled_from_both_ends,_100_/_*",
    "tests/hard/*[normal_force_to_zero_and_back,_touching_zero_/_ida_/_*",
    "tests/hard/*[normal_force_to_zero_and_back,_touching_zero_/_rodas_/_lugre*",
    "tests/hard/*[normal_force_to_zero_and_back,_at_once_/_ida_/_*",
    "tests/hard/*[normal_force_to_zero_and_back,_at_once_/_rodas_/_lugre*",
    "tests/hard/*[normal_force_to_zero_and_back,_four_times_/_rodas_/_lugre*",
    # random scenes: ninety-five of a hundred are played
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[networks-92]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[networks-161]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[networks-184]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[networks-207]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[routes-23]",
    "tests/invariance/test_invariance.py::test_the_order_in_which_a_hundred_parts_*[3]",
    # routes: one drive and one start are played
    "tests/models/test_guidance_drives.py::*[guidance_route_electric*",
    "tests/models/test_route_mesh.py::test_steady_tensions_converge_*",
    "tests/models/test_route_terms.py::*deployer*",
    "tests/models/test_route_terms.py::test_a_pulley_takes_what_its_bearing_takes*",
    "tests/models/test_rigid_sea.py::*array-*",
    "tests/models/test_rigid_sea.py::*-stepping*",
    "tests/models/test_rigid_sea.py::test_a_margin_that_holds_*",
    "tests/models/test_rigid_sea.py::test_line_that_goes_out_and_comes_back_*array*",
    "tests/models/test_rigid_sea.py::test_in_steady_tow_*[-0.4*",
    "tests/models/test_guidance_route.py::test_belts_clamped_too_weakly_*",
    "tests/models/test_guidance_route.py::test_with_a_slow_ship_*",
    "tests/models/test_long_lines.py::test_300_m_*",
    "tests/components/test_route_devices.py::test_at_its_stop_a_tensioner_*",
    "tests/models/test_carried.py::*-stepping*",
    "tests/models/test_bend_sweep.py::*literal*",
    "tests/models/test_bend_sweep.py::test_every_treatment_finds_*[0.35-LuGre]",
    "tests/models/test_bend_sweep.py::test_every_treatment_finds_*[0.5-tanh]",
    "tests/models/test_carried.py::test_a_line_that_is_paid_out_and_hauled_in_*[rim-*",
    "tests/models/test_route_mesh.py::test_steady_tensions_do_not_know_*",
    "tests/models/test_bend_variants.py::test_the_hose_*[creep 1e-3, mu 0.35]",
    # variants of the single bend: one of each kind of change is played
    "tests/models/test_bend_variants.py::test_the_hose_*[creep 1e-5]",
    "tests/models/test_bend_variants.py::test_the_hose_*[creep 1e-3]",
    "tests/models/test_bend_variants.py::test_the_hose_*[EA_h *",
    "tests/models/test_bend_variants.py::test_the_hose_*[bulkhead friction *",
    "tests/models/test_bend_variants.py::test_the_hose_*[mu 0.25]",
    "tests/models/test_bend_variants.py::test_the_hose_*[mu 0.40]",
    "tests/models/test_bend_variants.py::test_the_hose_*[mu 0.49, *",
    "tests/models/test_bend_variants.py::test_the_hose_*[mu 0.50, *",
    "tests/models/test_bend_variants.py::test_where_the_bulkheads_*[mu 0.25]",
    "tests/models/test_bend_variants.py::test_where_the_bulkheads_*[creep *",
    "tests/models/test_constant_inboard_tension.py::test_what_is_lacking_*[20000]",
    "tests/unit/test_carriage.py::test_what_is_left_does_not_depend_on_how_much_*",
    "tests/models/test_torsion.py::test_with_a_friction_of_its_own_*",
    # advice and cost: the closed forms and one model are played
    "tests/models/test_effects_advice.py::*[guidance_route*",
    "tests/models/test_effects_advice.py::test_the_command_prints_a_sentence_for_each*",
    "tests/models/test_effects_advice.py::test_laws_that_are_compiled_on_the_way_*",
    "tests/models/test_effects_advice.py::test_the_advice_holds_*",
    "tests/models/test_effects_advice.py::test_an_effect_that_matters_*",
    "tests/models/test_cost.py::test_a_scene_that_is_sensitive_*",
    # a loop of its own is compiled for it
    "tests/integrate/test_own_method.py::*",
    # treatments that are there to be seen failing, and random ones
    "tests/models/test_hazards.py::test_h4_in_a_chain_*",
    "tests/models/test_hazards.py::test_h6_*",
    "tests/models/test_hazards.py::test_h2_*",
    "tests/components/test_friction_treatments.py::test_the_naive_sign_*",
    "tests/components/test_friction_treatments.py::*hour*bristle*",
    "tests/components/test_bristle.py::test_friction_rises_to_stiction_*",
    "tests/models/test_contact_pairs.py::*Binding*naive*",
    "tests/models/test_contact_pairs.py::*Binding*literal*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Binding on*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Binding off*",
    "tests/components/test_friction_treatments.py::test_the_reset_integrator_has_the_period_*[0.0005-*",
    "tests/components/test_friction_treatments.py::test_the_reset_integrator_has_the_period_*[0.0003-*",
    "tests/components/test_curves.py::test_a_surface_with_a_nap_*elastoplastic*",
    "tests/components/test_curves.py::test_a_surface_with_a_nap_*lugre*",
    "tests/components/test_curves.py::test_a_surface_with_a_nap_*[saturation]",
    "tests/components/test_curves.py::test_a_surface_with_a_nap_*[root]",
    "tests/components/test_curves.py::test_a_surface_with_a_nap_*[reset_integrator]",
    "tests/components/test_curves.py::test_a_surface_with_a_nap_*[dahl]",
    "tests/components/test_curves.py::test_friction_grows_as_a_power_*[elastoplastic]",
    "tests/components/test_curves.py::test_friction_grows_as_a_power_*[dahl]",
    "tests/components/test_curves.py::test_friction_grows_as_a_power_*[reset_integrator]",
    "tests/components/test_curves.py::test_friction_grows_as_a_power_*[saturation]",
    "tests/components/test_curves.py::test_friction_grows_as_a_power_*[root]",
    "tests/components/test_curves.py::test_a_warm_contact_*[karnopp]",
    "tests/components/test_curves.py::test_a_warm_contact_*[arctan]",
    "tests/components/test_curves.py::test_a_warm_contact_*[root]",
    "tests/components/test_rotational_friction.py::test_a_clutch_locks_*[elastoplastic]",
    "tests/components/test_rotational_friction.py::test_a_clutch_locks_*[reset_integrator]",
    "tests/components/test_rotational_friction.py::test_a_clutch_locks_*[saturation]",
    "tests/components/test_rotational_friction.py::test_a_clutch_locks_*[root]",
    "tests/components/test_rotational_friction.py::test_a_clutch_locks_*[arctan]",
    "tests/components/test_effects_off.py::test_an_effect_that_is_off_leaves_no_*[LoopedCore-line_damping]",
    "tests/components/test_effects_off.py::test_an_effect_that_is_off_leaves_no_*[ServoCylinderDrive-cavitation]",
    # processes of their own: one of each kind of end is played
    "tests/models/test_runs_end_well.py::*max_events*",
    "tests/models/test_runs_end_well.py::*SIGHUP*",
    "tests/models/test_runs_end_well.py::test_a_budget_of_wall_time_*",
    "tests/models/test_runs_end_well.py::test_set_changes_*",
    "tests/models/test_runs_end_well.py::test_a_number_that_is_none_*",
    "tests/unit/test_friction_verbs.py::test_a_new_law_is_short_*",
    "tests/unit/test_native.py::*helper of a helper*",
    "tests/unit/test_docs.py::test_every_command_shown_ends_well*routes*",
    "tests/models/test_pickled_model.py::test_processes_that_are_spawned_*",
    # the larger of networks and settings
    "tests/models/test_held_networks.py::test_what_settles_is_friction*600-*",
    "tests/models/test_sandwich.py::test_the_reference_converges_*",
    "tests/models/test_line_search.py::test_a_singular_pattern_*",
    "tests/models/test_with_values.py::*[long_route*",
    "tests/models/test_slices.py::*guidance_route_electric*",
    "tests/integrate/test_linear.py::test_one_plan_serves_*[0-*",
)


_PATTERNS = [re.compile(".*".join(map(re.escape, one.split("*"))) + "$") for one in LEFT_TO_TEST_ALL]


def is_left(name: str) -> bool:
    """True for a test that is on the list, by the name that pytest prints."""
    return any(pattern.match(name) for pattern in _PATTERNS)
