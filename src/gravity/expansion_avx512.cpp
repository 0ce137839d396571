// SPDX-License-Identifier: BSD-3-Clause
// The operators of expansions with AVX-512 F, VL, DQ and BW: eight lanes.
#include <immintrin.h>

#include "expansion_impl.hpp"

namespace connectivity::detail {
namespace {

struct Avx512 {
    static constexpr int lanes = 8;
    using D = __m512d;
    static D load(const double* p) { return _mm512_loadu_pd(p); }
    static D load_some(const double* p, int n) {
        return _mm512_maskz_loadu_pd(static_cast<__mmask8>((1u << n) - 1), p);
    }
    static void store(double* p, D a) { _mm512_storeu_pd(p, a); }
    static D set(double a) { return _mm512_set1_pd(a); }
    static D add(D a, D b) { return _mm512_add_pd(a, b); }
    static D sub(D a, D b) { return _mm512_sub_pd(a, b); }
    static D mul(D a, D b) { return _mm512_mul_pd(a, b); }
    static D fma(D a, D b, D c) { return _mm512_fmadd_pd(a, b, c); }
    static D fnma(D a, D b, D c) { return _mm512_fnmadd_pd(a, b, c); }
    static D select_le(D a, D b, D yes, D no) {
        return _mm512_mask_blend_pd(_mm512_cmp_pd_mask(a, b, _CMP_LE_OQ), no, yes);
    }
    /// An estimate of 14 bits, made 42 by a step of third order and full by one of second order.
    static D rsqrt(D a) {
        const D half = set(0.5);
        D r = _mm512_rsqrt14_pd(a);
        D e = fnma(mul(a, r), r, set(1));
        r = fma(mul(r, e), fma(set(0.375), e, half), r);
        e = fnma(mul(a, r), r, set(1));
        return fma(mul(r, half), e, r);
    }
    static D gather(const double* base, const std::int32_t* at) {
        return _mm512_set_pd(base[at[7]], base[at[6]], base[at[5]], base[at[4]], base[at[3]],
                             base[at[2]], base[at[1]], base[at[0]]);
    }
    static constexpr int columns = 4;
    /// Halves of rows side by side: a third fewer shuffles than with whole rows.
    static void gather_columns(const double* const* row, int first, D* out) {
        D even[2], odd[2];
        for (int k = 0; k < 2; ++k) {
            const D a = halves(row[4 * k] + first, row[4 * k + 2] + first),
                    b = halves(row[4 * k + 1] + first, row[4 * k + 3] + first);
            even[k] = _mm512_unpacklo_pd(a, b);
            odd[k] = _mm512_unpackhi_pd(a, b);
        }
        out[0] = _mm512_shuffle_f64x2(even[0], even[1], 0x88);
        out[1] = _mm512_shuffle_f64x2(odd[0], odd[1], 0x88);
        out[2] = _mm512_shuffle_f64x2(even[0], even[1], 0xdd);
        out[3] = _mm512_shuffle_f64x2(odd[0], odd[1], 0xdd);
    }
    static D halves(const double* low, const double* high) {
        return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(low)),
                                  _mm256_loadu_pd(high), 1);
    }
    static void transpose(D (&a)[lanes]) {
        D b[8];
        for (int k = 0; k < 4; ++k) {
            b[2 * k] = _mm512_unpacklo_pd(a[2 * k], a[2 * k + 1]);
            b[2 * k + 1] = _mm512_unpackhi_pd(a[2 * k], a[2 * k + 1]);
        }
        for (int k = 0; k < 2; ++k) {  // columns 0, 4 | 2, 6 and 1, 5 | 3, 7
            const D low = _mm512_shuffle_f64x2(b[k], b[2 + k], 0x88),
                    high = _mm512_shuffle_f64x2(b[4 + k], b[6 + k], 0x88),
                    low2 = _mm512_shuffle_f64x2(b[k], b[2 + k], 0xdd),
                    high2 = _mm512_shuffle_f64x2(b[4 + k], b[6 + k], 0xdd);
            a[k] = _mm512_shuffle_f64x2(low, high, 0x88);
            a[4 + k] = _mm512_shuffle_f64x2(low, high, 0xdd);
            a[2 + k] = _mm512_shuffle_f64x2(low2, high2, 0x88);
            a[6 + k] = _mm512_shuffle_f64x2(low2, high2, 0xdd);
        }
    }
};

}  // namespace

const ExpansionKernels avx512_expansion_kernels = make_expansion_kernels<Avx512>("avx512");

}  // namespace connectivity::detail
