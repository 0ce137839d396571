// SPDX-License-Identifier: BSD-3-Clause
#include "bit_rows.hpp"

namespace connectivity::detail {

namespace {

void unite(const std::uint64_t* rows, long stride, const int* which, int n, std::uint64_t* out) {
    for (long w = 0; w < stride; w += row_words) {
        std::uint64_t sum[row_words] = {};
        for (int k = 0; k < n; ++k) {
            const std::uint64_t* const row = rows + which[k] * stride + w;
            for (int j = 0; j < row_words; ++j) sum[j] |= row[j];
        }
        for (int j = 0; j < row_words; ++j) out[w + j] = sum[j];
    }
}

}  // namespace

const BitRowKernels& bit_row_kernels() {
    static constexpr BitRowKernels portable{unite};
    return portable;
}

}  // namespace connectivity::detail
