// SPDX-License-Identifier: BSD-3-Clause
#include "expansion_kernels.hpp"

#include <cmath>

#include <connectivity/gravity/options.hpp>

#include "base/isa.hpp"

namespace connectivity::detail {

static_assert(max_expansion_order == max_gravity_order);

const ExpansionKernels& expansion_kernels() {
#if defined(CONNECTIVITY_X86_KERNELS)
    if (isa() == Isa::avx512) return avx512_expansion_kernels;
    if (isa() == Isa::avx2) return avx2_expansion_kernels;
#endif
    return portable_expansion_kernels;
}

void expansion_power(int order, const double* moments, double* out) {
    double middle = 1;  // k!²
    for (int k = 0; k <= order; ++k) {
        if (k > 0) middle *= static_cast<double>(k) * k;
        const double* const c = moments + k * k;
        double sum = middle * c[0] * c[0], weight = middle;
        for (int m = 1; m <= k; ++m) {
            weight *= static_cast<double>(k + m) / (k - m + 1);  // (k-m)! (k+m)!
            sum += 2 * weight * (c[2 * m - 1] * c[2 * m - 1] + c[2 * m] * c[2 * m]);
        }
        out[k] = std::sqrt(sum);
    }
}

}  // namespace connectivity::detail
