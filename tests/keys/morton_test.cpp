// SPDX-License-Identifier: BSD-3-Clause
// Morton keys against an interleave written bit by bit, and the cell rule at its edges.

#include <filesystem>
#include <fstream>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <connectivity/base/runtime.hpp>
#include <connectivity/keys/morton.hpp>
#include <support/random.hpp>
#include <support/shared_data.hpp>

namespace connectivity::test {
namespace {

template <int Dim>
std::uint64_t interleave_bit_by_bit(const std::uint64_t (&cell)[Dim]) {
    std::uint64_t key = 0;
    for (int bit = 0; bit < 63 / Dim; ++bit)
        for (int d = 0; d < Dim; ++d)
            if (cell[d] >> bit & 1) key |= std::uint64_t{1} << (bit * Dim + d);
    return key;
}

template <int Dim>
void expect_true_interleave() {
    Random random(7);
    for (int k = 0; k < 2000; ++k) {
        std::uint64_t cell[Dim];
        for (auto& c : cell)
            c = static_cast<std::uint64_t>(random.uniform() *
                                           static_cast<double>(std::uint64_t{1} << key_bits<Dim>));
        ASSERT_EQ(interleave<Dim>(cell), interleave_bit_by_bit<Dim>(cell)) << "dim " << Dim;
    }
    std::uint64_t last[Dim];
    for (auto& c : last) c = (std::uint64_t{1} << key_bits<Dim>)-1;
    EXPECT_EQ(interleave<Dim>(last), (std::uint64_t{1} << (key_bits<Dim> * Dim)) - 1);
}

View<double> view_of(const std::vector<double>& values) {
    auto view = allocate<double>("test", static_cast<Offset>(values.size()));
    for (std::size_t k = 0; k < values.size(); ++k) view(k) = values[k];
    return view;
}

TEST(Morton, keys_interleave_the_bits_of_all_axes_x_lowest) {
    expect_true_interleave<1>();
    expect_true_interleave<2>();
    expect_true_interleave<3>();
}

TEST(Morton, cells_are_half_open_and_the_last_one_is_closed) {
    const KeyBox<2> box{{-1, 10}, {1, 26}};
    const auto n = std::uint64_t{1} << 31;
    EXPECT_EQ(box.cell(-1, 0), 0u);
    EXPECT_EQ(box.cell(0, 0), n / 2);
    EXPECT_EQ(box.cell(-5e-10, 0), n / 2 - 1);
    EXPECT_EQ(box.cell(1, 0), n - 1);
    EXPECT_EQ(box.cell(14, 1), n / 4);
}

TEST(Morton, an_axis_of_no_width_has_one_cell) {
    start_runtime();
    const auto x = view_of({0, 5, 1, 5, 0.5, 5});
    const auto box = bounding_key_box<2>(x);
    EXPECT_EQ(box.cell(5, 1), 0u);
    const auto keys = morton_keys<2>(x, box);
    EXPECT_EQ(keys(0), 0u);
    EXPECT_LT(keys(0), keys(2));
    EXPECT_LT(keys(2), keys(1));
}

TEST(Morton, the_box_bounds_all_points) {
    start_runtime();
    const auto x = view_of({3, -2, 8, 1, 7, -9, 2, 2, 2});
    const auto box = bounding_key_box<3>(x);
    EXPECT_EQ(std::vector<double>(box.lo, box.lo + 3), (std::vector<double>{1, -2, -9}));
    EXPECT_EQ(std::vector<double>(box.hi, box.hi + 3), (std::vector<double>{3, 7, 8}));
}

TEST(Morton, keys_of_the_reference_case_are_met) {
    const std::filesystem::path file = shared_data("oracle/connectivity_cases.json");
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "reference cases are not here: " << file;
    start_runtime();
    const auto cases = nlohmann::json::parse(std::ifstream(file))["cases"];
    int checked = 0;
    for (const auto& c : cases) {
        if (!c["expected"].contains("morton_clean_keys") || c["dim"] != 2) continue;
        std::vector<double> x;
        std::vector<std::uint64_t> expected;
        for (const auto& list : c["nodeLists"])
            for (const auto& p : list["positions"])
                for (const auto& component : p) x.push_back(component.get<double>());
        for (const auto& list : c["expected"]["morton_clean_keys"])
            for (const auto& key : list) expected.push_back(key.get<std::uint64_t>());
        const auto keys = morton_keys<2>(view_of(x), bounding_key_box<2>(view_of(x)));
        EXPECT_EQ(std::vector<std::uint64_t>(keys.data(), keys.data() + keys.size()), expected)
            << c["name"];
        ++checked;
    }
    EXPECT_GT(checked, 0);
}

TEST(Morton, no_points_have_no_keys) {
    start_runtime();
    EXPECT_EQ(morton_keys<3>(view_of({}), bounding_key_box<3>(view_of({}))).size(), 0u);
}

}  // namespace
}  // namespace connectivity::test
