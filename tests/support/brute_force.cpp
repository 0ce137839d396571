// SPDX-License-Identifier: BSD-3-Clause
#include <support/brute_force.hpp>

#include <cmath>
#include <string>

namespace connectivity::test {
namespace {

struct Node {
    double x[3] = {0, 0, 0};
    double h = 0;
    double H[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    bool tensor = false, stored = false;
    std::size_t list = 0;
};

struct Problem {
    std::vector<Node> nodes;
    int dim = 3;
    double K = 0;
    bool periodic[3] = {false, false, false};
    double L[3] = {0, 0, 0};
};

void unpack(const double* packed, int dim, double (&H)[3][3]) {
    int at = 0;
    for (int a = 0; a < dim; ++a)
        for (int b = a; b < dim; ++b) H[a][b] = H[b][a] = packed[at++];
}

Problem flatten(const Case& c) {
    Problem p;
    p.dim = c.dim;
    p.K = c.kernel_extent();
    for (int d = 0; d < c.dim; ++d) {
        p.periodic[d] = c.domain.periodic[static_cast<std::size_t>(d)];
        p.L[d] =
            c.domain.hi[static_cast<std::size_t>(d)] - c.domain.lo[static_cast<std::size_t>(d)];
    }
    for (std::size_t k = 0; k < c.lists.size(); ++k) {
        const ListData& list = c.lists[k];
        for (Offset a = 0; a < c.n(k); ++a) {
            Node node;
            for (int d = 0; d < c.dim; ++d)
                node.x[d] = list.x[static_cast<std::size_t>(a * c.dim + d)];
            node.tensor = list.tensor;
            if (list.tensor)
                unpack(list.H.data() + a * n_symmetric(c.dim), c.dim, node.H);
            else
                node.h = list.h[static_cast<std::size_t>(a)];
            node.stored = c.ghost_rows || a < list.n_internal;
            node.list = k;
            p.nodes.push_back(node);
        }
    }
    return p;
}

/// The definition: difference first, then its nearest image; products rounded once; closed ball.
bool sees(const Problem& p, const Node& i, const Node& j) {
    double r[3] = {0, 0, 0};
    for (int d = 0; d < p.dim; ++d) {
        r[d] = i.x[d] - j.x[d];
        if (p.periodic[d]) {
            const double images = std::rint(r[d] / p.L[d]);
            const double shift = p.L[d] * images;
            r[d] = r[d] - shift;
        }
    }
    if (i.tensor) {
        double sum = 0;
        for (int a = 0; a < p.dim; ++a) {
            double component = 0;
            for (int b = 0; b < p.dim; ++b) {
                const double product = i.H[a][b] * r[b];
                component = b == 0 ? product : component + product;
            }
            const double square = component * component;
            sum = a == 0 ? square : sum + square;
        }
        return sum <= p.K * p.K;
    }
    if (i.h == 0) return false;
    double r2 = 0;
    for (int d = 0; d < p.dim; ++d) {
        const double square = r[d] * r[d];
        r2 = d == 0 ? square : r2 + square;
    }
    const double radius = p.K * i.h;
    const double radius2 = radius * radius;
    return r2 <= radius2;
}

bool is_neighbour(const Problem& p, const Node& i, const Node& j, SearchMode mode) {
    switch (mode) {
        case SearchMode::gather: return sees(p, i, j);
        case SearchMode::scatter: return sees(p, j, i);
        default: return sees(p, i, j) || sees(p, j, i);
    }
}

void count_lists(const Case& c, Expected& e) {
    e.list_offset = e.row_offset = {0};
    for (std::size_t k = 0; k < c.lists.size(); ++k) {
        e.list_offset.push_back(e.list_offset.back() + c.n(k));
        e.row_offset.push_back(e.row_offset.back() +
                               (c.ghost_rows ? c.n(k) : c.lists[k].n_internal));
    }
}

template <class T>
::testing::AssertionResult same(const char* what, const T* got, std::size_t n_got,
                                const std::vector<T>& want) {
    if (n_got != want.size())
        return ::testing::AssertionFailure()
               << what << " has " << n_got << " values instead of " << want.size();
    for (std::size_t k = 0; k < n_got; ++k)
        if (got[k] != want[k])
            return ::testing::AssertionFailure()
                   << what << "[" << k << "] is " << got[k] << " instead of " << want[k];
    return ::testing::AssertionSuccess();
}

}  // namespace

bool sees(const Case& c, Offset i, Offset j) {
    const Problem p = flatten(c);
    return sees(p, p.nodes[static_cast<std::size_t>(i)], p.nodes[static_cast<std::size_t>(j)]);
}

Expected brute_force(const Case& c) {
    const Problem p = flatten(c);
    const std::size_t n = p.nodes.size();
    Expected e;
    count_lists(c, e);
    e.row_offsets = e.pair_offsets = {0};
    for (std::size_t i = 0; i < n; ++i) {
        const Node& node = p.nodes[i];
        std::size_t list = 0;  // segments [0, list) of this row are closed
        for (std::size_t j = 0; j < n; ++j) {
            for (; node.stored && list < p.nodes[j].list; ++list)
                e.row_offsets.push_back(static_cast<Offset>(e.row_slots.size()));
            if (i == j || !is_neighbour(p, node, p.nodes[j], c.mode)) continue;
            if (node.stored) e.row_slots.push_back(static_cast<Slot>(j));
            if (j > i && (node.stored || p.nodes[j].stored))
                e.pair_j.push_back(static_cast<Slot>(j));
        }
        for (; node.stored && list < c.lists.size(); ++list)
            e.row_offsets.push_back(static_cast<Offset>(e.row_slots.size()));
        e.pair_offsets.push_back(static_cast<Offset>(e.pair_j.size()));
    }
    if (c.mode != SearchMode::gather_scatter) {
        e.pair_offsets.clear();
        e.pair_j.clear();
    }
    return e;
}

::testing::AssertionResult rows_equal(const RowsView<>& rows, const Expected& e) {
    if (auto r = same("rows.offsets", rows.offsets.data(), rows.offsets.size(), e.row_offsets); !r)
        return r;
    return same("rows.slots", rows.slots.data(), rows.slots.size(), e.row_slots);
}

::testing::AssertionResult pairs_equal(const NodePairList::View<>& pairs, const Expected& e) {
    if (auto r = same("pairs.offsets", pairs.offsets.data(), pairs.offsets.size(), e.pair_offsets);
        !r)
        return r;
    return same("pairs.j", pairs.j.data(), pairs.j.size(), e.pair_j);
}

::testing::AssertionResult equals(const ConnectivityMap& map, const Expected& e) {
    const SlotLayout& layout = map.layout();
    if (layout.list_offset() != e.list_offset || layout.row_offset() != e.row_offset)
        return ::testing::AssertionFailure() << "the layout of slots or rows differs";
    if (auto r = rows_equal(map.rows(), e); !r) return r;
    return e.pair_offsets.empty() ? ::testing::AssertionSuccess()
                                  : pairs_equal(map.pairs().view(), e);
}

}  // namespace connectivity::test
