// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Between arrays and vectors: partial vectors, rows of cells into lanes and back.

#include "expansion_kernels.hpp"

namespace connectivity::detail {
namespace {

/// Of n things from `first` on, how many are in the next vector.
template <class V>
inline int left(std::int64_t n, std::int64_t first) {
    return n - first < V::lanes ? static_cast<int>(n - first) : V::lanes;
}

/// Lanes below `some` of a, the others of b.
template <class V>
inline typename V::D first_lanes(int some, typename V::D a, typename V::D b) {
    constexpr double lane[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    return V::select_le(V::load(lane), V::set(some - 0.5), a, b);
}

/// Centre of entry k of a list, moved by its image.
inline void place(const CellArrays& cells, const CellList& list, std::int64_t k, double* centre) {
    const std::int32_t c = list.id[k];
    centre[0] = cells.x[c];
    centre[1] = cells.y[c];
    centre[2] = cells.z[c];
    if (list.image == nullptr) return;
    for (int a = 0; a < 3; ++a) centre[a] += list.shift[3 * list.image[k] + a];
}

/// Sums vectors over their lanes, and adds them to out[n].
template <class V>
inline void add_sums(const typename V::D* sums, int n, double* out) {
    using D = typename V::D;
    for (int first = 0; first < n; first += V::lanes) {
        D block[V::lanes];
        for (int k = 0; k < V::lanes; ++k) block[k] = first + k < n ? sums[first + k] : V::set(0);
        V::transpose(block);
        D total = block[0];
        for (int k = 1; k < V::lanes; ++k) total = V::add(total, block[k]);
        double lane[V::lanes];
        V::store(lane, total);
        for (int k = 0; k < V::lanes && first + k < n; ++k) out[first + k] += lane[k];
    }
}

/// The first n coefficients of a row per lane, and up to 3 more.
template <class V>
inline void gather_rows(const double* const* row, int n, typename V::D* out) {
    for (int first = 0; first < n; first += V::columns) V::gather_columns(row, first, out + first);
}

/// Adds the lanes to `some` rows.
template <class V>
inline void scatter_rows(const typename V::D* values, int some, int n, double* const* row) {
    using D = typename V::D;
    for (int first = 0; first < n; first += V::lanes) {
        D block[V::lanes];
        for (int k = 0; k < V::lanes; ++k) block[k] = first + k < n ? values[first + k] : V::set(0);
        V::transpose(block);
        for (int k = 0; k < some; ++k) {
            double* const to = row[k] + first;
            double lane[V::lanes];
            V::store(lane, block[k]);
            for (int j = 0; j < V::lanes && first + j < n; ++j) to[j] += lane[j];
        }
    }
}

}  // namespace
}  // namespace connectivity::detail
