// SPDX-License-Identifier: BSD-3-Clause
#include "bit_rows.hpp"

#include "base/isa.hpp"

namespace connectivity::detail {

const BitRowKernels& bit_row_kernels() {
#if defined(CONNECTIVITY_X86_KERNELS)
    if (isa() == Isa::avx512) return avx512_bit_row_kernels;
    if (isa() == Isa::avx2) return avx2_bit_row_kernels;
#endif
    return portable_bit_row_kernels;
}

}  // namespace connectivity::detail
