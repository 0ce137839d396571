! SPDX-License-Identifier: BSD-3-Clause
! Layouts, defaults, texts and errors.
module base_test
    use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_value
    use support
    implicit none

contains

    subroutine structs_have_the_sizes_of_c()
        type(conn_array) :: array
        type(conn_context_options) :: context_options
        type(conn_map_options) :: map_options
        type(conn_map_info) :: map_info
        type(conn_rows_view) :: rows
        type(conn_pairs_view) :: pairs
        type(conn_report_entry) :: entry
        type(conn_intersection_view) :: intersection
        type(conn_boundary_nodes) :: boundary_nodes
        type(conn_estimate) :: estimate
        type(conn_tree_options) :: tree_options
        type(conn_tree_input) :: tree_input
        type(conn_tree_view) :: tree
        type(conn_box_list_view) :: box_list
        type(conn_particles_view) :: particles
        type(conn_lists_options) :: lists_options
        type(conn_classes_view) :: classes
        type(conn_gravity_options) :: gravity_options
        type(conn_gravity_info) :: gravity_info
        type(conn_gravity_view) :: gravity_view
        call same(c_sizeof(array), c_sizeof(array), CONN_STRUCT_ARRAY)
        call same(c_sizeof(context_options), context_options%struct_size, &
                  CONN_STRUCT_CONTEXT_OPTIONS)
        call same(c_sizeof(map_options), map_options%struct_size, CONN_STRUCT_MAP_OPTIONS)
        call same(c_sizeof(map_info), map_info%struct_size, CONN_STRUCT_MAP_INFO)
        call same(c_sizeof(rows), rows%struct_size, CONN_STRUCT_ROWS_VIEW)
        call same(c_sizeof(pairs), pairs%struct_size, CONN_STRUCT_PAIRS_VIEW)
        call same(c_sizeof(entry), entry%struct_size, CONN_STRUCT_REPORT_ENTRY)
        call same(c_sizeof(intersection), intersection%struct_size, CONN_STRUCT_INTERSECTION_VIEW)
        call same(c_sizeof(boundary_nodes), boundary_nodes%struct_size, CONN_STRUCT_BOUNDARY_NODES)
        call same(c_sizeof(estimate), estimate%struct_size, CONN_STRUCT_ESTIMATE)
        call same(c_sizeof(tree_options), tree_options%struct_size, CONN_STRUCT_TREE_OPTIONS)
        call same(c_sizeof(tree_input), tree_input%struct_size, CONN_STRUCT_TREE_INPUT)
        call same(c_sizeof(tree), tree%struct_size, CONN_STRUCT_TREE_VIEW)
        call same(c_sizeof(box_list), box_list%struct_size, CONN_STRUCT_BOX_LIST_VIEW)
        call same(c_sizeof(particles), particles%struct_size, CONN_STRUCT_PARTICLES_VIEW)
        call same(c_sizeof(lists_options), lists_options%struct_size, CONN_STRUCT_LISTS_OPTIONS)
        call same(c_sizeof(classes), classes%struct_size, CONN_STRUCT_CLASSES_VIEW)
        call same(c_sizeof(gravity_options), gravity_options%struct_size, &
                  CONN_STRUCT_GRAVITY_OPTIONS)
        call same(c_sizeof(gravity_info), gravity_info%struct_size, CONN_STRUCT_GRAVITY_INFO)
        call same(c_sizeof(gravity_view), gravity_view%struct_size, CONN_STRUCT_GRAVITY_VIEW)
        call expect(conn_abi_sizeof(CONN_STRUCT_GRAVITY_VIEW + 1) == 0, 'there is no other struct')
    end subroutine structs_have_the_sizes_of_c

    subroutine same(bytes, struct_size, which)
        integer(c_size_t), intent(in) :: bytes, struct_size
        integer(c_int32_t), intent(in) :: which
        character(4) :: number
        write (number, '(i0)') which
        call expect(int(bytes, c_int64_t) == conn_abi_sizeof(which), 'size of struct '//number)
        call expect(bytes == struct_size, 'struct_size of struct '//number)
    end subroutine same

    subroutine defaults_are_those_of_c()
        type(conn_map_options) :: ours, of_c
        type(conn_context_options) :: context_ours, context_of_c
        type(conn_tree_options) :: tree_ours, tree_of_c
        type(conn_lists_options) :: lists_ours, lists_of_c
        type(conn_gravity_options) :: gravity_ours, gravity_of_c
        integer(c_int8_t), parameter :: garbage = 77
        of_c = transfer(spread(garbage, 1, int(c_sizeof(ours))), of_c)
        call expect_ok(conn_map_options_init(of_c), 'options of a map are initialised')
        call expect(all(transfer(ours, [garbage]) == transfer(of_c, [garbage])), &
                    'default options of a map are byte for byte those of C')
        context_of_c = transfer(spread(garbage, 1, int(c_sizeof(context_ours))), context_of_c)
        call expect_ok(conn_context_options_init(context_of_c), 'options of a context')
        call expect(all(transfer(context_ours, [garbage]) == transfer(context_of_c, [garbage])), &
                    'default options of a context are byte for byte those of C')
        tree_of_c = transfer(spread(garbage, 1, int(c_sizeof(tree_ours))), tree_of_c)
        call expect_ok(conn_tree_options_init(tree_of_c), 'options of a tree')
        call expect(all(transfer(tree_ours, [garbage]) == transfer(tree_of_c, [garbage])), &
                    'default options of a tree are byte for byte those of C')
        lists_of_c = transfer(spread(garbage, 1, int(c_sizeof(lists_ours))), lists_of_c)
        call expect_ok(conn_lists_options_init(lists_of_c), 'options of interaction lists')
        call expect(all(transfer(lists_ours, [garbage]) == transfer(lists_of_c, [garbage])), &
                    'default options of interaction lists are byte for byte those of C')
        gravity_of_c = transfer(spread(garbage, 1, int(c_sizeof(gravity_ours))), gravity_of_c)
        call expect_ok(conn_gravity_options_init(gravity_of_c), 'options of gravity')
        call expect(all(transfer(gravity_ours, [garbage]) == transfer(gravity_of_c, [garbage])), &
                    'default options of gravity are byte for byte those of C')
    end subroutine defaults_are_those_of_c

    subroutine the_module_is_of_the_version_of_the_library()
        character(16) :: text
        call expect(conn_version() == CONN_VERSION_MODULE, 'the numbers are equal')
        write (text, '(i0, a, i0, a, i0)') CONN_VERSION_MAJOR, '.', CONN_VERSION_MINOR, '.', &
            CONN_VERSION_PATCH
        call expect(conn_version_string() == trim(text), 'the texts are equal')
        call expect(index(conn_build_info(), '"version"') > 0, 'build info names the version')
    end subroutine the_module_is_of_the_version_of_the_library

    subroutine every_status_has_a_text()
        integer(c_int32_t) :: status
        call expect(conn_status_text(CONN_OK) == 'success', 'text of CONN_OK')
        do status = CONN_E_INTERNAL, CONN_E_CALLBACK
            call expect(conn_status_text(status) /= conn_status_text(9999_c_int32_t), &
                        'a status of the list has a text of its own')
        end do
        call expect(conn_status_text(9999_c_int32_t) == 'unknown status', 'text of no status')
    end subroutine every_status_has_a_text

    subroutine errors_come_back_as_statuses_with_texts()
        type(conn_context) :: context, nowhere
        type(conn_nodes) :: nodes
        type(conn_map) :: map, no_map
        integer(c_int64_t) :: generation
        real(c_double) :: x(3, 4), h(4)
        x = 0.5_c_double
        h = 0.1_c_double
        x(2, 3) = ieee_value(h(1), ieee_negative_inf)
        call expect(conn_nodes_create(nowhere, 'gas', 3, extent, nodes) /= CONN_OK, &
                    'a null context is refused')
        call expect_ok(conn_context_create(context), 'a context is created')
        call expect(conn_error_text() == '', 'no text after a success')
        call expect(conn_error_text(CONN_OK) == 'success', 'the text of a success')
        call expect_error(conn_nodes_create(context, 'gas', 7, extent, nodes), CONN_E_ARGUMENT, &
                          'dim = 7', 'a list of 7 dimensions')
        call expect(conn_error_text(CONN_E_ARGUMENT) == &
                    conn_status_text(CONN_E_ARGUMENT)//': '//conn_last_error(), &
                    'the text of an error has both parts')
        call expect(.not. c_associated(nodes%handle), 'no handle is made by an error')
        call expect_error(conn_nodes_create(context, '   ', 3, extent, nodes), CONN_E_ARGUMENT, &
                          'name', 'a blank name')
        call expect_error(conn_nodes_create(context, 'gas'//c_null_char//'dust', 3, extent, nodes), &
                          CONN_E_ARGUMENT, 'character 4', 'a NUL inside a name')
        call expect_ok(conn_nodes_create(context, 'gas  ', 3, extent, nodes), 'a list is created')
        call expect_ok(conn_map_create(context, map), 'a map is created')
        call expect_ok(conn_set_h(nodes, x, h), 'an infinite position is no error yet')
        call expect_error(conn_rebuild(map, nodes), CONN_E_NONFINITE, 'gas', 'a bad position')
        call expect(index(conn_last_error(), 'gas ') == 0, 'blanks at the end of a name are cut')
        call expect_error(conn_set_h(nodes, x, h(:3)), CONN_E_ARGUMENT, 'h', 'too few h')
        generation = 5
        call expect(conn_map_generation(no_map, generation) /= CONN_OK, 'a null map is refused')
        call expect(generation == 5, 'an output keeps its value on an error')
        call conn_set_error('a text of ours')
        call expect(conn_last_error() == 'a text of ours', 'a text that was set is the last error')
        call expect_ok(conn_destroy(map), 'a map is destroyed')
        call expect_ok(conn_destroy(map), 'and once more')
        call expect_ok(conn_destroy(nodes), 'a list is destroyed')
        call expect_ok(conn_destroy(context), 'a context is destroyed')
    end subroutine errors_come_back_as_statuses_with_texts

end module base_test
