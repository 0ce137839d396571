// SPDX-License-Identifier: BSD-3-Clause
// The kernels for any processor: four lanes in the vector types of GCC and Clang, which every
// x86-64 (SSE2) and most others have in hardware.
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "kernels_impl.hpp"

namespace {

struct Portable {
    static constexpr int lanes = 4;
    typedef float F __attribute__((vector_size(16)));
    typedef int Mask __attribute__((vector_size(16)));

    static F load(const float* p) {
        F a;
        std::memcpy(&a, p, sizeof a);
        return a;
    }
    static F set(float a) { return F{a, a, a, a}; }
    static F sub(F a, F b) { return a - b; }
    static F mul(F a, F b) { return a * b; }
    static F fma(F a, F b, F c) { return a * b + c; }
    static F div(F a, F b) { return a / b; }
    static F sqrt(F a) {
        for (int k = 0; k < lanes; ++k) a[k] = __builtin_sqrtf(a[k]);
        return a;
    }
    static F min(F a, F b) { return a < b ? a : b; }
    static F max(F a, F b) { return a > b ? a : b; }
    static void store(float* p, F a) { std::memcpy(p, &a, sizeof a); }
    static unsigned le(F a, F b) {
#if defined(__SSE2__)
        return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(a <= b)));
#else
        const Mask m = a <= b;
        return (m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8);
#endif
    }

    static constexpr int wide_lanes = 1;
    using D = double;
    static double load_wide(const double* p) { return *p; }
    static double set_wide(double a) { return a; }
    static double sub(double a, double b) { return a - b; }
    static double add(double a, double b) { return a + b; }
    static double mul(double a, double b) { return a * b; }
    static double max(double a, double b) { return a > b ? a : b; }
    static unsigned le(double a, double b) { return a <= b; }
    static unsigned equal(double a, double b) { return a == b; }
    static double div(double a, double b) { return a / b; }
    static double nearest(double a) { return __builtin_rint(a); }
    template <int N>
    static void gather_rows(const double* base, const int* row, double (&column)[N]) {
        for (int c = 0; c < N; ++c) column[c] = base[static_cast<long>(*row) * N + c];
    }
    static std::uint64_t deposit(std::uint64_t bits, std::uint64_t word) {
        std::uint64_t out = 0;
        for (; word != 0; word &= word - 1, bits >>= 1)
            if (bits & 1) out |= word & -word;
        return out;
    }

    static int count(unsigned mask) { return __builtin_popcount(mask); }
    static void pack(float* to, unsigned mask, F a) {
        for (int k = 0; k < lanes; ++k) *to = a[k], to += mask >> k & 1;
    }
    static void pack(int* to, unsigned mask, const int* from) {
        for (int k = 0; k < lanes; ++k) *to = from[k], to += mask >> k & 1;
    }
    static F load_doubles(const double* p, double centre, double scale) {
        F a;
        for (int k = 0; k < lanes; ++k) a[k] = static_cast<float>((p[k] - centre) * scale);
        return a;
    }
    static int unpack(int* out, std::uint64_t word, const int* label) {
        int n = 0;
        for (; word != 0; word &= word - 1) out[n++] = label[__builtin_ctzll(word)];
        return n;
    }
    static void places(const int* own, const int* label, int n, int* place) {
        for (int k = 0; k < connectivity::detail::leaf_size; ++k) {
            int at = 0;
            for (int length = n; length > 1;) {
                const int half = length / 2;
                if (label[at + half] <= own[k]) at += half;
                length -= half;
            }
            place[k] = at;
        }
    }
};

}  // namespace

CONNECTIVITY_DEFINE_KERNELS(portable_kernels, Portable, "portable")
