// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Gravity by direct summation: every source on some targets, which are sources themselves.
///
/// The same bits for any number of threads: how the work is cut depends on the sizes alone. Cost:
/// n_targets * n_sources pairs; scratch only for fewer than 8192 targets, at most 2 KB each.

#include <array>
#include <vector>

#include <connectivity/base/types.hpp>

#include "direct_kernels.hpp"

namespace connectivity::detail {

/// Sources that are targets, moved by `shift`. (What an image of all sources at +s does to the
/// targets is what the sources do to targets at -s.)
struct DirectTargets {
    const Slot* which = nullptr;  ///< [n] numbers of sources; nullptr: first, first + 1, ...
    Offset first = 0, n = 0;
    std::array<double, 3> shift{};
};

/// [n of the targets]: sums of m/r, positive, and of m d/r³.
struct DirectSums {
    double *p, *ax, *ay, *az;
};

/// Adds to `sums` what all sources do to the targets. A target does nothing to itself, moved or
/// not, where r is 0; other pairs at r = 0 have no force, and with plummer the potential of their
/// softening. sources.e may be null for newton only. Kokkos has been started.
void direct_sum(PairLaw law, const NearSources<double>& sources, const DirectTargets& targets,
                const DirectSums& sums, std::vector<double>& scratch);

}  // namespace connectivity::detail
