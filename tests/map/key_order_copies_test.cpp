// SPDX-License-Identifier: BSD-3-Clause
// The reference case of key order, stored in other ways: nodes permuted, others of them ghosts.
// Read by original ids, its lists are always those of the file.

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include <support/random.hpp>
#include <support/reference_cases.hpp>

namespace connectivity::test {
namespace {

using nlohmann::json;
using Ids = std::vector<std::int64_t>;

const json& reference() {
    static const json found = reference_case("c12a");
    return found;
}

/// The case with node ids[k] of the file as node k; the first n_internal are no ghosts.
Case stored_as(const Ids& ids, Offset n_internal) {
    const Case original = case_of(reference());
    const ListData& from = original.lists[0];
    const auto dim = static_cast<std::size_t>(original.dim);
    const std::size_t n_H = from.H.size() * dim / from.x.size();
    Case c = original;
    ListData& nodes = c.lists[0];
    nodes.n_internal = n_internal;
    nodes.x.resize(ids.size() * dim);
    nodes.H.resize(ids.size() * n_H);
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const auto at = static_cast<std::size_t>(ids[k]);
        std::copy_n(&from.x[at * dim], dim, &nodes.x[k * dim]);
        std::copy_n(&from.H[at * n_H], n_H, &nodes.H[k * n_H]);
    }
    return c;
}

/// All lists of the map by original ids, in the shape of the file.
json by_original_id(const ConnectivityMap& map, const Ids& ids) {
    const auto id = [&](Slot slot) { return ids[static_cast<std::size_t>(slot)]; };
    json traversal = json::array(), pairs = json::array();
    json rows(ids.size(), json()), keys(ids.size(), json());
    for (const Slot node : map.traversal(0)) traversal.push_back(id(node));
    const KeyOrderView<> order = map.key_order();
    for (Slot slot = 0; slot < static_cast<Slot>(ids.size()); ++slot) {
        const auto at = static_cast<std::size_t>(id(slot));
        keys[at] = order.keys(order.ranks(slot));
        json row = json::array();
        for (const Slot j : map.rows()[map.layout().row_of_slot(slot)]) row.push_back(id(j));
        rows[at] = json::array({row});
    }
    const auto list = map.pairs().view();
    for (Offset k = 0; k < list.size(); ++k)
        pairs.push_back(json::array({0, id(list[k].i), 0, id(list[k].j)}));
    return {{"traversal", json::array({traversal})},
            {"neighbors_key_order", json::array({rows})},
            {"pairs_key_order", pairs},
            {"morton_clean_keys", json::array({keys})}};
}

void expect_reference(const Ids& ids, Offset n_internal, SearchMethod method) {
    const Case c = stored_as(ids, n_internal);
    std::vector<NodeList> lists = node_lists(c);
    lists[0].set_global_ids(ConstView<std::int64_t>(ids.data(), ids.size()));
    MapOptions options = map_options(c, method);
    options.order = ListOrder::key;
    ConnectivityMap map;
    map.rebuild(lists, options);
    const json got = by_original_id(map, ids);
    for (const auto& [name, value] : got.items())
        EXPECT_EQ(value, reference()["expected"][name])
            << name << ", " << name_of(method) << ", " << n_internal << " internal, nodes "
            << json(ids);
}

Ids in_order(std::size_t n) {
    Ids ids(n);
    std::iota(ids.begin(), ids.end(), 0);
    return ids;
}

TEST(KeyOrderCopies, any_split_of_the_nodes_into_ghosts_gives_the_lists_of_the_file) {
    for (const SearchMethod method : all_methods)
        for (const bool reversed : {false, true})
            for (Offset n_internal = 0; n_internal <= 16; ++n_internal) {
                Ids ids = in_order(16);
                if (reversed) std::reverse(ids.begin(), ids.end());
                expect_reference(ids, n_internal, method);
            }
}

TEST(KeyOrderCopies, any_permutation_and_split_gives_the_lists_of_the_file) {
    Random random(12);
    Ids ids = in_order(16);
    for (int round = 0; round < 500 && !HasFailure(); ++round) {
        for (std::size_t k = 15; k > 0; --k)
            std::swap(ids[k], ids[static_cast<std::size_t>(random.below(static_cast<int>(k + 1)))]);
        expect_reference(ids, random.below(17), random.pick(all_methods));
    }
}

/// Domains of a host with several ranks: every second node, a half, a quarter; the rest are ghosts.
TEST(KeyOrderCopies, every_domain_of_a_decomposition_has_the_lists_of_the_file) {
    for (const std::int64_t n_domains : {2, 3, 4, 16})
        for (std::int64_t domain = 0; domain < n_domains; ++domain)
            for (const bool blocks : {false, true}) {
                Ids ids = in_order(16);
                const auto first_ghost =
                    std::stable_partition(ids.begin(), ids.end(), [&](std::int64_t id) {
                        return (blocks ? id * n_domains / 16 : id % n_domains) == domain;
                    });
                expect_reference(ids, first_ghost - ids.begin(), SearchMethod::automatic);
            }
}

}  // namespace
}  // namespace connectivity::test
