// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The owner of a box tree over particles: an adaptive 2^dim tree whose leaves hold few of them.
///
/// Invariants: those of TreeView; the same bits for any number of threads. A box at level l is the
/// half-open cube of points whose scaled coordinate (x - lo) / root_extent, rounded in the host's
/// precision, begins with the same l bits on every axis, so particles that differ are told apart at
/// any depth up to 254 levels. A rebuild that throws leaves the tree as it was; views handed out
/// stay valid and unchanged. Cost: O(N) per level of the tree that holds N particles; memory:
/// `bytes()`.

#include <memory>

#include <connectivity/base/report.hpp>
#include <connectivity/tree/mesh_boxes.hpp>
#include <connectivity/tree/tree_input.hpp>

namespace connectivity {

class BoxTree {
public:
    BoxTree();
    ~BoxTree();
    BoxTree(BoxTree&&) noexcept;  ///< what was moved from may only be assigned to
    BoxTree& operator=(BoxTree&&) noexcept;

    /// Builds the tree of these particles. Throws Error: argument (sizes, strides, limits, weights,
    /// coincident particles), nonfinite, support (a radius), box (not a cube, a particle outside),
    /// too_many (2^31 particles or boxes, more than 254 levels), budget, memory.
    void build(const TreeInput& input, const TreeOptions& options);

    /// The tree of these boxes, without particles. Levels, centres and the other table (parents or
    /// children) are derived. Throws Error: argument (a box out of order, with two parents or none,
    /// sizes), null, box, too_many, memory.
    void build(const MeshBoxes& boxes);

    /// Of the last build; empty before.
    const TreeView& view() const;

    /// Milliseconds and bytes of the parts of the last build.
    const Report& report() const;

    Offset bytes() const;          ///< of the tree
    Offset scratch_bytes() const;  ///< kept for the next build
    void release_scratch();        ///< gives that back

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Bytes that the largest arrays of a build take, before it starts: the arrays of particles in tree
/// order and those that sort them; boxes come on top.
Offset estimate_tree_bytes(const TreeInput& input);

}  // namespace connectivity
