// SPDX-License-Identifier: BSD-3-Clause
// The far images' kernel for any processor: two lanes in the vector types of GCC and Clang.
#include <cstring>

#include "lattice_kernels_impl.hpp"

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
    static void store(double* p, D a) { std::memcpy(p, &a, sizeof a); }
    static D set(double a) { return D{a, a}; }
    static D add(D a, D b) { return a + b; }
    static D fma(D a, D b, D c) { return a * b + c; }
    static D fnma(D a, D b, D c) { return c - a * b; }
};

}  // namespace

void lattice_kernel_portable(int order, const double* sums, const double* moments, double* locals) {
    apply_lattice<Portable>(order, sums, moments, locals);
}

}  // namespace connectivity::detail
