// SPDX-License-Identifier: BSD-3-Clause
// Handles, arguments and structs of gravity: what is dead, foreign, NULL or out of range is an
// error that names it, and the forces stay; older and newer hosts are served.

#include <cstring>
#include <functional>
#include <limits>
#include <string>

#include "gravity_support.hpp"

namespace connectivity::test {
namespace {

class CapiGravityHandles : public ::testing::Test {
protected:
    CapiGravityHandles() {
        for (std::size_t i = 0; i < n; ++i)
            for (const double x : {scene.x[i], scene.y[i], scene.z[i]}) places.push_back(x);
        EXPECT_TRUE(ok(gravity.solve(scene)));
        before = Forces(gravity).acceleration();
        generation = gravity.info().generation;
    }
    ~CapiGravityHandles() override {
        EXPECT_EQ(gravity.info().generation, generation);
        EXPECT_EQ(Forces(gravity).acceleration(), before);
    }

    struct Call {
        conn_array x, m, e;
        std::int32_t n_positions = 1;
        conn_gravity_options options = CONN_GRAVITY_OPTIONS_INIT;
    };
    /// A call that works, once it is spoilt.
    template <class Spoil>
    conn_status refused(const Spoil& spoil) {
        Call call{conn_array_matrix(places.data(), n, 3), conn_array_vector(scene.m.data(), n),
                  conn_array_vector(lengths.data(), n)};
        spoil(call);
        return conn_gravity_solve(gravity.handle, &call.x, call.n_positions, &call.m, &call.e,
                                  &call.options);
    }

