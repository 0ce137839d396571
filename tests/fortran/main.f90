! SPDX-License-Identifier: BSD-3-Clause
! Runs the law that is named by the argument.
program main
    use support
    use base_test
    use nodes_test
    use lists_test
    use map_test
    use fields_test
    use experimental_test
    use trees_test
    use gravity_test
    implicit none
    character(100) :: law

    call get_command_argument(1, law)
    select case (law)
    case ('structs_have_the_sizes_of_c')
        call structs_have_the_sizes_of_c()
    case ('defaults_are_those_of_c')
        call defaults_are_those_of_c()
    case ('the_module_is_of_the_version_of_the_library')
        call the_module_is_of_the_version_of_the_library()
    case ('every_status_has_a_text')
        call every_status_has_a_text()
    case ('errors_come_back_as_statuses_with_texts')
        call errors_come_back_as_statuses_with_texts()
    case ('every_form_of_the_nodes_gives_the_same_lists')
        call every_form_of_the_nodes_gives_the_same_lists()
    case ('single_precision_gives_the_lists_of_the_same_values')
        call single_precision_gives_the_lists_of_the_same_values()
    case ('steps_of_no_whole_elements_are_refused_by_their_bytes')
        call steps_of_no_whole_elements_are_refused_by_their_bytes()
    case ('one_and_two_dimensions_have_their_own_forms')
        call one_and_two_dimensions_have_their_own_forms()
    case ('round_tensors_give_the_lists_of_scalars')
        call round_tensors_give_the_lists_of_scalars()
    case ('descriptions_say_where_elements_are')
        call descriptions_say_where_elements_are()
    case ('pointers_show_rows_and_pairs_with_their_real_extents')
        call pointers_show_rows_and_pairs_with_their_real_extents()
    case ('index_base_1_indexes_ordinary_arrays')
        call index_base_1_indexes_ordinary_arrays()
    case ('copies_are_the_lists')
        call copies_are_the_lists()
    case ('arrays_of_more_than_2_to_the_31_elements_are_what_they_are')
        call arrays_of_more_than_2_to_the_31_elements_are_what_they_are()
    case ('orders_are_permutations_that_fields_follow')
        call orders_are_permutations_that_fields_follow()
    case ('overlap_and_intersections_are_sets_of_common_nodes')
        call overlap_and_intersections_are_sets_of_common_nodes()
    case ('numbers_of_a_map_are_those_of_its_lists')
        call numbers_of_a_map_are_those_of_its_lists()
    case ('a_skin_tells_when_lists_are_old')
        call a_skin_tells_when_lists_are_old()
    case ('inactive_nodes_have_no_pairs_with_each_other')
        call inactive_nodes_have_no_pairs_with_each_other()
    case ('ids_are_taken_and_checked')
        call ids_are_taken_and_checked()
    case ('the_log_comes_as_lines')
        call the_log_comes_as_lines()
    case ('a_traversal_brings_every_row_once')
        call a_traversal_brings_every_row_once()
    case ('sums_of_pair_fields_are_those_of_a_loop_over_pairs')
        call sums_of_pair_fields_are_those_of_a_loop_over_pairs()
    case ('coupling_comes_from_arrays_and_functions')
        call coupling_comes_from_arrays_and_functions()
    case ('pairs_that_are_left_out_are_gone')
        call pairs_that_are_left_out_are_gone()
    case ('a_patch_drops_and_renumbers_nodes')
        call a_patch_drops_and_renumbers_nodes()
    case ('a_mirror_makes_ghosts_with_mirrored_fields')
        call a_mirror_makes_ghosts_with_mirrored_fields()
    case ('queries_find_what_brute_force_finds')
        call queries_find_what_brute_force_finds()
    case ('validation_names_every_law')
        call validation_names_every_law()
    case ('a_line_of_points_has_the_boxes_and_lists_of_the_definitions')
        call a_line_of_points_has_the_boxes_and_lists_of_the_definitions()
    case ('every_target_meets_every_source_once')
        call every_target_meets_every_source_once()
    case ('lookups_find_leaves_balls_and_targets')
        call lookups_find_leaves_balls_and_targets()
    case ('every_form_of_the_particles_gives_the_forces_of_the_definition')
        call every_form_of_the_particles_gives_the_forces_of_the_definition()
    case ('settings_and_results_of_gravity_are_those_of_c')
        call settings_and_results_of_gravity_are_those_of_c()
    case ('nothing_works_after_a_shutdown')
        call nothing_works_after_a_shutdown()
    case default
        call expect(.false., 'there is no law '//trim(law))
    end select
    if (n_failures > 0) error stop 1
end program main
