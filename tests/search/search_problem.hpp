// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A prepared 3D problem for tests of the searcher, with the lists that brute force gives.

#include <support/brute_force.hpp>
#include <support/random_case.hpp>

#include "map/prepare.hpp"

namespace connectivity::test {

struct Problem {
    explicit Problem(Case source)
        : c(std::move(source)), expected(brute_force(c)), lists(node_lists(c)) {
        nodes = prepare_nodes<3>(lists, c.domain, storage);
        std::vector<ListSize> sizes;
        for (const NodeList& list : lists) sizes.push_back({list.n(), list.n_internal()});
        layout = SlotLayout(sizes, c.ghost_rows);
    }

    Case c;
    Expected expected;
    std::vector<NodeList> lists;
    PreparedStorage storage;
    SearchNodes<3> nodes;
    SlotLayout layout;
};

/// Random nodes, periodic for odd seeds.
inline Problem random_problem(std::uint64_t seed, int max_nodes = 400, int min_nodes = 50) {
    Case c = random_case(seed, {3, seed % 2 == 1, max_nodes, min_nodes});
    c.mode = SearchMode::gather_scatter;
    return Problem(std::move(c));
}

inline bool filled(const Csr& rows, const Csr& halves, const Problem& p) {
    return rows_equal({rows.offsets(), rows.values(), p.layout.n_lists(), 1}, p.expected) &&
           pairs_equal({halves.offsets(), halves.values(), {}, 1}, p.expected);
}

}  // namespace connectivity::test
