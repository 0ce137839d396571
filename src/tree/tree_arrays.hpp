// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The storage behind a TreeView, and how a rebuild takes it over without losing the old tree.
///
/// Invariant: arrays may be longer than the tree; `TreeArrays::view` cuts them. What somebody else
/// holds a view of is never written again.

#include <string>

#include <connectivity/tree/tree_view.hpp>

namespace connectivity::tree_detail {

/// Storage for n elements: the old one if it is large enough and nobody else holds it.
template <class T>
View<T> spare(const View<T>& old, const std::string& label, Offset n) {
    if (n <= static_cast<Offset>(old.size()) && old.use_count() <= 1) return old;
    return allocate<T>(label, n);
}

struct ParticleArrays {
    View<double> positions, radii;
    View<std::int32_t> box_starts, box_counts_nonchild, box_counts_cumul;
    View<double> hull_min, hull_max;

    TreeParticles view(const TreeView& tree, Offset n, bool radii_there, bool hulls_there) const;
    Offset bytes() const;
};

struct TreeArrays {
    TreeView header;  ///< numbers only, no arrays
    bool source_radii = false, target_radii = false, hulls = false;
    View<BoxId> level_starts, parents, children;
    View<double> centers;
    View<std::uint8_t> levels, flags;
    View<std::int32_t> user_source_ids, sorted_target_ids;
    ParticleArrays sources, targets;  ///< targets empty where sources are targets

    TreeView view() const;
    Offset bytes() const;

    /// Storage for a tree of the sizes in `header`, taken over from `old` where that is free.
    /// Throws Error{memory}; `old` stays as it is until somebody writes.
    void take(const TreeArrays& old);
};

}  // namespace connectivity::tree_detail