    static constexpr std::int64_t n = 50;
    Context context;
    GravityScene scene = plummer_scene(n);
    std::vector<double> places, lengths = std::vector<double>(n, 0.01);
    GravityHandle gravity{context};
    std::vector<double> before;
    std::uint64_t generation = 0;
};

/// Every function that takes gravity.
template <class Expect>
void with_gravity(conn_gravity* g, const Expect& expect) {
    conn_gravity_view view = CONN_GRAVITY_VIEW_INIT;
    conn_gravity_info info = CONN_GRAVITY_INFO_INIT;
    const conn_array x = conn_array_matrix(nullptr, 0, 3), m = conn_array_vector(nullptr, 0);
    std::int64_t length = 0;
    expect(conn_gravity_solve(g, &x, 1, &m, nullptr, nullptr));
    expect(conn_gravity_report_text(g, nullptr, 0, &length));
    expect(conn_gravity_release_scratch(g));
    expect(conn_gravity_get_info(g, &info));
    expect(conn_gravity_acquire(g, CONN_SPACE_HOST, &view));
    expect(conn_gravity_copy(g, nullptr, 0, nullptr, nullptr));
}

TEST_F(CapiGravityHandles, dead_foreign_and_null_handles_are_errors_in_every_function) {
    conn_gravity* dead = nullptr;
    ASSERT_TRUE(ok(conn_gravity_create(context.handle, &dead)));
    conn_gravity* copy = dead;
    ASSERT_TRUE(ok(conn_gravity_destroy(&copy)));
    EXPECT_EQ(copy, nullptr);
    ASSERT_TRUE(ok(conn_gravity_destroy(&copy)));
    ASSERT_TRUE(ok(conn_gravity_destroy(nullptr)));
    with_gravity(dead, [](conn_status s) { EXPECT_TRUE(fails(s, CONN_E_HANDLE, {"gravity"})); });
    with_gravity(nullptr, [](conn_status s) { EXPECT_TRUE(fails(s, CONN_E_NULL, {"gravity"})); });
    with_gravity(reinterpret_cast<conn_gravity*>(context.handle),
                 [](conn_status s) { EXPECT_TRUE(fails(s, CONN_E_HANDLE, {"a context"})); });
    EXPECT_TRUE(fails(conn_gravity_destroy(&dead), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_gravity_create(nullptr, &copy), CONN_E_NULL, {"context"}));
    EXPECT_TRUE(fails(conn_gravity_create(context.handle, nullptr), CONN_E_NULL, {"gravity"}));
}

TEST_F(CapiGravityHandles, there_are_no_results_before_the_first_solution) {
    const GravityHandle empty(context);
    conn_gravity_view view = CONN_GRAVITY_VIEW_INIT;
    conn_gravity_info info = CONN_GRAVITY_INFO_INIT;
    std::int64_t length = -1;
    for (const conn_status status : {conn_gravity_acquire(empty.handle, CONN_SPACE_HOST, &view),
                                     conn_gravity_get_info(empty.handle, &info),
                                     conn_gravity_copy(empty.handle, nullptr, 0, nullptr, nullptr)})
        EXPECT_EQ(status, CONN_E_NOT_BUILT);
    EXPECT_TRUE(fails(conn_gravity_get_info(empty.handle, &info), CONN_E_NOT_BUILT,
                      {"conn_gravity_solve"}));
    EXPECT_TRUE(ok(conn_gravity_release_scratch(empty.handle)));
    EXPECT_TRUE(ok(conn_gravity_report_text(empty.handle, nullptr, 0, &length)));
    EXPECT_GE(length, 0);
}

TEST_F(CapiGravityHandles, bad_options_are_named_and_the_forces_stay) {
    using O = conn_gravity_options;
    const auto bad = [&](auto spoil, const char* word, conn_status status = CONN_E_ARGUMENT) {
        EXPECT_TRUE(fails(refused([&](Call& c) { spoil(c.options); }), status, {word}));
    };
    const double nan = std::nan(""), negative[50] = {1, -2};
    bad([](O& o) { o.method = 4; }, "options->method = 4, must be in [0, 3]");
    bad([](O& o) { o.method = -1; }, "options->method = -1");
    bad([](O& o) { o.acceptance = 4; }, "options->acceptance = 4, must be in [1, 3]");
    bad([](O& o) { o.near_precision = 3; }, "options->near_precision = 3");
    bad([](O& o) { o.softening = 2; }, "options->softening = 2");
    bad([](O& o) { o.symmetric = 2; }, "options->symmetric = 2");
    bad([](O& o) { o.error_bound = -1; }, "options->error_bound = -1");
    bad([](O& o) { o.periodic[2] = 7; }, "options->periodic[2] = 7");
    bad([](O& o) { o.tolerance = 0; }, "tolerance is 0");
    bad([](O& o) { o.tolerance = 0.75; }, "tolerance is 0.75");
    bad([&](O& o) { o.tolerance = nan; }, "tolerance is nan");
    bad([](O& o) { o.order = 0; }, "order is 0");
    bad([](O& o) { o.order = 21; }, "order is 21");
    bad([](O& o) { o.leaf = 0; }, "leaf is 0");
    bad([](O& o) { o.order = 3, o.epsilon = 0; }, "epsilon is 0");
    bad([&](O& o) { o.order = 3, o.epsilon = nan; }, "epsilon is nan");
    bad([](O& o) { o.order = 3, o.epsilon = 2, o.acceptance = CONN_ACCEPT_GEOMETRIC; }, "epsilon");
    bad([](O& o) { o.epsilon = 0.5; }, "without order");
    bad([](O& o) { o.n_samples = -1; }, "n_samples is -1");
    bad([](O& o) { o.constant = 0; }, "constant is 0");
    bad([](O& o) { o.symmetric = 1, o.method = CONN_GRAVITY_WALK; }, "symmetric");
    bad([](O& o) { o.budget_bytes = -3; }, "budget_bytes = -3");
    bad([](O& o) { o.n_previous = 5; }, "previous_acceleration", CONN_E_NULL);
    bad([&](O& o) { o.n_previous = -5, o.previous_acceleration = negative; }, "n_previous = -5");
    bad([&](O& o) { o.n_previous = 5, o.previous_acceleration = negative; }, "must be 50");
    bad([&](O& o) { o.n_previous = 50, o.previous_acceleration = negative; },
        "previous_acceleration[1] = -2");
    bad([](O& o) { o.periodic[0] = 1, o.box_hi[0] = 1; }, "periodic", CONN_E_UNSUPPORTED);
    bad([](O& o) { o.periodic[0] = o.periodic[1] = o.periodic[2] = 1; }, "", CONN_E_BOX);
}

TEST_F(CapiGravityHandles, bad_particles_are_named_and_the_forces_stay) {
    const auto bad = [&](auto spoil, const char* word, conn_status status = CONN_E_ARGUMENT) {
        EXPECT_TRUE(fails(refused(spoil), status, {word}));
    };
    const float single[] = {1};
    bad([](Call& c) { c.n_positions = 0; }, "n_positions = 0, must be 1, 2 or 3");
    bad([](Call& c) { c.n_positions = 4; }, "n_positions = 4");
    bad([](Call& c) { c.x.extent[1] = 4; }, "positions.extent[1] = 4, must be 1, 2 or 3");
    bad([](Call& c) { c.x.extent[0] = -1; }, "positions.extent[0] = -1");
    bad([](Call& c) { c.x.extent[0] = 49; }, "masses.extent[0] = 50, must be 49 as in positions");
    bad([](Call& c) { c.e.extent[0] = 51; }, "softening.extent[0] = 51, must be 50");
    bad([&](Call& c) { c.m = conn_array_vector_float(single, 1); }, "masses.dtype = 1");
    bad([](Call& c) { c.x.dtype = CONN_INT32; }, "positions.dtype");
    bad([](Call& c) { c.x.ndim = 3; }, "positions.ndim = 3");
    bad([](Call& c) { c.m.ndim = 2, c.m.extent[1] = 2; }, "masses.extent[1] = 2");
    bad([](Call& c) { c.x.data = nullptr; }, "positions.data", CONN_E_NULL);
    bad([](Call& c) { c.m.data = nullptr; }, "masses.data", CONN_E_NULL);
    bad([](Call& c) { c.x.space = CONN_SPACE_DEVICE; }, "positions.space", CONN_E_UNSUPPORTED);
    bad([](Call& c) { c.x.extent[0] = std::int64_t{1} << 31; }, "positions", CONN_E_TOO_MANY);
    lengths[7] = -1;
    bad([](Call&) {}, "particle 7: softening = -1");
    lengths[7] = 0;
    places[3 * 9 + 2] = std::numeric_limits<double>::infinity();
    bad([](Call&) {}, "particle 9: position[2] = inf", CONN_E_NONFINITE);
    places[3 * 9 + 2] = 0;
    scene.m[4] = std::nan("");
    bad([](Call&) {}, "particle 4: mass = nan", CONN_E_NONFINITE);
    const conn_array x = conn_array_matrix(places.data(), n, 3),
                     m = conn_array_vector(places.data(), n);
    EXPECT_TRUE(fails(conn_gravity_solve(gravity.handle, nullptr, 1, &m, nullptr, nullptr),
                      CONN_E_NULL, {"positions"}));
    EXPECT_TRUE(fails(conn_gravity_solve(gravity.handle, &x, 1, nullptr, nullptr, nullptr),
                      CONN_E_NULL, {"masses"}));
}

TEST_F(CapiGravityHandles, forces_beyond_the_range_of_numbers_are_errors) {
    const double x[] = {0, 0, 0, 1e-150, 0, 0}, m[] = {1e150, 1e150};
    const conn_array places_of_two = conn_array_matrix(x, 2, 3), masses = conn_array_vector(m, 2);
    EXPECT_TRUE(
        fails(conn_gravity_solve(gravity.handle, &places_of_two, 1, &masses, nullptr, nullptr),
              CONN_E_NONFINITE));
    const GravityHandle large(context);
    const double far[] = {0, 0, 0, 1e-20, 0, 0}, one[] = {1, 1};
    const conn_array two = conn_array_matrix(far, 2, 3), ones = conn_array_vector(one, 2);
    ASSERT_TRUE(ok(conn_gravity_solve(large.handle, &two, 1, &ones, nullptr, nullptr)));
    float a[6] = {7, 7, 7, 7, 7, 7}, p[2] = {7, 7};
    const conn_array out = conn_array_matrix_float(a, 2, 3), out_p = conn_array_vector_float(p, 2);
    EXPECT_TRUE(fails(conn_gravity_copy(large.handle, &out, 1, &out_p, nullptr), CONN_E_NONFINITE,
                      {"acceleration of particle 0", "e+39"}));
    EXPECT_EQ(a[0], 7);
    EXPECT_EQ(p[1], 7) << "nothing is written on an error";
}

TEST_F(CapiGravityHandles, arrays_that_cannot_take_the_forces_are_named) {
    std::vector<double> out(200, 7);
    const conn_array good = conn_array_matrix(out.data(), n, 3),
                     column = conn_array_vector(out.data(), n);
    const auto bad = [&](auto spoil, const char* word, conn_status status = CONN_E_ARGUMENT) {
        conn_array a = good, p = column;
        std::int32_t n_arrays = 1;
        spoil(a, p, n_arrays);
        EXPECT_TRUE(
            fails(conn_gravity_copy(gravity.handle, &a, n_arrays, &p, nullptr), status, {word}));
    };
    using A = conn_array;
    bad([](A& a, A&, int&) { a.extent[0] = 49; }, "acceleration.extent[0] = 49, must be 50");
    bad([](A&, A& p, int&) { p.extent[0] = 51; }, "potential.extent[0] = 51, must be 50");
    bad([](A& a, A&, int&) { a.extent[1] = 2; }, "acceleration.extent[1] = 2");
    bad([](A&, A&, int& k) { k = 2; }, "n_acceleration = 2");
    bad([](A& a, A&, int&) { a.stride[0] = 2; }, "acceleration.stride");
    bad([](A&, A& p, int&) { p.stride[0] = 0; }, "potential.stride");
    bad([](A& a, A&, int&) { a.dtype = CONN_INT64; }, "acceleration.dtype");
    bad([](A& a, A&, int&) { a.data = nullptr; }, "acceleration.data", CONN_E_NULL);
    bad([](A&, A& p, int&) { p.data = reinterpret_cast<const char*>(p.data) + 4; }, "potential");
    EXPECT_TRUE(fails(conn_gravity_copy(gravity.handle, nullptr, 0, nullptr, &column),
                      CONN_E_NOT_BUILT, {"error_bound"}));
    EXPECT_EQ(out, std::vector<double>(200, 7)) << "nothing is written on an error";
    conn_gravity_view view = CONN_GRAVITY_VIEW_INIT;
    EXPECT_TRUE(
        fails(conn_gravity_acquire(gravity.handle, CONN_SPACE_DEVICE, &view), CONN_E_UNSUPPORTED));
    EXPECT_TRUE(fails(conn_gravity_acquire(gravity.handle, 9, &view), CONN_E_ARGUMENT, {"9"}));
    EXPECT_TRUE(fails(conn_gravity_acquire(gravity.handle, 0, nullptr), CONN_E_NULL, {"view"}));
    EXPECT_TRUE(fails(conn_gravity_get_info(gravity.handle, nullptr), CONN_E_NULL, {"info"}));
}

TEST_F(CapiGravityHandles, the_report_names_what_was_done) {
    std::int64_t length = 0;
    ASSERT_TRUE(ok(conn_gravity_report_text(gravity.handle, nullptr, 0, &length)));
    std::string text(static_cast<std::size_t>(length), ' ');
    EXPECT_TRUE(fails(conn_gravity_report_text(gravity.handle, text.data(), length, &length),
                      CONN_E_BUFFER));
    ASSERT_TRUE(ok(conn_gravity_report_text(gravity.handle, text.data(), length + 1, &length)));
    EXPECT_NE(text.find("direct"), std::string::npos) << text;
}

/// The host's struct in more memory than any version of it: sizes it cannot have are errors, a
/// longer one is served if what this library does not know is 0.
template <class T>
void expect_sizes(const T& init, const std::function<conn_status(T*)>& call) {
    struct {
        T value;
        unsigned char more[64];
    } host;
    const auto with = [&](std::size_t size, unsigned char last) {
        std::memset(&host, 0, sizeof host);
        std::memcpy(&host.value, &init, sizeof init);
        std::memcpy(&host.value, &size, sizeof size);
        host.more[63] = last;
        return call(&host.value);
    };
    EXPECT_TRUE(ok(with(sizeof(T), 1)));
    EXPECT_TRUE(ok(with(sizeof(T) + 64, 0)));
    EXPECT_TRUE(fails(with(sizeof(T) + 64, 1), CONN_E_UNSUPPORTED, {"byte"}));
    for (const std::size_t size : {std::size_t{0}, sizeof(T) - 1, std::size_t{4097}})
        EXPECT_TRUE(fails(with(size, 0), CONN_E_STRUCT_SIZE, {std::to_string(size)}));
}

TEST_F(CapiGravityHandles, structs_in_sizes_that_no_host_can_have_are_refused) {
    const GravityHandle other(context);
    const conn_array x = conn_array_matrix(places.data(), n, 3),
                     m = conn_array_vector(scene.m.data(), n);
    expect_sizes<conn_gravity_options>(CONN_GRAVITY_OPTIONS_INIT, [&](auto* options) {
        return conn_gravity_solve(other.handle, &x, 1, &m, nullptr, options);
    });
    expect_sizes<conn_gravity_info>(CONN_GRAVITY_INFO_INIT, [&](auto* info) {
        return conn_gravity_get_info(other.handle, info);
    });
    expect_sizes<conn_gravity_view>(CONN_GRAVITY_VIEW_INIT, [&](auto* view) {
        const conn_status status = conn_gravity_acquire(other.handle, CONN_SPACE_HOST, view);
        return status == CONN_OK ? conn_gravity_release(view) : status;
    });
}

TEST_F(CapiGravityHandles, sizes_and_defaults_are_those_of_the_header) {
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_GRAVITY_OPTIONS), sizeof(conn_gravity_options));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_GRAVITY_INFO), sizeof(conn_gravity_info));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_GRAVITY_VIEW), sizeof(conn_gravity_view));
    conn_gravity_options options;
    const conn_gravity_options defaults = CONN_GRAVITY_OPTIONS_INIT;
    ASSERT_TRUE(ok(conn_gravity_options_init(&options, sizeof options)));
    EXPECT_EQ(std::memcmp(&options, &defaults, sizeof options), 0);
    EXPECT_TRUE(fails(conn_gravity_options_init(&options, 8), CONN_E_STRUCT_SIZE));
}

}  // namespace
}  // namespace connectivity::test
