// SPDX-License-Identifier: BSD-3-Clause
// The kernels with AVX-512 F, VL, DQ and BW: sixteen lanes.
#include <immintrin.h>

#include "kernels_impl.hpp"

namespace {

struct Avx512 {
    static constexpr int lanes = 16;
    using F = __m512;
    static F load(const float* p) { return _mm512_loadu_ps(p); }
    static F set(float a) { return _mm512_set1_ps(a); }
    static F sub(F a, F b) { return _mm512_sub_ps(a, b); }
    static F mul(F a, F b) { return _mm512_mul_ps(a, b); }
    static F fma(F a, F b, F c) { return _mm512_fmadd_ps(a, b, c); }
    static F div(F a, F b) { return _mm512_div_ps(a, b); }
    static F sqrt(F a) { return _mm512_sqrt_ps(a); }
    static F min(F a, F b) { return _mm512_min_ps(a, b); }
    static F max(F a, F b) { return _mm512_max_ps(a, b); }
    static void store(float* p, F a) { _mm512_storeu_ps(p, a); }
    static unsigned le(F a, F b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
    static constexpr int wide_lanes = 8;
    using D = __m512d;
    static D load_wide(const double* p) { return _mm512_loadu_pd(p); }
    static D set_wide(double a) { return _mm512_set1_pd(a); }
    static D sub(D a, D b) { return _mm512_sub_pd(a, b); }
    static D add(D a, D b) { return _mm512_add_pd(a, b); }
    static D mul(D a, D b) { return _mm512_mul_pd(a, b); }
    static D max(D a, D b) { return _mm512_max_pd(a, b); }
    static D div(D a, D b) { return _mm512_div_pd(a, b); }
    static D nearest(D a) {
        return _mm512_roundscale_pd(a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    }
    static unsigned le(D a, D b) { return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ); }
    static unsigned equal(D a, D b) { return _mm512_cmp_pd_mask(a, b, _CMP_EQ_OQ); }
    /// The columns of eight rows of N doubles each; loads and a transposition are five times as
    /// fast as gathers here.
    template <int N>
    static void gather_rows(const double* base, const int* row, D (&column)[N]) {
        constexpr __mmask8 all = (1 << N) - 1;
        D even[4], odd[4];  // columns 0, 2, 4 and 1, 3, 5 of two rows
        for (int k = 0; k < 4; ++k) {
            const D a = _mm512_maskz_loadu_pd(all, base + static_cast<long>(row[2 * k]) * N),
                    b = _mm512_maskz_loadu_pd(all, base + static_cast<long>(row[2 * k + 1]) * N);
            even[k] = _mm512_unpacklo_pd(a, b);
            odd[k] = _mm512_unpackhi_pd(a, b);
        }
        column[0] = join<0>(even);
        if constexpr (N > 1) column[1] = join<0>(odd);
        if constexpr (N > 2) column[2] = join<1>(even);
        if constexpr (N > 3) column[3] = join<1>(odd);
        if constexpr (N > 4) column[4] = join<2>(even);
        if constexpr (N > 5) column[5] = join<2>(odd);
    }
    /// Part `Part` (two doubles) of four vectors.
    template <int Part>
    static D join(const D (&p)[4]) {
        constexpr int both = Part * 0x55;
        return _mm512_shuffle_f64x2(_mm512_shuffle_f64x2(p[0], p[1], both),
                                    _mm512_shuffle_f64x2(p[2], p[3], both), 0x88);
    }
    static std::uint64_t deposit(std::uint64_t bits, std::uint64_t word) {
        return _pdep_u64(bits, word);
    }
    static int count(unsigned mask) { return __builtin_popcount(mask); }
    // Compress in a register, then a plain store: the memory form of vpcompressd is slow on Zen 4.
    static void pack(float* to, unsigned mask, F a) {
        _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(mask), a));
    }
    static void pack(int* to, unsigned mask, const int* from) {
        _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(mask),
                                                            _mm512_loadu_si512(from)));
    }
    static F load_doubles(const double* p, double centre, double scale) {
        const __m512d c = _mm512_set1_pd(centre), s = _mm512_set1_pd(scale);
        const __m256 low = _mm512_cvtpd_ps(_mm512_mul_pd(_mm512_sub_pd(_mm512_loadu_pd(p), c), s));
        const __m256 high =
            _mm512_cvtpd_ps(_mm512_mul_pd(_mm512_sub_pd(_mm512_loadu_pd(p + 8), c), s));
        return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
    }
    static int unpack(int* out, std::uint64_t word, const int* label) {
        pack(out, static_cast<unsigned>(word & 0xffff), label);
        pack(out + __builtin_popcountll(word & 0xffff), static_cast<unsigned>(word >> 16 & 0xffff),
             label + 16);
        pack(out + __builtin_popcountll(word & 0xffffffff),
             static_cast<unsigned>(word >> 32 & 0xffff), label + 32);
        pack(out + __builtin_popcountll(word << 16), static_cast<unsigned>(word >> 48), label + 48);
        return __builtin_popcountll(word);
    }
    static void places(const int* own, const int* label, int n, int* place) {
        __m512i at = _mm512_setzero_si512();
        const __m512i wanted = _mm512_loadu_si512(own);
        for (int length = n; length > 1;) {
            const int half = length / 2;
            const __m512i found = _mm512_i32gather_epi32(at, label + half, 4);
            const __mmask16 below = _mm512_cmple_epi32_mask(found, wanted);
            at = _mm512_mask_add_epi32(at, below, at, _mm512_set1_epi32(half));
            length -= half;
        }
        _mm512_storeu_si512(place, at);
    }
};

}  // namespace

CONNECTIVITY_DEFINE_KERNELS(avx512_kernels, Avx512, "avx512")
