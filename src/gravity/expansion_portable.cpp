// SPDX-License-Identifier: BSD-3-Clause
// The operators of expansions for any processor: two lanes in the vector types of GCC and Clang.
#include <cstring>

#include "expansion_impl.hpp"

namespace connectivity::detail {
namespace {

struct Portable {
    static constexpr int lanes = 2;
    typedef double D __attribute__((vector_size(16)));
    static D load(const double* p) {
        D a;
        std::memcpy(&a, p, sizeof a);
        return a;
    }
    static D load_some(const double* p, int n) { return n > 1 ? load(p) : D{*p, 0}; }
    static void store(double* p, D a) { std::memcpy(p, &a, sizeof a); }
    static D set(double a) { return D{a, a}; }
    static D add(D a, D b) { return a + b; }
    static D sub(D a, D b) { return a - b; }
    static D mul(D a, D b) { return a * b; }
    static D fma(D a, D b, D c) { return a * b + c; }
    static D fnma(D a, D b, D c) { return c - a * b; }
    static D select_le(D a, D b, D yes, D no) { return a <= b ? yes : no; }
    static D rsqrt(D a) { return D{1 / __builtin_sqrt(a[0]), 1 / __builtin_sqrt(a[1])}; }
    static D gather(const double* base, const std::int32_t* at) {
        return D{base[at[0]], base[at[1]]};
    }
    static constexpr int columns = 2;
    static void gather_columns(const double* const* row, int first, D* out) {
        D a[2] = {load(row[0] + first), load(row[1] + first)};
        transpose(a);
        out[0] = a[0];
        out[1] = a[1];
    }
    static void transpose(D (&a)[lanes]) {
        const D first{a[0][0], a[1][0]}, second{a[0][1], a[1][1]};
        a[0] = first;
        a[1] = second;
    }
};

}  // namespace

const ExpansionKernels portable_expansion_kernels = make_expansion_kernels<Portable>("portable");

}  // namespace connectivity::detail
