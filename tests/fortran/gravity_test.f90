! SPDX-License-Identifier: BSD-3-Clause
! Gravity: forces against the sum over all pairs, whatever form the arrays have.
module gravity_test
    use support
    implicit none

contains

    !> a(3, n) and the potential of n particles, by the definition.
    pure subroutine brute_gravity(x, m, e, a, p)
        real(c_double), intent(in) :: x(:, :), m(:), e
        real(c_double), intent(out) :: a(3, size(m)), p(size(m))
        real(c_double) :: d(3), r
        integer :: i, j
        a = 0
        p = 0
        do i = 1, size(m)
            do j = 1, size(m)
                if (i == j) cycle
                d = x(:, j) - x(:, i)
                r = sqrt(sum(d**2) + e**2)
                a(:, i) = a(:, i) + m(j)*d/r**3
                p(i) = p(i) - m(j)/r
            end do
        end do
    end subroutine brute_gravity

    subroutine make_particles(context, gravity, x, m)
        type(conn_context), intent(inout) :: context
        type(conn_gravity), intent(inout) :: gravity
        real(c_double), intent(out) :: x(3, n_cloud), m(n_cloud)
        real(c_double) :: h(n_cloud)
        call make_cloud(815, x, h)
        x = real(real(x, c_float), c_double) ! whole in single precision, too
        m = real(real(h, c_float), c_double)
        call expect_ok(conn_context_create(context), 'context')
        call expect_ok(conn_gravity_create(context, gravity), 'gravity')
    end subroutine make_particles

    logical function near(found, expected, tolerance)
        real(c_double), intent(in) :: found(:, :), expected(:, :), tolerance
        near = all(shape(found) == shape(expected))
        if (near) near = all(abs(found - expected) <= tolerance*maxval(abs(expected)))
    end function near

    subroutine every_form_of_the_particles_gives_the_forces_of_the_definition()
        type(conn_context) :: context
        type(conn_gravity) :: gravity
        type(conn_gravity_view) :: view
        real(c_double) :: x(3, n_cloud), m(n_cloud), a(3, n_cloud), p(n_cloud), planar(n_cloud, 3)
        real(c_double) :: b(3, n_cloud), q(2, n_cloud)
        real(c_double), pointer :: forces(:, :), potential(:), bound(:)
        real(c_float) :: xf(3, n_cloud), mf(n_cloud), bf(n_cloud, 3), qf(n_cloud)
        call make_particles(context, gravity, x, m)
        call brute_gravity(x, m, 0._c_double, a, p)
        planar = transpose(x)
        xf = real(x, c_float)
        mf = real(m, c_float)
        call expect_ok(conn_gravity_solve(gravity, x, m), 'x(3, n)')
        call expect_ok(conn_acquire(gravity, view), 'view')
        call conn_gravity_pointers(view, forces, potential, bound)
        call expect(lbound(forces, 2) == 0 .and. size(bound) == 0, 'extents')
        call expect(near(forces, a, 1e-12_c_double), 'x(3, n)')
        call expect(near(reshape(potential, [1, n_cloud]), reshape(p, [1, n_cloud]), &
                         1e-12_c_double), 'potential')

        call expect_ok(conn_gravity_solve(gravity, planar, m, planar=.true.), 'x(n, 3)')
        b = 0
        q = -7
        call expect_ok(conn_gravity_copy(gravity, b, q(1, :)), 'a(3, n)')
        call expect(near(b, a, 1e-12_c_double), 'a(3, n)')
        call expect(all(q(1, :) == potential) .and. all(q(2, :) == -7), 'a section keeps the rest')
        call expect_ok(conn_gravity_solve(gravity, x(1, :), x(2, :), x(3, :), m), 'x, y, z')
        planar = 0
        call expect_ok(conn_gravity_copy(gravity, planar, planar=.true.), 'a(n, 3)')
        call expect(near(transpose(planar), a, 1e-12_c_double), 'a(n, 3)')
        call expect_ok(conn_gravity_solve(gravity, xf, mf), 'single')
        call expect_ok(conn_gravity_copy(gravity, b(1, :), b(2, :), b(3, :)), 'ax, ay, az')
        call expect(near(b, a, 1e-12_c_double), 'forces of single precision are summed in double')
        call expect_ok(conn_gravity_copy(gravity, bf, qf, planar=.true.), 'single a(n, 3)')
        call expect(all(bf == real(transpose(b), c_float)), 'single a(n, 3)')
        call expect_ok(conn_gravity_solve(gravity, xf(1, :), xf(2, :), xf(3, :), mf), 'single x')
        bf = 0
        call expect_ok(conn_gravity_copy(gravity, bf(:, 1), bf(:, 2), bf(:, 3), qf), 'single ax')
        call expect(all(bf == real(transpose(b), c_float)), 'single ax, ay, az')
        call expect(near(forces, a, 1e-12_c_double), 'a view keeps its forces')
        call expect_ok(conn_release(view), 'release')
        call conn_gravity_pointers(view, forces)
        call expect(size(forces) == 0, 'a released view shows nothing')
        call expect_ok(conn_destroy(gravity), 'destroy')
        call expect_ok(conn_destroy(context), 'destroy')
    end subroutine every_form_of_the_particles_gives_the_forces_of_the_definition

    subroutine settings_and_results_of_gravity_are_those_of_c()
        type(conn_context) :: context
        type(conn_gravity) :: gravity
        type(conn_gravity_options) :: options
        type(conn_gravity_info) :: info
        real(c_double), target :: x(3, n_cloud), m(n_cloud), length, strength(n_cloud)
        real(c_double), target :: b(n_cloud)
        real(c_double) :: a(3, n_cloud), p(n_cloud), found(3, n_cloud)
        character(:), allocatable :: text
        call make_particles(context, gravity, x, m)
        length = 0.0625_c_double
        call expect_error(conn_gravity_get_info(gravity, info), CONN_E_NOT_BUILT, &
                          'conn_gravity_solve', 'results before a solution')
        options%method = CONN_GRAVITY_FMM
        options%tolerance = 1e-3_c_double
        options%constant = 2
        options%order = 8
        options%acceptance = CONN_ACCEPT_ACCELERATION
        options%error_bound = 1
        strength = 1
        options%previous_acceleration = c_loc(strength)
        options%n_previous = n_cloud
        call expect_ok(conn_gravity_solve(gravity, [conn_array_matrix(x)], conn_array_vector(m), &
            options, conn_array_repeated(length, int(n_cloud, c_int64_t))), 'softened')
        call brute_gravity(x, m, length, a, p)
        call expect_ok(conn_gravity_copy(gravity, found), 'copy')
        call expect(near(found, 2*a, 3e-3_c_double), 'softened forces')
        call expect_ok(conn_gravity_get_info(gravity, info), 'info')
        call expect(info%method == CONN_GRAVITY_FMM .and. info%order == 8 .and. info%n == n_cloud &
                    .and. info%acceptance == CONN_ACCEPT_ACCELERATION .and. info%dim == 3, 'info')
        call expect(info%acceleration_p99 <= 1e-3_c_double .and. info%reached == 1, 'tolerance')
        call expect_ok(conn_gravity_report_text(gravity, text), 'report')
        call expect(index(text, 'near') > 0, 'the report names the phases')
        call expect_ok(conn_gravity_copy(gravity, error_bound=conn_array_vector(b)), 'bounds')
        call expect(all(b >= 0), 'bounds')
        call expect_ok(conn_gravity_release_scratch(gravity), 'scratch')
        call expect_ok(conn_gravity_get_info(gravity, info), 'info')
        call expect(info%scratch_bytes == 0, 'scratch is given back')
        call expect_error(conn_gravity_copy(gravity, found(:, :5)), CONN_E_ARGUMENT, '5', &
                          'room for 5 particles')
        m(7) = ieee_nan()
        call expect_error(conn_gravity_solve(gravity, x, m), CONN_E_NONFINITE, 'particle 6', 'NaN')
        options%tolerance = 7
        call expect_error(conn_gravity_solve(gravity, x, m, options), CONN_E_ARGUMENT, '7', &
                          'a tolerance of 7')
        call expect_ok(conn_destroy(gravity), 'destroy')
        call expect_ok(conn_destroy(context), 'destroy')
    end subroutine settings_and_results_of_gravity_are_those_of_c

    real(c_double) function ieee_nan()
        use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
        ieee_nan = ieee_value(ieee_nan, ieee_quiet_nan)
    end function ieee_nan

end module gravity_test
