// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Point sources that belong to the sources of a tree, which stand for groups of them: brought into
/// an order in which those of a source lie side by side, sources in tree order.

#include <span>

#include <connectivity/tree/tree_input.hpp>

namespace connectivity {

struct LinkedSources {
    Offset n = 0;
    View<double> positions;                    ///< [dim][n]
    View<std::int32_t> user_point_source_ids;  ///< [n]: user index of each
    View<std::int32_t> starts, counts;         ///< [n_sources], tree order: those of a source
    /// [n_boxes]: images of the slices of sources in TreeParticles.
    View<std::int32_t> box_starts, box_counts_nonchild, box_counts_cumul;
};

/// user_starts [n_sources + 1]: the point sources of source i, user order, are user_starts[i] ..
/// user_starts[i + 1]. Throws Error: argument (number or order of starts), null, nonfinite, memory.
LinkedSources link_point_sources(const TreeView& tree, std::span<const Offset> user_starts,
                                 const ParticleArray& points, CoordinateType coordinates);

}  // namespace connectivity
