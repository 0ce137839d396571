// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a box tree is made of: boxes, the particles in them and the orders of both, as arrays.
///
/// Invariants: box 0 is the root, boxes are numbered level by level, a parent before its children;
/// a box at level l has half width root_extent / 2^(l+1). Particles are in depth-first order, a
/// box's own before those of its children, so that a box's own particles are the head of its slice
/// of all particles below it. Child number of a box: bit d of dim from the highest is axis d, so x
/// is the most significant one. Trivial to copy: handles, not values. Host memory.
///
/// Names and meanings follow boxtree's Tree, https://documen.tician.de/boxtree/tree.html

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include <connectivity/base/spaces.hpp>

namespace connectivity {

/// Number of a box in a tree; ascending with the level.
using BoxId = std::int32_t;

/// Which region a particle with a radius must stay in to be handed to a child box: the child's
/// cube enlarged by 1 + stick_out_factor, or the ball around that cube.
enum class ExtentNorm { linf, l2 };

/// Precision in which a host gave its coordinates; positions relative to the root box are rounded
/// to it, everything after that is exact or double.
enum class CoordinateType { float32, float64 };

/// Bits of box_flags.
namespace box_flag {
constexpr std::uint8_t has_own_sources = 1, has_own_targets = 2, has_child_sources = 4,
                       has_child_targets = 8;
}

/// Particles of one kind (sources or targets) in tree order, and where each box has its own.
struct TreeParticles {
    Offset n = 0;
    ConstView<double> positions;  ///< [dim][n], tree order
    ConstView<double> radii;      ///< [n], tree order; empty: points
    /// [n_boxes]: particles before the box's first one; those of its own; those in its subtree.
    ConstView<std::int32_t> box_starts, box_counts_nonchild, box_counts_cumul;
    /// [dim][aligned_n_boxes]: hull of the box centre, of x - r and x + r of its own particles and
    /// of its children's hulls.
    ConstView<double> bounding_box_min, bounding_box_max;

    bool have_extent() const { return radii.size() > 0; }
};

struct TreeView {
    int dim = 0;
    CoordinateType coordinates = CoordinateType::float64;
    bool sources_are_targets = false;  ///< `targets` shares the arrays of `sources`
    std::array<bool, 3> periodic{};    ///< axes on which the root box repeats

    std::array<double, 3> bounding_box_min{}, bounding_box_max{};  ///< of the root box, a cube
    double root_extent = 0;                                        ///< its side
    double stick_out_factor = 0;
    std::optional<ExtentNorm> extent_norm;  ///< none where no particle has a radius

    int n_levels = 0;
    Offset n_boxes = 0, aligned_n_boxes = 0;  ///< aligned: rounded up to 32
    ConstView<BoxId> level_start_box_nrs;     ///< [n_levels + 1]
    ConstView<BoxId> box_parent_ids;          ///< [n_boxes]; 0 for the root too
    ConstView<BoxId> box_child_ids;           ///< [2^dim][aligned_n_boxes]; 0: no such child
    ConstView<double> box_centers;            ///< [dim][aligned_n_boxes]
    ConstView<std::uint8_t> box_levels;       ///< [n_boxes]
    ConstView<std::uint8_t> box_flags;        ///< [n_boxes], bits of box_flag

    TreeParticles sources, targets;
    ConstView<std::int32_t> user_source_ids;  ///< [n_sources]: user index of a source in tree order
    ConstView<std::int32_t> sorted_target_ids;  ///< [n_targets]: tree index of a user's target

    BoxId child(int number, BoxId box) const {
        return box_child_ids(number * aligned_n_boxes + box);
    }
    double center(int axis, BoxId box) const { return box_centers(axis * aligned_n_boxes + box); }
    double half_width(BoxId box) const { return std::ldexp(root_extent, -(box_levels(box) + 1)); }
    bool have_extent() const { return sources.have_extent() || targets.have_extent(); }
};

}  // namespace connectivity
