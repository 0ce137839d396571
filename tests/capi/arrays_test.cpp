// SPDX-License-Identifier: BSD-3-Clause
// Every way a host may lay out its arrays gives the lists of the same values.

#include <memory>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

constexpr int n = 400;

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

/// An argument in some layout, with the memory it points to.
struct Argument {
    std::vector<double> doubles;
    std::vector<float> floats;
    std::vector<conn_array> arrays;
};

/// Values [n][components] in memory where component c of node i is at origin + i*s0 + c*s1.
Argument strided(const std::vector<double>& values, int components, std::int64_t s0,
                 std::int64_t s1, std::size_t size, std::int64_t origin = 0) {
    Argument a;
    a.doubles.assign(size, -1e300);
    for (int i = 0; i < n; ++i)
        for (int c = 0; c < components; ++c)
            a.doubles[at(origin + i * s0 + c * s1)] = values[at(i * components + c)];
    conn_array array = conn_array_matrix(a.doubles.data() + origin, n, components);
    array.stride[0] = s0;
    array.stride[1] = s1;
    a.arrays = {array};
    return a;
}

Argument interleaved(const std::vector<double>& v, int c) { return strided(v, c, c, 1, at(n * c)); }
Argument planar(const std::vector<double>& v, int c) { return strided(v, c, 1, n, at(n * c)); }
Argument padded(const std::vector<double>& v, int c) {
    return strided(v, c, 3 * c + 2, 2, at(n * (3 * c + 2)));
}
Argument backwards(const std::vector<double>& v, int c) {
    return strided(v, c, -c, 1, at(n * c), (n - 1) * c);
}
Argument mirrored(const std::vector<double>& v, int c) {
    return strided(v, c, c, -1, at(n * c), c - 1);
}
Argument separate(const std::vector<double>& v, int components) {
    Argument a = planar(v, components);
    a.arrays.clear();
    for (int c = 0; c < components; ++c)
        a.arrays.push_back(conn_array_vector(a.doubles.data() + c * n, n));
    return a;
}
Argument separate_floats(const std::vector<double>& v, int components) {
    Argument a;
    a.floats.resize(v.size());
    for (int i = 0; i < n; ++i)
        for (int c = 0; c < components; ++c)
            a.floats[at(c * n + i)] = static_cast<float>(v[at(i * components + c)]);
    for (int c = 0; c < components; ++c) {
        conn_array array = conn_array_vector(nullptr, n);
        array.data = a.floats.data() + c * n;
        array.dtype = CONN_FLOAT32;
        a.arrays.push_back(array);
    }
    return a;
}
Argument interleaved_floats(const std::vector<double>& v, int components) {
    Argument a;
    a.floats.assign(v.begin(), v.end());
    conn_array array = conn_array_matrix(nullptr, n, components);
    array.data = a.floats.data();
    array.dtype = CONN_FLOAT32;
    a.arrays = {array};
    return a;
}

Argument planar_floats(const std::vector<double>& v, int components) {
    Argument a = separate_floats(v, components);
    a.arrays = {conn_array_planar_float(a.floats.data(), n, components)};
    return a;
}

using Layout = Argument (*)(const std::vector<double>&, int);
constexpr Layout all_layouts[] = {interleaved,     planar,        padded,
                                  backwards,       mirrored,      separate,
                                  separate_floats, planar_floats, interleaved_floats};

/// Values that float holds exactly.
void round_to_float(std::vector<double>& values) {
    for (double& value : values) value = static_cast<double>(static_cast<float>(value));
}

class CapiArrays : public ::testing::TestWithParam<int> {};

TEST_P(CapiArrays, every_layout_of_positions_and_h_gives_the_same_lists) {
    const int dim = GetParam();
    NodeSet set = random_nodes(dim, n, 7);
    round_to_float(set.x);
    round_to_float(set.h);
    const Lists expected = brute_force(dim, {set});
    const Context context;
    const Nodes nodes(context, dim);
    const Map map(context);
    for (const Layout x_layout : all_layouts)
        for (const Layout h_layout : all_layouts) {
            const Argument x = x_layout(set.x, dim), h = h_layout(set.h, 1);
            ASSERT_TRUE(ok(conn_nodes_set_h(nodes.handle, n, x.arrays.data(),
                                            static_cast<int>(x.arrays.size()), h.arrays.data())));
            ASSERT_TRUE(ok(map.rebuild({nodes.handle})));
            ASSERT_EQ(read_lists(map.handle), expected);
        }
}

TEST_P(CapiArrays, every_layout_of_tensors_gives_the_same_lists) {
    const int dim = GetParam();
    NodeSet set = random_nodes(dim, n, 8, true);
    round_to_float(set.H);
    const Lists expected = brute_force(dim, {set});
    const Context context;
    const Nodes nodes(context, dim);
    const Map map(context);
    const conn_array x = conn_array_matrix(set.x.data(), n, dim);
    for (const Layout layout : all_layouts) {
        const Argument H = layout(set.H, dim * (dim + 1) / 2);
        ASSERT_TRUE(ok(conn_nodes_set_tensor(nodes.handle, n, &x, 1, H.arrays.data(),
                                             static_cast<int>(H.arrays.size()))));
        ASSERT_TRUE(ok(map.rebuild({nodes.handle})));
        ASSERT_EQ(read_lists(map.handle), expected);
    }
}

