// SPDX-License-Identifier: BSD-3-Clause
// Maps with derived lists over many rebuilds: nothing depends on what was built before, nothing of
// the caller is kept, and any thread may ask.

#include <thread>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/map/neighbour_query.hpp>
#include <connectivity/map/validate.hpp>
#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

MapOptions options_of(int kind) {
    MapOptions options;
    options.order = kind == 0 ? ListOrder::key : ListOrder::slot;
    options.overlap = kind == 1;
    options.intersection = kind == 2 ? IntersectionKind::all : IntersectionKind::none;
    return options;
}

/// What the lists of a map take, without spare capacity.
Offset bytes_of(const ConnectivityMap& map) {
    const auto list = [](const auto& offsets, const auto& values) {
        return static_cast<Offset>(offsets.size() * sizeof(Offset) + values.size() * sizeof(Slot));
    };
    const auto rows = map.rows();
    const auto pairs = map.pairs().view();
    Offset sum = list(rows.offsets, rows.slots) + list(pairs.offsets, pairs.j);
    if (map.options().overlap) sum += list(map.overlap().offsets, map.overlap().slots);
    if (map.options().intersection != IntersectionKind::none)
        sum += list(map.intersection().offsets, map.intersection().slots);
    return sum;
}

TEST(DerivedLife, the_smallest_budget_does_not_depend_on_earlier_builds) {
    const Case small = cloud(300, 1, 0.1), large = cloud(5000, 2, 0.05);
    for (int kind = 0; kind < 3; ++kind) {
        MapOptions options = options_of(kind);
        ConnectivityMap fresh, used;
        fresh.rebuild(node_lists(small), options);
        const Offset needed = bytes_of(fresh);
        used.rebuild(node_lists(large), options);
        for (ConnectivityMap* map : {&fresh, &used}) {
            options.budget.bytes = needed - 1;
            EXPECT_TRUE(fails_with(Status::budget, {std::to_string(needed)}, [&] {
                map->rebuild(node_lists(small), options);
            })) << kind;
            options.budget.bytes = needed;
            map->rebuild(node_lists(small), options);
        }
    }
}

TEST(DerivedLife, nodes_are_read_during_the_call_only) {
    start_runtime();
    const Case c = cloud(100, 3, 0.2);
    View<double> x("x", c.lists[0].x.size()), h("h", c.lists[0].h.size());
    std::copy(c.lists[0].x.begin(), c.lists[0].x.end(), x.data());
    std::copy(c.lists[0].h.begin(), c.lists[0].h.end(), h.data());
    for (int kind = 0; kind < 4; ++kind) {
        ConnectivityMap map;
        map.rebuild({{NodeList::with_h("gas", 3, 100, x, h, 2)}}, options_of(kind));
        EXPECT_EQ(x.use_count(), 1) << kind;
        EXPECT_EQ(h.use_count(), 1) << kind;
    }
}

TEST(DerivedLife, scratch_memory_is_given_back_with_what_needed_it) {
    const Case c = cloud(2000, 4, 0.08);
    MapOptions heavy = options_of(1);
    heavy.intersection = IntersectionKind::all;
    heavy.exclude = std::make_shared<const PairPredicate>([](Slot i, Slot) { return i % 7 == 0; });
    ConnectivityMap fresh, used;
    used.rebuild(node_lists(c), heavy);
    const Offset most = used.report().find("derived")->bytes;
    for (ConnectivityMap* map : {&fresh, &used}) map->rebuild(node_lists(c), options_of(0));
    const Offset least = fresh.report().find("derived")->bytes,
                 left = used.report().find("derived")->bytes;
    EXPECT_LT(left, 2 * least);
    EXPECT_LT(left, most / 2);
    rebuild(used, c);
    EXPECT_EQ(used.report().find("derived")->bytes, 0);
}

TEST(DerivedLife, any_thread_may_validate_and_ask) {
    const Case c = cloud(300, 5, 0.15);
    ConnectivityMap map;
    map.rebuild(node_lists(c), options_of(1));
    const std::vector<NodeList> lists = node_lists(c);
    const auto ask = [&] {
        std::string text;
        EXPECT_TRUE(all_passed(validate(map, lists), &text)) << text;
        NeighbourQuery query;
        query.update(lists);
        for (Slot i = 0; i < 300; i += 50) {
            const auto row = map.rows()[i];
            EXPECT_EQ(query.neighbours(i), std::vector<Slot>(row.begin(), row.end()));
        }
    };
    std::thread(ask).join();
#if defined(_OPENMP)
#pragma omp parallel num_threads(2)
#pragma omp single
    ask();
#endif
}

TEST(DerivedLife, a_patched_map_with_a_predicate_passes_validation) {
    const Case c = cloud(200, 6, 0.2);
    MapOptions options;
    options.exclude =
        std::make_shared<const PairPredicate>([](Slot i, Slot j) { return (i + j) % 5 == 0; });
    ConnectivityMap map;
    map.rebuild(node_lists(c), options);
    std::vector<Slot> keep(200, 1), ids(200);
    for (std::size_t k = 0; k < 200; ++k) ids[k] = static_cast<Slot>(199 - k);
    map.patch(keep, ids);
    Case turned = c;
    for (std::size_t k = 0; k < 200; ++k)
        for (std::size_t d = 0; d < 3; ++d)
            turned.lists[0].x[3 * k + d] = c.lists[0].x[3 * (199 - k) + d];
    std::string text;
    EXPECT_TRUE(all_passed(validate(map, node_lists(turned)), &text)) << text;
    map.rebuild(node_lists(c), MapOptions());
    map.remove_pairs([](Slot i, Slot) { return i == 3; });
    EXPECT_TRUE(all_passed(validate(map, node_lists(c)), &text)) << text;
}

TEST(DerivedLife, questions_from_far_outside_a_periodic_box_lose_nobody) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Case c = cloud(60, seed, 0.2);
        c.domain = {{true, true, true}, {0, 0, 0}, {1, 1, 1}};
        NeighbourQuery query;
        query.update(node_lists(c), c.domain);
        ListData place = c.lists[0];
        place.x.resize(3), place.h.resize(1);
        place.n_internal = 1;
        place.name = "place";
        for (double& x : place.x) x += 1000 * static_cast<double>(seed);
        QueryPoint point;
        std::copy(place.x.begin(), place.x.end(), point.x.begin());
        point.h = place.h[0];
        Case with_node = c;
        with_node.lists.push_back(place);
        with_node.ghost_rows = true;
        const Expected e = brute_force(with_node);
        const std::size_t last = e.row_offsets.size() - 3;
        const std::vector<Slot> want(e.row_slots.begin() + e.row_offsets[last],
                                     e.row_slots.begin() + e.row_offsets[last + 2]);
        EXPECT_EQ(query.neighbours(point), want) << seed;
    }
}

}  // namespace
}  // namespace connectivity::test
