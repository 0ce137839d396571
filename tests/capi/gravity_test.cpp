// SPDX-License-Identifier: BSD-3-Clause
// Gravity through the interface, against sums by the definition: every method, whatever form the
// host's arrays have, open and periodic; and what views keep.

#include <array>

#include <support/ewald_brute.hpp>

#include "gravity_support.hpp"

namespace connectivity::test {
namespace {

TEST(CapiGravity, forces_are_those_of_the_definition_within_the_tolerance) {
    const Context context;
    const GravityHandle gravity(context);
    const GravityScene scene = plummer_scene(1500);
    const std::vector<BruteSum> expected = brute_gravity(scene);
    for (const int method :
         {CONN_GRAVITY_AUTOMATIC, CONN_GRAVITY_DIRECT, CONN_GRAVITY_WALK, CONN_GRAVITY_FMM})
        for (const double tolerance : {1e-2, 1e-5}) {
            SCOPED_TRACE(method);
            ASSERT_TRUE(ok(gravity.solve(scene, gravity_method(method, tolerance))));
            const conn_gravity_info info = gravity.info();
            const Forces forces(gravity);
            const ForceErrors errors =
                errors_of(forces.acceleration(), forces.potential(), expected);
            EXPECT_LT(errors.p99, tolerance);
            EXPECT_LT(errors.acceleration, 100 * tolerance);
            EXPECT_LT(errors.potential, 10 * tolerance);
            EXPECT_EQ(info.n, 1500);
            EXPECT_EQ(forces->n, 1500);
            EXPECT_EQ(info.generation, forces->generation);
            EXPECT_EQ(info.reached, 1);
            EXPECT_EQ(info.dim, 3);
            EXPECT_EQ(forces->error_bound, nullptr);
            EXPECT_GT(info.n_near, 0);
            if (method != CONN_GRAVITY_AUTOMATIC) {
                EXPECT_EQ(info.method, method);
            }
            if (info.method == CONN_GRAVITY_DIRECT) {
                EXPECT_LT(errors.acceleration, 1e-13);
                continue;
            }
            EXPECT_EQ(info.acceptance, CONN_ACCEPT_FIELD);
            EXPECT_GT(info.epsilon, 0);
            EXPECT_GE(info.order, 1);
            EXPECT_GT(info.n_far, 0);
            EXPECT_EQ(info.n_samples, 300);
            EXPECT_LE(info.acceleration_p99, tolerance);
            EXPECT_GT(info.acceleration_p99, 0.1 * errors.p99);
            EXPECT_LT(info.acceleration_p99, 10 * errors.p99 + 1e-14);
            EXPECT_LE(info.acceleration_rms, info.acceleration_max);
            EXPECT_LE(info.field_max, 1.02 * errors.acceleration + 1e-15);
            EXPECT_LE(info.field_rms, info.field_max);
            EXPECT_LE(info.field_p99, info.field_max);
            EXPECT_LE(info.potential_max, 1.02 * errors.potential + 1e-15);
            EXPECT_LE(info.potential_rms, info.potential_max);
            EXPECT_LE(info.potential_p99, info.potential_max);
        }
}

TEST(CapiGravity, settings_by_hand_are_those_that_are_used) {
    const Context context;
    const GravityHandle gravity(context);
    const GravityScene scene = plummer_scene(1500);
    conn_gravity_options options = gravity_method(CONN_GRAVITY_FMM, 0.5);
    options.order = 7;
    options.epsilon = 0.015625;
    options.leaf = 11;
    options.near_precision = CONN_NEAR_FLOAT64;
    options.n_samples = 40;
    options.seed = 5;
    for (const int acceptance :
         {CONN_ACCEPT_FIELD, CONN_ACCEPT_ACCELERATION, CONN_ACCEPT_GEOMETRIC}) {
        options.acceptance = acceptance;
        if (acceptance == CONN_ACCEPT_GEOMETRIC) options.epsilon = 0.5;
        ASSERT_TRUE(ok(gravity.solve(scene, options)));
        const conn_gravity_info info = gravity.info();
        EXPECT_EQ(info.method, CONN_GRAVITY_FMM);
        EXPECT_EQ(info.order, 7);
        EXPECT_EQ(info.acceptance, acceptance);
        EXPECT_EQ(info.epsilon, options.epsilon);
        EXPECT_EQ(info.near_precision, CONN_NEAR_FLOAT64);
        EXPECT_EQ(info.n_samples, 40);
    }
    options.near_precision = CONN_NEAR_FLOAT32;
    ASSERT_TRUE(ok(gravity.solve(scene, options)));
    EXPECT_EQ(gravity.info().near_precision, CONN_NEAR_FLOAT32);
}

TEST(CapiGravity, accelerations_of_the_step_before_are_taken_from_the_host) {
    const Context context;
    const GravityHandle gravity(context);
    const GravityScene scene = plummer_scene(1500);
    conn_gravity_options options = gravity_method(CONN_GRAVITY_FMM, 1e-3);
    options.acceptance = CONN_ACCEPT_ACCELERATION;
    options.order = 4;
    options.epsilon = 1e-3;
    const std::vector<double> strong(1500, 1e3), weak(1500, 1e-3);
    std::int64_t n_far[2];
    for (int k = 0; k < 2; ++k) {
        options.previous_acceleration = (k == 0 ? strong : weak).data();
        options.n_previous = 1500;
        ASSERT_TRUE(ok(gravity.solve(scene, options)));
        n_far[k] = gravity.info().n_near;
    }
    EXPECT_LT(n_far[0], n_far[1]) << "errors that are small beside strong forces are accepted";
}

TEST(CapiGravity, the_constant_and_the_softening_are_those_of_the_host) {
    const Context context;
    const GravityHandle gravity(context);
    GravityScene scene = uniform_scene(300);
    for (std::size_t i = 0; i < 300; ++i) scene.e.push_back(0.02 + 1e-4 * static_cast<double>(i));
    conn_gravity_options options = gravity_method(CONN_GRAVITY_DIRECT);
    options.constant = 4.5;
    for (const bool is_plummer : {true, false}) {
        options.softening = is_plummer ? CONN_SOFTENING_PLUMMER : CONN_SOFTENING_SPH_EXA;
        ASSERT_TRUE(ok(gravity.solve(scene, options)));
        const Forces forces(gravity);
        std::vector<double> a = forces.acceleration(), p = forces.potential();
        for (double& value : a) value /= 4.5;
        for (double& value : p) value /= 4.5;
        const ForceErrors errors = errors_of(
            a, p, brute_gravity(scene, is_plummer ? BruteLaw::plummer : BruteLaw::sph_exa));
        EXPECT_LT(errors.acceleration, 1e-13);
        EXPECT_LT(errors.potential, 1e-13);
    }
}

/// The forces on the same 200 particles, given as the arrays say.
std::vector<double> forces_by(const GravityHandle& gravity, const std::vector<conn_array>& x,
                              const conn_array& m, const conn_array& e) {
    const conn_gravity_options options = gravity_method(CONN_GRAVITY_FMM, 1e-3);
    EXPECT_TRUE(ok(conn_gravity_solve(gravity.handle, x.data(), static_cast<std::int32_t>(x.size()),
                                      &m, &e, &options)));
    const Forces forces(gravity);
    std::vector<double> all = forces.acceleration();
    const std::vector<double> p = forces.potential();
    all.insert(all.end(), p.begin(), p.end());
    return all;
}

TEST(CapiGravity, every_form_of_the_arrays_gives_the_same_forces) {
    const Context context;
    const GravityHandle gravity(context);
    constexpr int n = 200;
    const GravityScene scene = plummer_scene(n);
    std::vector<float> x(n * 3), planar(n * 3), mass(n);
    std::vector<double> wide(n * 7), reversed(n * 3), m(n), backwards(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double position[] = {scene.x[i], scene.y[i], scene.z[i]};
        for (std::size_t d = 0; d < 3; ++d) {
            const double value = std::rint(1024 * position[d]) / 1024;  // whole in float32, too
            wide[7 * i + 2 * d] = reversed[3 * (n - 1 - i) + d] = value;
            x[3 * i + d] = planar[d * n + i] = static_cast<float>(value);
        }
        m[i] = backwards[n - 1 - i] = 1 + static_cast<double>(i % 3);
        mass[i] = static_cast<float>(m[i]);
    }
    const double length = 0.015625;
    const float same_length = 0.015625f;
    conn_array e = conn_array_vector(&length, n), f = conn_array_vector_float(&same_length, n),
               spread = conn_array_matrix(wide.data(), n, 3),
               down = conn_array_matrix(&reversed[3 * (n - 1)], n, 3),
               down_mass = conn_array_vector(&backwards[n - 1], n);
    e.stride[0] = f.stride[0] = 0;
    spread.stride[0] = 7, spread.stride[1] = 2;
    down.stride[0] = -3;
    down_mass.stride[0] = -1;
    const conn_array masses = conn_array_vector(m.data(), n),
                     small = conn_array_vector_float(mass.data(), n);
    const std::vector<double> expected = forces_by(gravity, {spread}, masses, e);
    EXPECT_EQ(forces_by(gravity, {down}, down_mass, e), expected);
    EXPECT_EQ(forces_by(gravity, {conn_array_matrix_float(x.data(), n, 3)}, small, f), expected);
    EXPECT_EQ(forces_by(gravity, {conn_array_planar_float(planar.data(), n, 3)}, small, f),
              expected);
    EXPECT_EQ(forces_by(gravity,
                        {conn_array_vector_float(planar.data(), n),
                         conn_array_vector_float(&planar[n], n),
                         conn_array_vector_float(&planar[2 * n], n)},
                        small, f),
              expected);
}

TEST(CapiGravity, missing_coordinates_are_0) {
    const Context context;
    const GravityHandle gravity(context);
    const GravityScene scene = uniform_scene(40);
    const conn_array m = conn_array_vector(scene.m.data(), 40);
    const conn_array axes[] = {conn_array_vector(scene.x.data(), 40),
                               conn_array_vector(scene.y.data(), 40)};
    for (const int dim : {1, 2}) {
        GravityScene flat = scene;
        std::fill(flat.z.begin(), flat.z.end(), 0.0);
        if (dim == 1) std::fill(flat.y.begin(), flat.y.end(), 0.0);
        ASSERT_TRUE(ok(conn_gravity_solve(gravity.handle, axes, dim, &m, nullptr, nullptr)));
        EXPECT_EQ(gravity.info().dim, dim);
        const Forces forces(gravity);
        const ForceErrors errors =
            errors_of(forces.acceleration(), forces.potential(), brute_gravity(flat));
        EXPECT_LT(errors.acceleration, 1e-13);
        std::vector<double> a(80, -1);
        const conn_array out = conn_array_matrix(a.data(), 40, dim);
        ASSERT_TRUE(ok(conn_gravity_copy(gravity.handle, &out, 1, nullptr, nullptr)));
        EXPECT_EQ(a[static_cast<std::size_t>(dim)], forces->acceleration[3]);
        EXPECT_EQ(a[static_cast<std::size_t>(2 * dim - 1)], forces->acceleration[2 + dim]);
    }
}

TEST(CapiGravity, copies_have_the_layout_of_the_host) {
    const Context context;
    const GravityHandle gravity(context);
    const GravityScene scene = plummer_scene(100);
    ASSERT_TRUE(ok(gravity.solve(scene)));
    const Forces forces(gravity);
    constexpr std::size_t n = 100;
    std::vector<double> x(3 * n), planar(3 * n), axis(n), p(3 * n, -7);
    std::vector<float> small(3 * n), small_p(n);
    const conn_array one = conn_array_matrix(x.data(), n, 3),
                     turned = conn_array_planar(planar.data(), n, 3),
                     floats = conn_array_matrix_float(small.data(), n, 3),
                     p_float = conn_array_vector_float(small_p.data(), n);
    conn_array every_third = conn_array_vector(p.data(), n);
    every_third.stride[0] = 3;
    ASSERT_TRUE(ok(conn_gravity_copy(gravity.handle, &one, 1, &every_third, nullptr)));
    ASSERT_TRUE(ok(conn_gravity_copy(gravity.handle, &turned, 1, nullptr, nullptr)));
    ASSERT_TRUE(ok(conn_gravity_copy(gravity.handle, &floats, 1, &p_float, nullptr)));
    const conn_array axes[] = {conn_array_vector(axis.data(), n), conn_array_vector(&x[0], n),
                               conn_array_vector(&x[n], n)};
    const std::vector<double> kept = x;
    ASSERT_TRUE(ok(conn_gravity_copy(gravity.handle, axes, 3, nullptr, nullptr)));
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t d = 0; d < 3; ++d) {
            const double a = forces->acceleration[3 * i + d];
            ASSERT_EQ(kept[3 * i + d], a);
            ASSERT_EQ(planar[d * n + i], a);
            ASSERT_EQ(small[3 * i + d], static_cast<float>(a));
            ASSERT_EQ(d == 0 ? axis[i] : x[(d - 1) * n + i], a);
        }
        ASSERT_EQ(p[3 * i], forces->potential[i]);
        ASSERT_EQ(p[3 * i + 1], -7);
        ASSERT_EQ(small_p[i], static_cast<float>(forces->potential[i]));
    }
}

