// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Values laid end to end.

#include <connectivity/base/spaces.hpp>

namespace connectivity {

/// Copies `from` to to[at ...] and returns the place behind it. Fence before use.
inline Offset append(const View<double>& to, Offset at, const ConstView<double>& from) {
    double* const out = to.data() + at;
    const double* const in = from.data();
    const auto n = static_cast<Offset>(from.size());
    Kokkos::parallel_for("map/append",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
                         [=](const Offset i) { out[i] = in[i]; });
    return at + n;
}

}  // namespace connectivity
