// SPDX-License-Identifier: BSD-3-Clause
// The operators of expansions with AVX2 and FMA: four lanes.
#include <immintrin.h>

#include "expansion_impl.hpp"

namespace connectivity::detail {
namespace {

struct Avx2 {
    static constexpr int lanes = 4;
    using D = __m256d;
    static D load(const double* p) { return _mm256_loadu_pd(p); }
    static D load_some(const double* p, int n) {
        const __m256i mask =
            _mm256_cmpgt_epi64(_mm256_set1_epi64x(n), _mm256_set_epi64x(3, 2, 1, 0));
        return _mm256_maskload_pd(p, mask);
    }
    static void store(double* p, D a) { _mm256_storeu_pd(p, a); }
    static D set(double a) { return _mm256_set1_pd(a); }
    static D add(D a, D b) { return _mm256_add_pd(a, b); }
    static D sub(D a, D b) { return _mm256_sub_pd(a, b); }
    static D mul(D a, D b) { return _mm256_mul_pd(a, b); }
    static D fma(D a, D b, D c) { return _mm256_fmadd_pd(a, b, c); }
    static D fnma(D a, D b, D c) { return _mm256_fnmadd_pd(a, b, c); }
    static D select_le(D a, D b, D yes, D no) {
        return _mm256_blendv_pd(no, yes, _mm256_cmp_pd(a, b, _CMP_LE_OQ));
    }
    static D rsqrt(D a) { return _mm256_div_pd(set(1), _mm256_sqrt_pd(a)); }
    static D gather(const double* base, const std::int32_t* at) {
        return _mm256_set_pd(base[at[3]], base[at[2]], base[at[1]], base[at[0]]);
    }
    static constexpr int columns = 4;
    static void gather_columns(const double* const* row, int first, D* out) {
        D a[4];
        for (int k = 0; k < 4; ++k) a[k] = load(row[k] + first);
        transpose(a);
        for (int k = 0; k < 4; ++k) out[k] = a[k];
    }
    static void transpose(D (&a)[lanes]) {
        const D p = _mm256_unpacklo_pd(a[0], a[1]), q = _mm256_unpackhi_pd(a[0], a[1]),
                r = _mm256_unpacklo_pd(a[2], a[3]), s = _mm256_unpackhi_pd(a[2], a[3]);
        a[0] = _mm256_permute2f128_pd(p, r, 0x20);
        a[1] = _mm256_permute2f128_pd(q, s, 0x20);
        a[2] = _mm256_permute2f128_pd(p, r, 0x31);
        a[3] = _mm256_permute2f128_pd(q, s, 0x31);
    }
};

}  // namespace

const ExpansionKernels avx2_expansion_kernels = make_expansion_kernels<Avx2>("avx2");

}  // namespace connectivity::detail
