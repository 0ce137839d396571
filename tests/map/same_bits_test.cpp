// SPDX-License-Identifier: BSD-3-Clause
// The same bits with any number of threads and any instruction set. Both are fixed for a process,
// so this program runs itself and compares fingerprints of all results.

#include <iostream>
#include <span>
#include <sstream>

#include <gtest/gtest.h>

#include <connectivity/base/runtime.hpp>

#include <support/hash.hpp>
#include <support/process.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

void add_result(Fnv1a& hash, ConnectivityMap& map) {
    hash.add_view(map.rows().offsets);
    hash.add_view(map.rows().slots);
    hash.add_view(map.spatial_order());
    if (!map.options().pairs) return;
    const auto pairs = map.pairs().expanded_view();
    hash.add_view(pairs.offsets);
    hash.add_view(pairs.j);
    hash.add_view(pairs.i);
}

void add_case(Fnv1a& hash, ConnectivityMap& map, const Case& c,
              std::span<const SearchMethod> methods = all_methods) {
    for (const SearchMethod method : methods) {
        MapOptions options = map_options(c, method);
        options.spatial_order = true;
        map.rebuild(node_lists(c), options);
        add_result(hash, map);
    }
}

/// Two clouds large enough for every thread to get work.
Case large_cloud(bool periodic) {
    Random random(99);
    Case c = uniform_case(3, {}, 0);
    for (int k = 0; k < 3 * 12000; ++k) c.lists[0].x.push_back(random.uniform());
    for (int k = 0; k < 12000; ++k) c.lists[0].h.push_back(random.log_uniform(0.005, 0.1));
    c.lists[0].n_internal = 11000;
    c.domain.periodic = {periodic, periodic, periodic};
    c.domain.hi = {1, 1, 1};
    return c;
}

std::uint64_t fingerprint_of_all_results() {
    ConnectivityMap map;
    Fnv1a hash;
    constexpr SearchMethod parallel[] = {SearchMethod::groups, SearchMethod::device,
                                         SearchMethod::automatic};
    for (std::uint64_t seed = 0; seed < 120; ++seed)
        add_case(hash, map,
                 random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 1, 300, 0}));
    for (std::uint64_t seed = 0; seed < 6; ++seed)
        add_case(hash, map,
                 random_case(seed, {static_cast<int>(seed % 3) + 1, seed % 2 == 1, 3000, 2000}),
                 parallel);
    add_case(hash, map, large_cloud(false), parallel);
    add_case(hash, map, large_cloud(true), parallel);
    return hash.value();
}

/// Also run by the tests below, in processes of their own.
TEST(SameBits, a_second_time_agrees) {
    const std::uint64_t first = fingerprint_of_all_results();
    EXPECT_EQ(fingerprint_of_all_results(), first);
    std::cout << "\nthreads: " << runtime_threads() << "\nfingerprint: " << std::hex << first
              << std::endl;
}

/// The rest of the line that begins with a word.
std::string line_after(const std::string& text, const std::string& word) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        if (line.rfind(word, 0) == 0) return line.substr(word.size());
    return "";
}

std::string fingerprint(const std::string& environment, const std::string& threads) {
    const RunResult run = run_this_test_program("SameBits.a_second_time_agrees", environment);
    EXPECT_EQ(run.status, 0) << run.out;
    EXPECT_EQ(line_after(run.out, "threads: "), threads) << environment;
    const std::string value = line_after(run.out, "fingerprint: ");
    EXPECT_NE(value, "") << run.out;
    return value;
}

TEST(SameBits, one_two_and_three_threads_agree) {
    start_runtime();
    if (runtime_description().find("OpenMP") == std::string::npos)
        GTEST_SKIP() << "this Kokkos has no OpenMP: " << runtime_description();
    const std::string one = fingerprint("OMP_NUM_THREADS=1", "1");
    EXPECT_EQ(fingerprint("OMP_NUM_THREADS=2", "2"), one);
    EXPECT_EQ(fingerprint("OMP_NUM_THREADS=3", "3"), one);
}

TEST(SameBits, all_instruction_sets_agree) {
    const std::string widest = fingerprint("OMP_NUM_THREADS=1", "1");
    for (const char* set : {"portable", "avx2",
                            "avx512"})  // one that the processor lacks gives way to a narrower one
        EXPECT_EQ(fingerprint(std::string("OMP_NUM_THREADS=1 CONNECTIVITY_ISA=") + set, "1"),
                  widest)
            << set;
}

}  // namespace
}  // namespace connectivity::test
