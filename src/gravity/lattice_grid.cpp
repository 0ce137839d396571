// SPDX-License-Identifier: BSD-3-Clause
#include "lattice_grid.hpp"

#include <algorithm>

#include <connectivity/base/parallel.hpp>

namespace connectivity::detail {
namespace {

constexpr Offset block_size = 16384;

}  // namespace

void GridSort::sort(const LatticeGrid& grid, const std::array<const double*, 3>& x, Offset n) {
    const int n_cells = grid.size();
    const Offset n_blocks = (n + block_size - 1) / block_size;
    ensure_capacity(order_, "gravity/lattice/order", n);
    ensure_capacity(cell_, "gravity/lattice/cells", n);
    ensure_capacity(place_, "gravity/lattice/places", n_cells * n_blocks);
    Offset* const place = place_.data();
    std::uint16_t* const cell = cell_.data();
    std::int32_t* const order = order_.data();
    double inverse[3];
    for (int d = 0; d < 3; ++d) inverse[d] = 1 / grid.side[d];
    for_each_dynamic("gravity/lattice/count", n_blocks, [=](int, Offset block) {
        for (int c = 0; c < n_cells; ++c) place[c * n_blocks + block] = 0;
        const Offset last = std::min(n, (block + 1) * block_size);
        for (Offset i = block * block_size; i < last; ++i) {
            int at[3];
            for (int d = 0; d < 3; ++d)
                at[d] =
                    static_cast<int>(std::clamp(x[d][i] * inverse[d], 0.0, grid.cells[d] - 1.0));
            cell[i] = static_cast<std::uint16_t>(grid.index(at[0], at[1], at[2]));
            ++place[cell[i] * n_blocks + block];
        }
    });
    scan(n_cells, n_blocks);
    for_each_dynamic("gravity/lattice/sort", n_blocks, [=](int, Offset block) {
        const Offset last = std::min(n, (block + 1) * block_size);
        for (Offset i = block * block_size; i < last; ++i)
            order[place[cell[i] * n_blocks + block]++] = static_cast<std::int32_t>(i);
    });
    cut(n_cells, n_blocks);
}

/// Counts become the places of the first of each cell and block.
void GridSort::scan(int n_cells, Offset n_blocks) {
    Offset sum = 0;
    for (Offset k = 0; k < n_cells * n_blocks; ++k) {
        const Offset count = place_(k);
        place_(k) = sum;
        sum += count;
    }
}

/// Places are now the ends of each cell and block.
void GridSort::cut(int n_cells, Offset n_blocks) {
    chunks_.clear();
    if (n_blocks == 0) return;
    Offset first = 0;
    for (int c = 0; c < n_cells; ++c) {
        const Offset end = place_((c + 1) * n_blocks - 1);
        for (; first < end; first += std::min(chunk_size, end - first))
            chunks_.push_back({c, first, std::min(end, first + chunk_size)});
    }
}

Offset GridSort::bytes() const {
    return static_cast<Offset>(order_.size() * sizeof(std::int32_t) +
                               cell_.size() * sizeof(std::uint16_t) +
                               place_.size() * sizeof(Offset) + chunks_.capacity() * sizeof(Chunk));
}

}  // namespace connectivity::detail
