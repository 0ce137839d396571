! SPDX-License-Identifier: BSD-3-Clause
! The lattice of ../c/pairs.c from Fortran: 3 m²(m-1) + 6 m (m-1)² pairs.
program pairs
    use, intrinsic :: iso_c_binding
    use connectivity
    implicit none

    integer, parameter :: m = 10, n = m**3
    integer, parameter :: expected = 3*m*m*(m - 1) + 6*m*(m - 1)**2
    real(c_double) :: x(3, n), h(n)
    type(c_ptr) :: context = c_null_ptr, nodes = c_null_ptr, map = c_null_ptr
    type(conn_array) :: array
    integer(c_int32_t) :: slots(n), i
    integer(c_int64_t) :: count
    integer :: ends

    if (c_sizeof(array) /= conn_abi_sizeof(CONN_STRUCT_ARRAY)) error stop 'conn_array differs'
    do i = 0, n - 1
        x(:, i + 1) = [mod(i, m), mod(i/m, m), i/m/m]
    end do
    h = 0.75_c_double

    call check(conn_context_create(c_null_ptr, context))
    call check(conn_nodes_create(context, 'lattice', 3, 2.0_c_double, nodes))
    call check(conn_nodes_set_h(nodes, int(n, c_int64_t), [conn_matrix(x)], 1, conn_vector(h)))
    call check(conn_map_create(context, c_null_ptr, map))
    call check(conn_map_rebuild(map, [nodes], 1))

    ends = 0
    do i = 0, n - 1
        call check(conn_map_all_neighbours(map, i, i, slots, int(n, c_int64_t), count))
        ends = ends + int(count) - merge(1, 0, any(slots(:count) == i))
    end do
    print '(i0, 2a)', ends/2, ' pairs, version ', conn_version_string()

    call check(conn_map_destroy(map))
    call check(conn_nodes_destroy(nodes))
    call check(conn_context_destroy(context))
    if (ends /= 2*expected) error stop 'wrong number of pairs'

contains

    subroutine check(status)
        integer(c_int32_t), intent(in) :: status
        if (status == CONN_OK) return
        print '(3a)', conn_status_text(status), ': ', conn_last_error()
        error stop 1
    end subroutine check

end program pairs
