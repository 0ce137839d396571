// SPDX-License-Identifier: BSD-3-Clause
// Sums over pairs have the same bits with any number of threads where that is promised. The number
// is fixed for a process, so this program runs itself and compares fingerprints.

#include <algorithm>
#include <iostream>
#include <sstream>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>
#include <connectivity/map/pair_sum.hpp>

#include <support/brute_force.hpp>
#include <support/hash.hpp>
#include <support/process.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

/// A force that rounds differently in every order.
struct Force {
    const double* x;
    int dim;

    KOKKOS_INLINE_FUNCTION PairContribution<double, 3> operator()(Offset, Slot i, Slot j) const {
        PairContribution<double, 3> c;
        double r2 = 1e-3;
        for (int d = 0; d < 3; ++d) {
            c.i[d] = d < dim ? x[i * dim + d] - x[j * dim + d] : 0;
            r2 += c.i[d] * c.i[d];
        }
        for (int d = 0; d < 3; ++d) c.i[d] /= r2, c.j[d] = -c.i[d];
        return c;
    }
};

std::uint64_t fingerprint_of_sums() {
    Fnv1a hash;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        Case c = cloud(20000, seed, 0.035);
        c.lists[0].n_internal = 17000;
        c.ghost_rows = seed == 1;
        ConnectivityMap map;
        MapOptions options = map_options(c);
        options.spatial_order = true;
        map.rebuild(node_lists(c), options);
        const Force force{c.lists[0].x.data(), c.dim};
        const RowPairs of(map);
        const PairColours colours(map.pairs(), map.spatial_order(), 100);
        const View<double> by_rows("a", static_cast<std::size_t>(3 * c.n_slots())),
            by_colours("b", static_cast<std::size_t>(3 * c.n_slots()));
        add_pairs_by_rows(HostExec(), of.view(map), force, by_rows);
        add_pairs_by_colours(HostExec(), colours, map.pairs().view(), force, by_colours);
        hash.add_view(by_rows);
        hash.add_view(by_colours);
        hash.add_view(of.view(map).pair);
        hash.add_view(colours.slots());
    }
    return hash.value();
}

/// Also run by the test below, in processes of their own.
TEST(PairSum, a_second_time_has_the_same_bits) {
    const std::uint64_t first = fingerprint_of_sums();
    EXPECT_EQ(fingerprint_of_sums(), first);
    std::cout << "\nthreads " << runtime_threads() << " fingerprint " << first << std::endl;
}

TEST(PairSum, one_two_and_three_threads_give_the_same_bits) {
    start_runtime();
    if (runtime_description().find("OpenMP") == std::string::npos)
        GTEST_SKIP() << "this Kokkos has no OpenMP: " << runtime_description();
    std::string one;
    for (const std::string threads : {"1", "2", "3"}) {
        const RunResult run = run_this_test_program("PairSum.a_second_time_has_the_same_bits",
                                                    "OMP_NUM_THREADS=" + threads);
        ASSERT_EQ(run.status, 0) << run.out;
        const std::size_t at = run.out.find("threads " + threads + " fingerprint ");
        ASSERT_NE(at, std::string::npos) << run.out;
        std::istringstream words(run.out.substr(at));
        std::string skipped, fingerprint;
        words >> skipped >> skipped >> skipped >> fingerprint;
        if (one.empty()) one = fingerprint;
        EXPECT_EQ(fingerprint, one) << threads << " threads";
    }
}

TEST(PairSum, sums_by_rows_add_along_the_row) {
    const Case c = cloud(300, 7, 0.15);
    ConnectivityMap map;
    rebuild(map, c);
    const Force force{c.lists[0].x.data(), c.dim};
    const Expected e = brute_force(c);
    const View<double> out("out", 900);
    const RowPairs of(map);
    add_pairs_by_rows(HostExec(), of.view(map), force, out);
    for (int a = 0; a < 300; ++a)
        for (int d = 0; d < 3; ++d) {
            double sum = 0;
            for (auto t = e.row_offsets[static_cast<std::size_t>(a)];
                 t < e.row_offsets[static_cast<std::size_t>(a + 1)]; ++t) {
                const Slot b = e.row_slots[static_cast<std::size_t>(t)];
                const auto add = force(0, std::min(a, b), std::max(a, b));
                sum += a < b ? add.i[d] : add.j[d];
            }
            ASSERT_EQ(out(3 * a + d), sum);
        }
}

}  // namespace
}  // namespace connectivity::test
