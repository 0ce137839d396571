// SPDX-License-Identifier: BSD-3-Clause
// The bit row kernels for any processor.
#include "bit_rows_impl.hpp"

namespace connectivity::detail {
namespace {

struct Portable {
    static constexpr int words = 1, lanes = 1;
    using B = std::uint64_t;
    static B none() { return 0; }
    static B load_bits(const std::uint64_t* p) { return *p; }
    static B unite(B a, B b) { return a | b; }
    static void store_bits(std::uint64_t* p, B a) { *p = a; }
    using D = double;
    static D load(const double* p) { return *p; }
    static D set(double a) { return a; }
    static D mul(D a, D b) { return a * b; }
    static D add(D a, D b) { return a + b; }
    static unsigned between(D a, D end) { return unsigned{a >= 0} & unsigned{a <= end}; }
};

}  // namespace

const BitRowKernels portable_bit_row_kernels{unite<Portable>, keep_between<Portable>};

}  // namespace connectivity::detail
