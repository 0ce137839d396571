// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Sets as rows of bits, one table of functions per instruction set, chosen at run time.
///
/// Raw pointers only, as in search/kernels.hpp, so that no wide code can leak into the baseline.
/// All tables give the same bits.

#include <cstdint>

namespace connectivity::detail {

constexpr int row_words = 8;  ///< rows are padded to a multiple: one line of the cache

/// Vectors to many nodes, component by component, and a direction that is scaled alike.
struct Slab {
    const double* x[3];  ///< [dim][64 * n_words]
    double u[3];
    double end;
    int dim;
};

struct BitRowKernels {
    /// out = union of rows[which[k]], k < n; a row has `stride` words, a multiple of row_words.
    void (*unite)(const std::uint64_t* rows, long stride, const int* which, int n,
                  std::uint64_t* out);
    /// Clears the bits of nodes whose sum of x·u, in the order of the axes, is not in [0, end].
    void (*keep_between)(const Slab& slab, std::uint64_t* bits, int n_words);
};

/// The table for this processor, or the one that CONNECTIVITY_ISA names.
const BitRowKernels& bit_row_kernels();

extern const BitRowKernels portable_bit_row_kernels;
#if defined(CONNECTIVITY_X86_KERNELS)
extern const BitRowKernels avx2_bit_row_kernels, avx512_bit_row_kernels;
#endif

constexpr long padded_words(long n_bits) {
    return (n_bits + 64 * row_words - 1) / (64 * row_words) * row_words;
}

}  // namespace connectivity::detail
