// SPDX-License-Identifier: BSD-3-Clause
// Sizes beyond what can be stored: an exact 64-bit count and an error before any allocation.

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/brute_force.hpp>
#include <support/expect_error.hpp>
#include <support/process.hpp>
#include <support/random.hpp>

namespace connectivity::test {
namespace {

/// n nodes that all see each other.
Case one_heap(Offset n) {
    Random random(1);
    std::vector<double> x;
    for (Offset k = 0; k < 3 * n; ++k) x.push_back(0.1 * random.uniform());
    return uniform_case(3, std::move(x), 1);
}

struct Explosion {
    Offset n;
    bool rows, pairs;
    SearchMethod method;
    bool after_small_build = false;  ///< the searcher may have learned to expect few neighbours
};

void PrintTo(const Explosion& e, std::ostream* out) {
    *out << e.n << (e.rows ? " rows" : "") << (e.pairs ? " pairs " : " ") << name_of(e.method)
         << (e.after_small_build ? " after a small build" : "");
}

class PairExplosion : public ::testing::TestWithParam<Explosion> {};

TEST_P(PairExplosion, is_an_error_with_the_exact_count_before_memory_is_taken) {
    const auto& [n, rows, pairs, method, after_small_build] = GetParam();
    if (sanitized && (n > 50000 || method == SearchMethod::cells))
        GTEST_SKIP() << "a minute of distance tests under a sanitizer; " << n << " runs without";
    const Case heap = one_heap(n), small = one_heap(300);
    const Expected expected = brute_force(small);
    ConnectivityMap map;
    if (after_small_build) rebuild(map, small, method);
    MapOptions options = map_options(heap, method);
    options.rows = rows;
    options.pairs = pairs;
    options.budget.bytes = Offset{1} << 30;
    std::vector<std::string> words = {"GiB", std::to_string(options.budget.bytes), "node list 0"};
    const Offset n_pairs = n * (n - 1) / 2;
    if (rows) words.push_back(std::to_string(2 * n_pairs) + " row entries");
    if (pairs) words.push_back(std::to_string(n_pairs) + " pairs");
    const std::vector<NodeList> lists = node_lists(heap);
    reset_peak();
    const std::int64_t before = resident_bytes();
    EXPECT_TRUE(fails_with(Status::budget, words, [&] { map.rebuild(lists, options); }));
    EXPECT_TRUE(sanitized || peak_resident_bytes() - before <= (std::int64_t{64} << 20) + 64 * n)
        << peak_resident_bytes() - before;
    EXPECT_TRUE(!after_small_build || equals(map, expected)) << "the old lists stay";
    rebuild(map, small, method);
    EXPECT_TRUE(equals(map, expected)) << "the next build works";
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, PairExplosion,
    ::testing::Values(Explosion{46342, true, false, SearchMethod::groups},  // entries pass 2^31
                      Explosion{46342, true, false, SearchMethod::cells},
                      Explosion{46342, true, true, SearchMethod::automatic, true},
                      Explosion{65537, false, true, SearchMethod::groups},  // pairs pass 2^31
                      Explosion{65537, true, true, SearchMethod::automatic},
                      Explosion{92683, false, true, SearchMethod::automatic},  // pairs pass 2^32
                      Explosion{92683, true, true, SearchMethod::automatic, true}));

TEST(IndexLimits, more_nodes_than_slots_are_refused_before_they_are_read) {
    start_runtime();
    const auto nothing = [](Offset n) {
        return ConstView<double>(nullptr, static_cast<std::size_t>(n));
    };
    const auto list = [&](Offset n) {
        return NodeList::with_h("huge", 1, n, nothing(n), nothing(n), 2);
    };
    ConnectivityMap map;
    const Offset limit = max_slots;
    for (const std::vector<Offset>& sizes : {std::vector<Offset>{limit + 1},
                                             {limit, 1},
                                             {limit / 2, limit / 2, 2},
                                             {limit, limit, limit, limit}}) {
        std::vector<NodeList> lists;
        Offset sum = 0;
        for (const Offset n : sizes) lists.push_back(list(n)), sum += n;
        EXPECT_TRUE(fails_with(Status::too_many, {std::to_string(sum), std::to_string(limit)},
                               [&] { map.rebuild(lists, {}); }));
    }
    EXPECT_EQ(map.generation(), 0u);
}

}  // namespace
}  // namespace connectivity::test
