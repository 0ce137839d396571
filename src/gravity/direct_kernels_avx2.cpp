// SPDX-License-Identifier: BSD-3-Clause
// The sums over pairs with AVX2.
#include <immintrin.h>

#include "direct_kernels_impl.hpp"

namespace connectivity::detail {
namespace {

struct Avx2Double {
    using T = double;
    using F = __m256d;
    static constexpr int lanes = 4, tile = 1, step = 2;
    static constexpr T root_scale = 1;
    static F load(const T* p) { return _mm256_loadu_pd(p); }
    static void store(T* p, F a) { _mm256_storeu_pd(p, a); }
    static void store(float* p, F a) { _mm_storeu_ps(p, _mm256_cvtpd_ps(a)); }
    static __m256i first(int n) {
        return _mm256_cmpgt_epi64(_mm256_set1_epi64x(n), _mm256_setr_epi64x(0, 1, 2, 3));
    }
    static F load_some(const T* p, __m256i some) { return _mm256_maskload_pd(p, some); }
    static F set(T a) { return _mm256_set1_pd(a); }
    static F add(F a, F b) { return _mm256_add_pd(a, b); }
    static F sub(F a, F b) { return _mm256_sub_pd(a, b); }
    static F mul(F a, F b) { return _mm256_mul_pd(a, b); }
    static F max(F a, F b) { return _mm256_max_pd(a, b); }
    static F fma(F a, F b, F c) { return _mm256_fmadd_pd(a, b, c); }
    static T sum(F a) {
        const __m128d half = _mm_add_pd(_mm256_castpd256_pd128(a), _mm256_extractf128_pd(a, 1));
        return _mm_cvtsd_f64(_mm_add_sd(half, _mm_unpackhi_pd(half, half)));
    }
    static bool all_zero(F a) {
        return _mm256_movemask_pd(_mm256_cmp_pd(a, set(0), _CMP_EQ_OQ)) == 0xf;
    }
    static F where_nonzero(F r2, F a) {
        const __m256i zero = _mm256_cmpeq_epi64(_mm256_castpd_si256(r2), _mm256_setzero_si256());
        return _mm256_andnot_pd(_mm256_castsi256_pd(zero), a);
    }
    /// From the 12 bits of a float: with e = 1 - d2 r², 1/sqrt(d2) is r (1 - e)^(-1/2), whose
    /// series ends where e^5 < 2^-52. Infinite or NaN where a float cannot hold d2.
    static F inverse_root(F d2, F r2) {
        const F r = where_nonzero(r2, _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(d2))));
        const F e = _mm256_fnmadd_pd(mul(d2, r), r, set(1));
        const F series = fma(fma(fma(set(0.2734375), e, set(0.3125)), e, set(0.375)), e, set(0.5));
        return fma(mul(r, e), series, r);
    }
    static F exact_inverse_root(F d2, F r2) {
        return where_nonzero(r2, _mm256_div_pd(set(1), _mm256_sqrt_pd(d2)));
    }
};

struct Avx2Float {
    using T = float;
    using F = __m256;
    static constexpr int lanes = 8, tile = 1, step = 2;
    static constexpr T root_scale = 2;
    static F load(const T* p) { return _mm256_loadu_ps(p); }
    static void store(T* p, F a) { _mm256_storeu_ps(p, a); }
    static F set(T a) { return _mm256_set1_ps(a); }
    static F add(F a, F b) { return _mm256_add_ps(a, b); }
    static F sub(F a, F b) { return _mm256_sub_ps(a, b); }
    static F mul(F a, F b) { return _mm256_mul_ps(a, b); }
    static F max(F a, F b) { return _mm256_max_ps(a, b); }
    static F fma(F a, F b, F c) { return _mm256_fmadd_ps(a, b, c); }
    static T sum(F a) {
        __m128 s = _mm_add_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
        s = _mm_add_ps(s, _mm_movehl_ps(s, s));
        return _mm_cvtss_f32(_mm_add_ss(s, _mm_movehdup_ps(s)));
    }
    static bool all_zero(F a) {
        return _mm256_movemask_ps(_mm256_cmp_ps(a, set(0), _CMP_EQ_OQ)) == 0xff;
    }
    static F where_nonzero(F r2, F a) {
        const __m256i zero = _mm256_cmpeq_epi32(_mm256_castps_si256(r2), _mm256_setzero_si256());
        return _mm256_andnot_ps(_mm256_castsi256_ps(zero), a);
    }
    /// From 12 bits by Newton's step, without its factor 1/2.
    static F inverse_root(F d2, F r2) {
        const F r = where_nonzero(r2, _mm256_rsqrt_ps(d2));
        return mul(r, _mm256_fnmadd_ps(mul(d2, r), r, set(3)));
    }
    static F exact_inverse_root(F d2, F r2) {
        return where_nonzero(r2, _mm256_div_ps(set(1), _mm256_sqrt_ps(d2)));
    }
};

}  // namespace

const DirectKernels avx2_direct_kernels{"avx2", add<Avx2Double>, add<Avx2Float>,
                                        gather<Avx2Double, double>, gather<Avx2Double, float>};

}  // namespace connectivity::detail
