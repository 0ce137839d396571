// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The root box and where a particle lies in it: scaled coordinates, their bits at any depth, and
/// whether a particle sticks out of a box.
///
/// Invariants: a scaled coordinate is rounded once, in the host's precision; its bits are exact at
/// every level, since powers of two and floor are. One on the upper face has all bits set.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <connectivity/keys/morton.hpp>

#include "particles.hpp"

namespace connectivity::tree_detail {

/// Deepest level of a box.
constexpr int max_level = 254;

/// 2^k for |k| <= 1022.
inline double power_of_two(int k) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + k) << 52);
}

/// Floor of v >= 0; from 2^53 on all doubles are integers.
inline double floor_of(double v) {
    return v < 0x1p53 ? static_cast<double>(static_cast<std::int64_t>(v)) : v;
}

template <class Real, int Dim>
struct Frame {
    Real lo[Dim];
    Real side[Dim];  ///< upper face minus lower face, each rounded: may differ in the last bits
    Real extent;     ///< side of the root box before that rounding

    /// The cube of side `length` above `lo`.
    void set_cube(Real length) {
        extent = length;
        for (int d = 0; d < Dim; ++d) {
            const Real hi = lo[d] + length;
            side[d] = hi - lo[d];
        }
    }

    double scaled(Real x, int d) const { return static_cast<double>((x - lo[d]) / side[d]); }

    /// `n_bits` bits of a scaled coordinate, those of levels (level, level + n_bits].
    static std::uint64_t bits(double t, int level, int n_bits) {
        if (t >= 1) return (std::uint64_t{1} << n_bits) - 1;
        double rest = t * power_of_two(level);
        rest -= floor_of(rest);
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(rest * power_of_two(n_bits)));
    }

    /// Bits of all axes for the key_bits<Dim> levels below `level`, the first axis most
    /// significant.
    std::uint64_t key(const Particles<Real, Dim>& particles, Offset i, int level) const {
        std::uint64_t cell[Dim];
        for (int d = 0; d < Dim; ++d)
            cell[Dim - 1 - d] = bits(scaled(particles.position(i, d), d), level, key_bits<Dim>);
        return interleave<Dim>(cell);
    }

    /// Centre, on one axis, of the box at `level` that holds x; rounded as the host's numbers are.
    Real center(Real x, int d, int level) const {
        const double cells = power_of_two(level);
        const double cell = std::min(floor_of(scaled(x, d) * cells), cells - 1);
        return lo[d] + side[d] * static_cast<Real>((cell + 0.5) * power_of_two(-level));
    }
};

/// Who sticks out of which box. Sums are rounded in the host's precision, as boxtree's are: they
/// decide where points on faces stay.
template <class Real, int Dim>
struct StickOut {
    Frame<Real, Dim> frame;
    double factor = 0;
    ExtentNorm norm = ExtentNorm::linf;

    /// Half the width of an enlarged box.
    Real room(int level, int d) const {
        const auto half = static_cast<Real>(frame.side[d] * power_of_two(-(level + 1)));
        return static_cast<Real>(1 + static_cast<double>(static_cast<Real>(factor))) * half;
    }

    /// Does particle i stick out of the box at `level` that holds its centre?
    bool sticks_out(const Particles<Real, Dim>& particles, Offset i, int level) const {
        const Real radius = particles.radius(i);
        double distance2 = 0;
        for (int d = 0; d < Dim; ++d) {
            const Real x = particles.position(i, d), c = frame.center(x, d, level),
                       h = room(level, d);
            if (norm == ExtentNorm::linf && (x + radius >= c + h || x - radius < c - h))
                return true;
            const double away = x - c;
            distance2 += away * away;
        }
        if (norm == ExtentNorm::linf) return false;
        const double reach = std::sqrt(distance2) + static_cast<double>(radius), h = room(level, 0);
        return reach * reach >= Dim * h * h;
    }

    /// Deepest level in [level, last] that particle i, now at `level`, may enter.
    int deepest(const Particles<Real, Dim>& particles, Offset i, int level, int last) const {
        int next = std::max(level, first_doubtful(particles, i)) + 1;
        while (next <= last && !sticks_out(particles, i, next)) ++next;
        return std::min(next - 1, last);
    }

private:
    /// A level that the particle enters in any case: there its radius, and all rounding, are less
    /// than what it may stick out.
    int first_doubtful(const Particles<Real, Dim>& particles, Offset i) const {
        constexpr double rounding = sizeof(Real) == 4 ? 0x1p-21 : 0x1p-50;
        double slack = particles.radius(i) + static_cast<double>(frame.extent) * rounding;
        for (int d = 0; d < Dim; ++d)
            slack += std::abs(static_cast<double>(frame.lo[d])) * rounding;
        // factor * extent / 2^(level + 1) > slack
        const double ratio = factor * static_cast<double>(frame.extent) / slack;
        if (!(ratio > 4)) return 0;
        return std::min(std::ilogb(ratio) - 2, max_level);
    }
};

}  // namespace connectivity::tree_detail
