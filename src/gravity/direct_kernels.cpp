// SPDX-License-Identifier: BSD-3-Clause
#include "direct_kernels.hpp"

#include "base/isa.hpp"

namespace connectivity::detail {

const DirectKernels& direct_kernels() {
#if defined(CONNECTIVITY_X86_KERNELS)
    if (isa() == Isa::avx512) return avx512_direct_kernels;
    if (isa() == Isa::avx2) return avx2_direct_kernels;
#endif
    return portable_direct_kernels;
}

}  // namespace connectivity::detail
