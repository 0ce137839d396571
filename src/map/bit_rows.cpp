// SPDX-License-Identifier: BSD-3-Clause
#include "bit_rows.hpp"

#include <string_view>

#include "search/kernels.hpp"

namespace connectivity::detail {

/// The search has looked at the processor already.
const BitRowKernels& bit_row_kernels() {
#if defined(CONNECTIVITY_X86_KERNELS)
    const std::string_view name = kernels<3>().name;
    if (name == "avx512") return avx512_bit_row_kernels;
    if (name == "avx2") return avx2_bit_row_kernels;
#endif
    return portable_bit_row_kernels;
}

}  // namespace connectivity::detail
