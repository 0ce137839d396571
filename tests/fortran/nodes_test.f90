! SPDX-License-Identifier: BSD-3-Clause
! Nodes in, in every form that a host may have them.
module nodes_test
    use support
    implicit none

    type :: particle
        real(c_double) :: x, y, z, mass
        real(c_float) :: h, u
    end type particle

contains

    subroutine every_form_of_the_nodes_gives_the_same_lists()
        type(world) :: w
        real(c_double) :: columns(n_cloud, 3), wide(7, 2*n_cloud), one_h
        real(c_double) :: x(n_cloud), y(n_cloud), z(n_cloud)
        integer(c_int64_t) :: n, n_internal
        call make_world(w)
        call expect_pairs(w%map, w%near, 0, 'x(3, n)')
        columns = transpose(w%x)
        call expect_ok(conn_set_h(w%nodes, columns, w%h, planar=.true.), 'x(n, 3) is set')
        call rebuilt('x(n, 3)')
        x = w%x(1, :)
        y = w%x(2, :)
        z = w%x(3, :)
        call expect_ok(conn_set_h(w%nodes, x, y, z, w%h), 'x, y, z are set')
        call rebuilt('x, y, z')
        wide = huge(wide)
        wide(2:6:2, 2::2) = w%x
        call expect_ok(conn_set_h(w%nodes, wide(2:6:2, 2::2), w%h), 'a section is set')
        call rebuilt('a section')
        wide(6:2:-2, 2*n_cloud:2:-2) = w%x
        call expect_ok(conn_set_h(w%nodes, wide(6:2:-2, 2*n_cloud:2:-2), w%h), 'backwards')
        call rebuilt('a section backwards')
        call expect_ok(conn_set_h(w%nodes, w%x(1, :), w%x(2, :), w%x(3, :), w%h), 'rows of x')
        call rebuilt('rows of x')
        call expect_error(conn_set_h(w%nodes, columns, w%h), CONN_E_ARGUMENT, 'extent', &
                          'x(n, 3) without planar')
        one_h = 0.12_c_double
        w%near = brute_force(w%x, spread(one_h, 1, n_cloud))
        call expect_ok(conn_set_h(w%nodes, w%x, one_h), 'one h for all')
        call rebuilt('one h')
        call expect_ok(conn_set_h(w%nodes, columns, one_h, planar=.true.), 'planar, one h for all')
        call rebuilt('planar, one h')
        call expect_ok(conn_set_h(w%nodes, x, y, z, one_h, n_internal=100), '100 internal nodes')
        call rebuilt('100 internal nodes', internal=100)
        call expect_ok(conn_nodes_size(w%nodes, n, n_internal), 'the size is asked for')
        call expect(n == n_cloud .and. n_internal == 100, 'sizes')
        call expect_ok(conn_nodes_size(w%nodes), 'nothing is asked for')
        call end_world(w)
    contains
        !> Pairs of ghosts with each other are not in the list.
        subroutine rebuilt(what, internal)
            character(*), intent(in) :: what
            integer, intent(in), optional :: internal
            logical :: near(n_cloud, n_cloud)
            near = w%near
            if (present(internal)) near(internal + 1:, internal + 1:) = .false.
            call expect_ok(conn_rebuild(w%map, [w%nodes]), what//' is built')
            call expect_pairs(w%map, near, 0, what)
        end subroutine rebuilt
    end subroutine every_form_of_the_nodes_gives_the_same_lists

    subroutine single_precision_gives_the_lists_of_the_same_values()
        type(world) :: w
        real(c_float) :: x(3, n_cloud), h(n_cloud)
        type(particle), target :: particles(n_cloud)
        integer(c_int64_t), parameter :: n = n_cloud
        call make_world(w)
        x = real(w%x, c_float)
        h = real(w%h, c_float)
        w%near = brute_force(real(x, c_double), real(h, c_double))
        call expect_ok(conn_set_h(w%nodes, x, h), 'x(3, n) in single precision')
        call rebuilt('x(3, n)')
        call expect_ok(conn_set_h(w%nodes, transpose(x), h, planar=.true.), 'an expression')
        call rebuilt('an expression')
        call expect_ok(conn_set_h(w%nodes, x(1, :), x(2, :), x(3, :), h), 'x, y, z')
        call rebuilt('x, y, z')
        particles%x = x(1, :)
        particles%y = x(2, :)
        particles%z = x(3, :)
        particles%h = h
        call expect_ok(conn_nodes_set_h(w%nodes, n, [ &
             conn_array_strided(particles(1)%x, particles(2)%x, n), &
             conn_array_strided(particles(1)%y, particles(2)%y, n), &
             conn_array_strided(particles(1)%z, particles(2)%z, n)], &
            conn_array_strided(particles(1)%h, particles(2)%h, n)), 'structs, mixed')
        call rebuilt('structs')
        call expect_ok(conn_set_h(w%nodes, real(particles%x), real(particles%y), &
                                  real(particles%z), particles%h), 'components')
        call rebuilt('components')
        h = 0.12
        w%near = brute_force(real(x, c_double), real(h, c_double))
        call expect_ok(conn_set_h(w%nodes, x, h(1)), 'one h in single precision')
        call rebuilt('one h')
        call end_world(w)
    contains
        subroutine rebuilt(what)
            character(*), intent(in) :: what
            call expect_ok(conn_rebuild(w%map, w%nodes), what//' is built')
            call expect_pairs(w%map, w%near, 0, what//' in single precision')
        end subroutine rebuilt
    end subroutine single_precision_gives_the_lists_of_the_same_values

    subroutine steps_of_no_whole_elements_are_refused_by_their_bytes()
        use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int8_t, c_loc
        type(world) :: w
        integer(c_int8_t), target :: bytes(64)
        real(c_double), pointer :: first, second
        call make_world(w)
        call c_f_pointer(c_loc(bytes(1)), first)
        call c_f_pointer(c_loc(bytes(13)), second)
        call expect_error(conn_nodes_set_h(w%nodes, 4_c_int64_t, [conn_array_vector(w%h(:4)), &
                                           conn_array_vector(w%h(:4)), conn_array_vector(w%h(:4))], &
                                           conn_array_strided(first, second, 4_c_int64_t)), &
                          CONN_E_ARGUMENT, 'h: elements are 12 bytes apart', 'a step of 12 bytes')
        call end_world(w)
    end subroutine steps_of_no_whole_elements_are_refused_by_their_bytes

    subroutine one_and_two_dimensions_have_their_own_forms()
        type(conn_context) :: context
        type(conn_nodes) :: line, plane
        type(conn_map) :: map
        type(conn_map_info) :: info
        real(c_double) :: x(10), y(10)
        integer :: k
        x = [(k, k = 1, 10)]
        y = mod([(k, k = 1, 10)], 2)
        call expect_ok(conn_context_create(context), 'context')
        call expect_ok(conn_nodes_create(context, 'line', 1, 1._c_double, line), 'line')
        call expect_ok(conn_nodes_create(context, 'plane', 2, 1._c_double, plane), 'plane')
        call expect_ok(conn_map_create(context, map), 'map')
        call expect_ok(conn_set_h(line, x, 1.1_c_double), 'x')
        call expect_ok(conn_rebuild(map, line), 'rebuild')
        call expect_ok(conn_map_get_info(map, info), 'info')
        call expect(info%n_pairs == 9 .and. info%dim == 1, 'a chain of 10 nodes has 9 pairs')
        call expect_ok(conn_set_h(line, x, [(1.1_c_double, k=1, 10)]), 'x and h')
        call expect_ok(conn_set_h(plane, x, y, 2.1_c_double), 'x, y')
        call expect_ok(conn_rebuild(map, plane), 'rebuild')
        call expect_ok(conn_map_get_info(map, info), 'info')
        call expect(info%n_pairs == 9 + 8 .and. info%dim == 2, 'a zigzag of 10 nodes has 17 pairs')
        call expect_ok(conn_set_h(plane, x, y, [(2.1_c_double, k=1, 10)]), 'x, y and h')
        call expect_error(conn_rebuild(map, [line, plane]), CONN_E_ARGUMENT, 'dim', &
                          'lists of two dimensions')
        call expect_ok(conn_destroy(map), 'map')
        call expect_ok(conn_destroy(plane), 'plane')
        call expect_ok(conn_destroy(line), 'line')
        call expect_ok(conn_destroy(context), 'context')
    end subroutine one_and_two_dimensions_have_their_own_forms

    subroutine round_tensors_give_the_lists_of_scalars()
        type(world) :: w
        real(c_double) :: tensor(6, n_cloud)
        call make_world(w)
        tensor = 0
        tensor(1, :) = 1/w%h
        tensor(4, :) = 1/w%h
        tensor(6, :) = 1/w%h
        call expect_ok(conn_set_tensor(w%nodes, w%x, tensor), 'tensors')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect_pairs(w%map, w%near, 0, 'tensors')
        call expect_ok(conn_set_tensor(w%nodes, transpose(w%x), transpose(tensor), &
                                       n_internal=n_cloud, planar=.true.), 'planar tensors')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'rebuild')
        call expect_pairs(w%map, w%near, 0, 'planar tensors')
        call expect_ok(conn_set_tensor(w%nodes, real(w%x), real(tensor)), 'in single precision')
        call end_world(w)
    end subroutine round_tensors_give_the_lists_of_scalars

    subroutine descriptions_say_where_elements_are()
        real(c_double), target :: a(4, 5)
        integer(c_int32_t), target :: i(6)
        integer(c_int64_t), target :: l(2, 3)
        type(conn_array) :: d
        type(c_ptr) :: at
        d = conn_array_matrix(a)
        at = c_loc(a) ! within c_associated it stops gfortran 12
        call expect(d%dtype == CONN_FLOAT64 .and. d%ndim == 2 .and. all(d%extent == [5, 4]) .and. &
                    all(d%stride == [4, 1]) .and. c_associated(d%data, at), 'a(4, 5)')
        d = conn_array_planar(a(::3, 5:1:-2))
        at = c_loc(a(1, 5))
        call expect(all(d%extent == [2, 3]) .and. all(d%stride == [3, -8]) .and. &
                    c_associated(d%data, at), 'a section of a')
        d = conn_array_vector(i(2::2))
        call expect(d%dtype == CONN_INT32 .and. d%ndim == 1 .and. d%extent(1) == 3 .and. &
                    d%stride(1) == 2, 'i(2::2)')
        d = conn_array_vector(i(1:0))
        call expect(d%extent(1) == 0 .and. .not. c_associated(d%data), 'no elements')
        d = conn_array_matrix(l)
        call expect(d%dtype == CONN_INT64 .and. all(d%stride == [2, 1]), 'l(2, 3)')
        d = conn_array_repeated(a(2, 2), 9_c_int64_t)
        call expect(d%extent(1) == 9 .and. d%stride(1) == 0, 'one value for all')
    end subroutine descriptions_say_where_elements_are

end module nodes_test
