// SPDX-License-Identifier: BSD-3-Clause
// The far images' kernel with AVX2 and FMA: four lanes.
#include <immintrin.h>

#include "lattice_kernels_impl.hpp"

namespace connectivity::detail {
namespace {

struct Avx2 {
    static constexpr int lanes = 4;
    using D = __m256d;
    static D load(const double* p) { return _mm256_loadu_pd(p); }
    static void store(double* p, D a) { _mm256_storeu_pd(p, a); }
    static D set(double a) { return _mm256_set1_pd(a); }
    static D add(D a, D b) { return _mm256_add_pd(a, b); }
    static D fma(D a, D b, D c) { return _mm256_fmadd_pd(a, b, c); }
    static D fnma(D a, D b, D c) { return _mm256_fnmadd_pd(a, b, c); }
};

}  // namespace

void lattice_kernel_avx2(int order, const double* sums, const double* moments, double* locals) {
    apply_lattice<Avx2>(order, sums, moments, locals);
}

}  // namespace connectivity::detail