TEST(CapiGravity, views_keep_their_forces_through_solutions_and_the_end_of_the_object) {
    const Context context;
    conn_gravity_view view = CONN_GRAVITY_VIEW_INIT;
    const GravityScene scene = plummer_scene(120);
    const std::vector<BruteSum> expected = brute_gravity(scene);
    {
        const GravityHandle gravity(context);
        ASSERT_TRUE(ok(gravity.solve(scene)));
        ASSERT_TRUE(ok(conn_gravity_acquire(gravity.handle, CONN_SPACE_HOST, &view)));
        EXPECT_TRUE(fails(conn_gravity_acquire(gravity.handle, CONN_SPACE_HOST, &view),
                          CONN_E_ARGUMENT, {"view"}));
        for (std::uint64_t seed = 2; seed < 5; ++seed)
            ASSERT_TRUE(ok(gravity.solve(plummer_scene(120, seed))));
        EXPECT_NE(gravity.info().generation, view.generation);
        ASSERT_TRUE(ok(conn_gravity_release_scratch(gravity.handle)));
        EXPECT_EQ(gravity.info().scratch_bytes, 0);
    }
    const ForceErrors errors = errors_of({view.acceleration, view.acceleration + 360},
                                         {view.potential, view.potential + 120}, expected);
    EXPECT_LT(errors.acceleration, 1e-13);
    ASSERT_TRUE(ok(conn_gravity_release(&view)));
    EXPECT_EQ(view.acceleration, nullptr);
    EXPECT_EQ(view.owner, nullptr);
    ASSERT_TRUE(ok(conn_gravity_release(&view)));
}

