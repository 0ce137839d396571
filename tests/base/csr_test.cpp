// SPDX-License-Identifier: BSD-3-Clause
// The CSR builder: count, scan, fill; what readers hold stays; nothing visible changes before
// commit.

#include <numeric>

#include <gtest/gtest.h>

#include <connectivity/base/csr.hpp>
#include <connectivity/base/runtime.hpp>

#include <support/expect_error.hpp>

#if defined(__SANITIZE_ADDRESS__)
/// A request for more memory than there is must come back as an error, not end the program.
extern "C" __attribute__((visibility("default"))) const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "allocator_may_return_null=1"; }
#endif

namespace connectivity::test {
namespace {

/// Row i has length[i] values 100 i, 100 i + 1, ...
void build(Csr& csr, const std::vector<Offset>& length) {
    csr.prepare(static_cast<Offset>(length.size()),
                [&](Offset i) { return length[static_cast<std::size_t>(i)]; });
    csr.reserve();
    csr.commit(
        [](Offset first, Offset last, const Offset* offsets, Slot* values) {
            for (Offset i = first; i < last; ++i)
                for (Offset k = offsets[i]; k < offsets[i + 1]; ++k)
                    values[k] = static_cast<Slot>(100 * i + k - offsets[i]);
        },
        3);
}

using Rows = std::vector<std::vector<Slot>>;

template <class Offsets, class Values>
Rows rows_of(const Offsets& offsets, const Values& values) {
    Rows rows;
    for (std::size_t i = 0; i + 1 < offsets.size(); ++i)
        rows.emplace_back(values.data() + offsets(i), values.data() + offsets(i + 1));
    return rows;
}

Rows wanted(const std::vector<Offset>& length) {
    Rows rows;
    for (std::size_t i = 0; i < length.size(); ++i) {
        rows.emplace_back(static_cast<std::size_t>(length[i]));
        std::iota(rows[i].begin(), rows[i].end(), static_cast<Slot>(100 * i));
    }
    return rows;
}

class CsrBuilder : public ::testing::Test {
protected:
    void SetUp() override { start_runtime(); }
    Csr csr_{"test/csr"};
};

TEST_F(CsrBuilder, rows_hold_what_was_counted_and_filled) {
    for (const std::vector<Offset>& length : {std::vector<Offset>{},
                                              {0},
                                              {3},
                                              {0, 0, 0},
                                              {1, 0, 5, 2, 0, 0, 7, 0},
                                              std::vector<Offset>(200, 3)}) {
        build(csr_, length);
        EXPECT_EQ(csr_.n_rows(), static_cast<Offset>(length.size()));
        EXPECT_EQ(csr_.n_values(), std::accumulate(length.begin(), length.end(), Offset{0}));
        EXPECT_EQ(csr_.offsets().size(), length.size() + 1);
        EXPECT_EQ(csr_.offsets()(0), 0);
        EXPECT_EQ(rows_of(csr_.offsets(), csr_.values()), wanted(length));
    }
}

TEST_F(CsrBuilder, each_row_is_counted_once_and_filled_once) {
    const Offset n = 1000;
    std::vector<int> counted(n), filled(n);
    csr_.prepare(n, [&](Offset i) {
        ++counted[static_cast<std::size_t>(i)];
        return i % 3;
    });
    csr_.reserve();
    csr_.commit([&](Offset first, Offset last, const Offset*, Slot*) {
        for (Offset i = first; i < last; ++i) ++filled[static_cast<std::size_t>(i)];
    });
    EXPECT_EQ(counted, std::vector<int>(n, 1));
    EXPECT_EQ(filled, std::vector<int>(n, 1));
}

TEST_F(CsrBuilder, nothing_visible_changes_before_commit) {
    build(csr_, {1, 2, 3});
    csr_.prepare(5, [](Offset) { return 40; });
    csr_.reserve();
    EXPECT_EQ(csr_.n_prepared(), 200);
    EXPECT_EQ(csr_.prepared_offsets()[5], 200);
    EXPECT_EQ(rows_of(csr_.offsets(), csr_.values()), wanted({1, 2, 3}));
    csr_.prepare(2, [](Offset) { return 1; });  // given up and begun anew
    EXPECT_EQ(rows_of(csr_.offsets(), csr_.values()), wanted({1, 2, 3}));
    build(csr_, {4, 4});
    EXPECT_EQ(rows_of(csr_.offsets(), csr_.values()), wanted({4, 4}));
}

TEST_F(CsrBuilder, counts_beyond_32_bits_are_exact_and_cost_nothing) {
    build(csr_, {2, 2});
    const Offset big = Offset{1} << 31;
    const Offset bytes = csr_.prepare(5, [=](Offset i) { return big + i; });
    EXPECT_EQ(csr_.n_prepared(), 5 * big + 10);
    EXPECT_EQ(bytes, (5 * big + 10) * 4 + 6 * 8);
    EXPECT_EQ(rows_of(csr_.offsets(), csr_.values()), wanted({2, 2}));
}

TEST_F(CsrBuilder, memory_that_does_not_exist_is_an_error_and_the_rows_stay) {
    build(csr_, {2, 2});
    csr_.prepare(3, [](Offset) { return Offset{1} << 45; });
    EXPECT_TRUE(fails_with(Status::memory, {"test/csr"}, [&] { csr_.reserve(); }));
    EXPECT_EQ(rows_of(csr_.offsets(), csr_.values()), wanted({2, 2}));
    build(csr_, {0, 5});
    EXPECT_EQ(rows_of(csr_.offsets(), csr_.values()), wanted({0, 5}));
}

TEST_F(CsrBuilder, views_that_readers_hold_never_change) {
    struct Held {
        ConstView<Offset> offsets;
        ConstView<Slot> values;
        Rows rows;
    };
    std::vector<Held> held;
    for (int k = 0; k < 10; ++k) {
        const std::vector<Offset> length(static_cast<std::size_t>(20 - k), k % 4);
        build(csr_, length);
        held.push_back({csr_.offsets(), csr_.values(), wanted(length)});
        for (const Held& h : held) EXPECT_EQ(rows_of(h.offsets, h.values), h.rows);
    }
    csr_.clear();
    for (const Held& h : held) EXPECT_EQ(rows_of(h.offsets, h.values), h.rows);
}

TEST_F(CsrBuilder, storage_nobody_holds_is_used_again) {
    build(csr_, std::vector<Offset>(50, 4));
    const Slot* const values = csr_.values().data();
    const Offset bytes = csr_.bytes();
    for (int k = 0; k < 6; ++k) {
        build(csr_, std::vector<Offset>(50, k % 5));
        EXPECT_EQ(csr_.values().data(), values);
    }
    EXPECT_LE(csr_.bytes(), 2 * bytes);  // the second set of offsets came with the second build
}

TEST_F(CsrBuilder, clearing_gives_the_memory_back) {
    build(csr_, {3, 3});
    csr_.clear();
    EXPECT_EQ(csr_.bytes(), 0);
    EXPECT_EQ(csr_.n_rows(), 0);
    EXPECT_EQ(csr_.n_values(), 0);
    build(csr_, {1});
    EXPECT_EQ(rows_of(csr_.offsets(), csr_.values()), wanted({1}));
}

TEST_F(CsrBuilder, offsets_have_64_bits_and_values_32) {
    static_assert(std::is_same_v<decltype(csr_.offsets())::non_const_value_type, std::int64_t>);
    static_assert(std::is_same_v<decltype(csr_.values())::non_const_value_type, std::int32_t>);
}

}  // namespace
}  // namespace connectivity::test
