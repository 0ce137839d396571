// SPDX-License-Identifier: BSD-3-Clause
// Reference cases decided in exact rational arithmetic: rows, counts, gather, scatter, pairs,
// overlap, intersections, traversal, key order, and what culling leaves.

#include <fstream>

#include <gtest/gtest.h>

#include <support/reference_cases.hpp>
#include <support/shared_data.hpp>

namespace connectivity::test {
namespace {

using nlohmann::json;

/// Rows of a map in the shape of the file: [list][node][list] -> node ids.
json rows_of(const ConnectivityMap& map, const RowsView<>& rows) {
    const SlotLayout& layout = map.layout();
    json all = json::array();
    for (std::size_t k = 0; k < static_cast<std::size_t>(layout.n_lists()); ++k) {
        json nodes = json::array();
        for (Offset r = layout.row_offset()[k]; r < layout.row_offset()[k + 1]; ++r) {
            json segments = json::array();
            for (int l = 0; l < layout.n_lists(); ++l) {
                json ids = json::array();
                for (const Slot j : rows(r, l))
                    ids.push_back(j - layout.list_offset()[static_cast<std::size_t>(l)]);
                segments.push_back(ids);
            }
            nodes.push_back(segments);
        }
        all.push_back(nodes);
    }
    return all;
}

json rows_of(const ConnectivityMap& map) { return rows_of(map, map.rows()); }

json traversal_of(const ConnectivityMap& map) {
    json all = json::array();
    for (int l = 0; l < map.layout().n_lists(); ++l) {
        json ids = json::array();
        for (const Slot node : map.traversal(l)) ids.push_back(node);
        all.push_back(ids);
    }
    return all;
}

/// [{pair, nodes by list}]
json intersections_of(ConnectivityMap& map, const json& pairs) {
    const IntersectionView<> common = map.intersection();
    const SlotLayout& layout = map.layout();
    json all = json::array();
    for (Offset p = 0; p < common.n_pairs(); ++p) {
        json nodes = json::array();
        for (int l = 0; l < layout.n_lists(); ++l) nodes.push_back(json::array());
        for (const Slot slot : common[p]) {
            const auto list = static_cast<std::size_t>(layout.list_of_slot(slot));
            nodes[list].push_back(slot - layout.list_offset()[list]);
        }
        all.push_back({{"pair", pairs[static_cast<std::size_t>(p)]}, {"nodes", nodes}});
    }
    return all;
}

json pairs_of(ConnectivityMap& map) {
    const auto pairs = map.pairs().expanded_view();
    const SlotLayout& layout = map.layout();
    const auto name = [&](json& pair, Slot slot) {
        const int list = layout.list_of_slot(slot);
        pair.push_back(list);
        pair.push_back(slot - layout.list_offset()[static_cast<std::size_t>(list)]);
    };
    json all = json::array();
    for (Offset k = 0; k < pairs.size(); ++k) {
        json pair = json::array();
        name(pair, pairs[k].i);
        name(pair, pairs[k].j);
        all.push_back(pair);
    }
    return all;
}

/// The file lists every node; a map has rows of stored nodes.
json stored_part(json all, const json& n_stored) {
    for (std::size_t k = 0; k < all.size(); ++k)
        while (all[k].size() > n_stored[k].get<std::size_t>()) all[k].erase(all[k].size() - 1);
    return all;
}

void check_lists(const json& source, SearchMethod method) {
    const json& want = source["expected"];
    Case c = case_of(source);
    EXPECT_EQ(c.kernel_extent(), want["K_used"].get<double>());
    ConnectivityMap map;
    rebuild(map, c, method);
    EXPECT_EQ(rows_of(map), stored_part(want["neighbors"], want["numStored"]));
    EXPECT_EQ(pairs_of(map), want["pairs"]);
    for (std::size_t k = 0; k < c.lists.size(); ++k)
        for (Offset a = 0; a < want["numStored"][k].get<Offset>(); ++a)
            EXPECT_EQ(map.rows()[map.layout().row_offset()[k] + a].size(),
                      want["numNeighbors"][k][static_cast<std::size_t>(a)].get<Offset>());
    if (!source["flags"]["domainIndependent"].get<bool>()) {
        EXPECT_EQ(traversal_of(map), want["traversal"]);
    }
    c.mode = SearchMode::gather;
    rebuild(map, c, method);
    EXPECT_EQ(rows_of(map), stored_part(want["gather"], want["numStored"]));
    c.mode = SearchMode::scatter;
    rebuild(map, c, method);
    EXPECT_EQ(rows_of(map), stored_part(want["scatter"], want["numStored"]));
}

void check_overlap(const json& source, SearchMethod method) {
    const json& want = source["expected"];
    if (!want.contains("overlap")) return;
    const Case c = case_of(source);
    MapOptions options = map_options(c, method);
    options.overlap = true;
    ConnectivityMap map;
    map.rebuild(node_lists(c), options);
    EXPECT_EQ(rows_of(map, map.overlap()), want["overlap"]);
    EXPECT_EQ(rows_of(map), want["neighbors"]);
    EXPECT_EQ(pairs_of(map), want["pairs"]);
}

void check_intersections(const json& source, SearchMethod method) {
    const json& want = source["expected"];
    if (!want.contains("intersection_filtered")) return;
    const Case c = case_of(source);
    MapOptions options = map_options(c, method);
    ConnectivityMap map;
    for (const auto& [kind, name] :
         {std::pair{IntersectionKind::all, "intersection_unfiltered"},
          std::pair{IntersectionKind::in_segment, "intersection_filtered"}}) {
        options.intersection = kind;
        map.rebuild(node_lists(c), options);
        EXPECT_EQ(pairs_of(map), want["pairs"]);
        EXPECT_EQ(intersections_of(map, want["pairs"]), want[name]) << name;
    }
}

void check_key_order(const json& source, SearchMethod method) {
    const json& want = source["expected"];
    if (!source["flags"]["domainIndependent"].get<bool>()) return;
    const Case c = case_of(source);
    MapOptions options = map_options(c, method);
    options.order = ListOrder::key;
    ConnectivityMap map;
    map.rebuild(node_lists(c), options);
    EXPECT_EQ(traversal_of(map), want["traversal"]);
    EXPECT_EQ(rows_of(map), want["neighbors_key_order"]);
    EXPECT_EQ(pairs_of(map), want["pairs_key_order"]);
    const KeyOrderView<> order = map.key_order();
    for (std::size_t l = 0; l < c.lists.size(); ++l)
        for (Offset a = 0; a < c.n(l); ++a)
            EXPECT_EQ(
                order.keys(order.ranks(map.layout().list_offset()[l] + a)),
                want["morton_clean_keys"][l][static_cast<std::size_t>(a)].get<std::uint64_t>());
}

void check_patch(const json& source, SearchMethod method) {
    if (!source.contains("patch")) return;
    const json &patch = source["patch"], &want = patch["expected_after"];
    std::vector<Slot> keep, old2new;
    for (const json& list : patch["flags"])
        for (const json& flag : list) keep.push_back(flag.get<Slot>());
    for (const json& list : patch["old2new"])
        for (const json& id : list) old2new.push_back(id.get<Slot>());
    ConnectivityMap map;
    rebuild(map, case_of(source), method);
    map.patch(keep, old2new);
    EXPECT_EQ(rows_of(map), want["neighbors"]);
    EXPECT_EQ(pairs_of(map), want["pairs"]);
    for (std::size_t l = 0; l < want["numNodes"].size(); ++l) {
        EXPECT_EQ(map.layout().list_offset()[l + 1] - map.layout().list_offset()[l],
                  want["numNodes"][l].get<Offset>());
        EXPECT_EQ(map.n_internal()[l], want["numInternal"][l].get<Offset>());
    }
}

void check_file(std::ifstream& file) {
    const json cases = json::parse(file)["cases"];
    ASSERT_GE(cases.size(), 9u);
    for (const json& source : cases)
        for (const SearchMethod method : all_methods) {
            SCOPED_TRACE(source["name"].get<std::string>() + ", " + name_of(method));
            check_lists(source, method);
            check_overlap(source, method);
            check_intersections(source, method);
            check_key_order(source, method);
            check_patch(source, method);
        }
}

TEST(OracleCases, every_list_is_the_exact_one) {
    std::ifstream file(reference_file);
    ASSERT_TRUE(file) << reference_file;
    check_file(file);
}

TEST(OracleCases, the_full_reference_file_holds_too) {
    std::ifstream file(shared_data("oracle/connectivity_cases.json"));
    if (!file) GTEST_SKIP() << "no reference data beside the repository: " << shared_data("");
    check_file(file);
}

}  // namespace
}  // namespace connectivity::test
