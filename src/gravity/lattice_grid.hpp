// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A regular grid of cells over a box whose low corner is 0, and particles sorted into it.
///
/// Invariants: in a cell particles keep their order, whatever the number of threads; positions
/// beside the box are of the outermost cell. Cost: two passes; scratch is kept.

#include <array>
#include <vector>

#include <connectivity/base/spaces.hpp>

namespace connectivity::detail {

struct LatticeGrid {
    std::array<int, 3> cells{1, 1, 1};
    std::array<double, 3> side{};  ///< of a cell

    int size() const { return cells[0] * cells[1] * cells[2]; }
    int index(int i, int j, int k) const { return (i * cells[1] + j) * cells[2] + k; }
    std::array<int, 3> place(int cell) const {
        return {cell / (cells[1] * cells[2]), cell / cells[2] % cells[1], cell % cells[2]};
    }
    double centre(int cell, int axis) const { return (place(cell)[axis] + 0.5) * side[axis]; }
};

class GridSort {
public:
    /// Some particles of one cell: order()[first, last).
    struct Chunk {
        int cell;
        Offset first, last;
    };
    static constexpr Offset chunk_size = 512;

    /// Finite positions. Throws Error{memory}.
    void sort(const LatticeGrid& grid, const std::array<const double*, 3>& x, Offset n);

    const std::int32_t* order() const { return order_.data(); }
    const std::vector<Chunk>& chunks() const { return chunks_; }  ///< by cell, then by place
    Offset bytes() const;

private:
    void scan(int n_cells, Offset n_blocks);
    void cut(int n_cells, Offset n_blocks);

    View<std::int32_t> order_;
    View<std::uint16_t> cell_;
    View<Offset> place_;  ///< [cell][block]
    std::vector<Chunk> chunks_;
};

}  // namespace connectivity::detail
