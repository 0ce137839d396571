// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_kernels.hpp"

#include "base/isa.hpp"

namespace connectivity::detail {

LatticeKernel lattice_kernel() {
#if defined(CONNECTIVITY_X86_KERNELS)
    if (isa() == Isa::avx512) return lattice_kernel_avx512;
    if (isa() == Isa::avx2) return lattice_kernel_avx2;
#endif
    return lattice_kernel_portable;
}

}  // namespace connectivity::detail
