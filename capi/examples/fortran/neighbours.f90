! SPDX-License-Identifier: BSD-3-Clause
! Nodes in, rebuild, loop over pairs, sums of pair values at nodes, move, rebuild, patch: the same
! digits as ../c/neighbours.c and ../python/neighbours.py. Nodes count from 1 here. Built by
!     gfortran neighbours.f90 $(pkg-config --cflags --libs connectivity-fortran)
program neighbours
    use, intrinsic :: iso_c_binding
    use connectivity
    implicit none
    integer, parameter :: side = 10, n = side**3, left = n - side**2
    real(c_double) :: x(3, n), h(n) = 0.75_c_double, density(n), d(3)
    real(c_double), pointer :: weight(:, :)
    integer(c_int32_t), pointer :: i(:), j(:)
    integer(c_int32_t) :: old2new(n), a, k
    type(conn_context) :: context
    type(conn_nodes) :: gas
    type(conn_map) :: map
    type(conn_map_options) :: options
    type(conn_pairs_view) :: pairs
    type(conn_pair_field) :: weights
    ! A unit lattice; supports reach 2 h = 1.5.
    x = reshape([(mod(a, side), mod(a/side, side), a/side**2, a = 0, n - 1)], [3, n])
    old2new = [(a, a = 1, n)]
    options%index_base = 1
    call check(conn_context_create(context))
    call check(conn_nodes_create(context, 'gas', 3, 2.0_c_double, gas))
    call check(conn_map_create(context, map, options))
    call step()
    x = x*spread([1.25_c_double, 0.9_c_double, 1._c_double], 2, n) ! stretched and squeezed
    call step()
    call check(conn_map_patch(map, merge(1, 0, old2new <= left), old2new, [weights]))
    call show('patched') ! without the last layer
contains
    subroutine step()
        call check(conn_set_h(gas, x, h))
        call check(conn_rebuild(map, gas))
        call check(conn_destroy(weights))
        call check(conn_pair_field_create(map, 1, weights))
        call check(conn_pair_field_data(weights, map, weight))
        call check(conn_acquire(map, pairs, expand=.true.))
        call conn_pairs_pointers(pairs, i, j)
        do k = 0, size(j) - 1 ! each pair once
            d = x(:, i(k)) - x(:, j(k))
            weight(1, k) = 1 - (d(1)*d(1) + d(2)*d(2) + d(3)*d(3))/2.25_c_double
        end do
        call check(conn_release(pairs))
        call show('rebuilt')
    end subroutine step
    subroutine show(what)
        character(*), intent(in) :: what
        call check(conn_pair_field_data(weights, map, weight))
        call check(conn_pair_field_sum(weights, map, CONN_SYMMETRIC, &
                                       CONN_SUM_DETERMINISTIC, density))
        print '(2a, i0, a/2es24.16)', what, ': ', size(weight), ' pairs', density([1, left])
    end subroutine show
    subroutine check(status)
        integer(c_int32_t), intent(in) :: status
        if (status /= CONN_OK) print '(a)', conn_error_text(status)
        if (status /= CONN_OK) error stop 1
    end subroutine check
end program neighbours
