// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Bodies of the bit row kernels over a type `V` of vector operations: words and lanes a vector, B
/// (words), none, load_bits, unite, store_bits; D (doubles), load, set, mul, add, between (mask).
/// Included once by each instruction set's file, after its V.

#include "bit_rows.hpp"

namespace connectivity::detail {
namespace {

/// `Tile` vectors of the rows at a time, which stay in registers.
template <class V, int Tile>
inline void unite_tile(const std::uint64_t* rows, long stride, const int* which, int n,
                       std::uint64_t* out) {
    typename V::B sum[Tile];
    for (auto& s : sum) s = V::none();
    for (int k = 0; k < n; ++k) {
        const std::uint64_t* const row = rows + which[k] * stride;
        for (int t = 0; t < Tile; ++t) sum[t] = V::unite(sum[t], V::load_bits(row + t * V::words));
    }
    for (int t = 0; t < Tile; ++t) V::store_bits(out + t * V::words, sum[t]);
}

template <class V>
void unite(const std::uint64_t* rows, long stride, const int* which, int n, std::uint64_t* out) {
    constexpr int tile = 8, small = row_words / V::words;
    long w = 0;
    for (; w + tile * V::words <= stride; w += tile * V::words)
        unite_tile<V, tile>(rows + w, stride, which, n, out + w);
    for (; w < stride; w += row_words) unite_tile<V, small>(rows + w, stride, which, n, out + w);
}

template <class V, int Dim>
inline void keep_between_in(const Slab& slab, std::uint64_t* bits, int n_words) {
    typename V::D u[Dim];
    for (int d = 0; d < Dim; ++d) u[d] = V::set(slab.u[d]);
    const auto end = V::set(slab.end);
    for (int w = 0; w < n_words; ++w) {
        if (bits[w] == 0) continue;
        std::uint64_t between = 0;
        for (int k = 0; k < 64; k += V::lanes) {
            auto sum = V::mul(V::load(slab.x[0] + w * 64 + k), u[0]);
            for (int d = 1; d < Dim; ++d)
                sum = V::add(sum, V::mul(V::load(slab.x[d] + w * 64 + k), u[d]));
            between |= static_cast<std::uint64_t>(V::between(sum, end)) << k;
        }
        bits[w] &= between;
    }
}

template <class V>
void keep_between(const Slab& slab, std::uint64_t* bits, int n_words) {
    if (slab.dim == 1) return keep_between_in<V, 1>(slab, bits, n_words);
    if (slab.dim == 2) return keep_between_in<V, 2>(slab, bits, n_words);
    keep_between_in<V, 3>(slab, bits, n_words);
}

}  // namespace
}  // namespace connectivity::detail
