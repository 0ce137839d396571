// SPDX-License-Identifier: BSD-3-Clause
// Fields over pairs: values by number and by nodes, what goes stale, copies, and how a patch
// carries them.

#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <connectivity/map/copy_to.hpp>
#include <connectivity/map/pairwise_field.hpp>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

Case random_pairs(std::uint64_t seed) {
    Case c = random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 1, 60, 0});
    c.mode = SearchMode::gather_scatter;
    return c;
}

/// Number of every pair, from the definition.
std::map<std::pair<Slot, Slot>, Offset> numbers_of(const Case& c) {
    const Expected e = brute_force(c);
    std::map<std::pair<Slot, Slot>, Offset> numbers;
    for (std::size_t i = 0; i + 1 < e.pair_offsets.size(); ++i)
        for (Offset p = e.pair_offsets[i]; p < e.pair_offsets[i + 1]; ++p)
            numbers[{static_cast<Slot>(i), e.pair_j[static_cast<std::size_t>(p)]}] = p;
    return numbers;
}

Case small() { return cloud(40, 5, 0.15); }

struct Tensor {
    double xx = 7, xy = 0;
    int tag = 3;
};

TEST(PairwiseField, values_start_as_those_of_the_type) {
    ConnectivityMap map;
    rebuild(map, cloud(3000, 1, 0.05));
    const PairwiseField<double> zeros(map.pairs());
    const PairwiseField<Tensor, 3> tensors(map.pairs());
    ASSERT_GT(zeros.size(), few_items);
    ASSERT_EQ(zeros.size(), map.pairs().size());
    for (Offset k = 0; k < zeros.size(); ++k) {
        ASSERT_EQ(zeros[k], 0);
        for (int c = 0; c < 3; ++c) ASSERT_TRUE(tensors[k][c].xx == 7 && tensors[k][c].tag == 3);
    }
    EXPECT_EQ(tensors.bytes(), tensors.size() * 3 * Offset{sizeof(Tensor)});
}

TEST(PairwiseField, a_pair_has_one_value_in_both_orientations_and_by_number) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const Case c = random_pairs(seed);
        ConnectivityMap map;
        rebuild(map, c);
        PairwiseField<Offset> one(map.pairs());
        PairwiseField<Offset, 3> three(map.pairs());
        const auto numbers = numbers_of(c);
        ASSERT_EQ(one.size(), static_cast<Offset>(numbers.size())) << c.text;
        for (const auto& [pair, k] : numbers) {
            one(map.pairs(), pair.first, pair.second) = 10 * k;
            for (int e = 0; e < 3; ++e) three(map.pairs(), pair.second, pair.first)[e] = 10 * k + e;
        }
        const auto& one_read = one;
        const auto& three_read = three;
        for (const auto& [pair, k] : numbers) {
            ASSERT_EQ(one_read(map.pairs(), pair.second, pair.first), 10 * k) << c.text;
            ASSERT_EQ(one_read[k], 10 * k);
            ASSERT_EQ(one_read(k), 10 * k);
            ASSERT_EQ(one_read.view(map.pairs())[k], 10 * k);
            ASSERT_EQ(three_read.find(map.pairs(), pair.first, pair.second), three_read[k]);
            for (int e = 0; e < 3; ++e) {
                ASSERT_EQ(three_read[k][e], 10 * k + e) << c.text;
                ASSERT_EQ(three_read.view()[k][e], 10 * k + e);
                ASSERT_EQ(three_read.data()[3 * k + e], 10 * k + e);
            }
        }
    }
}

TEST(PairwiseField, slots_that_are_no_pair_have_no_value) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const Case c = random_pairs(seed);
        ConnectivityMap map;
        rebuild(map, c);
        const PairwiseField<int> field(map.pairs());
        const auto numbers = numbers_of(c);
        const auto n = static_cast<Slot>(c.n_slots());
        for (Slot i = -1; i <= n; ++i)
            for (Slot j = -1; j <= n; ++j)
                ASSERT_EQ(field.find(map.pairs(), i, j) != nullptr,
                          numbers.contains({std::min(i, j), std::max(i, j)}))
                    << c.text;
    }
    ConnectivityMap map;
    rebuild(map, uniform_case(1, {0, 1, 9}, 1));
    PairwiseField<int> field(map.pairs());
    EXPECT_TRUE(fails_with(Status::argument, {"slots 2 and 0", "no pair"},
                           [&] { field(map.pairs(), 2, 0) = 1; }));
    EXPECT_TRUE(fails_with(Status::argument, {"slots 1 and 7"},
                           [&] { std::as_const(field)(map.pairs(), 1, 7); }));
}

