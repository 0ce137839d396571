// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The domain: open or periodic on each axis by itself.
///
/// A periodic axis has a length > 0; positions outside the box are legal, because only differences
/// are wrapped.

#include <array>
#include <cmath>

#include <Kokkos_Macros.hpp>

namespace connectivity {

/// What a caller states, for up to three axes; axes beyond the dimension are ignored.
struct Domain {
    std::array<bool, 3> periodic{false, false, false};
    std::array<double, 3> lo{0, 0, 0};
    std::array<double, 3> hi{0, 0, 0};

    bool any_periodic(int dim) const {
        for (int d = 0; d < dim; ++d)
            if (periodic[d]) return true;
        return false;
    }
    /// Length of axis d, 0 where it is open.
    double length(int d) const { return periodic[d] ? hi[d] - lo[d] : 0.0; }

    friend bool operator==(const Domain&, const Domain&) = default;

    /// Throws Error{box} if a periodic axis is inverted, empty or not finite.
    void check(int dim) const;
};

/// Lengths of the periodic axes (0 = open), for kernels. `wrap` is the one place where a difference
/// is wrapped.
template <int Dim>
struct Periods {
    double length[Dim];
    bool any;

    /// Nearest image of a difference. Odd in its argument bit for bit, so that both ends of a pair
    /// agree.
    KOKKOS_INLINE_FUNCTION double wrap(double difference, int d) const {
        return length[d] > 0 ? difference - length[d] * std::rint(difference / length[d])
                             : difference;
    }
};

template <int Dim>
Periods<Dim> periods(const Domain& domain) {
    Periods<Dim> p{};
    for (int d = 0; d < Dim; ++d) {
        p.length[d] = domain.length(d);
        p.any = p.any || domain.periodic[d];
    }
    return p;
}

}  // namespace connectivity
