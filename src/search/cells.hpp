// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A hashed grid of cells as wide as the largest reach: candidates are the nodes of the 3^Dim cells
/// around a node.
///
/// Invariants: two nodes within the largest reach of each other, wrapped or not, live in equal or
/// adjacent cells; a cell is visited once even where a periodic axis has fewer than three cells.
/// Memory is O(N), however far nodes are apart. Cost: O(N) for supports of one size; one giant
/// support makes every cell as wide as itself.

#include <array>
#include <cstdint>

#include <connectivity/search/predicate.hpp>

namespace connectivity::detail {

template <int Dim>
class Cells {
public:
    /// Throws Error{memory}.
    explicit Cells(const SearchNodes<Dim>& nodes);

    template <class F>
    void visit(Offset i, const F& f) const {
        const Cell home = cell(i);
        Index around[Dim][3];
        int n_around[Dim];
        for (int d = 0; d < Dim; ++d) n_around[d] = neighbours_along(home[d], d, around[d]);
        visit_product(around, n_around, f);
    }

    double width() const { return width_; }

private:
    using Index = std::int32_t;
    struct Cell : std::array<Index, Dim> {};

    static std::uint64_t hash(const Cell& c) {
        std::uint64_t h = 0;
        for (int d = 0; d < Dim; ++d)
            h = (h ^ static_cast<std::uint32_t>(c[d])) * 0x9E3779B97F4A7C15ULL;
        return h ^ h >> 32;
    }

    Cell cell(Offset i) const {
        Cell c;
        for (int d = 0; d < Dim; ++d) c[d] = index(positions_[i * Dim + d], d);
        return c;
    }

    Index index(double x, int d) const;

    /// The cells at distance <= 1 along an axis, each once.
    int neighbours_along(Index at, int d, Index (&out)[3]) const;

    template <class F>
    void visit_product(const Index (&around)[Dim][3], const int (&n)[Dim], const F& f) const {
        int pick[Dim] = {};
        while (true) {
            Cell c;
            for (int d = 0; d < Dim; ++d) c[d] = around[d][pick[d]];
            visit_cell(c, f);
            int d = 0;
            while (d < Dim && ++pick[d] == n[d]) pick[d++] = 0;
            if (d == Dim) return;
        }
    }

    template <class F>
    void visit_cell(const Cell& c, const F& f) const {
        const auto bucket = static_cast<Offset>(hash(c) & mask_);
        for (Offset k = start_(bucket); k < start_(bucket + 1); ++k)
            if (cell_(k) == c)
                f(static_cast<Offset>(slot_(k)));  // other cells may share the bucket
    }

    void fill(Offset n);

    const double* positions_;
    double width_ = 1;
    double origin_[Dim];
    double period_[Dim];  // 0 on open axes
    Index count_[Dim];    // cells along a periodic axis
    std::uint64_t mask_ = 0;
    View<Offset> start_;  // [buckets + 1]
    View<Slot> slot_;     // [n], by bucket
    View<Cell> cell_;     // [n], by bucket
};

extern template class Cells<1>;
extern template class Cells<2>;
extern template class Cells<3>;

}  // namespace connectivity::detail
