// SPDX-License-Identifier: BSD-3-Clause
// The bit row kernels with AVX-512.
#include <immintrin.h>

#include "bit_rows_impl.hpp"

namespace connectivity::detail {
namespace {

struct Avx512 {
    static constexpr int words = 8, lanes = 8;
    using B = __m512i;
    static B none() { return _mm512_setzero_si512(); }
    static B load_bits(const std::uint64_t* p) { return _mm512_loadu_si512(p); }
    static B unite(B a, B b) { return _mm512_or_si512(a, b); }
    static void store_bits(std::uint64_t* p, B a) { _mm512_storeu_si512(p, a); }
    using D = __m512d;
    static D load(const double* p) { return _mm512_loadu_pd(p); }
    static D set(double a) { return _mm512_set1_pd(a); }
    static D mul(D a, D b) { return _mm512_mul_pd(a, b); }
    static D add(D a, D b) { return _mm512_add_pd(a, b); }
    static unsigned between(D a, D end) {
        return _mm512_mask_cmp_pd_mask(_mm512_cmp_pd_mask(a, _mm512_setzero_pd(), _CMP_GE_OQ), a,
                                       end, _CMP_LE_OQ);
    }
};

}  // namespace

const BitRowKernels avx512_bit_row_kernels{unite<Avx512>, keep_between<Avx512>};

}  // namespace connectivity::detail
