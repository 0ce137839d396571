! SPDX-License-Identifier: BSD-3-Clause
! Boundaries, queries and checks.
module experimental_test
    use support
    implicit none

contains

    !> A row of nodes before a mirror at x = 0.
    subroutine a_mirror_makes_ghosts_with_mirrored_fields()
        type(conn_context) :: context
        type(conn_nodes) :: nodes
        type(conn_map) :: map
        type(conn_boundaries) :: boundaries
        type(conn_boundary_nodes) :: view
        real(c_double), pointer :: x(:, :), h(:), tensor(:, :)
        integer(c_int32_t), pointer :: owner(:)
        integer(c_int64_t), pointer :: global_id(:)
        real(c_double) :: mine(2, 5), velocity(2, 7), mass(7)
        integer :: k
        mine(1, :) = [(k - 0.5_c_double, k=1, 5)]
        mine(2, :) = 0.25_c_double
        call expect_ok(conn_context_create(context), 'context')
        call expect_ok(conn_nodes_create(context, 'gas', 2, 1._c_double, nodes), 'nodes')
        call expect_ok(conn_map_create(context, map), 'map')
        call expect_ok(conn_set_h(nodes, mine, 2.2_c_double), 'set')
        call expect_ok(conn_boundaries_create(context, 2, boundaries), 'boundaries')
        call expect_error(conn_boundaries_add(boundaries, CONN_BOUNDARY_REFLECTING, 'wall', &
            reshape([0._c_double], [1, 1]), .true.), CONN_E_ARGUMENT, 'planes', 'one number')
        call expect_ok(conn_boundaries_add(boundaries, CONN_BOUNDARY_REFLECTING, 'wall', &
            reshape([0._c_double, 0._c_double, 2._c_double, 0._c_double], [2, 2]), .false.), 'wall')
        call expect_ok(conn_boundaries_update(boundaries, [nodes], CONN_GHOSTS_KEEP, map), 'update')
        call expect_ok(conn_boundaries_get_nodes(boundaries, 0, view), 'get')
        call conn_boundary_pointers(boundaries, view, x, h, tensor, owner, global_id)
        call expect(view%n == 7 .and. view%n_internal == 5, 'the two nodes at the wall have ghosts')
        call expect(all(shape(x) == [2, 7]) .and. lbound(x, 2) == 0 .and. size(h) == 7 .and. &
                    size(tensor) == 0 .and. size(global_id) == 0 .and. size(owner) == 2, 'extents')
        call expect(all(x(1, 5:6) == -x(1, owner)) .and. all(x(2, 5:6) == x(2, owner)), 'mirrored')
        velocity = 3
        mass = [1, 2, 3, 4, 5, 0, 0]
        call expect_ok(conn_boundaries_fill_ghosts(boundaries, 0, CONN_FIELD_VECTOR, velocity), 'v')
        call expect(all(velocity(1, 6:) == -3) .and. all(velocity(2, 6:) == 3), 'velocities')
        call expect_ok(conn_boundaries_fill_ghosts(boundaries, 0, CONN_FIELD_SCALAR, mass), 'm')
        call expect(all(mass(6:) == mass(owner + 1)), 'masses')
        call expect_error(conn_boundaries_fill_ghosts(boundaries, 0, CONN_FIELD_SCALAR, mass(:6)), &
                          CONN_E_ARGUMENT, '6', 'too few')
        call expect_ok(conn_boundaries_update(boundaries, [nodes], CONN_GHOSTS_REFRESH), 'refresh')
        call expect_ok(conn_destroy(boundaries), 'destroy')
        call expect_ok(conn_destroy(map), 'destroy')
        call expect_ok(conn_destroy(nodes), 'destroy')
        call expect_ok(conn_destroy(context), 'destroy')
    end subroutine a_mirror_makes_ghosts_with_mirrored_fields

    subroutine queries_find_what_brute_force_finds()
        type(world) :: w
        type(conn_query) :: query
        type(conn_map_options) :: domain
        real(c_double), parameter :: middle(3) = 0.5_c_double, half(3) = 0.25_c_double, &
            normal(3) = [0._c_double, 3._c_double, 0._c_double]
        real(c_double) :: r, shift(3)
        integer(c_int32_t) :: slots(n_cloud), row(n_cloud)
        integer(c_int64_t) :: n, n_coarse
        integer :: k, a
        logical :: found(n_cloud)
        call make_world(w)
        call expect_ok(conn_query_create(w%context, query), 'query')
        call expect_error(conn_query_neighbours(query, 1, CONN_GATHER, n), CONN_E_NOT_BUILT, '', &
                          'a query without nodes')
        domain%index_base = 1
        call expect_ok(conn_query_update(query, [w%nodes], domain), 'update')
        do a = 1, n_cloud
            call expect_ok(conn_query_neighbours(query, a, CONN_GATHER_SCATTER, n, slots), 'of a')
            row(:count(w%near(:, a))) = pack([(k, k=1, n_cloud)], w%near(:, a))
            call expect(n == count(w%near(:, a)), 'as many neighbours')
            call expect(all(slots(:n) == row(:n)), 'the same neighbours')
        end do
        r = 0.5_c_double
        found = sum((w%x - spread(middle, 2, n_cloud))**2, 1) <= r**2
        call expect_ok(conn_query_neighbours_at(query, middle, r/2, CONN_GATHER, n, slots), 'at')
        call expect(n == count(found), 'nodes in a ball')
        call expect_ok(conn_query_neighbours_at(query, middle, 0._c_double, CONN_GATHER, n, slots, &
            [extent/r, 0._c_double, 0._c_double, extent/r, 0._c_double, extent/r]), 'tensor')
        call expect(n == count(found), 'nodes in an ellipsoid')
        call expect(conn_query_neighbours_at(query, middle(:2), r, CONN_GATHER, n) /= CONN_OK, &
                    'a place with too few coordinates')
        call expect_ok(conn_query_near_box(query, half, middle, CONN_GATHER, n, slots), 'box')
        found = all(w%x >= 0.25_c_double .and. w%x <= 0.5_c_double, 1)
        call expect(n == count(found) .and. all(found(slots(:n))), 'nodes in a box')
        call expect_ok(conn_query_near_plane(query, middle, normal, 0.1_c_double, CONN_GATHER, n, &
                                             slots), 'plane')
        found = abs(w%x(2, :) - 0.5_c_double) <= 0.1_c_double
        call expect(n == count(found) .and. all(found(slots(:n))), 'nodes near a plane')
        call expect_ok(conn_query_candidates(query, 7, CONN_GATHER_SCATTER, &
                                             CONN_CANDIDATES_COARSE, n_coarse), 'coarse')
        call expect_ok(conn_query_candidates(query, 7, CONN_GATHER_SCATTER, &
                                             CONN_CANDIDATES_REFINE, n, slots), 'refine')
        found = .false.
        found(slots(:n)) = .true.
        call expect(n_coarse >= n .and. found(7) .and. all(found .or. .not. w%near(:, 7)), &
                    'candidates')
        domain%periodic = 1
        domain%box_hi = 1
        call expect_ok(conn_query_update(query, [w%nodes], domain), 'update')
        call expect_ok(conn_query_periodic_shift(query, 1, 2, shift), 'shift')
        call expect(all(abs(w%x(:, 2) + shift - w%x(:, 1)) <= 0.5_c_double), 'the nearest image')
        call expect_ok(conn_destroy(query), 'destroy')
        call end_world(w)
    end subroutine queries_find_what_brute_force_finds

    subroutine validation_names_every_law()
        type(world) :: w
        character(:), allocatable :: text
        integer(c_int32_t) :: n_failed
        call make_world(w)
        n_failed = -1
        call expect_ok(conn_map_validate(w%map, [w%nodes], n_failed, text), 'validate')
        call expect(n_failed == 0 .and. index(text, 'ok ') == 1, 'all laws hold')
        call expect(index(text, 'FAILED') == 0, 'and the text says so')
        w%x(:, 9) = w%x(:, 9) + 3
        call expect_ok(conn_set_h(w%nodes, w%x, w%h), 'a node moves')
        call expect_ok(conn_map_validate(w%map, [w%nodes], n_failed), 'validate')
        call expect(n_failed > 0, 'old lists fail')
        call end_world(w)
    end subroutine validation_names_every_law

    !> The last of all calls of a process.
    subroutine nothing_works_after_a_shutdown()
        type(world) :: w
        type(conn_context) :: context
        call make_world(w)
        call expect_ok(conn_shutdown(), 'shutdown')
        call expect_error(conn_context_create(context), CONN_E_FINALIZED, '', 'a new context')
        call expect_error(conn_rebuild(w%map, w%nodes), CONN_E_FINALIZED, '', 'a rebuild')
        call end_world(w)
    end subroutine nothing_works_after_a_shutdown

end module experimental_test
