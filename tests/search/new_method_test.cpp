// SPDX-License-Identifier: BSD-3-Clause
// The guide in src/search/README.md, followed: a toy method in one file passes the property tests.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <support/brute_force.hpp>
#include <support/random_case.hpp>

#include "map/prepare.hpp"
#include "search/direct.hpp"

namespace connectivity::test {
namespace {

/// Nodes sorted along the first axis: candidates are those not farther along it than the largest
/// reach. On a periodic first axis all nodes are.
template <int Dim>
class AxisSweep {
public:
    explicit AxisSweep(const SearchNodes<Dim>& nodes) : nodes_(nodes) {
        for (Offset i = 0; i < nodes.n; ++i) {
            by_x_.emplace_back(x(i), i);
            reach_ = std::max(reach_, std::sqrt(std::max(nodes.reach2(i), 0.0)));
        }
        std::sort(by_x_.begin(), by_x_.end());
        if (nodes.periods.length[0] > 0) reach_ = HUGE_VAL;
        reach_ *= 1 + 1e-15;
    }

    template <class F>
    void visit(Offset i, const F& f) const {
        // Differences of the sorted coordinates are those of the predicate, and as monotone.
        for (const auto& [at, j] : by_x_)
            if (reach_ == HUGE_VAL || std::fabs(at - x(i)) <= reach_) f(j);
    }

private:
    double x(Offset i) const { return nodes_.positions(i * Dim); }
    const SearchNodes<Dim>& nodes_;
    std::vector<std::pair<double, Offset>> by_x_;
    double reach_ = 0;
};

template <int Dim>
void expect_brute_force_lists(std::uint64_t seed) {
    const Case c = random_case(seed, {Dim, seed % 2 != 0, 120, 0});
    const Expected expected = brute_force(c);
    const std::vector<NodeList> lists = node_lists(c);
    PreparedStorage storage;
    const SearchNodes<Dim> nodes = prepare_nodes<Dim>(lists, c.domain, storage);
    std::vector<ListSize> sizes;
    for (const NodeList& list : lists) sizes.push_back({list.n(), list.n_internal()});
    const SlotLayout layout(sizes, c.ghost_rows);
    const bool has_pairs = c.mode == SearchMode::gather_scatter;

    Csr rows, halves;
    const AxisSweep<Dim> sweep(nodes);
    detail::DirectBuild<Dim, AxisSweep<Dim>>(sweep, nodes, layout,
                                             {true, has_pairs, c.mode, SearchMethod::brute, {}})
        .run({rows, halves});

    ASSERT_TRUE(rows_equal({rows.offsets(), rows.values(), layout.n_lists(), 1}, expected))
        << c.text;
    if (has_pairs) {
        ASSERT_TRUE(pairs_equal({halves.offsets(), halves.values(), {}, 1}, expected)) << c.text;
    }
}

TEST(NewMethod, a_toy_in_one_file_gives_the_lists_of_brute_force) {
    for (std::uint64_t seed = 0; seed < 350; ++seed) {
        expect_brute_force_lists<1>(seed);
        expect_brute_force_lists<2>(seed);
        expect_brute_force_lists<3>(seed);
        if (HasFailure()) return;
    }
}

}  // namespace
}  // namespace connectivity::test
