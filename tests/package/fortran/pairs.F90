! SPDX-License-Identifier: BSD-3-Clause
! The lattice of ../c/pairs.c from Fortran: 3 m²(m-1) + 6 m (m-1)² pairs.
program pairs
    use, intrinsic :: iso_c_binding
    use connectivity
    implicit none

    integer, parameter :: m = 10, n = m**3
    integer, parameter :: expected = 3*m*m*(m - 1) + 6*m*(m - 1)**2
    real(c_double), parameter :: h = 0.75_c_double
    real(c_double) :: x(3, 0:n - 1)
    type(conn_context) :: context
    type(conn_nodes) :: nodes
    type(conn_map) :: map
    type(conn_pairs_view) :: view
    integer(c_int32_t), pointer :: i(:), j(:)
    integer :: k, n_close

    if (c_sizeof(view) /= conn_abi_sizeof(CONN_STRUCT_PAIRS_VIEW)) error stop 'sizes differ'
    do k = 0, n - 1
        x(:, k) = [mod(k, m), mod(k/m, m), k/m/m]
    end do
    call check(conn_context_create(context))
    call check(conn_nodes_create(context, 'lattice', 3, 2.0_c_double, nodes))
    call check(conn_set_h(nodes, x, h))
    call check(conn_map_create(context, map))
    call check(conn_rebuild(map, nodes))
    call check(conn_acquire(map, view, expand=.true.))
    call conn_pairs_pointers(view, i, j)

    n_close = 0
    do k = 0, size(j) - 1
        if (sum((x(:, i(k)) - x(:, j(k)))**2) <= 1.5**2) n_close = n_close + 1
    end do
    print '(i0, 2a)', n_close, ' pairs, version ', conn_version_string()

    call check(conn_release(view))
    call check(conn_destroy(map))
    call check(conn_destroy(nodes))
    call check(conn_destroy(context))
    if (n_close /= expected .or. size(j) /= expected) error stop 'wrong number'

contains

    subroutine check(status)
        integer(c_int32_t), intent(in) :: status
        if (status == CONN_OK) return
        print '(a)', conn_error_text(status)
        error stop 1
    end subroutine check

end program pairs
