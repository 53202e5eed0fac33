"""Tests that `make test` leaves to `make test-all`: they take long, and others of their file show the mechanism.

Patterns of test names as pytest prints them (`*` stands for anything), beside those that their files mark themselves.
"""

from __future__ import annotations

import functools
import re
from collections import Counter, defaultdict
from collections.abc import Hashable, Iterable, Iterator
from typing import Any

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
    # random scenes: about forty of a hundred are played
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[networks-92]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[networks-161]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[networks-184]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[networks-207]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[routes-23]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[*-115]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[*-138]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[*-184]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[*-5]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[*-28]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[*-74]",
    "tests/scenes/test_blows.py::test_every_impact_*[1*]",
    "tests/invariance/test_invariance.py::test_the_order_in_which_a_hundred_parts_*[3]",
    # routes: the ideal drives all along, the others for their first seconds; one start
    "tests/models/test_guidance_drives.py::*[guidance_route*",
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
    "tests/models/test_bend_sweep.py::test_every_treatment_finds_*[0.35-*",
    "tests/models/test_bend_sweep.py::test_every_treatment_finds_*[0.5-tanh]",
    "tests/models/test_carried.py::test_a_line_that_is_paid_out_and_hauled_in_*[rim-*",
    "tests/models/test_carried.py::test_a_line_that_is_paid_out_and_hauled_in_*[layers-*",
    "tests/models/test_guidance_drives.py::test_drives_bring_*[electric]",
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
    "tests/models/test_constant_inboard_tension.py::test_at_low_friction_*",
    "tests/unit/test_carriage.py::test_what_is_left_does_not_depend_on_how_much_*",
    "tests/models/test_torsion.py::test_with_a_friction_of_its_own_*",
    # advice and cost: the closed forms and one model are played
    "tests/models/test_effects_advice.py::test_every_effect_of_a_bundled_model_*[power_unit]",
    "tests/models/test_effects_advice.py::test_every_effect_of_a_bundled_model_*[hundred_blocks]",
    "tests/models/test_effects_advice.py::test_every_effect_of_a_bundled_model_*[crustacean]",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[crustacean-rodas-ida]",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[torsion-rodas-ida]",
    "tests/models/test_effects_advice.py::*[guidance_route*",
    "tests/models/test_effects_advice.py::test_the_command_prints_a_sentence_for_each*",
    "tests/models/test_effects_advice.py::test_laws_that_are_compiled_on_the_way_*",
    "tests/models/test_effects_advice.py::test_the_advice_holds_*",
    "tests/models/test_effects_advice.py::test_an_effect_that_matters_*",
    "tests/models/test_cost.py::test_a_scene_that_is_sensitive_*",
    # a loop of its own is compiled for it; of FMUs for any processor that of one engine is
    "tests/fmu/test_tunable.py::test_what_is_tuned_moves_as_in_fairlead_*[3-stepping]",
    "tests/integrate/test_own_method.py::*",
    # treatments that are there to be seen failing, and random ones
    "tests/models/test_hazards.py::test_h4_in_a_chain_*",
    "tests/models/test_hazards.py::test_h4_is_gone_*[0.6]",
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
    # the contract: an effect of lines off on plain ones
    "tests/components/test_contract.py::test_registered_component_keeps[LoopedCore[line_damping off] *",
    "tests/components/test_contract.py::test_registered_component_keeps[LoopedHose[line_damping off] *",
    "tests/components/test_contract.py::test_registered_component_keeps[RelaxingHose[line_damping off] *",
    "tests/components/test_contract.py::test_registered_component_keeps[WatchedHose[line_damping off] *",
    # the larger of networks and settings
    "tests/models/test_held_networks.py::test_what_settles_is_friction*600-*",
    "tests/models/test_sandwich.py::test_the_reference_converges_*",
    "tests/models/test_line_search.py::test_a_singular_pattern_*",
    "tests/models/test_with_values.py::*[long_route*",
    "tests/models/test_slices.py::*guidance_route_electric*",
    "tests/integrate/test_linear.py::test_one_plan_serves_*[0-*",
    # of several variants of one mechanism the plainest or the shortest is played
    "tests/fmu/test_export.py::test_the_belt_goes_as_in_fairlead_to_the_last_bit[2]",
    "tests/fmu/test_tunable.py::test_a_parameter_that_follows_no_law_*[line.diameter]",
    "tests/fmu/test_tunable.py::test_a_parameter_that_follows_no_law_*[line.weight]",
    "tests/fmu/test_tunable.py::test_a_parameter_that_follows_no_law_*[line.bulkhead*",
    "tests/fmu/test_tunable.py::test_what_is_tuned_moves_as_in_fairlead_*[2-rodas]",
    "tests/fmu/test_library.py::test_two_libraries_of_a_model_*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Binding reduced*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Elastoplastic*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[MaxwellSlip*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Karnopp*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Dahl*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Bristle*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[ResetIntegrator*",
    "tests/models/test_single_bend.py::test_at_high_friction_*[binding]",
    "tests/models/test_single_bend.py::test_at_low_friction_*[binding]",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[crustacean-stepping-ida]",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[sandwich-rodas-ida]",
    "tests/models/test_with_values.py::*[guidance_route_ideal*",
    "tests/models/test_held_networks.py::test_what_settles_is_friction*[100-200-*",
    "tests/models/test_constant_inboard_tension.py::test_what_is_lacking_*[5000]",
    "tests/models/test_bend_sweep.py::test_every_treatment_finds_*[0.5-LuGre]",
    "tests/components/test_assembly.py::test_the_jacobian_*[machines/traction_winch]",
    "tests/components/test_assembly.py::test_the_jacobian_*[machines/servo_cylinder]",
    "tests/components/test_assembly.py::test_the_jacobian_*[machines/hydrostatic_drive]",
    "tests/components/test_assembly.py::test_the_jacobian_*[guidance_route_electric]",
    "tests/components/test_assembly.py::test_the_mass_matrix_*[guidance_route_electric]",
    "tests/components/test_friction_treatments.py::test_the_reset_integrator_has_the_period_*",
    "tests/components/test_rotational_friction.py::test_a_clutch_locks_*[maxwell_slip]",
    "tests/components/test_curves.py::test_a_method_that_cannot_shift_*[elastoplastic]",
    "tests/components/test_curves.py::test_no_load_at_all_*",
    "tests/components/test_effects_off.py::*[Hold-load_dependence]",
    "tests/unit/test_describe.py::test_every_type_has_a_page_*[PositionServo]",
    "tests/unit/test_describe.py::test_every_type_has_a_page_*[LoopedCore]",
    "tests/unit/test_docs.py::test_a_component_in_a_users_file_*[gap.py]",
    "tests/unit/test_docs.py::test_a_component_in_a_users_file_*[bumper.py]",
    "tests/unit/test_docs.py::test_a_component_in_a_users_file_*[relaxing.py]",
    "tests/fuzz/test_netlists.py::test_a_damaged_netlist_*[1]",
    "tests/fuzz/test_netlists.py::test_a_damaged_netlist_*[2]",
    "tests/fuzz/test_netlists.py::test_a_damaged_netlist_*[3]",
    "tests/scenes/test_scenes.py::test_a_random_scene_checks_clean_*[route-2]",
    "tests/scenes/test_scenes.py::test_a_random_scene_checks_clean_*[network-1]",
    "tests/messages/test_untrusted_netlists.py::test_of_many_mistakes_of_one_sort_*[mistakes1]",
    "tests/integrate/test_linear.py::test_one_plan_serves_*[1-dense]",
    "tests/integrate/test_published.py::*ring_modulator*",
    "tests/hard/*[stiff_core_in_a_soft_hose,_*_/_ida_/_*",
    "tests/hard/*[random_networks,_20_/_*",
    "tests/hard/*_pulled_from_both_ends,_*_/_ida_/_*",
    "tests/hard/*[two_blocks_on_a_belt_that_are_shaken,_*_/_ida_/_*",
    "tests/hard/*[stick_slip_at_accuracy,_*_/_ida_/_*",
    "tests/hard/*[normal_force_to_zero_and_back,_*_/_ida_/_*",
    "tests/unit/test_lowering.py::test_random_programs_*[1*]",
    "tests/unit/test_plot_verb.py::test_every_figure_*[.pdf*",
    "tests/models/test_single_bend.py::test_the_inboard_tension_*-binding]",
    "tests/integrate/test_linear.py::test_one_plan_serves_*[1-sparse]",
    "tests/integrate/test_room_crossing.py::test_the_root_of_a_cubic_guard_*[0]",
    "tests/components/test_bristle.py::test_a_curve_that_falls_too_far_*",
    "tests/components/test_assembly.py::test_the_jacobian_*[guidance_route]",
    "tests/components/test_assembly.py::test_the_mass_matrix_*[machines/traction_winch]",
    "tests/models/test_long_lines.py::test_what_lies_on_the_drum_*",
    "tests/models/test_constant_inboard_tension.py::test_with_too_little_*",
    # the same is asked, of less, by others of the file or of test_invariance, test_guidance_route, test_slices
    "tests/models/test_two_runs.py::test_two_runs_are_the_same_*",
    "tests/models/test_two_runs.py::test_the_runs_that_were_compared_*",
    "tests/models/test_runs_against_statics.py::*[guidance_route]",
    "tests/models/test_switch_inside_a_step.py::test_switches_at_the_start_*",
    "tests/models/test_route_mesh.py::test_a_start_knows_*",
    "tests/models/test_hazards.py::test_h4_*",
    "tests/models/test_rigid_sea.py::test_line_on_the_drum_and_line_in_the_sea_*",
    "tests/models/test_torsion.py::test_on_the_whole_route_*",
    "tests/models/test_long_lines.py::test_what_is_still_on_the_drum_*",
    "tests/models/test_carried.py::test_a_line_that_is_paid_out_and_hauled_in_*",
    "tests/models/test_route_terms.py::test_the_work_of_each_*",
    "tests/models/test_route_terms.py::test_behind_a_pulley_*",
    "tests/models/test_cost.py::test_a_coarser_mesh_*",
    "tests/models/test_cost.py::test_a_mesh_that_cannot_*",
    "tests/components/test_maxwell_slip.py::test_a_surface_with_a_nap_*",
    "tests/components/test_maxwell_slip.py::test_sliding_follows_*",
    "tests/components/test_bristle.py::test_a_seed_decides_*",
    "tests/components/test_line_mesh.py::test_the_weights_of_all_nodes_*",
    "tests/components/test_arrays.py::test_bulkheads_at_a_pitch_*",
    "tests/unit/test_describe.py::test_a_held_motion_*",
    "tests/unit/test_friction_verbs.py::test_every_command_of_the_page_*",
    "tests/studies/test_fits.py::test_a_robust_loss_*",
    # closed forms of whole routes, and what compiles much for one assertion: devices, the single bend and one export
    # show the same in `make test`
    "tests/models/test_route_terms.py::*",
    "tests/unit/test_describe.py::test_every_type_has_a_page_*[Contact]",
    "tests/components/test_contract.py::test_registered_component_keeps[ThrottledCylinder[oil] units]",
    "tests/components/test_contract.py::test_registered_component_keeps[MaxwellSlip[stribeck] units]",
    "tests/components/test_contract_exceptions.py::test_an_exception_*[maxwell_slip *",
    "tests/components/test_contract_exceptions.py::test_an_exception_*[elastoplastic *",
    "tests/components/test_contract_exceptions.py::test_an_exception_*[binding dissipates break_backward]",
    "tests/components/test_one_successor.py::*[maxwell_slip]",
    "tests/components/test_route_devices.py::test_energy_closes_while_line_*",
    "tests/components/test_friction_treatments.py::test_a_treatment_that_holds_nothing_*",
    "tests/fmu/test_tunable.py::test_a_parameter_that_follows_no_law_*[line.element]",
    "tests/fmu/test_tunable.py::test_a_speed_at_the_start_*",
    "tests/fmu/test_library.py::test_a_compiler_that_makes_nothing_*",
    "tests/fmu/test_refusals.py::test_another_start_than_*",
    "tests/fmu/test_what_is_asked_wrongly.py::test_an_example_that_was_edited_*",
    "tests/models/test_rigid_sea.py::test_in_steady_tow_*",
    "tests/models/test_rigid_sea.py::test_line_that_goes_out_and_comes_back_*",
    "tests/models/test_rigid_sea.py::test_a_margin_longer_*",
    "tests/models/test_rigid_sea.py::test_strong_damping_*",
    "tests/models/test_rigid_sea.py::test_effects_tell_*",
    "tests/models/test_held_networks.py::test_what_settles_is_friction[300-*",
    "tests/models/test_held_networks.py::test_what_settles_is_friction[20-40-*",
    "tests/models/test_held_networks.py::test_a_hundred_blocks_*[3e-2-*",
    "tests/models/test_held_networks.py::test_a_hundred_blocks_*[1e-2-rodas5p]",
    "tests/models/test_held_networks.py::test_two_settlements_*[rodas]",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Binding aggregate]",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[sandwich-*",
    "tests/models/test_names_say_nothing.py::test_a_contact_says_how_*",
    "tests/models/test_effects_advice.py::test_a_switch_that_changes_no_*",
    "tests/models/test_idle_contacts.py::test_blocks_that_stand_still_*[rodas]",
    "tests/models/test_jump_inside.py::test_steps_with_many_jumps_*equal]",
    "tests/models/test_constant_inboard_tension.py::*",
    "tests/integrate/test_linear.py::test_one_plan_serves_*[2-dense]",
    "tests/integrate/test_room_crossing.py::test_the_root_of_a_cubic_guard_*",
    "tests/integrate/test_room_stepping.py::test_rows_that_are_exchanged_*[0]",
    # repeats of what a treatment, an effect or an engine shows beside them
    "tests/components/test_curves.py::test_a_method_that_cannot_shift_*[bristle]",
    "tests/components/test_curves.py::test_a_surface_with_a_nap_*[karnopp]",
    "tests/components/test_curves.py::test_a_surface_with_a_nap_*[tanh]",
    "tests/components/test_assembly.py::test_only_unknowns_with_a_rate_*[machines/traction_winch]",
    "tests/components/test_assembly.py::test_only_unknowns_with_a_rate_*[guidance_route_electric]",
    "tests/models/test_long_runs.py::test_a_block_goes_on_*[100-10-0.2-1e-4-ida]",
    "tests/models/test_long_runs.py::test_a_block_goes_on_*[1000000.0-100000.0-20-1e-6-ida]",
    # what others of the file or of a smaller scene show: routes in a unit test, one more variant or pair of engines
    "tests/unit/test_shown_rates.py::test_some_laws_*[guidance_route]",
    "tests/unit/test_shown_rates.py::test_some_laws_*[long_deployment]",
    "tests/unit/test_friction_verbs.py::test_friction_tells_the_creep_*[saturation-*",
    "tests/unit/test_friction_verbs.py::test_friction_tells_the_creep_*[root-*",
    "tests/unit/test_derivatives.py::test_so_have_those_of_laws_*[PositionServo]",
    "tests/unit/test_derivatives.py::test_so_have_those_of_laws_*[LoopedCore]",
    "tests/unit/test_docs.py::test_a_component_in_a_users_file_*[bungee.py]",
    "tests/unit/test_drawing.py::test_svg_*[guidance_route]",
    "tests/unit/test_drawing.py::test_svg_*[guidance_route_ideal]",
    "tests/unit/test_drawing.py::test_svg_*[long_*",
    "tests/unit/test_drawing.py::test_svg_*[slack_start]",
    "tests/unit/test_drawing.py::test_svg_*[weak_clamp]",
    "tests/unit/test_statics.py::test_every_bundled_route_*[long_deployment]",
    "tests/unit/test_reference_engines.py::test_both_bend_engines_*",
    "tests/models/test_bend_variants.py::test_the_hose_*[element 0.125 m]",
    "tests/models/test_bend_variants.py::test_the_hose_*[mu 0.51, *",
    "tests/models/test_bend_variants.py::test_the_hose_*[T_out 200 N]",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[torsion-stepping-ida]",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[power_unit-*stepping*",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[winch_drive-*ida]",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[block_and_spring-*stepping*",
    "tests/models/test_engines_agree.py::test_two_engines_agree_*[friction_anchor-*ida]",
    "tests/models/test_coupled_route.py::test_electronics_called_at_every_sample_*",
    "tests/models/test_guidance_route.py::test_more_friction_*",
    "tests/models/test_effects_advice.py::test_every_effect_of_a_bundled_model_*[single_bend]",
    "tests/models/test_effects_advice.py::test_every_effect_of_a_bundled_model_*[friction_anchor]",
    "tests/models/test_effects_advice.py::test_every_effect_of_a_bundled_model_*[torsion]",
    "tests/models/test_jenkins.py::test_contacts_that_creep_or_bend_*[dahl]",
    "tests/models/test_jenkins.py::test_contacts_that_creep_or_bend_*[arctan]",
    "tests/models/test_jenkins.py::test_where_friction_falls_*[binding]",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[NaiveZone *",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Arctan *",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Root *",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Saturation *",
    "tests/models/test_narrowing.py::test_what_was_left_out_wakes_*[rodas]",
    "tests/models/test_positions.py::test_pistons_that_pass_*[6]",
    "tests/models/test_positions.py::test_a_thousand_revolutions_*[1e-06]",
    "tests/models/test_rebound.py::test_no_impact_of_a_random_scene_*[2]",
    "tests/models/test_lightly_pressed.py::test_every_treatment_*[maxwell_slip]",
    "tests/models/test_narrowing_at_random.py::test_what_moves_alone_*[1*]",
    "tests/models/test_hazards.py::test_h1_*",
    "tests/hard/*_/_ida_/_hold]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[*-92]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[*-207]",
    "tests/models/test_with_values.py::*[crustacean*",
    "tests/fmu/test_export.py::test_what_is_set_acts_*[2]",
    "tests/invariance/test_invariance.py::test_the_order_in_which_a_hundred_parts_*[2]",
    "tests/scenes/test_verdicts.py::test_a_random_scene_is_right[networks-46]",
    "tests/models/test_thrown_from_a_stop.py::test_a_block_stopped_*[elastoplastic-*",
    "tests/models/test_with_values.py::*[guidance_route_torsion*",
    "tests/models/test_with_values.py::*[machines/traction_winch*",
    "tests/components/test_curves.py::test_a_surface_with_a_nap_*[binding]",
    "tests/components/test_curves.py::test_friction_grows_as_a_power_*[binding]",
    "tests/components/test_contract.py::test_registered_component_keeps[DogClutch zones_reached]",
    "tests/models/test_first_steps.py::test_few_first_steps_*",
    "tests/models/test_rigid_core.py::test_a_stiff_core_goes_to_one_*",
    "tests/models/test_contact_pairs.py::test_*_in_machine_code[Binding stribeck]",
    "tests/models/test_contact_pairs.py::test_*_as_a_formula[NaiveZone *",
    "tests/models/test_contact_pairs.py::test_*_as_a_formula[Arctan *",
    "tests/models/test_contact_pairs.py::test_*_as_a_formula[Root *",
    "tests/models/test_contact_pairs.py::test_*_as_a_formula[Saturation *",
    "tests/models/test_servo_fit.py::test_the_servo_moves_*[up_and_down]",
    "tests/unit/test_reference_engines.py::test_event_driven_*",
    "tests/studies/test_sweeps.py::test_short_cases_are_handed_out_*",
    "tests/hard/*[pads_side_by_side_on_one_block,_300_/_*",
    "tests/hard/*[emergency_stop_of_a_running_route,_within_0.1_s_/_*",
    "tests/components/test_assembly.py::test_the_jacobian_*[guidance_route_torsion]",
    "tests/components/test_assembly.py::test_the_jacobian_*[machines/web_line]",
    "tests/components/test_assembly.py::test_the_jacobian_*[machines/lowering_winch]",
    "tests/hard/*[unit_rescaled,_lengths_*_/_ida_/_*",
    "tests/hard/*[time_shifted,_1e4_s_/_ida_/_*",
    "tests/hard/*[steep_falling_curve,_stribeck_over_1e-07_m/s_/_ida_/_*",
    "tests/hard/*[mirrored_blocks_stay_mirrored,_jump_/_ida_/_*",
    "tests/hard/*[shaken_to_and_fro_*_/_ida_/_*",
    "tests/hard/*[block_on_a_shaken_table,_slipping_/_ida_/_*",
    "tests/hard/*[node_without_mass_*_/_rodas_/_lugre]",
    "tests/hard/*[normal_force_to_zero_and_back,_in_ramps_/_rodas_/_lugre]",
    "tests/hard/*[steep_falling_curve,_tustin_*_/_rodas_/_lugre]",
    # of the page the example beside a library is compiled, and a program in C sets, advances and reads
    "tests/fmu/test_library.py::test_the_program_on_the_page_*",
    # a clamp that is too weak, in a shorter scene, stands beside it
    "tests/messages/test_route_remarks.py::test_the_deliberately_weak_clamp_*",
    # its Jacobian is left already; other machines, bends and a route with torsion are asked for their matrices
    "tests/components/test_assembly.py::test_the_mass_matrix_*[guidance_route]",
    "tests/components/test_assembly.py::test_only_unknowns_with_a_rate_*[guidance_route]",
    # names that go with an effect are left out of a shorter scene by the others of the file
    "tests/unit/test_gone_with_effects.py::test_a_route_is_set_and_recorded_*",
)