TEST_P(CapiArrays, a_zero_stride_repeats_one_value) {
    const int dim = GetParam();
    NodeSet set = random_nodes(dim, n, 9);
    const double h = set.h[0];
    set.h.assign(n, h);
    const Context context;
    const Nodes nodes(context, dim);
    const Map map(context);
    const conn_array x = conn_array_matrix(set.x.data(), n, dim);
    conn_array repeated = conn_array_vector(&h, n);
    repeated.stride[0] = 0;
    ASSERT_TRUE(ok(conn_nodes_set_h(nodes.handle, n, &x, 1, &repeated)));
    ASSERT_TRUE(ok(map.rebuild({nodes.handle})));
    EXPECT_EQ(read_lists(map.handle), brute_force(dim, {set}));
}

TEST_P(CapiArrays, several_lists_with_ghosts_and_unequal_extents_equal_brute_force) {
    const int dim = GetParam();
    std::vector<NodeSet> sets{random_nodes(dim, 120, 1), random_nodes(dim, 90, 2, true), NodeSet{},
                              random_nodes(dim, 60, 3)};
    sets[0].n_internal = 70;
    sets[1].extent = 1.5;
    sets[2].extent = 2.25;
    sets[3].n_internal = 0;
    EXPECT_EQ(lists_of(Context(), dim, sets), brute_force(dim, sets));
}

INSTANTIATE_TEST_SUITE_P(Dimensions, CapiArrays, ::testing::Values(1, 2, 3));

TEST(CapiArray, whole_numbers_are_no_positions_and_no_supports) {
    const Context context;
    const Nodes nodes(context, 3);
    const std::int32_t narrow[6] = {};
    const std::int64_t wide[6] = {};
    const double real[6] = {};
    const conn_array x = conn_array_matrix(real, 2, 3), h = conn_array_vector(real, 2),
                     whole_x = conn_array_matrix_of(CONN_INT32, narrow, 2, 3),
                     whole_h = conn_array_vector_int64(wide, 2);
    EXPECT_TRUE(fails(conn_nodes_set_h(nodes.handle, 2, &whole_x, 1, &h), CONN_E_ARGUMENT,
                      {"positions.dtype = 2", "CONN_FLOAT64 or CONN_FLOAT32"}));
    EXPECT_TRUE(fails(conn_nodes_set_h(nodes.handle, 2, &x, 1, &whole_h), CONN_E_ARGUMENT,
                      {"h.dtype = 3"}));
    EXPECT_TRUE(ok(conn_nodes_set_h(nodes.handle, 2, &x, 1, &h)));
}

TEST(CapiArray, device_memory_is_refused_and_pinned_memory_is_read) {
    const Context context;
    const Nodes nodes(context, 3);
    const double real[6] = {};
    conn_array x = conn_array_matrix(real, 2, 3);
    const conn_array h = conn_array_vector(real, 2);
    for (const int space : {CONN_SPACE_DEVICE, CONN_SPACE_MANAGED}) {
        x.space = space;
        EXPECT_TRUE(fails(conn_nodes_set_h(nodes.handle, 2, &x, 1, &h), CONN_E_UNSUPPORTED,
                          {"positions.space", "host"}));
    }
    x.space = CONN_SPACE_HOST_PINNED;
    EXPECT_TRUE(ok(conn_nodes_set_h(nodes.handle, 2, &x, 1, &h)));
}

TEST(CapiArray, nothing_of_the_host_is_kept) {
    const Context context;
    const Nodes nodes(context, 3);
    const Map map(context);
    const NodeSet set = random_nodes(3, n, 5);
    {
        const auto copy = std::make_unique<NodeSet>(set);
        ASSERT_TRUE(ok(nodes.set(3, *copy)));
    }
    ASSERT_TRUE(ok(map.rebuild({nodes.handle})));
    EXPECT_EQ(read_lists(map.handle), brute_force(3, {set}));
}

TEST(CapiArray, a_list_may_shrink_grow_and_change_its_kind_of_support) {
    const Context context;
    const Nodes nodes(context, 2);
    const Map map(context);
    for (const int size : {300, 10, 0, 500, 501}) {
        const NodeSet set = random_nodes(2, size, 6, size % 2 == 1);
        ASSERT_TRUE(ok(nodes.set(2, set)));
        ASSERT_TRUE(ok(map.rebuild({nodes.handle})));
        EXPECT_EQ(read_lists(map.handle), brute_force(2, {set}));
        std::int64_t total = -1, internal = -1;
        ASSERT_TRUE(ok(conn_nodes_size(nodes.handle, &total, &internal)));
        EXPECT_EQ(total, size);
        EXPECT_EQ(internal, size);
    }
}

}  // namespace
}  // namespace connectivity::test