TEST(CapiGravity, a_periodic_box_has_the_forces_of_ewald) {
    const Context context;
    const GravityHandle gravity(context);
    constexpr std::size_t n = 60;
    const std::array<double, 3> lengths{1, 1.25, 0.75}, lo{-0.5, 2, 0.125};
    const GravityScene scene = uniform_scene(n);
    std::vector<double> x(3 * n);
    for (std::size_t i = 0; i < n; ++i) {
        const double unit[] = {scene.x[i], scene.y[i], scene.z[i]};
        for (std::size_t d = 0; d < 3; ++d) x[3 * i + d] = lo[d] + lengths[d] * unit[d];
    }
    const EwaldSums expected = ewald_brute(lengths, x, scene.m, x);
    double most_a = 0, most_p = 0;
    for (const double a : expected.a) most_a = std::max(most_a, std::abs(a));
    for (const double p : expected.p) most_p = std::max(most_p, std::abs(p));
    for (const int method : {CONN_GRAVITY_DIRECT, CONN_GRAVITY_FMM}) {
        conn_gravity_options options = gravity_method(method, 1e-6);
        for (std::size_t d = 0; d < 3; ++d) {
            options.periodic[d] = 1;
            options.box_lo[d] = lo[d];
            options.box_hi[d] = lo[d] + lengths[d];
        }
        x[0] += 3 * lengths[0];  // particles may lie outside
        const conn_array positions = conn_array_matrix(x.data(), n, 3),
                         masses = conn_array_vector(scene.m.data(), n);
        ASSERT_TRUE(
            ok(conn_gravity_solve(gravity.handle, &positions, 1, &masses, nullptr, &options)));
        const Forces forces(gravity);
        for (std::size_t k = 0; k < 3 * n; ++k)
            EXPECT_NEAR(forces->acceleration[k], expected.a[k], 2e-6 * most_a);
        for (std::size_t i = 0; i < n; ++i)
            EXPECT_NEAR(forces->potential[i], -expected.p[i], 2e-6 * most_p);
    }
}

