! SPDX-License-Identifier: BSD-3-Clause
! Nodes in, rebuild, loop over pairs, values of pairs summed at the nodes, move, rebuild, patch: the
! same digits as ../c/neighbours.c and ../python/neighbours.py. Nodes count from 1 here.
! gfortran neighbours.f90 $(pkg-config --cflags --libs connectivity-fortran)
program neighbours
    use, intrinsic :: iso_c_binding
    use connectivity
    implicit none
    integer, parameter :: side = 10, n = side**3, left = n - side**2
    real(c_double) :: x(3, n), h(n) = 0.75_c_double, density(n), push(3, n), d(3), q, t
    integer(c_int32_t) :: keep(n) = 1, old2new(n) = 1, a
    type(conn_context) :: context
    type(conn_nodes) :: gas
    type(conn_map) :: map
    type(conn_map_options) :: options
    type(conn_pair_field) :: force

    do a = 1, n ! a unit lattice; supports reach 2 h = 1.5
        x(:, a) = [mod(a - 1, side), mod((a - 1)/side, side), (a - 1)/side**2]
    end do
    options%index_base = 1
    call check(conn_context_create(context))
    call check(conn_nodes_create(context, 'gas', 3, 2.0_c_double, gas))
    call check(conn_map_create(context, map, options))
    call check(conn_set_h(gas, x, h))
    call check(conn_rebuild(map, gas))
    call check(conn_pair_field_create(map, 3, force))
    call interact()

    x(1, :) = 1.25_c_double*x(1, :) ! stretched along x, squeezed along y
    x(2, :) = 0.9_c_double*x(2, :)
    call check(conn_set_h(gas, x, h))
    call check(conn_rebuild(map, gas))
    call check(conn_pair_field_reset(force, map))
    call interact()

    keep(left + 1:) = 0 ! the last layer goes, the other nodes keep their numbers
    old2new(:left) = [(a, a = 1, left)]
    call check(conn_map_patch(map, keep, old2new, [force]))
    call report('patched')
    call check(conn_destroy(force))
    call check(conn_destroy(map))
    call check(conn_destroy(gas))
    call check(conn_destroy(context))

contains

    subroutine interact()
        type(conn_pairs_view) :: pairs
        integer(c_int32_t), pointer :: i(:), j(:)
        real(c_double), pointer :: f(:, :)
        integer :: k
        call check(conn_acquire(map, pairs, expand=.true.))
        call check(conn_pair_field_data(force, map, f))
        call conn_pairs_pointers(pairs, i, j)
        density = 1 ! a node sees itself; Wendland C2 over its value at distance 0
        do k = 0, size(j) - 1 ! each pair once
            d = x(:, i(k)) - x(:, j(k))
            q = sqrt(d(1)*d(1) + d(2)*d(2) + d(3)*d(3))/1.5_c_double
            t = (1 - q)*(1 - q)
            density(i(k)) = density(i(k)) + t*t*(1 + 4*q)
            density(j(k)) = density(j(k)) + t*t*(1 + 4*q)
            f(:, k) = t*d
        end do
        call check(conn_release(pairs))
        print '(a, 2es24.16)', 'density', density(1), density(n/2)
        call report('rebuilt')
    end subroutine interact

    subroutine report(what)
        character(*), intent(in) :: what
        type(conn_map_info) :: info
        call check(conn_map_get_info(map, info))
        call check(conn_pair_field_sum(force, map, CONN_ANTISYMMETRIC, CONN_SUM_DETERMINISTIC, push))
        print '(2a, i0, a, 3es24.16)', what, ': ', info%n_pairs, ' pairs, force', push(:, left)
    end subroutine report

    subroutine check(status)
        integer(c_int32_t), intent(in) :: status
        if (status == CONN_OK) return
        print '(a)', conn_error_text(status)
        error stop 1
    end subroutine check

end program neighbours