/// All accesses that name a pair list.
template <class Field>
::testing::AssertionResult is_stale(Field& field, ConnectivityMap& map) {
    const auto& read = std::as_const(field);
    const NodePairList& pairs = map.pairs();
    if (field.is_current(pairs)) return ::testing::AssertionFailure() << "said to be current";
    const std::function<void()> calls[] = {
        [&] { field(pairs, 0, 1); },      [&] { read(pairs, 0, 1); },
        [&] { field.find(pairs, 0, 1); }, [&] { field.view(pairs); },
        [&] { read.find(pairs, 0, 1); },  [&] { read.view(pairs); }};
    for (const auto& call : calls)
        if (auto result = fails_with(Status::stale, {"pair"}, call); !result) return result;
    return ::testing::AssertionSuccess();
}

TEST(PairwiseField, a_rebuild_makes_it_stale_even_with_the_same_nodes) {
    ConnectivityMap map;
    rebuild(map, small());
    PairwiseField<double> field(map.pairs());
    EXPECT_TRUE(field.is_current(map.pairs()));
    rebuild(map, small());
    EXPECT_TRUE(is_stale(field, map));
    field.reset(map.pairs());
    EXPECT_TRUE(field.is_current(map.pairs()));
}

TEST(PairwiseField, it_is_of_no_other_map) {
    ConnectivityMap map, twin;
    rebuild(map, small());
    rebuild(twin, small());
    ASSERT_EQ(map.generation(), twin.generation());
    PairwiseField<double, 2> field(map.pairs());
    EXPECT_TRUE(is_stale(field, twin));
    ConnectivityMap heir = std::move(map);
    EXPECT_TRUE(field.is_current(heir.pairs()));
}

TEST(PairwiseField, a_rebuild_that_fails_leaves_it_current) {
    ConnectivityMap map;
    rebuild(map, small());
    PairwiseField<double> field(map.pairs());
    Case bad = small();
    bad.lists[0].x[3] = NAN;
    EXPECT_TRUE(fails_with(Status::nonfinite, {}, [&] { rebuild(map, bad); }));
    EXPECT_TRUE(field.is_current(map.pairs()));
}

TEST(PairwiseField, a_rebuild_without_pairs_makes_it_stale_and_there_is_no_list_to_make_one_of) {
    ConnectivityMap map;
    const Case c = small();
    rebuild(map, c);
    NodePairList& pairs = map.pairs();
    PairwiseField<double> field(pairs);
    MapOptions options;
    options.pairs = false;
    map.rebuild(node_lists(c), options);
    EXPECT_TRUE(fails_with(Status::stale, {"stamp"}, [&] { field.find(pairs, 0, 1); }));
    EXPECT_TRUE(fails_with(Status::not_built, {"never built"},
                           [&] { const PairwiseField<double> other(pairs); }));
    EXPECT_TRUE(fails_with(Status::not_built, {}, [&] { field.reset(NodePairList()); }));
    EXPECT_GT(field.size(), 0);
}

TEST(PairwiseField, an_empty_field_is_of_no_list) {
    ConnectivityMap map;
    rebuild(map, small());
    PairwiseField<double> field;
    EXPECT_EQ(field.size(), 0);
    EXPECT_TRUE(is_stale(field, map));
    EXPECT_FALSE(field.is_current(NodePairList()));
}

TEST(PairwiseField, a_map_without_pairs_between_its_nodes_has_empty_fields) {
    ConnectivityMap map;
    rebuild(map, uniform_case(1, {0, 10}, 1));
    const PairwiseField<double, 2> field(map.pairs());
    EXPECT_EQ(field.size(), 0);
    EXPECT_TRUE(field.is_current(map.pairs()));
    EXPECT_EQ(field.find(map.pairs(), 0, 1), nullptr);
}

template <int n>
PairwiseField<double, n> numbered(const NodePairList& pairs) {
    PairwiseField<double, n> field(pairs);
    for (Offset k = 0; k < n * field.size(); ++k) field.data()[k] = 0.5 * static_cast<double>(k);
    return field;
}

template <int n>
bool is_numbered(const PairwiseField<double, n>& field) {
    for (Offset k = 0; k < n * field.size(); ++k)
        if (field.data()[k] != 0.5 * static_cast<double>(k)) return false;
    return true;
}

TEST(PairwiseField, copies_are_deep_and_what_was_moved_from_is_empty) {
    ConnectivityMap map;
    rebuild(map, cloud(2000, 3, 0.06));
    auto field = numbered<2>(map.pairs());
    auto copy = field;
    field[7][1] = -1;
    EXPECT_TRUE(is_numbered(copy) && copy.is_current(map.pairs()));
    copy = field;
    EXPECT_EQ(copy[7][1], -1);
    auto moved = std::move(copy);
    EXPECT_EQ(moved[7][1], -1);
    EXPECT_TRUE(moved.is_current(map.pairs()));
    EXPECT_TRUE(copy.size() == 0 && copy.stamp() == 0 && copy.data() == nullptr);
    copy = std::move(moved);
    EXPECT_EQ(copy[7][1], -1);
    EXPECT_EQ(moved.size(), 0);
}

