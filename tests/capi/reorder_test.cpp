// SPDX-License-Identifier: BSD-3-Clause
// Fields in another order: node k gets what node order[k] had, whatever the type and the layout.

#include <algorithm>
#include <numeric>

#include <support/random.hpp>
#include "capi_support.hpp"

namespace connectivity::test {
namespace {

constexpr int n = 5000;

using Slots = std::vector<std::int32_t>;

std::size_t at(std::int64_t index) { return static_cast<std::size_t>(index); }

Slots shuffled(int base = 0) {
    Slots order(n);
    std::iota(order.begin(), order.end(), base);
    Random random(3);
    for (int k = n - 1; k > 0; --k) std::swap(order[at(k)], order[at(random.below(k + 1))]);
    return order;
}

template <class T>
constexpr std::int32_t dtype_of = std::is_same_v<T, double>         ? CONN_FLOAT64
                                  : std::is_same_v<T, float>        ? CONN_FLOAT32
                                  : std::is_same_v<T, std::int32_t> ? CONN_INT32
                                                                    : CONN_INT64;

/// A layout of n_components of n nodes in `size` elements, node 0 at `origin`.
struct Place {
    int n_components;
    std::int64_t node, component, origin;
    std::size_t size;
};
const Place places[] = {{1, 1, 1, 0, n},
                        {3, 3, 1, 0, 3 * n},
                        {3, 1, n, 0, 3 * n},
                        {2, 7, 3, 2, 7 * n + 4},
                        {3, -3, 1, 3 * (n - 1), 3 * n},
                        {2, 2, -1, 1, 2 * n}};

template <class T>
void check_type(const Place& place, int base) {
    std::vector<T> field(place.size, T{77});
    const auto element = [&](std::int64_t node, int c) {
        return at(place.origin + node * place.node + c * place.component);
    };
    for (int k = 0; k < n; ++k)
        for (int c = 0; c < place.n_components; ++c)
            field[element(k, c)] = static_cast<T>(10 * k + c);
    conn_array in =
        conn_array_matrix_of(dtype_of<T>, field.data() + place.origin, n, place.n_components);
    in.stride[0] = place.node, in.stride[1] = place.component;
    const Slots order = shuffled(base);
    std::vector<T> expected(place.size, T{77}), out(place.size, T{77});
    for (int k = 0; k < n; ++k)
        for (int c = 0; c < place.n_components; ++c)
            expected[element(k, c)] = static_cast<T>(10 * (order[at(k)] - base) + c);
    ASSERT_TRUE(ok(conn_reorder(&in, order.data(), n, base, out.data() + place.origin)));
    EXPECT_EQ(out, expected);
    ASSERT_TRUE(ok(conn_reorder(&in, order.data(), n, base, field.data() + place.origin)));
    EXPECT_EQ(field, expected) << "in place";
}

TEST(CapiReorder, every_type_and_layout_is_gathered_also_in_place) {
    const Context context;
    for (const Place& place : places)
        for (const int base : {0, 1}) {
            check_type<double>(place, base);
            check_type<float>(place, base);
            check_type<std::int32_t>(place, base);
            check_type<std::int64_t>(place, base);
        }
}

TEST(CapiReorder, a_host_that_follows_the_spatial_order_gets_the_same_lists_renumbered) {
    const Context context;
    NodeSet set = random_nodes(3, 900, 5);
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.spatial_order = 1;
    options.index_base = 1;
    const Built built(context, 3, {set}, options);
    const Slots order =
        two_calls<std::int32_t>([&](std::int32_t* out, std::int64_t room, std::int64_t* count) {
            return conn_map_spatial_order(built.map.handle, 0, out, room, count);
        });
    const conn_array x = conn_array_matrix(set.x.data(), 900, 3),
                     h = conn_array_vector(set.h.data(), 900);
    ASSERT_TRUE(ok(conn_reorder(&x, order.data(), 900, 1, set.x.data())));
    ASSERT_TRUE(ok(conn_reorder(&h, order.data(), 900, 1, set.h.data())));
    ASSERT_TRUE(ok(built.nodes[0]->set(3, set)));
    options.spatial_order = 0;
    const Lists moved = lists_of(context, 3, {set});
    EXPECT_EQ(moved, brute_force(3, {set}));
    EXPECT_EQ(moved.pairs.size(), brute_force(3, {random_nodes(3, 900, 5)}).pairs.size());
}

TEST(CapiReorder, what_is_no_permutation_is_refused_and_nothing_is_written) {
    const Context context;
    const std::vector<double> field(n, 2.0);
    std::vector<double> out(n, -7.0);
    const conn_array in = conn_array_vector(field.data(), n);
    Slots order = shuffled();
    const auto call = [&](int base = 0, std::int64_t size = n) {
        return conn_reorder(&in, order.data(), size, base, out.data());
    };
    const std::int32_t kept = order[7];
    for (const std::int32_t bad : {-1, n, INT32_MIN, INT32_MAX}) {
        order[7] = bad;
        EXPECT_TRUE(
            fails(call(), CONN_E_ARGUMENT, {"order[7] = " + std::to_string(bad), "[0, 5000)"}));
    }
    order[7] = order[8];
    EXPECT_TRUE(fails(call(), CONN_E_ARGUMENT, {"times"}));
    order[7] = kept;
    EXPECT_TRUE(fails(call(1), CONN_E_ARGUMENT, {"must be in [1, 5001)"}));
    EXPECT_TRUE(fails(call(2), CONN_E_ARGUMENT, {"index_base = 2"}));
    EXPECT_TRUE(fails(call(0, n - 1), CONN_E_ARGUMENT, {"n = 4999", "5000"}));
    EXPECT_EQ(out, std::vector<double>(n, -7.0));
    EXPECT_TRUE(ok(call()));
}

TEST(CapiReorder, an_order_under_its_output_is_refused_and_stays) {
    const Context context;
    constexpr int length = 100;
    Slots memory(3 * length);
    for (int k = 0; k < 3 * length; ++k) memory[static_cast<std::size_t>(k)] = k % length;
    const Slots before = memory;
    const Slots field(length, 7);
    const conn_array in = conn_array_vector_int32(field.data(), length);
    const auto call = [&](int out) {
        return conn_reorder(&in, memory.data() + length, length, 0, memory.data() + out);
    };
    for (const int out : {1, length, 2 * length - 1})
        EXPECT_TRUE(fails(call(out), CONN_E_ARGUMENT, {"out overlaps order"})) << out;
    EXPECT_EQ(memory, before);
    EXPECT_TRUE(ok(call(0)));
    EXPECT_TRUE(ok(call(2 * length)));
}

TEST(CapiReorder, layouts_with_two_elements_in_one_place_and_overlaps_are_refused) {
    const Context context;
    std::vector<double> field(64), out(64);
    const Slots order{0, 1, 2};
    conn_array in = conn_array_matrix(field.data(), 3, 2);
    const auto call = [&](void* to) { return conn_reorder(&in, order.data(), 3, 0, to); };
    EXPECT_TRUE(ok(call(out.data())));
    EXPECT_TRUE(ok(call(field.data() + 6)));
    EXPECT_TRUE(fails(call(field.data() + 5), CONN_E_ARGUMENT, {"overlaps", "40 bytes"}));
    EXPECT_TRUE(fails(call(reinterpret_cast<char*>(out.data()) + 4), CONN_E_ARGUMENT, {"aligned"}));
    EXPECT_TRUE(fails(call(nullptr), CONN_E_NULL, {"out"}));
    const std::int64_t bad[][2] = {{0, 1}, {2, 0}, {1, 1}, {2, 2}, {1, 2}};
    for (const auto& strides : bad) {
        in.stride[0] = strides[0], in.stride[1] = strides[1];
        EXPECT_TRUE(fails(call(out.data()), CONN_E_ARGUMENT, {"two elements in one place"}));
    }
    in.stride[0] = 1, in.stride[1] = 3;
    EXPECT_TRUE(ok(call(out.data())));
    in.dtype = 9;
    EXPECT_TRUE(fails(call(out.data()), CONN_E_ARGUMENT, {"in.dtype = 9", "CONN_INT64"}));
    in.dtype = CONN_INT64, in.extent[1] = 0;
    EXPECT_TRUE(fails(call(out.data()), CONN_E_ARGUMENT, {"in.extent[1] = 0"}));
    in.extent[0] = 0, in.extent[1] = 2;
    EXPECT_TRUE(ok(conn_reorder(&in, nullptr, 0, 0, nullptr)));
}

}  // namespace
}  // namespace connectivity::test
