// SPDX-License-Identifier: BSD-3-Clause
// The sums over pairs for any processor: 16 bytes in the vector types of GCC and Clang, which every
// x86-64 (SSE2) and most others have in hardware.
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "direct_kernels_impl.hpp"

namespace connectivity::detail {
namespace {

template <class Number>
struct Portable {
    using T = Number;
    typedef T F __attribute__((vector_size(16)));
    static constexpr int lanes = 16 / sizeof(T), tile = 2, step = 1;
    static constexpr T root_scale = 1;
    static F load(const T* p) {
        F a;
        std::memcpy(&a, p, sizeof a);
        return a;
    }
    static void store(T* p, F a) { std::memcpy(p, &a, sizeof a); }
    static int first(int n) { return n; }
    static F load_some(const T* p, int n) {
        if (n == lanes) return load(p);
        F a = {};
        a[0] = p[0];
        return a;
    }
    static void store(float* p, F a) requires(lanes == 2) {
        p[0] = static_cast<float>(a[0]), p[1] = static_cast<float>(a[1]);
    }
    static F set(T a) { return a - F{}; }
    static F add(F a, F b) { return a + b; }
    static F sub(F a, F b) { return a - b; }
    static F mul(F a, F b) { return a * b; }
    static F max(F a, F b) { return a > b ? a : b; }
    static F fma(F a, F b, F c) { return a * b + c; }
    static T sum(F a) {
        T s = a[0];
        for (int k = 1; k < lanes; ++k) s += a[k];
        return s;
    }
    static bool all_zero(F a) {
        bool zero = true;
        for (int k = 0; k < lanes; ++k) zero &= a[k] == 0;
        return zero;
    }
    static F sqrt(F a) {
#if defined(__SSE2__)
        if constexpr (lanes == 2) return (F)_mm_sqrt_pd((__m128d)a);
        if constexpr (lanes == 4) return (F)_mm_sqrt_ps((__m128)a);
#endif
        for (int k = 0; k < lanes; ++k) a[k] = static_cast<T>(__builtin_sqrt(a[k]));
        return a;
    }
    static F inverse_root(F d2, F r2) { return r2 != 0 ? set(1) / sqrt(d2) : F{}; }
    static F exact_inverse_root(F d2, F r2) { return inverse_root(d2, r2); }
};

}  // namespace

const DirectKernels portable_direct_kernels{"portable", add<Portable<double>>, add<Portable<float>>,
                                            gather<Portable<double>, double>,
                                            gather<Portable<double>, float>};

}  // namespace connectivity::detail
