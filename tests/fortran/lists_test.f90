! SPDX-License-Identifier: BSD-3-Clause
! Rows, pairs and orders of a map, against brute force.
module lists_test
    use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_loc
    use support
    implicit none

contains

    subroutine pointers_show_rows_and_pairs_with_their_real_extents()
        type(world) :: w
        type(conn_rows_view) :: rows
        type(conn_pairs_view) :: pairs
        integer(c_int64_t), pointer :: offsets(:), list_offset(:), row_offset(:)
        integer(c_int32_t), pointer :: slots(:), i(:), j(:), by_rank(:), ranks(:)
        real(c_double), pointer :: coupling(:)
        integer :: r
        call make_world(w)
        call expect_ok(conn_acquire(w%map, rows), 'rows')
        call conn_rows_pointers(rows, offsets, slots, list_offset, row_offset)
        call expect(lbound(offsets, 1) == 0 .and. size(offsets) == n_cloud + 1, 'offsets(0:n)')
        call expect(lbound(slots, 1) == 0 .and. size(slots) == count(w%near), 'slots(0:)')
        call expect(all(list_offset == [0, n_cloud]) .and. all(row_offset == [0, n_cloud]), 'lists')
        do r = 0, n_cloud - 1
            call expect(all(slots(offsets(r):offsets(r + 1) - 1) == row_of(w%near, r + 1) - 1), &
                        'a row is what brute force finds')
        end do
        call expect_ok(conn_release(rows), 'release')
        call expect_ok(conn_release(rows), 'release twice')
        call expect_ok(conn_acquire(w%map, pairs), 'pairs')
        call conn_pairs_pointers(pairs, i, j, coupling, offsets, list_offset, by_rank, ranks)
        call expect(size(i) == 0 .and. size(coupling) == 0 .and. size(by_rank) == 0 .and. &
                    size(ranks) == 0, 'arrays that are not there have no elements')
        call expect(lbound(j, 1) == 0 .and. 2*size(j) == count(w%near), 'j(0:)')
        call expect(size(offsets) == n_cloud + 1 .and. offsets(n_cloud) == size(j), 'offsets(0:n)')
        call expect_error(conn_acquire(w%map, pairs), CONN_E_ARGUMENT, 'view', 'a view in use')
        call expect_ok(conn_release(pairs), 'release')
        call conn_pairs_pointers(pairs, j=j)
        call expect(size(j) == 0, 'a released view shows nothing')
        call end_world(w)
    end subroutine pointers_show_rows_and_pairs_with_their_real_extents

    !> Neighbours of a node, both counted from 1.
    pure function row_of(near, a) result(row)
        logical, intent(in) :: near(:, :)
        integer, intent(in) :: a
        integer, allocatable :: row(:)
        integer :: b
        row = pack([(b, b=1, size(near, 2))], near(:, a))
    end function row_of

    subroutine index_base_1_indexes_ordinary_arrays()
        type(world) :: w
        type(conn_map_options) :: options
        type(conn_rows_view) :: rows
        integer(c_int64_t), pointer :: offsets(:)
        integer(c_int32_t), pointer :: slots(:)
        integer(c_int32_t) :: found(n_cloud)
        integer(c_int64_t) :: n, pair(2)
        integer :: a
        options%index_base = 1
        call make_world(w, options)
        call expect_pairs(w%map, w%near, 1, 'index_base 1')
        call expect_ok(conn_acquire(w%map, rows), 'rows')
        call conn_rows_pointers(rows, offsets, slots)
        do a = 1, n_cloud
            call expect(all(slots(offsets(a - 1):offsets(a) - 1) == row_of(w%near, a)), 'a row')
            call expect_ok(conn_map_all_neighbours(w%map, a, a, n, found), 'neighbours of a')
            call expect(all(pack(found(:n), found(:n) /= a) == row_of(w%near, a)), 'and its copy')
        end do
        call expect_ok(conn_release(rows), 'release')
        call expect_ok(conn_map_find_pairs(w%map, [1, 1], [1, 2], pair), 'pairs are found')
        call expect(pair(1) == -1 .and. (pair(2) >= 0 .eqv. w%near(1, 2)), 'pairs')
        call expect_error(conn_map_find_pairs(w%map, [1, 1], [2], pair), CONN_E_ARGUMENT, &
                          'one size', 'arrays of different sizes')
        call end_world(w)
    end subroutine index_base_1_indexes_ordinary_arrays

    subroutine copies_are_the_lists()
        type(world) :: w
        integer(c_int64_t) :: n, m, offsets(0:n_cloud), lists(2), nothing(0)
        integer(c_int32_t), allocatable :: slots(:), i(:), j(:)
        real(c_double), allocatable :: coupling(:)
        call make_world(w)
        call expect_ok(conn_map_rows_copy(w%map, n, m), 'the sizes of rows')
        call expect(n == n_cloud + 1 .and. m == count(w%near), 'sizes of rows')
        allocate (slots(m))
        call expect_ok(conn_map_rows_copy(w%map, n, m, offsets, slots), 'rows are copied')
        call expect(all(slots(offsets(3) + 1:offsets(4)) == row_of(w%near, 4) - 1), 'row 3')
        call expect_error(conn_map_rows_copy(w%map, n, m, slots=slots(:5)), CONN_E_BUFFER, '5', &
                          'a buffer of 5')
        call expect_error(conn_map_rows_copy(w%map, n, m, offsets=nothing), CONN_E_BUFFER, '0', &
                          'a buffer without elements')
        call expect_ok(conn_map_pairs_copy(w%map, n), 'the number of pairs')
        allocate (i(n), j(n), coupling(n))
        call expect_ok(conn_map_pairs_copy(w%map, n, i, j, coupling), 'pairs are copied')
        call expect(all(i < j) .and. all(coupling == 1) .and. 2*n == count(w%near), 'pairs')
        call expect_ok(conn_map_offsets(w%map, n, lists), 'offsets of lists')
        call expect(n == 2 .and. all(lists == [0, n_cloud]), 'slots of the list')
        call expect_ok(conn_map_offsets(w%map, n, row_offset=lists), 'offsets of rows')
        call expect_error(conn_map_offsets(w%map, n, lists(:1), lists), CONN_E_BUFFER, '2', &
                          'the smaller of two buffers counts')
        call end_world(w)
    end subroutine copies_are_the_lists

    !> Extents are told, not allocated: what is written is what the map has.
    subroutine arrays_of_more_than_2_to_the_31_elements_are_what_they_are()
        type(world) :: w
        integer(c_int32_t), allocatable, target :: memory(:)
        integer(c_int32_t), pointer, contiguous :: huge_i(:)
        real(c_double), pointer, contiguous :: huge_x(:, :)
        type(conn_array) :: x
        integer(c_int64_t) :: n
        call make_world(w)
        call expect_ok(conn_map_pairs_copy(w%map, n), 'the number of pairs')
        allocate (memory(n), source=-7_c_int32_t)
        call c_f_pointer(c_loc(memory), huge_i, [3000000000_c_int64_t])
        call expect_ok(conn_map_pairs_copy(w%map, n, j=huge_i), 'room for 3e9 pairs')
        call expect(all(memory >= 0), 'written where the host wants it')
        call c_f_pointer(c_loc(memory), huge_x, [3_c_int64_t, 800000000_c_int64_t])
        x = conn_array_matrix(huge_x)
        call expect(c_associated(x%data) .and. x%extent(1) == 800000000_c_int64_t, 'x(3, 8e8)')
        call expect(all(x%stride == [3, 1]), 'strides of x(3, 8e8)')
        call end_world(w)
    end subroutine arrays_of_more_than_2_to_the_31_elements_are_what_they_are

    subroutine orders_are_permutations_that_fields_follow()
        type(world) :: w
        type(conn_map_options) :: options
        integer(c_int32_t) :: order(n_cloud), ranks(n_cloud), marks(n_cloud), k
        integer(c_int64_t) :: n, keys(n_cloud), long(n_cloud)
        real(c_double) :: field(n_cloud), x(3, n_cloud)
        real(c_double), target :: copy(n_cloud), source(n_cloud)
        real(c_float) :: single(n_cloud), matrix(2, n_cloud)
        options%spatial_order = 1
        options%order = CONN_ORDER_KEY
        options%index_base = 1
        call make_world(w, options)
        call expect_ok(conn_map_traversal(w%map, 0, n, order), 'traversal')
        call expect(n == n_cloud .and. is_permutation(order), 'traversal is a permutation')
        call expect_ok(conn_map_key_order(w%map, n, order, ranks, keys), 'key order')
        call expect(all(order(ranks + 1) == [(k, k=1, n_cloud)]), 'slots and ranks are inverse')
        call expect_ok(conn_map_key_order(w%map, n), 'the size of key order')
        call expect_ok(conn_map_spatial_order(w%map, 0, n), 'the size of spatial order')
        call expect_ok(conn_map_spatial_order(w%map, 0, n, order), 'spatial order')
        call expect(n == n_cloud .and. is_permutation(order), 'spatial order is a permutation')
        marks = [(k, k=1, n_cloud)]
        call expect_ok(conn_reorder(marks, order, 1), 'int32')
        call expect(all(marks == order), 'an int32 field')
        long = [(k, k=1, n_cloud)]
        call expect_ok(conn_reorder(long, order, 1), 'int64')
        call expect(all(long == order), 'an int64 field')
        field = w%h
        call expect_ok(conn_reorder(field, order - 1, 0), 'float64, from 0')
        call expect(all(field == w%h(order)), 'a float64 field')
        single = real(w%h, c_float)
        call expect_ok(conn_reorder(single, order, 1), 'float32')
        call expect(all(single == real(w%h(order), c_float)), 'a float32 field')
        x = w%x
        call expect_ok(conn_reorder(x, order, 1), 'x(3, n)')
        call expect(all(x == w%x(:, order)), 'a vector field')
        matrix = real(w%x(:2, :), c_float)
        call expect_ok(conn_reorder(matrix, order, 1), 'float32 (2, n)')
        call expect(all(matrix == real(w%x(:2, order), c_float)), 'a float32 vector field')
        source = w%h
        call expect_ok(conn_reorder(conn_array_vector(source), order, 1, c_loc(copy)), 'elsewhere')
        call expect(all(copy == w%h(order)) .and. all(source == w%h), 'a copy in another order')
        order(1) = order(2)
        call expect(conn_reorder(source, order, 1) == CONN_E_ARGUMENT, 'no permutation')
        call end_world(w)
    end subroutine orders_are_permutations_that_fields_follow

    pure logical function is_permutation(order)
        integer(c_int32_t), intent(in) :: order(:)
        integer :: k
        is_permutation = all([(any(order == k), k=1, size(order))])
    end function is_permutation

    subroutine overlap_and_intersections_are_sets_of_common_nodes()
        type(world) :: w
        type(conn_map_options) :: options
        type(conn_rows_view) :: overlap
        type(conn_intersection_view) :: view
        type(conn_pairs_view) :: pairs
        integer(c_int64_t), pointer :: offsets(:)
        integer(c_int32_t), pointer :: slots(:), i(:), j(:)
        integer(c_int32_t) :: common(n_cloud)
        integer(c_int64_t) :: n, m
        logical :: sees(n_cloud, n_cloud), gather(n_cloud, n_cloud)
        integer :: k, a
        options%overlap = 1
        options%intersection = CONN_INTERSECTION_ALL
        call make_world(w, options)
        sees = w%near
        do a = 1, n_cloud
            sees(a, a) = .true.
            gather(:, a) = sum((w%x - spread(w%x(:, a), 2, n_cloud))**2, 1) <= (extent*w%h(a))**2
        end do
        call expect_ok(conn_map_overlap_acquire(w%map, CONN_SPACE_HOST, overlap), 'overlap')
        call conn_rows_pointers(overlap, offsets, slots)
        do a = 1, n_cloud
            n = count([(k /= a .and. any(gather(:, a) .and. gather(:, k)), k=1, n_cloud)])
            call expect(offsets(a) - offsets(a - 1) == n, 'a row of overlap')
        end do
        call expect_ok(conn_release(overlap), 'release')
        call expect_ok(conn_acquire(w%map, view), 'intersections')
        call expect_ok(conn_acquire(w%map, pairs, .true.), 'pairs')
        call conn_intersection_pointers(view, offsets, slots)
        call conn_pairs_pointers(pairs, i, j)
        do k = 0, size(j) - 1
            call expect(offsets(k + 1) - offsets(k) == &
                        count(sees(:, i(k) + 1) .and. sees(:, j(k) + 1)), 'an intersection')
            call expect_ok(conn_map_common_neighbours(w%map, i(k), j(k), n, common), 'of a pair')
            call expect(all(common(:n) == slots(offsets(k):offsets(k + 1) - 1)), 'any two nodes')
        end do
        call expect_ok(conn_map_common_neighbours(w%map, i(0), j(0), m, lists=[w%nodes]), 'between')
        call expect(m >= 2 .and. m <= offsets(1), 'fewer are between the two')
        call expect_ok(conn_release(view), 'release')
        call expect_ok(conn_release(pairs), 'release')
        call end_world(w)
    end subroutine overlap_and_intersections_are_sets_of_common_nodes

end module lists_test
