// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// True Morton keys: 63, 31 or 21 bits an axis in 1, 2, 3 dimensions, interleaved into one 64-bit
/// integer.
///
/// Invariants: bit k of axis d is bit k*Dim + d of the key (x least significant); keys grow along
/// every axis; cells are [lo, hi) divided into 2^bits equal parts, the last one closed. Cost: one
/// pass over the positions.

#include <cstdint>

#include <connectivity/base/spaces.hpp>

namespace connectivity {

template <int Dim>
constexpr int key_bits = Dim == 1   ? 63
                         : Dim == 2 ? 31
                                    : 21;

/// Spreads the low key_bits<Dim> bits of v so that bit k lands on bit k * Dim.
template <int Dim>
KOKKOS_INLINE_FUNCTION constexpr std::uint64_t spread_bits(std::uint64_t v) {
    if constexpr (Dim == 2) {
        v &= 0x7fffffffULL;
        v = (v | v << 16) & 0x0000ffff0000ffffULL;
        v = (v | v << 8) & 0x00ff00ff00ff00ffULL;
        v = (v | v << 4) & 0x0f0f0f0f0f0f0f0fULL;
        v = (v | v << 2) & 0x3333333333333333ULL;
        v = (v | v << 1) & 0x5555555555555555ULL;
    } else if constexpr (Dim == 3) {
        v &= 0x1fffffULL;
        v = (v | v << 32) & 0x001f00000000ffffULL;
        v = (v | v << 16) & 0x001f0000ff0000ffULL;
        v = (v | v << 8) & 0x100f00f00f00f00fULL;
        v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
        v = (v | v << 2) & 0x1249249249249249ULL;
    }
    return v;
}

/// Key of integer cell coordinates, each in [0, 2^key_bits<Dim>).
template <int Dim>
KOKKOS_INLINE_FUNCTION constexpr std::uint64_t interleave(const std::uint64_t (&cell)[Dim]) {
    std::uint64_t key = 0;
    for (int d = 0; d < Dim; ++d) key |= spread_bits<Dim>(cell[d]) << d;
    return key;
}

/// The box whose cells the keys number: the bounding box of all nodes, ghosts included.
template <int Dim>
struct KeyBox {
    double lo[Dim], hi[Dim];

    /// Cell of coordinate x on axis d: min(2^bits - 1, floor((x - lo)/(hi - lo) * 2^bits)); 0 on an
    /// axis of no width.
    KOKKOS_INLINE_FUNCTION std::uint64_t cell(double x, int d) const {
        const double width = hi[d] - lo[d];
        if (!(width > 0)) return 0;
        constexpr auto last = (std::uint64_t{1} << key_bits<Dim>)-1;
        const double at =
            (x - lo[d]) / width * static_cast<double>(std::uint64_t{1} << key_bits<Dim>);
        if (!(at > 0)) return 0;
        return at >= static_cast<double>(last) ? last : static_cast<std::uint64_t>(at);
    }

    KOKKOS_INLINE_FUNCTION std::uint64_t key(const double* x) const {
        std::uint64_t c[Dim];
        for (int d = 0; d < Dim; ++d) c[d] = cell(x[d], d);
        return interleave<Dim>(c);
    }
};

/// Bounding box of n points, positions [n * Dim] interleaved, host. All zeros for n = 0.
template <int Dim>
KeyBox<Dim> bounding_key_box(ConstView<double> positions);

/// Keys of all points, [n], host.
template <int Dim>
View<std::uint64_t> morton_keys(ConstView<double> positions, const KeyBox<Dim>& box);

}  // namespace connectivity
