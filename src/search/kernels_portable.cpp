// SPDX-License-Identifier: BSD-3-Clause
// The kernels in plain C++: one lane.
#include "kernels_impl.hpp"

namespace {

struct Scalar {
    static constexpr int lanes = 1;
    using F = float;
    static F load(const float* p) { return *p; }
    static F set(float a) { return a; }
    static F sub(F a, F b) { return a - b; }
    static F mul(F a, F b) { return a * b; }
    static F fma(F a, F b, F c) { return a * b + c; }
    static F max(F a, F b) { return a > b ? a : b; }
    static unsigned le(F a, F b) { return a <= b; }
    static constexpr int wide_lanes = 1;
    static double load_wide(const double* p) { return *p; }
    static double set_wide(double a) { return a; }
    static double sub(double a, double b) { return a - b; }
    static double add(double a, double b) { return a + b; }
    static double mul(double a, double b) { return a * b; }
    static double max(double a, double b) { return a > b ? a : b; }
    static unsigned le(double a, double b) { return a <= b; }
    static unsigned count(unsigned mask) { return mask; }
    static void pack(float* to, unsigned, F a) { *to = a; }
    static void pack(int* to, unsigned, const int* from) { *to = *from; }
    static F load_doubles(const double* p, double centre, double scale) {
        return static_cast<float>((*p - centre) * scale);
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

CONNECTIVITY_DEFINE_KERNELS(portable_kernels, Scalar, "portable")
