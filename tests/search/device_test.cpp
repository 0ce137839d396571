// SPDX-License-Identifier: BSD-3-Clause
// The device search by itself: however its lists are cut into batches and parts, it gives what
// brute force gives; and its sort.

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/expect_error.hpp>
#include <support/random.hpp>

#include "search/device/device_search.hpp"
#include "search/device/sort_segments.hpp"
#include "search_problem.hpp"

namespace connectivity::test {
namespace {

using detail::device::Array;
using Exec = Kokkos::DefaultExecutionSpace;

/// A device search with limits of its own, and the lists it fills.
struct Device {
    explicit Device(Offset limit) { search.limit_lists(limit); }

    void run(const Problem& p, Offset budget = 0) {
        SearchRequest request;
        request.budget.bytes = budget;
        search.run(p.nodes, detail::order_groups(p.nodes), p.layout, request, {rows, halves},
                   report);
    }
    Offset parts() const { return report.count("device_parts"); }

    detail::DeviceSearch<3> search;
    Csr rows, halves;
    Report report;
};

/// Every leaf by itself; some parts; one.
constexpr Offset limits[] = {0, 30000, Offset{1} << 40};

TEST(DeviceSearch, any_limit_of_its_lists_gives_the_same_rows_and_half_rows) {
    for (const Offset limit : limits) {
        Device device(limit);
        for (std::uint64_t seed = 20; seed < 28; ++seed) {
            const Problem p = limit == 0 ? random_problem(seed) : random_problem(seed, 2500, 1200);
            device.run(p);
            ASSERT_TRUE(filled(device.rows, device.halves, p)) << limit << ", " << p.c.text;
        }
    }
}

/// Supports of 0.1 in the unit cube: every node sees a few others.
Problem cloud_problem(int n) { return Problem(cloud(n, 7)); }

TEST(DeviceSearch, a_low_limit_makes_many_parts_and_a_high_one_makes_one) {
    const Problem p = cloud_problem(1000);
    Device one(Offset{1} << 40), many(10000), all(0);
    one.run(p), many.run(p), all.run(p);
    EXPECT_EQ(one.parts(), 1);
    EXPECT_GT(many.parts(), 1);
    EXPECT_LT(many.parts(), all.parts());
    EXPECT_GE(all.parts(), (1000 + 15) / 16) << "every leaf by itself";
    for (Device* device : {&one, &many, &all})
        EXPECT_TRUE(filled(device->rows, device->halves, p)) << device->parts();
}

TEST(DeviceSearch, coincident_nodes_are_all_neighbours_whatever_the_limit) {
    const Problem p(uniform_case(3, std::vector<double>(3 * 700, 0.25), 1e-3));
    for (const Offset limit : limits) {
        Device device(limit);
        device.run(p);
        EXPECT_EQ(device.rows.n_values(), 700 * 699);
        EXPECT_TRUE(filled(device.rows, device.halves, p));
    }
}

TEST(DeviceSearch, no_node_and_one_node_give_empty_rows) {
    Device device(0);
    for (const int n : {0, 1, 0}) {
        const Problem p(uniform_case(3, std::vector<double>(3 * n, 0.5), 1));
        device.run(p);
        EXPECT_EQ(device.rows.n_rows(), n);
        EXPECT_EQ(device.rows.n_values() + device.halves.n_values(), 0);
    }
}

TEST(DeviceSearch, over_budget_its_lists_stay_as_they_were) {
    const Problem first = cloud_problem(300), second = cloud_problem(900);
    for (const Offset limit : limits) {
        Device device(limit);
        device.run(first);
        EXPECT_TRUE(fails_with(Status::budget, {"64"}, [&] { device.run(second, 64); }));
        EXPECT_TRUE(filled(device.rows, device.halves, first));
        device.run(second);
        EXPECT_TRUE(filled(device.rows, device.halves, second));
    }
}

TEST(DeviceSearch, rows_of_inactive_nodes_are_empty_and_pairs_need_an_active_node) {
    Problem p = cloud_problem(300);
    View<std::uint8_t> active("active", 300);
    for (Offset i = 0; i < 300; ++i) active(i) = i % 3 == 0;
    p.layout = SlotLayout({{300, 300}}, false, active);
    Device device(10000);
    device.run(p);
    const auto holds = [](const Csr& list, Offset i, Offset j) {
        const Offset* const at = list.offsets().data() + i;
        const Slot* const values = list.values().data();
        return std::binary_search(values + at[0], values + at[1], Slot(j));
    };
    for (Offset i = 0; i < 300; ++i)
        for (Offset j = 0; j < 300; ++j) {
            const bool met = i != j && (sees(p.c, i, j) || sees(p.c, j, i)),
                       some_active = active(i) + active(j) > 0;
            ASSERT_EQ(holds(device.rows, i, j), met && active(i) == 1) << i << ", " << j;
            ASSERT_EQ(holds(device.halves, i, j), met && i < j && some_active) << i << ", " << j;
        }
}

TEST(DeviceSearch, a_second_build_takes_no_more_memory) {
    const Problem p = cloud_problem(2000);
    Device device(Offset{1} << 40);
    device.run(p);
    const Offset bytes = device.search.bytes();
    device.run(p);
    EXPECT_EQ(device.search.bytes(), bytes);
}

TEST(DeviceSort, lists_of_any_length_come_out_ascending) {
    start_runtime();
    std::vector<Offset> offsets = {5};  // lists need not begin at zero
    for (const Offset n : {0, 1, 2, 3, 4, 5, 7, 16, 17, 31, 33, 100, 1000, 1023, 1024, 1025, 5000})
        offsets.push_back(offsets.back() + n);
    const Offset n_lists = static_cast<Offset>(offsets.size()) - 1, n = offsets.back() - 5;
    View<Offset> host_offsets("offsets", offsets.size());
    std::copy(offsets.begin(), offsets.end(), host_offsets.data());
    View<Slot> values("values", static_cast<std::size_t>(n));
    std::iota(values.data(), values.data() + n, 0);
    Random random(3);
    for (Offset k = n - 1; k > 0; --k)
        std::swap(values(k), values(static_cast<Offset>(random.uniform() * double(k))));

    auto device_offsets = Kokkos::create_mirror_view_and_copy(Exec(), host_offsets);
    auto device_values = Kokkos::create_mirror_view_and_copy(Exec(), values);
    std::vector<Slot> sorted(values.data(), values.data() + n);
    detail::device::sort_segments<Exec>(n_lists, device_offsets.data(), device_values.data());
    Exec().fence();
    Kokkos::deep_copy(values, device_values);
    for (Offset l = 0; l < n_lists; ++l)
        std::sort(sorted.begin() + offsets[l] - 5, sorted.begin() + offsets[l + 1] - 5);
    EXPECT_TRUE(std::equal(sorted.begin(), sorted.end(), values.data()));
}

}  // namespace
}  // namespace connectivity::test
