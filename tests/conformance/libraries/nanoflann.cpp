// SPDX-License-Identifier: BSD-3-Clause
// nanoflann: a kd-tree. The node with the larger support owns a pair, of equal ones the later node:
// so one search a node, with its own support, finds each pair once.
#include <cstdint>
#include <vector>

#include <nanoflann.hpp>

#include "../conformance.h"

namespace {

struct Points {
    const conf_nodes& nodes;
    std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(nodes.n); }
    double kdtree_get_pt(std::size_t k, int d) const {
        return nodes.x[k * static_cast<std::size_t>(nodes.dim) + static_cast<std::size_t>(d)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points>;

/// The tree takes what is closer than worstDist(): the margin keeps the surface, decided here.
struct OwnedPairs {
    const conf_nodes& nodes;
    std::int64_t i;
    conf_answer* answer;

    double R2() const { return nodes.radius[i] * nodes.radius[i]; }
    double worstDist() const { return R2() * (1 + 1e-12); }
    bool full() const { return true; }
    std::size_t size() const { return 0; }
    void sort() {}
    template <class Index>
    bool addPoint(double r2, Index found) {
        const auto j = static_cast<std::int64_t>(found);
        const bool owned =
            nodes.radius[j] < nodes.radius[i] || (nodes.radius[j] == nodes.radius[i] && j < i);
        if (owned && r2 <= R2()) conf_add_pair(answer, i, j);
        return true;
    }
};

template <class T>
void search(const T& tree, OwnedPairs& pairs, const double* x) {
    if constexpr (requires { tree.findNeighbors(pairs, x); })
        tree.findNeighbors(pairs, x);
    else
        tree.findNeighbors(pairs, x, nanoflann::SearchParams());
}

void find_pairs(const conf_nodes* nodes, conf_answer* answer) {
    if (nodes->n == 0) return;
    const Points points{*nodes};
    const Tree tree(nodes->dim, points, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    for (std::int64_t i = 0; i < nodes->n; ++i) {
        OwnedPairs pairs{*nodes, i, answer};
        search(tree, pairs, nodes->x + i * nodes->dim);
    }
}

}  // namespace

extern "C" const conf_library conf_nanoflann = {"nanoflann", CONF_OPEN_ONLY, find_pairs};
