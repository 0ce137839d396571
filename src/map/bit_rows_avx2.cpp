// SPDX-License-Identifier: BSD-3-Clause
// The bit row kernels with AVX2.
#include <immintrin.h>

#include "bit_rows_impl.hpp"

namespace connectivity::detail {
namespace {

struct Avx2 {
    static constexpr int words = 4, lanes = 4;
    using B = __m256i;
    static B none() { return _mm256_setzero_si256(); }
    static B load_bits(const std::uint64_t* p) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
    }
    static B unite(B a, B b) { return _mm256_or_si256(a, b); }
    static void store_bits(std::uint64_t* p, B a) {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(p), a);
    }
    using D = __m256d;
    static D load(const double* p) { return _mm256_loadu_pd(p); }
    static D set(double a) { return _mm256_set1_pd(a); }
    static D mul(D a, D b) { return _mm256_mul_pd(a, b); }
    static D add(D a, D b) { return _mm256_add_pd(a, b); }
    static unsigned between(D a, D end) {
        return static_cast<unsigned>(_mm256_movemask_pd(_mm256_and_pd(
            _mm256_cmp_pd(a, _mm256_setzero_pd(), _CMP_GE_OQ), _mm256_cmp_pd(a, end, _CMP_LE_OQ))));
    }
};

}  // namespace

const BitRowKernels avx2_bit_row_kernels{unite<Avx2>, keep_between<Avx2>};

}  // namespace connectivity::detail
