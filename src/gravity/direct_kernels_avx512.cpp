// SPDX-License-Identifier: BSD-3-Clause
// The sums over pairs with AVX-512.
#include <immintrin.h>

#include "direct_kernels_impl.hpp"

namespace connectivity::detail {
namespace {

struct Avx512Double {
    using T = double;
    using F = __m512d;
    static constexpr int lanes = 8, tile = 2, step = 1;
    static constexpr T root_scale = 1;
    static F load(const T* p) { return _mm512_loadu_pd(p); }
    static void store(T* p, F a) { _mm512_storeu_pd(p, a); }
    static void store(float* p, F a) { _mm256_storeu_ps(p, _mm512_cvtpd_ps(a)); }
    static __mmask8 first(int n) { return static_cast<__mmask8>((1 << n) - 1); }
    static F load_some(const T* p, __mmask8 some) { return _mm512_maskz_loadu_pd(some, p); }
    static F set(T a) { return _mm512_set1_pd(a); }
    static F add(F a, F b) { return _mm512_add_pd(a, b); }
    static F sub(F a, F b) { return _mm512_sub_pd(a, b); }
    static F mul(F a, F b) { return _mm512_mul_pd(a, b); }
    static F max(F a, F b) { return _mm512_max_pd(a, b); }
    static F fma(F a, F b, F c) { return _mm512_fmadd_pd(a, b, c); }
    static T sum(F a) { return _mm512_reduce_add_pd(a); }
    static bool all_zero(F a) { return _mm512_cmp_pd_mask(a, set(0), _CMP_EQ_OQ) == 0xff; }
    static __mmask8 nonzero(F a) {
        return _mm512_test_epi64_mask(_mm512_castpd_si512(a), _mm512_castpd_si512(a));
    }
    /// From 14 bits: with e = 1 - d2 r², 1/sqrt(d2) is r (1 - e)^(-1/2), whose series ends where
    /// e^4 < 2^-52.
    static F inverse_root(F d2, F r2) {
        const F r = _mm512_maskz_rsqrt14_pd(nonzero(r2), d2);
        const F e = _mm512_fnmadd_pd(mul(d2, r), r, set(1));
        return fma(mul(r, e), fma(fma(set(0.3125), e, set(0.375)), e, set(0.5)), r);
    }
    static F exact_inverse_root(F d2, F r2) {
        return _mm512_maskz_div_pd(nonzero(r2), set(1), _mm512_sqrt_pd(d2));
    }
};

struct Avx512Float {
    using T = float;
    using F = __m512;
    static constexpr int lanes = 16, tile = 2, step = 1;
    static constexpr T root_scale = 2;
    static F load(const T* p) { return _mm512_loadu_ps(p); }
    static void store(T* p, F a) { _mm512_storeu_ps(p, a); }
    static F set(T a) { return _mm512_set1_ps(a); }
    static F add(F a, F b) { return _mm512_add_ps(a, b); }
    static F sub(F a, F b) { return _mm512_sub_ps(a, b); }
    static F mul(F a, F b) { return _mm512_mul_ps(a, b); }
    static F max(F a, F b) { return _mm512_max_ps(a, b); }
    static F fma(F a, F b, F c) { return _mm512_fmadd_ps(a, b, c); }
    static T sum(F a) { return _mm512_reduce_add_ps(a); }
    static bool all_zero(F a) { return _mm512_cmp_ps_mask(a, set(0), _CMP_EQ_OQ) == 0xffff; }
    static __mmask16 nonzero(F a) {
        return _mm512_test_epi32_mask(_mm512_castps_si512(a), _mm512_castps_si512(a));
    }
    /// From 14 bits by Newton's step, without its factor 1/2.
    static F inverse_root(F d2, F r2) {
        const F r = _mm512_maskz_rsqrt14_ps(nonzero(r2), d2);
        return mul(r, _mm512_fnmadd_ps(mul(d2, r), r, set(3)));
    }
    static F exact_inverse_root(F d2, F r2) {
        return _mm512_maskz_div_ps(nonzero(r2), set(1), _mm512_sqrt_ps(d2));
    }
};

}  // namespace

const DirectKernels avx512_direct_kernels{"avx512", add<Avx512Double>, add<Avx512Float>,
                                          gather<Avx512Double, double>,
                                          gather<Avx512Double, float>};

}  // namespace connectivity::detail
