// SPDX-License-Identifier: BSD-3-Clause
#include "kernels.hpp"

#include "base/isa.hpp"

namespace connectivity::detail {

template <int Dim>
const Kernels<Dim>& kernels() {
#if defined(CONNECTIVITY_X86_KERNELS)
    if (isa() == Isa::avx512) return avx512_kernels<Dim>();
    if (isa() == Isa::avx2) return avx2_kernels<Dim>();
#endif
    return portable_kernels<Dim>();
}

template const Kernels<1>& kernels<1>();
template const Kernels<2>& kernels<2>();
template const Kernels<3>& kernels<3>();

}  // namespace connectivity::detail
