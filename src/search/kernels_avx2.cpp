// SPDX-License-Identifier: BSD-3-Clause
// The kernels with AVX2 and FMA: eight lanes.
#include <immintrin.h>

#include "kernels_impl.hpp"

namespace {

/// For every mask of eight lanes the permutation that moves its lanes to the front.
struct PackTable {
    alignas(32) int lane[256][8];
    constexpr PackTable() : lane{} {
        for (int mask = 0; mask < 256; ++mask)
            for (int bit = 0, k = 0; bit < 8; ++bit)
                if (mask >> bit & 1) lane[mask][k++] = bit;
    }
};
constexpr PackTable pack_table;

struct Avx2 {
    static constexpr int lanes = 8;
    using F = __m256;
    static F load(const float* p) { return _mm256_loadu_ps(p); }
    static F set(float a) { return _mm256_set1_ps(a); }
    static F sub(F a, F b) { return _mm256_sub_ps(a, b); }
    static F mul(F a, F b) { return _mm256_mul_ps(a, b); }
    static F fma(F a, F b, F c) { return _mm256_fmadd_ps(a, b, c); }
    static F div(F a, F b) { return _mm256_div_ps(a, b); }
    static F sqrt(F a) { return _mm256_sqrt_ps(a); }
    static F min(F a, F b) { return _mm256_min_ps(a, b); }
    static F max(F a, F b) { return _mm256_max_ps(a, b); }
    static void store(float* p, F a) { _mm256_storeu_ps(p, a); }
    static unsigned le(F a, F b) {
        return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)));
    }
    static constexpr int wide_lanes = 4;
    using D = __m256d;
    static D load_wide(const double* p) { return _mm256_loadu_pd(p); }
    static D set_wide(double a) { return _mm256_set1_pd(a); }
    static D sub(D a, D b) { return _mm256_sub_pd(a, b); }
    static D add(D a, D b) { return _mm256_add_pd(a, b); }
    static D mul(D a, D b) { return _mm256_mul_pd(a, b); }
    static D max(D a, D b) { return _mm256_max_pd(a, b); }
    static unsigned le(D a, D b) {
        return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_LE_OQ)));
    }
    static unsigned equal(D a, D b) {
        return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_EQ_OQ)));
    }
    static D div(D a, D b) { return _mm256_div_pd(a, b); }
    static D nearest(D a) {
        return _mm256_round_pd(a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
    }
    /// The columns of four rows of N doubles each, by loads and transpositions.
    template <int N>
    static void gather_rows(const double* base, const int* row, D (&column)[N]) {
        const double* p[4];
        for (int k = 0; k < 4; ++k) p[k] = base + static_cast<long>(row[k]) * N;
        for (int c = 0; c + 2 <= N; c += 2) {
            const __m128d a = _mm_loadu_pd(p[0] + c), b = _mm_loadu_pd(p[1] + c);
            const __m256d ac = _mm256_insertf128_pd(_mm256_castpd128_pd256(a),
                                                    _mm_loadu_pd(p[2] + c), 1),
                          bd = _mm256_insertf128_pd(_mm256_castpd128_pd256(b),
                                                    _mm_loadu_pd(p[3] + c), 1);
            column[c] = _mm256_unpacklo_pd(ac, bd);
            column[c + 1] = _mm256_unpackhi_pd(ac, bd);
        }
        if constexpr (N % 2 == 1)
            column[N - 1] = _mm256_set_pd(p[3][N - 1], p[2][N - 1], p[1][N - 1], p[0][N - 1]);
    }
    static std::uint64_t deposit(std::uint64_t bits, std::uint64_t word) {
        return _pdep_u64(bits, word);
    }
    static int count(unsigned mask) { return __builtin_popcount(mask); }
    static __m256i lanes_of(unsigned mask) {
        return _mm256_load_si256(reinterpret_cast<const __m256i*>(pack_table.lane[mask]));
    }
    static void pack(float* to, unsigned mask, F a) {
        _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(a, lanes_of(mask)));
    }
    static void pack(int* to, unsigned mask, const int* from) {
        const __m256i a = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                            _mm256_permutevar8x32_epi32(a, lanes_of(mask)));
    }
    static F load_doubles(const double* p, double centre, double scale) {
        const __m256d c = _mm256_set1_pd(centre), s = _mm256_set1_pd(scale);
        const __m128 low = _mm256_cvtpd_ps(_mm256_mul_pd(_mm256_sub_pd(_mm256_loadu_pd(p), c), s));
        const __m128 high =
            _mm256_cvtpd_ps(_mm256_mul_pd(_mm256_sub_pd(_mm256_loadu_pd(p + 4), c), s));
        return _mm256_insertf128_ps(_mm256_castps128_ps256(low), high, 1);
    }
    static int unpack(int* out, std::uint64_t word, const int* label) {
        for (int bit = 0; bit < 64; bit += 8)
            pack(out + (bit > 0 ? __builtin_popcountll(word << (64 - bit)) : 0),
                 static_cast<unsigned>(word >> bit & 255), label + bit);
        return __builtin_popcountll(word);
    }
    static void places(const int* own, const int* label, int n, int* place) {
        for (int v = 0; v < connectivity::detail::leaf_size; v += lanes) {
            __m256i at = _mm256_setzero_si256();
            const __m256i wanted = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(own + v));
            for (int length = n; length > 1;) {
                const int half = length / 2;
                const __m256i found = _mm256_i32gather_epi32(label + half, at, 4);
                const __m256i above = _mm256_cmpgt_epi32(found, wanted);
                at = _mm256_add_epi32(at, _mm256_andnot_si256(above, _mm256_set1_epi32(half)));
                length -= half;
            }
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(place + v), at);
        }
    }
};

}  // namespace

CONNECTIVITY_DEFINE_KERNELS(avx2_kernels, Avx2, "avx2")
