// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Which nodes lie between two others: the closed slab test.
///
/// Node k lies between a and b iff the perpendicular foot of x_k on the line from a to b is in the
/// closed segment: 0 <= (x_k - x_a)·r <= r·r with r = x_b - x_a, differences wrapped on periodic
/// axes. Where r = 0 every node does. Only signs and sums of products are compared, and vectors are
/// scaled by powers of two first, so that the answer does not depend on the unit of length and no
/// product overflows.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <connectivity/base/box.hpp>
#include <connectivity/base/types.hpp>

#include "bit_rows.hpp"

namespace connectivity::detail {

/// The power of two that brings a number >= 0 into [1, 2); the largest there is for 0.
inline double scale_to_one(double number) {
    const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(number) >> 52);
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent < 2046 ? 2046 - exponent : 1)
                                 << 52);
}

/// Differences of some nodes from node a, the largest component scaled into [1, 2).
template <int Dim>
class SegmentsFrom {
public:
    /// positions: [n * Dim] by label.
    void start(const double* positions, const Periods<Dim>& periods, Slot a,
               std::span<const Slot> labels) {
        n_ = labels.size();
        for (auto& d : d_)
            if (d.size() < n_ + 64) d.resize(n_ + n_ / 2 + 64);  // whole words of bits
        double largest = 0;
        for (std::size_t k = 0; k < n_; ++k)
            for (int d = 0; d < Dim; ++d) {
                const double r =
                    positions[Offset{labels[k]} * Dim + d] - positions[Offset{a} * Dim + d];
                d_[d][k] = periods.any ? periods.wrap(r, d) : r;
                largest = std::max(largest, std::fabs(d_[d][k]));
            }
        const double scale = scale_to_one(largest);
        for (auto& d : d_)
            for (std::size_t k = 0; k < n_; ++k) d[k] *= scale;
    }

    /// Now towards the node labels[k].
    void aim(std::size_t k) {
        double largest = 0;
        for (const auto& d : d_) largest = std::max(largest, std::fabs(d[k]));
        const double scale = scale_to_one(largest);
        for (int d = 0; d < Dim; ++d) u_[d] = d_[d][k] * scale;
        end_ = along(k);
    }

    bool holds(std::size_t k) const {
        const double s = along(k);
        return 0 <= s && s <= end_;
    }

    /// What `holds` asks of all nodes, for the kernels; numbers beyond the last node are any.
    Slab slab() const {
        Slab slab{{}, {}, end_, Dim};
        for (int d = 0; d < Dim; ++d) slab.x[d] = d_[d].data(), slab.u[d] = u_[d];
        return slab;
    }

    Offset bytes() const { return static_cast<Offset>(Dim * d_[0].capacity() * sizeof(double)); }

private:
    double along(std::size_t k) const {
        double sum = d_[0][k] * u_[0];
        for (int d = 1; d < Dim; ++d) sum += d_[d][k] * u_[d];
        return sum;
    }

    std::size_t n_ = 0;
    std::vector<double> d_[Dim];
    double u_[Dim] = {}, end_ = 0;
};

}  // namespace connectivity::detail
