! SPDX-License-Identifier: BSD-3-Clause
! Values of pairs, sums, exclusions and patches.
module fields_test
    use support
    implicit none

contains

    subroutine sums_of_pair_fields_are_those_of_a_loop_over_pairs()
        type(world) :: w
        type(conn_pair_field) :: field, scalars
        type(conn_pairs_view) :: view
        integer(c_int32_t), pointer :: i(:), j(:)
        real(c_double), pointer :: values(:, :), one(:, :)
        real(c_double) :: sums(3, n_cloud), expected(3, n_cloud), ends(n_cloud)
        integer :: k
        call make_world(w)
        call expect_ok(conn_acquire(w%map, view, .true.), 'pairs')
        call conn_pairs_pointers(view, i, j)
        call expect_ok(conn_pair_field_create(w%map, 3, field), 'a field')
        call expect_ok(conn_pair_field_create(w%map, 1, scalars), 'a field of scalars')
        call expect_ok(conn_pair_field_data(field, w%map, values), 'its values')
        call expect_ok(conn_pair_field_data(scalars, w%map, one), 'its values')
        call expect(all(shape(values) == [3, size(j)]) .and. lbound(values, 1) == 1 .and. &
                    lbound(values, 2) == 0 .and. all(values == 0), 'values(3, 0:n_pairs-1), zeros')
        expected = 0
        one = 1
        do k = 0, size(j) - 1
            values(:, k) = w%x(:, i(k) + 1) - w%x(:, j(k) + 1)
            expected(:, i(k) + 1) = expected(:, i(k) + 1) + values(:, k)
            expected(:, j(k) + 1) = expected(:, j(k) + 1) - values(:, k)
        end do
        call expect_ok(conn_release(view), 'release')
        call expect_ok(conn_pair_field_sum(field, w%map, CONN_ANTISYMMETRIC, &
                                           CONN_SUM_DETERMINISTIC, sums), 'sums')
        call expect(maxval(abs(sums - expected)) < 1e-12_c_double, 'antisymmetric sums')
        call expect_ok(conn_pair_field_sum(scalars, w%map, CONN_SYMMETRIC, CONN_SUM_ATOMIC, ends), &
                       'sums')
        call expect(all(ends == count(w%near, 1)), 'as many ends as neighbours')
        call expect_error(conn_pair_field_sum(field, w%map, CONN_ANTISYMMETRIC, &
            CONN_SUM_DETERMINISTIC, sums(:, :5)), CONN_E_BUFFER, '15', 'too little room')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect_error(conn_pair_field_data(field, w%map, values), CONN_E_STALE, 'rebuild', &
                          'an old field')
        call expect_ok(conn_pair_field_reset(field, w%map), 'reset')
        call expect_ok(conn_pair_field_data(field, w%map, values), 'its values')
        call expect(all(values == 0), 'zeros again')
        call expect_ok(conn_destroy(field), 'destroy')
        call expect_ok(conn_destroy(scalars), 'destroy')
        call end_world(w)
    end subroutine sums_of_pair_fields_are_those_of_a_loop_over_pairs

    subroutine coupling_comes_from_arrays_and_functions()
        type(world) :: w
        real(c_double), allocatable :: values(:)
        real(c_double), target :: scale
        integer(c_int32_t), allocatable :: i(:), j(:)
        integer(c_int64_t) :: n
        integer :: k
        call make_world(w)
        call expect_ok(conn_map_pairs_copy(w%map, n), 'pairs')
        allocate (values(n), i(n), j(n))
        values = [(1/real(k, c_double), k=1, int(n))]
        call expect_ok(conn_map_set_coupling(w%map, values), 'an array')
        call expect_ok(conn_map_pairs_copy(w%map, n, coupling=values), 'copy')
        call expect(values(4) == 0.25_c_double, 'values of the array')
        scale = 0.001_c_double
        call expect_ok(conn_map_set_coupling_function(w%map, scaled_sum, c_loc(scale)), 'function')
        call expect_ok(conn_map_pairs_copy(w%map, n, i, j, values), 'copy')
        call expect(all(values == scale*(i + j)), 'values of the function')
        call expect_error(conn_map_set_coupling(w%map, values(:3)), CONN_E_ARGUMENT, '3', 'too few')
        call expect_ok(conn_map_set_coupling(w%map), 'none')
        call expect_ok(conn_map_pairs_copy(w%map, n, coupling=values), 'copy')
        call expect(all(values == 1), '1 for all')
        call end_world(w)
    end subroutine coupling_comes_from_arrays_and_functions

    recursive function scaled_sum(user_data, slot_i, slot_j) bind(c) result(answer)
        type(c_ptr), value :: user_data
        integer(c_int32_t), value :: slot_i, slot_j
        real(c_double) :: answer
        real(c_double), pointer :: scale
        call c_f_pointer(user_data, scale)
        answer = scale*(slot_i + slot_j)
    end function scaled_sum

    subroutine pairs_that_are_left_out_are_gone()
        type(world) :: w
        type(conn_pair_field) :: field
        real(c_double), pointer :: values(:, :)
        logical :: near(n_cloud, n_cloud)
        integer :: a, b
        call make_world(w)
        do b = 1, n_cloud
            do a = 1, n_cloud
                near(a, b) = w%near(a, b) .and. mod(a + b - 2, 3) /= 0
            end do
        end do
        call expect_ok(conn_pair_field_create(w%map, 1, field), 'a field')
        call expect_ok(conn_map_remove_pairs(w%map, every_third, fields=[field]), 'remove')
        call expect_pairs(w%map, near, 0, 'removed')
        call expect_ok(conn_pair_field_data(field, w%map, values), 'the field goes along')
        call expect(2*size(values) == count(near), 'with the pairs that stay')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect_ok(conn_map_remove_pairs(w%map, every_third), 'remove without a field')
        call expect_pairs(w%map, near, 0, 'removed')
        call expect_ok(conn_map_set_exclusion(w%map, every_third), 'exclusion')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect_pairs(w%map, near, 0, 'excluded')
        call expect_ok(conn_map_set_exclusion(w%map), 'no exclusion')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect_pairs(w%map, w%near, 0, 'all')
        call expect_ok(conn_destroy(field), 'destroy')
        call end_world(w)
    end subroutine pairs_that_are_left_out_are_gone

    recursive function every_third(user_data, slot_i, slot_j) bind(c) result(answer)
        type(c_ptr), value :: user_data
        integer(c_int32_t), value :: slot_i, slot_j
        integer(c_int32_t) :: answer
        answer = merge(1, 0, mod(slot_i + slot_j, 3) == 0)
        if (c_associated(user_data)) answer = 0
    end function every_third

    subroutine a_patch_drops_and_renumbers_nodes()
        type(world) :: w
        type(conn_map_options) :: options
        type(conn_pair_field) :: field
        type(conn_pairs_view) :: view
        real(c_double), pointer :: values(:, :)
        integer(c_int32_t), pointer :: i(:), j(:)
        integer(c_int32_t) :: keep(n_cloud), old2new(n_cloud), stay(n_cloud/2), k
        options%index_base = 1
        call make_world(w, options)
        call expect_ok(conn_pair_field_create(w%map, 2, field), 'a field')
        call expect_ok(conn_pair_field_data(field, w%map, values), 'its values')
        call expect_ok(conn_acquire(w%map, view, .true.), 'pairs')
        call conn_pairs_pointers(view, i, j)
        values(1, :) = i
        values(2, :) = j
        call expect_ok(conn_release(view), 'release')
        keep = [(mod(k, 2), k=1, n_cloud)]
        old2new = [((k + 1)/2, k=1, n_cloud)]
        stay = [(2*k - 1, k=1, n_cloud/2)]
        call expect_error(conn_map_patch(w%map, keep, old2new(:7)), CONN_E_ARGUMENT, 'one size', &
                          'arrays of different sizes')
        call expect_ok(conn_map_patch(w%map, keep, old2new, [field]), 'patch')
        call expect_pairs(w%map, w%near(stay, stay), 1, 'patched')
        call expect_ok(conn_pair_field_data(field, w%map, values), 'the field goes along')
        call expect_ok(conn_acquire(w%map, view, .true.), 'pairs')
        call conn_pairs_pointers(view, i, j)
        call expect(all(values(1, :) == stay(i)) .and. all(values(2, :) == stay(j)), &
                    'with the values of the pairs that stay')
        call expect_ok(conn_release(view), 'release')
        keep(:n_cloud/2) = 1
        old2new(:n_cloud/2) = [(k, k=1, n_cloud/2)]
        call expect_ok(conn_map_patch(w%map, keep(:n_cloud/2), old2new(:n_cloud/2)), 'no field')
        call expect_error(conn_pair_field_data(field, w%map, values), CONN_E_STALE, '', 'left out')
        call expect_ok(conn_destroy(field), 'destroy')
        call end_world(w)
    end subroutine a_patch_drops_and_renumbers_nodes

end module fields_test
