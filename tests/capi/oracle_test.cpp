// SPDX-License-Identifier: BSD-3-Clause
// Reference cases decided in exact rational arithmetic, through the C interface.

#include <fstream>

#include <support/reference_files.hpp>
#include <support/shared_data.hpp>
#include "capi_support.hpp"

namespace connectivity::test {
namespace {

using nlohmann::json;

constexpr int all_methods[] = {CONN_METHOD_AUTOMATIC, CONN_METHOD_BRUTE, CONN_METHOD_CELLS,
                               CONN_METHOD_GROUPS, CONN_METHOD_DEVICE};

std::vector<NodeSet> sets_of(const json& source) {
    std::vector<NodeSet> sets;
    for (const json& list : source["nodeLists"]) {
        NodeSet set;
        set.name = list["name"].get<std::string>();
        set.x = flat(list["positions"]);
        set.H = flat(list["H"]);
        set.n_internal = list["nInternal"].get<std::int64_t>();
        set.extent = list["kernelExtent"].get<double>();
        sets.push_back(set);
    }
    return sets;
}

using Slots = std::vector<std::int32_t>;

/// First slot of each list, where the file has one entry for every node.
Slots offsets_of(const json& by_node) {
    Slots offsets{0};
    for (const json& list : by_node)
        offsets.push_back(offsets.back() + static_cast<std::int32_t>(list.size()));
    return offsets;
}

Slots offsets_of(const std::vector<NodeSet>& sets, int dim) {
    Slots offsets{0};
    for (const NodeSet& set : sets)
        offsets.push_back(offsets.back() + static_cast<std::int32_t>(set.x.size()) / dim);
    return offsets;
}

/// Node ids [list] as slots.
Slots slots_of(const json& ids, const Slots& list_offset) {
    Slots slots;
    for (std::size_t l = 0; l < ids.size(); ++l)
        for (const json& id : ids[l]) slots.push_back(list_offset[l] + id.get<std::int32_t>());
    return slots;
}

/// Neighbour ids [list][node][list] of the file as rows of slots; with n_stored those of the first
/// nodes of each list.
std::vector<Slots> slots_of(const json& all, const json& n_stored, const Slots& list_offset) {
    std::vector<Slots> rows;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const std::size_t n = n_stored.is_null() ? all[k].size() : n_stored[k].get<std::size_t>();
        for (std::size_t a = 0; a < n; ++a) rows.push_back(slots_of(all[k][a], list_offset));
    }
    return rows;
}

/// Pairs (list, node, list, node) of the file.
std::vector<std::pair<std::int32_t, std::int32_t>> slot_pairs(const json& pairs,
                                                              const Slots& list_offset) {
    std::vector<std::pair<std::int32_t, std::int32_t>> out;
    for (const json& p : pairs)
        out.emplace_back(list_offset[p[0].get<std::size_t>()] + p[1].get<int>(),
                         list_offset[p[2].get<std::size_t>()] + p[3].get<int>());
    return out;
}

Slots traversal_of(const Built& built, int list) {
    return two_calls<std::int32_t>([&](auto* nodes, auto capacity, auto* count) {
        return conn_map_traversal(built.map.handle, list, nodes, capacity, count);
    });
}

void check_traversal(const Built& built, const json& want) {
    for (std::size_t l = 0; l < want.size(); ++l)
        EXPECT_EQ(traversal_of(built, static_cast<int>(l)), want[l].get<Slots>());
}

void check(const Context& context, const json& source, int method) {
    const json& want = source["expected"];
    const int dim = source["dim"].get<int>();
    const std::vector<NodeSet> sets = sets_of(source);
    const Slots list_offset = offsets_of(sets, dim);
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.method = method;
    for (std::size_t k = 0; k < sets.size(); ++k)
        if (want["numStored"][k].get<std::int64_t>() != sets[k].n_internal) options.ghost_rows = 1;
    Lists expected;
    expected.rows = slots_of(want["neighbors"], want["numStored"], list_offset);
    expected.pairs = slot_pairs(want["pairs"], list_offset);
    const Built built(context, dim, sets, options);
    const Lists found = read_lists(built.map.handle);
    if (!source["flags"]["domainIndependent"].get<bool>())
        check_traversal(built, want["traversal"]);
    EXPECT_EQ(found.rows, expected.rows);
    EXPECT_EQ(found.pairs, expected.pairs);
    std::size_t r = 0;
    for (std::size_t k = 0; k < sets.size(); ++k)
        for (std::size_t a = 0; a < want["numStored"][k].get<std::size_t>(); ++a, ++r)
            EXPECT_EQ(found.rows[r].size(), want["numNeighbors"][k][a].get<std::size_t>());

    options.pairs = 0;
    options.mode = CONN_GATHER;
    EXPECT_EQ(lists_of(context, dim, sets, options).rows,
              slots_of(want["gather"], want["numStored"], list_offset));
    options.mode = CONN_SCATTER;
    EXPECT_EQ(lists_of(context, dim, sets, options).rows,
              slots_of(want["scatter"], want["numStored"], list_offset));
}

void check_overlap(const Context& context, const json& source, int method) {
    const json& want = source["expected"];
    if (!want.contains("overlap")) return;
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.method = method;
    options.overlap = 1;
    const Built built(context, source["dim"].get<int>(), sets_of(source), options);
    const Slots list_offset = offsets_of(want["neighbors"]);
    conn_rows_view view = CONN_ROWS_VIEW_INIT;
    ASSERT_TRUE(ok(conn_map_overlap_acquire(built.map.handle, CONN_SPACE_HOST, &view)));
    EXPECT_EQ(rows_of(view), slots_of(want["overlap"], nullptr, list_offset));
    EXPECT_EQ(view.generation, 1u);
    EXPECT_TRUE(ok(conn_map_rows_release(&view)));
    const Lists found = read_lists(built.map.handle);
    EXPECT_EQ(found.rows, slots_of(want["neighbors"], nullptr, list_offset));
    EXPECT_EQ(found.pairs, slot_pairs(want["pairs"], list_offset));
}

/// By pair of the file: the nodes of the view, and what the question about these two says.
void check_intersection(const Built& built, const json& want, const Slots& list_offset,
                        const conn_intersection_view& view) {
    ASSERT_EQ(view.n_pairs, static_cast<std::int64_t>(want.size()));
    for (std::size_t k = 0; k < want.size(); ++k) {
        const auto [a, b] = slot_pairs(json::array({want[k]["pair"]}), list_offset)[0];
        const Slots expected = slots_of(want[k]["nodes"], list_offset);
        EXPECT_EQ(Slots(view.slots + view.offsets[k], view.slots + view.offsets[k + 1]), expected);
        EXPECT_EQ(
            two_calls<std::int32_t>([&, i = a, j = b](auto* slots, auto capacity, auto* count) {
                return conn_map_common_neighbours(
                    built.map.handle, i, j, view.in_segment ? built.lists.data() : nullptr,
                    view.in_segment ? static_cast<int>(built.lists.size()) : 0, slots, capacity,
                    count);
            }),
            expected);
    }
}

void check_intersections(const Context& context, const json& source, int method) {
    const json& want = source["expected"];
    if (!want.contains("intersection_filtered")) return;
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.method = method;
    const Built built(context, source["dim"].get<int>(), sets_of(source), options);
    for (const auto& [kind, name] :
         {std::pair{CONN_INTERSECTION_ALL, "intersection_unfiltered"},
          std::pair{CONN_INTERSECTION_IN_SEGMENT, "intersection_filtered"}}) {
        SCOPED_TRACE(name);
        options.intersection = kind;
        ASSERT_TRUE(ok(built.rebuild(options)));
        conn_intersection_view view = CONN_INTERSECTION_VIEW_INIT;
        ASSERT_TRUE(ok(conn_map_intersection_acquire(built.map.handle, CONN_SPACE_HOST, &view)));
        EXPECT_EQ(view.in_segment, kind == CONN_INTERSECTION_IN_SEGMENT ? 1 : 0);
        check_intersection(built, want[name], offsets_of(want["neighbors"]), view);
        EXPECT_TRUE(ok(conn_map_intersection_release(&view)));
    }
}

void check_key_order(const Context& context, const json& source, int method) {
    const json& want = source["expected"];
    if (!source["flags"]["domainIndependent"].get<bool>()) return;
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.method = method;
    options.order = CONN_ORDER_KEY;
    const Built built(context, source["dim"].get<int>(), sets_of(source), options);
    const Slots list_offset = offsets_of(want["neighbors"]);
    check_traversal(built, want["traversal"]);
    const Lists found = read_lists(built.map.handle);
    EXPECT_EQ(found.rows, slots_of(want["neighbors_key_order"], nullptr, list_offset));
    EXPECT_EQ(found.pairs, slot_pairs(want["pairs_key_order"], list_offset));
    conn_map* const map = built.map.handle;
    const Slots slots = two_calls<std::int32_t>([&](auto* out, auto capacity, auto* count) {
        return conn_map_key_order(map, out, nullptr, nullptr, capacity, count);
    });
    const Slots ranks = two_calls<std::int32_t>([&](auto* out, auto capacity, auto* count) {
        return conn_map_key_order(map, nullptr, out, nullptr, capacity, count);
    });
    const auto keys = two_calls<std::uint64_t>([&](auto* out, auto capacity, auto* count) {
        return conn_map_key_order(map, nullptr, nullptr, out, capacity, count);
    });
    std::size_t slot = 0;
    for (const json& list : want["morton_clean_keys"])
        for (const json& key : list) {
            const auto rank = static_cast<std::size_t>(ranks[slot]);
            EXPECT_EQ(slots[rank], static_cast<std::int32_t>(slot++));
            EXPECT_EQ(keys[rank], key.get<std::uint64_t>());
        }
}

Slots joined(const json& lists) {
    Slots all;
    for (const json& list : lists)
        for (const json& value : list) all.push_back(value.get<std::int32_t>());
    return all;
}

void check_patch(const Context& context, const json& source, int method) {
    if (!source.contains("patch")) return;
    const json &patch = source["patch"], &want = patch["expected_after"];
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.method = method;
    const Built built(context, source["dim"].get<int>(), sets_of(source), options);
    const Slots keep = joined(patch["flags"]), old2new = joined(patch["old2new"]);
    ASSERT_TRUE(ok(conn_map_patch(built.map.handle, keep.data(), old2new.data(),
                                  static_cast<std::int64_t>(keep.size()), nullptr, 0)));
    Slots list_offset{0};
    for (const json& n : want["numNodes"])
        list_offset.push_back(list_offset.back() + n.get<std::int32_t>());
    const Lists found = read_lists(built.map.handle);
    EXPECT_EQ(found.rows, slots_of(want["neighbors"], nullptr, list_offset));
    EXPECT_EQ(found.pairs, slot_pairs(want["pairs"], list_offset));
    std::int64_t lists[8], rows[8], count = 0;
    ASSERT_TRUE(ok(conn_map_offsets(built.map.handle, lists, rows, 8, &count)));
    for (std::size_t l = 0; l < want["numNodes"].size(); ++l) {
        EXPECT_EQ(lists[l + 1], list_offset[l + 1]);
        EXPECT_EQ(rows[l + 1] - rows[l], want["numInternal"][l].get<std::int64_t>());
    }
    EXPECT_EQ(built.map.generation(), 2u);
}

void check_file(std::ifstream& file) {
    const Context context;
    const json cases = json::parse(file)["cases"];
    int n_checked = 0;
    for (const json& source : cases)
        for (const int method : all_methods) {
            SCOPED_TRACE(source["name"].get<std::string>() + ", method " + std::to_string(method));
            check(context, source, method);
            check_overlap(context, source, method);
            check_intersections(context, source, method);
            check_key_order(context, source, method);
            check_patch(context, source, method);
            ++n_checked;
        }
    EXPECT_GE(n_checked, 16);
}

TEST(CapiOracle, every_list_is_the_exact_one) {
    std::ifstream file(reference_file);
    ASSERT_TRUE(file) << "tests/support/data/connectivity_cases.json is missing";
    check_file(file);
}

TEST(CapiOracle, the_full_reference_file_holds_too) {
    std::ifstream file(connectivity::test::shared_data("oracle/connectivity_cases.json"));
    if (!file)
        GTEST_SKIP() << "no reference data beside the repository: "
                     << connectivity::test::shared_data("");
    check_file(file);
}

}  // namespace
}  // namespace connectivity::test
