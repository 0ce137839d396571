// SPDX-License-Identifier: BSD-3-Clause
// TreeNSearch: full lists; with a radius of each point they are those of either in reach.
#include <vector>

#include <TreeNSearch.h>

#include "../conformance.h"

namespace {

void find_rows(const conf_nodes* nodes, conf_answer* answer) {
    if (nodes->n == 0) return;
    const auto n = static_cast<int>(nodes->n);
    tns::TreeNSearch search;
    if (nodes->same_radius) {
        search.set_search_radius(nodes->radius[0]);
        search.add_point_set(nodes->x, n);
    } else {
        search.add_point_set(nodes->x, nodes->radius, n);
        search.set_symmetric_search(true);
    }
    search.set_active_search(0, 0);
    search.run();
    for (int i = 0; i < n; ++i) {
        const tns::NeighborList row = search.get_neighborlist(0, 0, i);
        conf_add_row(answer, i, row.get_ptr(), row.size());
    }
}

}  // namespace

extern "C" const conf_library conf_treensearch = {
    "TreeNSearch", CONF_OPEN_ONLY | CONF_THREE_D_ONLY | CONF_SINGLE_PRECISION, find_rows};