EACH_VALUE_ONCE = (
    "tests/models/*",
    "tests/components/test_contacts_that_part.py::*",
    "tests/components/test_jamming_screws.py::*",
    "tests/components/test_shaft_friction.py::*",
    "tests/components/test_hydraulics.py::*",
    "tests/components/test_choosing_creep.py::*",
    "tests/integrate/test_published.py::test_the_error_falls_*",
    "tests/integrate/test_tuning.py::*",
    "tests/unit/test_plot_verb.py::test_every_figure_*",
)
"""Of tests of these names that have several parameters, such as a scene, an engine and an accuracy, `make test` plays
every value of each, but not each with all values of the others."""


@functools.cache
def _of(patterns: tuple[str, ...]) -> re.Pattern[str]:
    return re.compile("|".join(".*".join(map(re.escape, one.split("*"))) for one in patterns))


def fits(pattern: str, name: str) -> bool:
    """True for a name that a pattern stands for."""
    return _of((pattern,)).fullmatch(name) is not None


_LEFT, _ONCE = _of(LEFT_TO_TEST_ALL), _of(EACH_VALUE_ONCE)


def is_left(name: str) -> bool:
    """True for a test that is on the list, by the name that pytest prints."""
    return _LEFT.fullmatch(name) is not None


def repeats(tests: Iterable[Any]) -> Iterator[Any]:
    """Of the quick tests in EACH_VALUE_ONCE those whose values all stand in others of the same function."""
    products = defaultdict(list)
    for test in tests:
        quick = _ONCE.fullmatch(test.nodeid) and not test.get_closest_marker("slow")
        if quick and len(list(test.iter_markers("parametrize"))) > 1:
            products[test.nodeid.partition("[")[0]].append(test)
    for product in products.values():
        played = each_value_once([_values(test) for test in product])
        yield from (test for k, test in enumerate(product) if k not in played)


def _values(test: Any) -> list[Hashable]:
    """What a test is given for each of its parameters, or for those that are given together."""
    names = [mark.args[0] for mark in test.iter_markers("parametrize")]
    axes = [one.replace(" ", "").split(",") if isinstance(one, str) else one for one in names]
    return [(*axis, *(id(test.callspec.params[name]) for name in axis)) for axis in axes]


def each_value_once(product: list[list[Hashable]]) -> set[int]:
    """Places of few members that have all values: always the one with most that are new, then with those met least."""
    values, met, played = [set(member) for member in product], Counter[Hashable](), set[int]()
    wanted: set[Hashable] = set().union(*values)
    while wanted:
        k = min(range(len(values)), key=lambda k: (-len(values[k] & wanted), sum(met[value] for value in values[k])))
        played.add(k)
        wanted -= values[k]
        met.update(values[k])
    return played
