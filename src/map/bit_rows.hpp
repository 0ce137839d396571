// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Sets as rows of bits, one table of functions per instruction set, chosen at run time.
///
/// Raw pointers only, as in search/kernels.hpp, so that no wide code can leak into the baseline.

#include <cstdint>

namespace connectivity::detail {

constexpr int row_words = 8;  ///< rows are padded to a multiple: one line of the cache

struct BitRowKernels {
    /// out = union of rows[which[k]], k < n; a row has `stride` words, a multiple of row_words.
    void (*unite)(const std::uint64_t* rows, long stride, const int* which, int n,
                  std::uint64_t* out);
};

/// The table for this processor, or the one that CONNECTIVITY_ISA names.
const BitRowKernels& bit_row_kernels();

constexpr long padded_words(long n_bits) {
    return (n_bits + 64 * row_words - 1) / (64 * row_words) * row_words;
}

}  // namespace connectivity::detail
