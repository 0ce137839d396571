! SPDX-License-Identifier: BSD-3-Clause
! What the tests of the Fortran module share: expectations, a cloud of nodes, neighbours by brute
! force.
module support
    use, intrinsic :: iso_c_binding
    use connectivity
    implicit none
    integer, parameter :: n_cloud = 120
    real(c_double), parameter :: extent = 2
    integer :: n_failures = 0

    !> Context, one list and a map, of a cloud in the unit cube.
    type :: world
        type(conn_context) :: context
        type(conn_nodes) :: nodes
        type(conn_map) :: map
        real(c_double) :: x(3, n_cloud), h(n_cloud)
        logical :: near(n_cloud, n_cloud) = .false. !< gather-scatter, never a node itself
    end type world

contains

    subroutine expect(holds, what)
        logical, intent(in) :: holds
        character(*), intent(in) :: what
        if (holds) return
        n_failures = n_failures + 1
        print '(2a)', 'FAILED: ', what
    end subroutine expect

    subroutine expect_ok(status, what)
        integer(c_int32_t), intent(in) :: status
        character(*), intent(in) :: what
        if (status == CONN_OK) return
        call expect(.false., what//': '//conn_error_text(status))
    end subroutine expect_ok

    !> The error asked for, with a text that says what.
    subroutine expect_error(status, expected, part, what)
        integer(c_int32_t), intent(in) :: status, expected
        character(*), intent(in) :: part, what
        call expect(status == expected, what//' gives status '//conn_status_text(expected)// &
                    ', found '//conn_error_text(status))
        call expect(index(conn_last_error(), part) > 0, &
                    what//' says "'//part//'", found: '//conn_last_error())
    end subroutine expect_error

    !> Numbers in (0, 1), the same ones on every machine.
    function uniform(seed, n) result(values)
        integer, intent(in) :: seed, n
        real(c_double) :: values(n)
        integer(c_int64_t) :: state
        integer :: k
        state = seed
        do k = 1, n
            state = mod(state*48271_c_int64_t, 2147483647_c_int64_t)
            values(k) = real(state, c_double)/2147483647._c_double
        end do
    end function uniform

    !> Supports about two node distances wide.
    subroutine make_cloud(seed, x, h)
        integer, intent(in) :: seed
        real(c_double), intent(out) :: x(3, n_cloud), h(n_cloud)
        x = reshape(uniform(seed, 3*n_cloud), [3, n_cloud])
        h = 0.1_c_double + 0.05_c_double*uniform(seed + 77, n_cloud)
    end subroutine make_cloud

    pure function brute_force(x, h) result(near)
        real(c_double), intent(in) :: x(:, :), h(:)
        logical :: near(size(h), size(h))
        integer :: i, j
        do j = 1, size(h)
            do i = 1, size(h)
                near(i, j) = i /= j .and. &
                    sum((x(:, i) - x(:, j))**2) <= (extent*max(h(i), h(j)))**2
            end do
        end do
    end function brute_force

    !> The world of a seed, its map built.
    subroutine make_world(w, options)
        type(world), intent(inout) :: w
        type(conn_map_options), intent(in), optional :: options
        call make_cloud(4711, w%x, w%h)
        w%near = brute_force(w%x, w%h)
        call expect_ok(conn_context_create(w%context), 'a context is created')
        call expect_ok(conn_nodes_create(w%context, 'gas', 3, extent, w%nodes), 'a list is created')
        call expect_ok(conn_set_h(w%nodes, w%x, w%h), 'nodes are set')
        call expect_ok(conn_map_create(w%context, w%map, options), 'a map is created')
        call expect_ok(conn_rebuild(w%map, w%nodes), 'a map is built')
    end subroutine make_world

    subroutine end_world(w)
        type(world), intent(inout) :: w
        call expect_ok(conn_destroy(w%map), 'a map is destroyed')
        call expect_ok(conn_destroy(w%nodes), 'a list is destroyed')
        call expect_ok(conn_destroy(w%context), 'a context is destroyed')
        call expect(.not. c_associated(w%map%handle), 'a destroyed handle is null')
    end subroutine end_world

    !> Pairs of a map against brute force: as many, and each of them near. base: of the slots.
    subroutine expect_pairs(map, near, base, what)
        type(conn_map), intent(in) :: map
        logical, intent(in) :: near(:, :)
        integer, intent(in) :: base
        character(*), intent(in) :: what
        type(conn_pairs_view) :: view
        integer(c_int32_t), pointer :: i(:), j(:)
        integer :: k, wrong
        call expect_ok(conn_acquire(map, view, expand=.true.), what//': pairs are acquired')
        call conn_pairs_pointers(view, i, j)
        call expect(2*size(j) == count(near), what//': as many pairs as by brute force')
        wrong = 0
        do k = 0, size(j) - 1
            if (.not. near(i(k) - base + 1, j(k) - base + 1)) wrong = wrong + 1
        end do
        call expect(wrong == 0 .and. size(j) > 0, what//': each pair is near')
        call expect_ok(conn_release(view), what//': pairs are released')
    end subroutine expect_pairs

end module support
