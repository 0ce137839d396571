// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the opaque handles of connectivity_tree.h and connectivity_lists.h are, and the owners of
/// their views.

#include <cstdint>
#include <optional>
#include <vector>

#include <connectivity/base/csr.hpp>
#include <connectivity/lists/traversal.hpp>
#include <connectivity/lists/work.hpp>
#include <connectivity/tree/box_tree.hpp>

#include "arrays.hpp"
#include "connectivity_lists.h"
#include "registry.hpp"
#include "structs.hpp"
#include "view_structs.hpp"

struct conn_tree final : connectivity::capi::Handle {
    const std::int64_t context_budget;
    std::optional<connectivity::BoxTree> builder{std::in_place};  ///< none after Kokkos stopped
    std::optional<connectivity::TreeView> given;  ///< boxes of the host, in place of built ones
    connectivity::Offset given_bytes = 0;
    std::uint64_t generation = 0;  ///< 0: there are no boxes

    explicit conn_tree(std::int64_t budget) : context_budget(budget) {}
    const connectivity::TreeView& view() const { return given ? *given : builder->view(); }
    const char* kind() const noexcept override { return "a tree"; }
    void drop_views() noexcept override {
        builder.reset();
        given.reset();
        generation = 0;
    }
};

struct conn_lists final : connectivity::capi::Handle {
    const std::int64_t context_budget;
    std::optional<connectivity::FMMTraversalInfo> lists{std::in_place};
    mutable std::optional<connectivity::WorkCounts> work;  ///< once asked for
    std::uint64_t generation = 0;                          ///< of the tree; 0: there are no lists

    explicit conn_lists(std::int64_t budget) : context_budget(budget) {}
    const char* kind() const noexcept override { return "interaction lists"; }
    void drop_views() noexcept override {
        lists.reset();
        work.reset();
        generation = 0;
    }
};

namespace connectivity::capi {

CONNECTIVITY_FIRST_LAYOUT(conn_tree_options, budget_bytes);
CONNECTIVITY_FIRST_LAYOUT(conn_tree_input, refine_weights);
CONNECTIVITY_FIRST_LAYOUT(conn_tree_view, owner);
CONNECTIVITY_FIRST_LAYOUT(conn_box_list_view, owner);
CONNECTIVITY_FIRST_LAYOUT(conn_particles_view, owner);
CONNECTIVITY_FIRST_LAYOUT(conn_lists_options, budget_bytes);
CONNECTIVITY_FIRST_LAYOUT(conn_classes_view, owner);

/// The tree behind the handle. Throws Error{null | handle | not_built}.
const conn_tree& built_tree(const conn_tree* tree);

/// The lists behind the handle. Throws as built_tree.
const conn_lists& built_lists(const conn_lists* lists);

/// Counts builds of all trees of the process. Used under the call mutex.
std::uint64_t next_tree_generation();

/// A text for a buffer of the host, which asks with NULL for its bytes first.
void copy_text_out(const std::string& lines, char* text, std::int64_t capacity,
                   std::int64_t* length);

/// The options' own, or that of the context where it is 0. Throws Error{argument} if negative.
std::int64_t read_budget(std::int64_t bytes, std::int64_t context_budget);

/// Throws Error{unsupported} unless it is 0.
void check_reserved(std::int32_t reserved, const char* name);

struct TreePin final : Handle {
    TreeView tree;

    const char* kind() const noexcept override { return "the owner of a tree view"; }
    void drop_views() noexcept override { tree = {}; }
};

struct BoxListPin final : Handle {
    LevelBoxList list;
    ConstView<BoxId> row_boxes;

    const char* kind() const noexcept override { return "the owner of a box list view"; }
    void drop_views() noexcept override {
        list = {};
        row_boxes = {};
    }
};

/// Pins the list; row_boxes may be empty. Throws Error: struct_size, unsupported, argument, null.
void hand_over_list(const LevelBoxList& list, const ConstView<BoxId>& row_boxes,
                    std::uint64_t generation, std::int32_t space, conn_box_list_view* view);

/// Value i is element i * stride.
struct HostValues {
    const void* data;
    Offset stride;
};

/// Particles of the host as trees and gravity take them, valid while this lives: arrays that it
/// cannot take as they are have been copied.
class HostParticles {
public:
    /// Throws Error: null, argument, too_many, unsupported, memory; names are the arguments'. radii
    /// NULL: points.
    ParticleArray read(const conn_array* positions, std::int32_t n_arrays, int dim,
                       const conn_array* radii, const char* name, const char* radii_name);
    /// [n], of the type of the arrays before; `of` names the array of the n particles.
    HostValues read_values(const conn_array& values, Offset n, const char* name, const char* of);
    /// [n] contiguous, of 32 bits.
    const std::int32_t* read_weights(const conn_array& weights, Offset n);

    CoordinateType coordinates() const;

private:
    void agree_on(std::int32_t dtype, const char* name);
    const void* keep(const Columns& columns);

    std::optional<std::int32_t> dtype_;
    std::vector<View<double>> copies_;
    View<std::int32_t> weights_;
};

}  // namespace connectivity::capi