TEST(PairwiseField, a_reset_reuses_memory_but_leaves_views_as_they_are) {
    ConnectivityMap map;
    rebuild(map, cloud(1000, 3));
    auto field = numbered<1>(map.pairs());
    const double* const memory = field.data();
    rebuild(map, cloud(900, 3));
    field.reset(map.pairs());
    EXPECT_EQ(field.data(), memory);
    for (Offset k = 0; k < field.size(); ++k) ASSERT_EQ(field[k], 0);
    const auto view = field.view();
    field.reset(map.pairs());
    field[0] = 5;
    EXPECT_EQ(view[0], 0);
}

TEST(PairwiseField, copies_in_another_memory_space_come_back) {
    ConnectivityMap map;
    rebuild(map, cloud(500, 4));
    auto field = numbered<3>(map.pairs());
    const auto there = copy_to<HostMemory>(field);
    EXPECT_NE(there.data(), field.data());
    EXPECT_EQ(there.size(), field.size());
    const auto values = there.values;
    Kokkos::parallel_for(
        "test/increment",
        Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, 3 * there.size()),
        [=](const Offset k) { values(k) += 1; });
    HostExec().fence();
    EXPECT_TRUE(is_numbered(field));
    copy_back(there, field);
    for (Offset k = 0; k < 3 * field.size(); ++k)
        ASSERT_EQ(field.data()[k], 0.5 * static_cast<double>(k) + 1);
    const auto pairs = copy_to<HostMemory>(map.pairs().view());
    EXPECT_EQ(pairs.stamp, field.stamp());
    for (Offset k = 0; k < pairs.size(); ++k) ASSERT_EQ(pairs.find(pairs[k].j, pairs[k].i), k);
    const auto rows = copy_to<HostMemory>(map.rows());
    EXPECT_TRUE(rows_equal(rows, brute_force(cloud(500, 4))));
    rebuild(map, cloud(500, 4));
    field.reset(map.pairs());
    EXPECT_TRUE(fails_with(Status::stale, {"copy"}, [&] { copy_back(there, field); }));
}

/// Ascending numbers of the pairs that survive, as a patch has them.
View<Offset> survivors(Offset n_pairs, Random& random) {
    std::vector<Offset> kept;
    for (Offset k = 0; k < n_pairs; ++k)
        if (random.chance(0.6)) kept.push_back(k);
    View<Offset> view("kept", kept.size());
    std::copy(kept.begin(), kept.end(), view.data());
    return view;
}

TEST(PairwiseField, a_patch_carries_the_values_of_surviving_pairs) {
    Random random(8);
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        ConnectivityMap map, patched;
        rebuild(map, random_pairs(seed));
        rebuild(patched, small());
        auto one = numbered<1>(map.pairs());
        auto three = numbered<3>(map.pairs());
        const auto view = one.view();
        const auto kept = survivors(one.size(), random);
        for (PairFieldBase* field :
             {static_cast<PairFieldBase*>(&one), static_cast<PairFieldBase*>(&three)}) {
            field->prepare_remap(kept);
            EXPECT_TRUE(field->is_current(map.pairs()));
            field->abandon_remap();
            field->commit_remap(patched.pairs().stamp());  // nothing was prepared
            ASSERT_TRUE(field->is_current(map.pairs()));
            field->prepare_remap(kept);
        }
        ASSERT_TRUE(is_numbered(one) && is_numbered(three));
        for (PairFieldBase* field :
             {static_cast<PairFieldBase*>(&one), static_cast<PairFieldBase*>(&three)}) {
            field->commit_remap(patched.pairs().stamp());
            ASSERT_TRUE(field->is_current(patched.pairs()));
            ASSERT_EQ(field->size(), static_cast<Offset>(kept.size()));
        }
        for (std::size_t k = 0; k < kept.size(); ++k) {
            ASSERT_EQ(one(static_cast<Offset>(k)), 0.5 * static_cast<double>(kept(k)));
            for (int e = 0; e < 3; ++e)
                ASSERT_EQ(three[static_cast<Offset>(k)][e],
                          0.5 * static_cast<double>(3 * kept(k) + e));
        }
        for (Offset k = 0; k < view.size(); ++k)  // held from before
            ASSERT_EQ(view[k], 0.5 * static_cast<double>(k));
    }
}

TEST(NodePairList, no_two_lists_have_the_same_stamp) {
    std::set<Stamp> stamps{NodePairList().stamp()};
    EXPECT_EQ(NodePairList().stamp(), 0u);
    std::vector<ConnectivityMap> maps(5);
    for (int round = 0; round < 4; ++round)
        for (ConnectivityMap& map : maps) {
            rebuild(map, small());
            EXPECT_TRUE(stamps.insert(map.pairs().stamp()).second);
            EXPECT_EQ(map.pairs().view().stamp, map.pairs().stamp());
        }
}

}  // namespace
}  // namespace connectivity::test
