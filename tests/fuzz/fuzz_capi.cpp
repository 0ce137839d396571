// SPDX-License-Identifier: BSD-3-Clause
// libFuzzer chooses calls of the C interface and their arguments. Any status may come back, but
// nothing crashes, leaks or hangs, and afterwards the library still finds the right neighbours.

#include <cstdio>
#include <cstdlib>
#include <span>

#include <capi/fuzz_calls.hpp>

#include "leaks.hpp"

namespace connectivity::test {
namespace {

struct Counts {
    long long inputs = 0, calls = 0, built = 0, views = 0, traversed = 0, patched = 0, summed = 0,
              bounded = 0;
} counts;

void at_end() {
    check_for_leaks();
    std::fprintf(stderr,
                 "fuzz_capi: %lld inputs, %lld calls; of these got through: %lld rebuilds, %lld "
                 "views, %lld traversals, %lld patches, %lld sums, %lld boundaries\n",
                 counts.inputs, counts.calls, counts.built, counts.views, counts.traversed,
                 counts.patched, counts.summed, counts.bounded);
}

/// The first byte says who the host is and whether it begins with a map; all others what it calls.
class Calls : public Fuzz {
public:
    explicit Calls(std::span<const std::uint8_t> bytes) : Fuzz(bytes.empty() ? 0 : bytes[0]) {
        if (!bytes.empty() && bytes[0] % 4 < 2) begin_well();
        random_ = Random(bytes.empty() ? bytes : bytes.subspan(1));
    }
    void make_all() {
        constexpr int most = 200;
        int n = 0;
        for (; n < most && !random_.exhausted(); ++n) call();
        counts.calls += n;
        counts.built += n_built;
        counts.views += n_views;
        counts.traversed += n_traversed;
        counts.patched += n_patched;
        counts.summed += n_summed;
        counts.bounded += n_bounded;
    }
};

void check_that_it_still_works() {
    static const NodeSet set = random_nodes(3, 30, 1);
    static const Lists expected = brute_force(3, {set});
    EXPECT_EQ(lists_of(Context(), 3, {set}), expected);
}

}  // namespace
}  // namespace connectivity::test

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    ::testing::GTEST_FLAG(break_on_failure) = true;  // libFuzzer keeps the input of an abort
    std::atexit(connectivity::test::at_end);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace connectivity::test;
    Calls(std::span(data, size)).make_all();
    if (++counts.inputs % 64 == 0) check_that_it_still_works();
    if (counts.inputs % 512 == 0) check_for_leaks();
    return 0;
}