TEST(CapiGravity, bounds_of_errors_are_there_only_if_they_were_asked_for) {
    const Context context;
    const GravityHandle gravity(context);
    const GravityScene scene = plummer_scene(1500);
    conn_gravity_options options = gravity_method(CONN_GRAVITY_FMM, 1e-3);
    options.near_precision = CONN_NEAR_FLOAT64;
    std::vector<double> bound(1500, -1);
    const conn_array out = conn_array_vector(bound.data(), 1500);
    ASSERT_TRUE(ok(gravity.solve(scene, options)));
    EXPECT_TRUE(fails(conn_gravity_copy(gravity.handle, nullptr, 0, nullptr, &out),
                      CONN_E_NOT_BUILT, {"error_bound"}));
    options.error_bound = 1;
    ASSERT_TRUE(ok(gravity.solve(scene, options)));
    ASSERT_TRUE(ok(conn_gravity_copy(gravity.handle, nullptr, 0, nullptr, &out)));
    const std::vector<BruteSum> expected = brute_gravity(scene);
    const Forces forces(gravity);
    ASSERT_NE(forces->error_bound, nullptr);
    for (std::size_t i = 0; i < 1500; ++i) {
        const double* const a = forces->acceleration + 3 * i;
        EXPECT_EQ(bound[i], forces->error_bound[i]);
        EXPECT_LE(distance(expected[i], a[0], a[1], a[2]), bound[i] + 1e-13 * expected[i].size_a);
    }
}

TEST(CapiGravity, no_particles_have_no_forces) {
    const Context context;
    const GravityHandle gravity(context);
    ASSERT_TRUE(ok(gravity.solve({})));
    EXPECT_EQ(gravity.info().n, 0);
    const Forces forces(gravity);
    EXPECT_EQ(forces->n, 0);
    const conn_array a = conn_array_matrix(nullptr, 0, 3), p = conn_array_vector(nullptr, 0);
    EXPECT_TRUE(ok(conn_gravity_copy(gravity.handle, &a, 1, &p, nullptr)));
}

}  // namespace
}  // namespace connectivity::test
