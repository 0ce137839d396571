! SPDX-License-Identifier: BSD-3-Clause
! The map as a whole: options, estimate, report, log, callbacks, several lists.
module map_test
    use support
    implicit none
    integer, save, target :: n_lines = 0
    logical, save :: line_is_text = .true.

contains

    subroutine numbers_of_a_map_are_those_of_its_lists()
        type(world) :: w
        type(conn_map_info) :: info
        type(conn_estimate) :: estimate
        type(conn_report_entry) :: entry
        character(:), allocatable :: text, name
        integer(c_int64_t) :: bytes, high_water, value, generation
        integer(c_int32_t) :: k, n_threads
        logical :: found
        call make_world(w)
        call expect_ok(conn_map_get_info(w%map, info), 'info')
        call expect(info%n_slots == n_cloud .and. info%n_rows == n_cloud .and. info%dim == 3 .and. &
                    info%n_entries == count(w%near) .and. info%n_lists == 1, 'info')
        call expect_ok(conn_map_estimate(w%map, [w%nodes], estimate), 'estimate')
        call expect(estimate%n_entries == info%n_entries .and. estimate%n_pairs == info%n_pairs &
                    .and. estimate%relative_error == 0, 'the estimate of few nodes is exact')
        call expect_ok(conn_map_memory(w%map, CONN_SPACE_HOST, bytes, high_water), 'memory')
        call expect(bytes > 4*info%n_entries .and. high_water >= bytes, 'memory')
        call expect_ok(conn_map_memory(w%map, CONN_SPACE_HOST), 'nothing is asked for')
        call expect_ok(conn_map_generation(w%map, generation), 'generation')
        call expect(generation == 1 .and. info%generation == 1, 'generation')
        call expect_ok(conn_context_threads(w%context, n_threads), 'threads')
        call expect(n_threads >= 1, 'there is a thread')
        found = .false.
        do k = 0, info%n_report_entries - 1
            call expect_ok(conn_map_report_entry(w%map, k, entry), 'entry')
            if (conn_text(entry%product) == 'rows') found = entry%bytes > 0 .and. entry%built == 1
        end do
        call expect(found, 'the report names rows')
        call expect_ok(conn_map_report_text(w%map, text), 'text')
        call expect(index(text, 'rows') > 0, 'the table names rows')
        do k = 0, info%n_report_counters - 1
            call expect_ok(conn_map_report_counter(w%map, k, name, value), 'counter')
            call expect(len(name) > 0, 'counters have names')
        end do
        call expect_error(conn_map_report_entry(w%map, 9999, entry), CONN_E_ARGUMENT, '9999', &
                          'no entry')
        call end_world(w)
    end subroutine numbers_of_a_map_are_those_of_its_lists

    subroutine a_skin_tells_when_lists_are_old()
        type(world) :: w
        type(conn_map_options) :: options
        logical :: needed
        real(c_double) :: drift
        options%skin = 0.05_c_double
        call make_world(w, options)
        w%x(1, 7) = w%x(1, 7) + 0.01_c_double
        call expect_ok(conn_set_h(w%nodes, w%x, w%h), 'a small step')
        call expect_ok(conn_map_needs_rebuild(w%map, [w%nodes], needed, drift), 'is it needed')
        call expect(.not. needed .and. abs(drift - 0.02_c_double) < 1e-12_c_double, 'not yet')
        w%x(1, 7) = w%x(1, 7) + 0.1_c_double
        call expect_ok(conn_set_h(w%nodes, w%x, w%h), 'a large step')
        call expect_ok(conn_map_needs_rebuild(w%map, [w%nodes], needed), 'is it needed')
        call expect(needed, 'now')
        options%skin = 0
        call expect_ok(conn_map_set_options(w%map, options), 'options are set')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect_pairs(w%map, brute_force(w%x, w%h), 0, 'without a skin')
        call end_world(w)
    end subroutine a_skin_tells_when_lists_are_old

    subroutine inactive_nodes_have_no_pairs_with_each_other()
        type(world) :: w
        type(conn_map_options) :: options
        integer(c_int8_t), target :: active(n_cloud), seen(4)
        type(conn_nodes) :: halves(2)
        logical :: near(n_cloud, n_cloud)
        integer :: k, first
        call make_world(w)
        active = [(int(mod(k, 2), c_int8_t), k=1, n_cloud)]
        options%active = c_loc(active)
        options%n_active = n_cloud
        call expect_ok(conn_map_set_options(w%map, options), 'active')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        near = w%near
        near(2::2, 2::2) = .false.
        call expect_pairs(w%map, near, 0, 'active')
        do k = 1, 2
            call expect_ok(conn_nodes_create(w%context, 'half', 3, extent, halves(k)), 'half')
            first = 60*k - 59
            call expect_ok(conn_set_h(halves(k), w%x(:, first:60*k), w%h(first:60*k)), 'half')
        end do
        seen = [1_c_int8_t, 0_c_int8_t, 0_c_int8_t, 1_c_int8_t]
        options = conn_map_options(interactions=c_loc(seen), n_interactions=4)
        call expect_ok(conn_map_set_options(w%map, options), 'interactions')
        call expect_ok(conn_rebuild(w%map, halves), 'two lists')
        near = w%near
        near(:60, 61:) = .false.
        near(61:, :60) = .false.
        call expect_pairs(w%map, near, 0, 'lists that do not see each other')
        call expect_ok(conn_map_set_options(w%map), 'the defaults')
        call expect_ok(conn_rebuild(w%map, halves), 'two lists')
        call expect_pairs(w%map, w%near, 0, 'two lists')
        call expect_ok(conn_destroy(halves(1)), 'half')
        call expect_ok(conn_destroy(halves(2)), 'half')
        call end_world(w)
    end subroutine inactive_nodes_have_no_pairs_with_each_other

    subroutine ids_are_taken_and_checked()
        type(world) :: w
        type(conn_map_options) :: options
        integer(c_int64_t), target :: ids(n_cloud)
        integer(c_int32_t), target :: owner(20)
        integer :: k
        options%order = CONN_ORDER_KEY
        call make_world(w, options)
        ids = [(1000 - k, k=1, n_cloud)]
        owner = -1
        call expect_ok(conn_set_h(w%nodes, w%x, w%h, n_internal=100), '20 ghosts')
        call expect_ok(conn_nodes_set_ids(w%nodes, conn_array_vector(ids), &
                                          conn_array_vector(owner)), 'ids')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect_error(conn_nodes_set_ids(w%nodes, owner=conn_array_vector(owner(:19))), &
                          CONN_E_ARGUMENT, '19', 'too few owners')
        call expect_ok(conn_nodes_set_ids(w%nodes), 'no ids')
        call end_world(w)
    end subroutine ids_are_taken_and_checked

    subroutine the_log_comes_as_lines()
        type(world) :: w
        call make_world(w)
        call expect_ok(conn_context_set_log(w%context, CONN_LOG_INFO, count_line, c_loc(n_lines)), &
                       'the log is on')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect(n_lines == 1 .and. line_is_text, 'a line that names the rebuild')
        call expect_ok(conn_context_set_log(w%context, CONN_LOG_NONE), 'the log is off')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect(n_lines == 1, 'no other line')
        call end_world(w)
    end subroutine the_log_comes_as_lines

    subroutine count_line(user_data, level, line) bind(c)
        type(c_ptr), value :: user_data
        integer(c_int32_t), value :: level
        type(c_ptr), value :: line
        integer, pointer :: n
        call c_f_pointer(user_data, n)
        n = n + 1
        line_is_text = line_is_text .and. index(conn_text(line), 'rebuild') > 0 .and. &
            level == CONN_LOG_INFO
    end subroutine count_line

    subroutine a_traversal_brings_every_row_once()
        type(world) :: w
        integer(c_int64_t), target :: entries(0:511)
        call make_world(w)
        entries = 0
        call expect_ok(conn_map_traverse(w%map, [w%nodes], CONN_ROWS, count_entries, &
                                         c_loc(entries)), 'rows')
        call expect(sum(entries) == count(w%near), 'rows')
        entries = 0
        call expect_ok(conn_map_traverse(w%map, [w%nodes], CONN_PAIRS, count_entries, &
                                         c_loc(entries)), 'pairs')
        call expect(2*sum(entries) == count(w%near), 'pairs')
        call expect_error(conn_map_traverse(w%map, [w%nodes], CONN_ROWS, count_entries), &
                          CONN_E_CALLBACK, 'nowhere to count', 'a callback that stops')
        call end_world(w)
    end subroutine a_traversal_brings_every_row_once

    !> Neighbours, by worker.
    recursive function count_entries(user_data, worker, n_rows, slots, offsets, neighbours) bind(c) &
        result(answer)
        type(c_ptr), value :: user_data
        integer(c_int32_t), value :: worker
        integer(c_int64_t), value :: n_rows
        integer(c_int32_t), intent(in) :: slots(0:*), neighbours(0:*)
        integer(c_int64_t), intent(in) :: offsets(0:*)
        integer(c_int32_t) :: answer
        integer(c_int64_t), pointer :: entries(:)
        integer(c_int64_t) :: r
        answer = 1
        if (.not. c_associated(user_data)) then
            call conn_set_error('nowhere to count')
            return
        end if
        call c_f_pointer(user_data, entries, [512])
        do r = 0, n_rows - 1
            if (any(neighbours(offsets(r):offsets(r + 1) - 1) == slots(r))) return
        end do
        entries(worker + 1) = entries(worker + 1) + offsets(n_rows)
        answer = 0
    end function count_entries

end module map_test
