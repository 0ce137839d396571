! SPDX-License-Identifier: BSD-3-Clause
! Nodes in, rebuild, loop over pairs, sums of pair values at nodes, move, rebuild, patch: the same
! digits as ../c/neighbours.c and ../python/neighbours.py. Nodes count from 1 here. Built by
!
!     gfortran neighbours.f90 $(pkg-config --cflags --libs connectivity-fortran)
program neighbours
    use, intrinsic :: iso_c_binding
    use connectivity
    implicit none
    integer, parameter :: side = 10, n = side**3, left = n - side**2
    real(c_double) :: x(3, n), h(n) = 0.75_c_double, density(n), push(3, n), d(3), q, t
    real(c_double), pointer :: force(:, :)
    integer(c_int32_t), pointer :: i(:), j(:)
    integer(c_int32_t) :: old2new(n), a, k
    integer(c_int64_t) :: n_pairs
    type(conn_context) :: context
    type(conn_nodes) :: gas
    type(conn_map) :: map
    type(conn_map_options) :: options
    type(conn_pairs_view) :: pairs
    type(conn_pair_field) :: field

    ! A unit lattice; supports reach 2 h = 1.5.
    x = reshape([(mod(a, side), mod(a/side, side), a/side**2, a = 0, n - 1)], [3, n])
    options%index_base = 1
    call check(conn_context_create(context))
    call check(conn_nodes_create(context, 'gas', 3, 2.0_c_double, gas))
    call check(conn_map_create(context, map, options))
    call step()

    ! Stretched along x, squeezed along y.
    x = x*spread([1.25_c_double, 0.9_c_double, 1._c_double], 2, n)
    call step()

    old2new = [(a, a = 1, n)] ! the last layer goes, the other nodes keep their numbers
    call check(conn_map_patch(map, merge(1, 0, old2new <= left), old2new, [field]))
    call check(conn_map_pairs_copy(map, n_pairs))
    call check(conn_pair_field_sum(field, map, CONN_ANTISYMMETRIC, CONN_SUM_DETERMINISTIC, push))
    print '(a, i0, a/a, 3es24.16)', 'patched: ', n_pairs, ' pairs', 'force', push(:, left)
    call check(conn_destroy(field))
    call check(conn_destroy(map))
    call check(conn_destroy(gas))
    call check(conn_destroy(context))

contains

    subroutine step()
        call check(conn_set_h(gas, x, h))
        call check(conn_rebuild(map, gas))
        call check(conn_destroy(field))
        call check(conn_pair_field_create(map, 3, field))
        call check(conn_pair_field_data(field, map, force))
        call check(conn_acquire(map, pairs, expand=.true.))
        call conn_pairs_pointers(pairs, i, j)
        density = 1 ! a node sees itself; Wendland C2 over its value at distance 0
        do k = 0, size(j) - 1 ! each pair once
            d = x(:, i(k)) - x(:, j(k))
            q = sqrt(d(1)*d(1) + d(2)*d(2) + d(3)*d(3))/1.5_c_double
            t = (1 - q)*(1 - q)
            density(i(k)) = density(i(k)) + t*t*(1 + 4*q)
            density(j(k)) = density(j(k)) + t*t*(1 + 4*q)
            force(:, k) = t*d
        end do
        call check(conn_pair_field_sum(field, map, CONN_ANTISYMMETRIC, &
                                       CONN_SUM_DETERMINISTIC, push))
        print '(a, i0, a/a, 2es24.16/a, 3es24.16)', 'rebuilt: ', pairs%n_pairs, ' pairs', &
            'density', density(1), density(n/2), 'force', push(:, left)
        call check(conn_release(pairs))
    end subroutine step

    subroutine check(status)
        integer(c_int32_t), intent(in) :: status
        if (status /= CONN_OK) print '(a)', conn_error_text(status)
        if (status /= CONN_OK) error stop 1
    end subroutine check

end program neighbours
