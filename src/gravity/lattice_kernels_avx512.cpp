// SPDX-License-Identifier: BSD-3-Clause
// The far images' kernel with AVX-512 F: eight lanes.
#include <immintrin.h>

#include "lattice_kernels_impl.hpp"

namespace connectivity::detail {
namespace {

struct Avx512 {
    static constexpr int lanes = 8;
    using D = __m512d;
    static D load(const double* p) { return _mm512_loadu_pd(p); }
    static void store(double* p, D a) { _mm512_storeu_pd(p, a); }
    static D set(double a) { return _mm512_set1_pd(a); }
    static D add(D a, D b) { return _mm512_add_pd(a, b); }
    static D fma(D a, D b, D c) { return _mm512_fmadd_pd(a, b, c); }
    static D fnma(D a, D b, D c) { return _mm512_fnmadd_pd(a, b, c); }
};

}  // namespace

void lattice_kernel_avx512(int order, const double* sums, const double* moments, double* locals) {
    apply_lattice<Avx512>(order, sums, moments, locals);
}

}  // namespace connectivity::detail
