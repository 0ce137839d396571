// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Counting sorts of short lists of keys, in one thread, without comparisons.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include <connectivity/base/types.hpp>

namespace connectivity::detail {

using Keys = std::vector<std::uint64_t>;

/// Sorts by digit(key) < n_digits; equal ones keep their order. `spare` has the size of `keys`; the
/// two change places.
template <class Digit>
void stable_sort_by(Keys& keys, Keys& spare, std::vector<Offset>& counts, std::size_t n_digits,
                    const Digit& digit) {
    counts.assign(n_digits + 1, 0);
    for (const std::uint64_t key : keys) ++counts[static_cast<std::size_t>(digit(key)) + 1];
    for (std::size_t d = 1; d <= n_digits; ++d) counts[d] += counts[d - 1];
    for (const std::uint64_t key : keys)
        spare[static_cast<std::size_t>(counts[static_cast<std::size_t>(digit(key))]++)] = key;
    keys.swap(spare);
}

/// Sorts by the upper 32 bits, which must differ.
inline void sort_by_high_half(Keys& keys, Keys& spare, std::vector<Offset>& counts) {
    constexpr std::size_t few = 64;
    if (keys.size() <= few) return std::sort(keys.begin(), keys.end());
    const auto [low, high] = std::minmax_element(keys.begin(), keys.end());
    const std::uint64_t first = *low >> 32;
    const int bits = static_cast<int>(std::bit_width((*high >> 32) - first)),
              passes = (bits + 10) / 11, width = (bits + passes - 1) / passes;
    const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
    for (int pass = 0; pass < passes; ++pass)
        stable_sort_by(keys, spare, counts, std::size_t{1} << width, [=](std::uint64_t key) {
            return ((key >> 32) - first) >> (pass * width) & mask;
        });
}

}  // namespace connectivity::detail
