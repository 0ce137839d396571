// SPDX-License-Identifier: BSD-3-Clause
// ArborX: a tree of boxes. The node with the larger support owns a pair, of equal ones the later
// node, so that one query a node, with its own support, finds each pair once.
#include <ArborX.hpp>

#include "../conformance.h"

namespace {

using Space = Kokkos::DefaultHostExecutionSpace;
using Memory = Space::memory_space;
using Point = ArborX::Point<3, double>;

struct Balls {
    Kokkos::View<Point*, Memory> x;
    const double* R;
};

struct KeepOwned {
    const double* R;

    template <class Predicate, class Value, class Output>
    void operator()(const Predicate& ball, const Value& other, const Output& output) const {
        const int i = ArborX::getData(ball), j = static_cast<int>(other.index);
        if (R[j] < R[i] || (R[j] == R[i] && j < i)) output(j);
    }
};

}  // namespace

template <>
struct ArborX::AccessTraits<Balls> {
    using memory_space = Memory;
    static std::size_t size(const Balls& balls) { return balls.x.size(); }
    static auto get(const Balls& balls, std::size_t i) {
        return attach(intersects(ArborX::Sphere{balls.x(i), balls.R[i]}), static_cast<int>(i));
    }
};

namespace {

void search(const conf_nodes& nodes, conf_answer* answer) {
    const auto n = static_cast<int>(nodes.n);
    const Kokkos::View<Point*, Memory> points("points", static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i)
        points(i) = {nodes.x[3 * i], nodes.x[3 * i + 1], nodes.x[3 * i + 2]};
    const Space space;
    const ArborX::BoundingVolumeHierarchy tree(space,
                                               ArborX::Experimental::attach_indices<int>(points));
    Kokkos::View<int*, Memory> offsets("offsets", 0), values("values", 0);
    tree.query(space, Balls{points, nodes.radius}, KeepOwned{nodes.radius}, values, offsets);
    for (int i = 0; i < n; ++i)
        for (int k = offsets(i); k < offsets(i + 1); ++k) conf_add_pair(answer, i, values(k));
}

void find_pairs(const conf_nodes* nodes, conf_answer* answer) {
    const Kokkos::ScopeGuard kokkos;
    search(*nodes, answer);
}

}  // namespace

extern "C" const conf_library conf_arborx = {"ArborX", CONF_OPEN_ONLY | CONF_THREE_D_ONLY,
                                             find_pairs};
