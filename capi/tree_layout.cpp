// SPDX-License-Identifier: BSD-3-Clause
/// The layouts of connectivity_tree.h and connectivity_lists.h, locked as those of layout.cpp: the
/// Fortran module and other mirrors of the headers rely on them.

#include <cstddef>
#include <type_traits>

#include "connectivity_lists.h"

namespace {

template <class T>
constexpr bool is_plain = std::is_standard_layout_v<T>&& std::is_trivially_copyable_v<T>;

#define CONN_CHECK_OFFSET(type, member, at) static_assert(offsetof(type, member) == (at))

static_assert(is_plain<conn_tree_options> && sizeof(conn_tree_options) == 120);
CONN_CHECK_OFFSET(conn_tree_options, struct_size, 0);
CONN_CHECK_OFFSET(conn_tree_options, kind, 8);
CONN_CHECK_OFFSET(conn_tree_options, max_particles_in_box, 12);
CONN_CHECK_OFFSET(conn_tree_options, max_leaf_refine_weight, 16);
CONN_CHECK_OFFSET(conn_tree_options, extent_norm, 20);
CONN_CHECK_OFFSET(conn_tree_options, stick_out_factor, 24);
CONN_CHECK_OFFSET(conn_tree_options, coincident, 32);
CONN_CHECK_OFFSET(conn_tree_options, hulls, 36);
CONN_CHECK_OFFSET(conn_tree_options, skip_prune, 40);
CONN_CHECK_OFFSET(conn_tree_options, bounding_box, 44);
CONN_CHECK_OFFSET(conn_tree_options, box_lo, 48);
CONN_CHECK_OFFSET(conn_tree_options, box_hi, 72);
CONN_CHECK_OFFSET(conn_tree_options, periodic, 96);
CONN_CHECK_OFFSET(conn_tree_options, reserved, 108);
CONN_CHECK_OFFSET(conn_tree_options, budget_bytes, 112);

static_assert(is_plain<conn_tree_input> && sizeof(conn_tree_input) == 64);
CONN_CHECK_OFFSET(conn_tree_input, struct_size, 0);
CONN_CHECK_OFFSET(conn_tree_input, dim, 8);
CONN_CHECK_OFFSET(conn_tree_input, n_sources, 12);
CONN_CHECK_OFFSET(conn_tree_input, n_targets, 16);
CONN_CHECK_OFFSET(conn_tree_input, reserved, 20);
CONN_CHECK_OFFSET(conn_tree_input, sources, 24);
CONN_CHECK_OFFSET(conn_tree_input, targets, 32);
CONN_CHECK_OFFSET(conn_tree_input, source_radii, 40);
CONN_CHECK_OFFSET(conn_tree_input, target_radii, 48);
CONN_CHECK_OFFSET(conn_tree_input, refine_weights, 56);

static_assert(is_plain<conn_tree_view> && sizeof(conn_tree_view) == 336);
CONN_CHECK_OFFSET(conn_tree_view, struct_size, 0);
CONN_CHECK_OFFSET(conn_tree_view, n_sources, 8);
CONN_CHECK_OFFSET(conn_tree_view, n_targets, 16);
CONN_CHECK_OFFSET(conn_tree_view, n_boxes, 24);
CONN_CHECK_OFFSET(conn_tree_view, aligned_n_boxes, 32);
CONN_CHECK_OFFSET(conn_tree_view, generation, 40);
CONN_CHECK_OFFSET(conn_tree_view, dim, 48);
CONN_CHECK_OFFSET(conn_tree_view, n_levels, 52);
CONN_CHECK_OFFSET(conn_tree_view, coordinates, 56);
CONN_CHECK_OFFSET(conn_tree_view, sources_are_targets, 60);
CONN_CHECK_OFFSET(conn_tree_view, extent_norm, 64);
CONN_CHECK_OFFSET(conn_tree_view, space, 68);
CONN_CHECK_OFFSET(conn_tree_view, device_id, 72);
CONN_CHECK_OFFSET(conn_tree_view, periodic, 76);
CONN_CHECK_OFFSET(conn_tree_view, stick_out_factor, 88);
CONN_CHECK_OFFSET(conn_tree_view, root_extent, 96);
CONN_CHECK_OFFSET(conn_tree_view, bounding_box_min, 104);
CONN_CHECK_OFFSET(conn_tree_view, bounding_box_max, 128);
CONN_CHECK_OFFSET(conn_tree_view, level_start_box_nrs, 152);
CONN_CHECK_OFFSET(conn_tree_view, box_parent_ids, 160);
CONN_CHECK_OFFSET(conn_tree_view, box_child_ids, 168);
CONN_CHECK_OFFSET(conn_tree_view, box_centers, 176);
CONN_CHECK_OFFSET(conn_tree_view, box_levels, 184);
CONN_CHECK_OFFSET(conn_tree_view, box_flags, 192);
CONN_CHECK_OFFSET(conn_tree_view, sources, 200);
CONN_CHECK_OFFSET(conn_tree_view, source_radii, 208);
CONN_CHECK_OFFSET(conn_tree_view, user_source_ids, 216);
CONN_CHECK_OFFSET(conn_tree_view, box_source_starts, 224);
CONN_CHECK_OFFSET(conn_tree_view, box_source_counts_nonchild, 232);
CONN_CHECK_OFFSET(conn_tree_view, box_source_counts_cumul, 240);
CONN_CHECK_OFFSET(conn_tree_view, box_source_bounding_box_min, 248);
CONN_CHECK_OFFSET(conn_tree_view, box_source_bounding_box_max, 256);
CONN_CHECK_OFFSET(conn_tree_view, targets, 264);
CONN_CHECK_OFFSET(conn_tree_view, target_radii, 272);
CONN_CHECK_OFFSET(conn_tree_view, sorted_target_ids, 280);
CONN_CHECK_OFFSET(conn_tree_view, box_target_starts, 288);
CONN_CHECK_OFFSET(conn_tree_view, box_target_counts_nonchild, 296);
CONN_CHECK_OFFSET(conn_tree_view, box_target_counts_cumul, 304);
CONN_CHECK_OFFSET(conn_tree_view, box_target_bounding_box_min, 312);
CONN_CHECK_OFFSET(conn_tree_view, box_target_bounding_box_max, 320);
CONN_CHECK_OFFSET(conn_tree_view, owner, 328);

static_assert(is_plain<conn_box_list_view> && sizeof(conn_box_list_view) == 96);
CONN_CHECK_OFFSET(conn_box_list_view, struct_size, 0);
CONN_CHECK_OFFSET(conn_box_list_view, n_rows, 8);
CONN_CHECK_OFFSET(conn_box_list_view, n_entries, 16);
CONN_CHECK_OFFSET(conn_box_list_view, generation, 24);
CONN_CHECK_OFFSET(conn_box_list_view, is_none, 32);
CONN_CHECK_OFFSET(conn_box_list_view, space, 36);
CONN_CHECK_OFFSET(conn_box_list_view, device_id, 40);
CONN_CHECK_OFFSET(conn_box_list_view, reserved, 44);
CONN_CHECK_OFFSET(conn_box_list_view, starts, 48);
CONN_CHECK_OFFSET(conn_box_list_view, lists, 56);
CONN_CHECK_OFFSET(conn_box_list_view, images, 64);
CONN_CHECK_OFFSET(conn_box_list_view, row_boxes, 72);
CONN_CHECK_OFFSET(conn_box_list_view, nonempty_indices, 80);
CONN_CHECK_OFFSET(conn_box_list_view, owner, 88);

static_assert(is_plain<conn_particles_view> && sizeof(conn_particles_view) == 120);
CONN_CHECK_OFFSET(conn_particles_view, struct_size, 0);
CONN_CHECK_OFFSET(conn_particles_view, n, 8);
CONN_CHECK_OFFSET(conn_particles_view, n_boxes, 16);
CONN_CHECK_OFFSET(conn_particles_view, n_sources, 24);
CONN_CHECK_OFFSET(conn_particles_view, generation, 32);
CONN_CHECK_OFFSET(conn_particles_view, dim, 40);
CONN_CHECK_OFFSET(conn_particles_view, space, 44);
CONN_CHECK_OFFSET(conn_particles_view, device_id, 48);
CONN_CHECK_OFFSET(conn_particles_view, reserved, 52);
CONN_CHECK_OFFSET(conn_particles_view, ids, 56);
CONN_CHECK_OFFSET(conn_particles_view, box_starts, 64);
CONN_CHECK_OFFSET(conn_particles_view, box_counts_nonchild, 72);
CONN_CHECK_OFFSET(conn_particles_view, box_counts_cumul, 80);
CONN_CHECK_OFFSET(conn_particles_view, positions, 88);
CONN_CHECK_OFFSET(conn_particles_view, starts, 96);
CONN_CHECK_OFFSET(conn_particles_view, counts, 104);
CONN_CHECK_OFFSET(conn_particles_view, owner, 112);

static_assert(is_plain<conn_lists_options> && sizeof(conn_lists_options) == 80);
CONN_CHECK_OFFSET(conn_lists_options, struct_size, 0);
CONN_CHECK_OFFSET(conn_lists_options, well_sep_is_n_away, 8);
CONN_CHECK_OFFSET(conn_lists_options, from_sep_smaller_crit, 12);
CONN_CHECK_OFFSET(conn_lists_options, from_sep_smaller_min_nsources_cumul, 16);
CONN_CHECK_OFFSET(conn_lists_options, same_level_non_well_sep_boxes, 24);
CONN_CHECK_OFFSET(conn_lists_options, neighbor_source_boxes, 28);
CONN_CHECK_OFFSET(conn_lists_options, from_sep_siblings, 32);
CONN_CHECK_OFFSET(conn_lists_options, from_sep_smaller, 36);
CONN_CHECK_OFFSET(conn_lists_options, from_sep_bigger, 40);
CONN_CHECK_OFFSET(conn_lists_options, reserved, 44);
CONN_CHECK_OFFSET(conn_lists_options, source_boxes_mask, 48);
CONN_CHECK_OFFSET(conn_lists_options, source_parent_boxes_mask, 56);
CONN_CHECK_OFFSET(conn_lists_options, n_mask, 64);
CONN_CHECK_OFFSET(conn_lists_options, budget_bytes, 72);

static_assert(is_plain<conn_classes_view> && sizeof(conn_classes_view) == 88);
CONN_CHECK_OFFSET(conn_classes_view, struct_size, 0);
CONN_CHECK_OFFSET(conn_classes_view, n_entries, 8);
CONN_CHECK_OFFSET(conn_classes_view, generation, 16);
CONN_CHECK_OFFSET(conn_classes_view, n_classes, 24);
CONN_CHECK_OFFSET(conn_classes_view, n_levels, 28);
CONN_CHECK_OFFSET(conn_classes_view, dim, 32);
CONN_CHECK_OFFSET(conn_classes_view, space, 36);
CONN_CHECK_OFFSET(conn_classes_view, device_id, 40);
CONN_CHECK_OFFSET(conn_classes_view, reserved, 44);
CONN_CHECK_OFFSET(conn_classes_view, classes, 48);
CONN_CHECK_OFFSET(conn_classes_view, level_starts, 56);
CONN_CHECK_OFFSET(conn_classes_view, vectors, 64);
CONN_CHECK_OFFSET(conn_classes_view, angles, 72);
CONN_CHECK_OFFSET(conn_classes_view, owner, 80);

#undef CONN_CHECK_OFFSET

static_assert(CONN_TREE_ADAPTIVE == 0 && CONN_TREE_LEVEL_RESTRICTED == 1 &&
              CONN_TREE_NON_ADAPTIVE == 2);
static_assert(CONN_EXTENT_NONE == 0 && CONN_EXTENT_LINF == 1 && CONN_EXTENT_L2 == 2);
static_assert(CONN_COINCIDENT_ERROR == 0 && CONN_COINCIDENT_LEAF == 1);
static_assert(CONN_HULLS_AUTOMATIC == 0 && CONN_HULLS_ALWAYS == 1 && CONN_HULLS_NEVER == 2);
static_assert(CONN_BOX_HAS_OWN_SOURCES == 1 && CONN_BOX_HAS_OWN_TARGETS == 2 &&
              CONN_BOX_HAS_CHILD_SOURCES == 4 && CONN_BOX_HAS_CHILD_TARGETS == 8);
static_assert(CONN_CRIT_DEFAULT == 0 && CONN_CRIT_STATIC_LINF == 1 && CONN_CRIT_PRECISE_LINF == 2 &&
              CONN_CRIT_STATIC_L2 == 3);
static_assert(CONN_LIST_SOURCE_BOXES == 0 && CONN_LIST_TARGET_BOXES == 1 &&
              CONN_LIST_SOURCE_PARENT_BOXES == 2 && CONN_LIST_TARGET_OR_TARGET_PARENT_BOXES == 3 &&
              CONN_LIST_SAME_LEVEL_NON_WELL_SEP_BOXES == 4 && CONN_LIST_COLLEAGUES == 5 &&
              CONN_LIST_NEIGHBOR_SOURCE_BOXES == 6 && CONN_LIST_FROM_SEP_SIBLINGS == 7 &&
              CONN_LIST_FROM_SEP_SMALLER == 8 && CONN_LIST_FROM_SEP_CLOSE_SMALLER == 9 &&
              CONN_LIST_FROM_SEP_BIGGER == 10 && CONN_LIST_FROM_SEP_CLOSE_BIGGER == 11);
static_assert(CONN_CLASSES_TRANSLATION_PER_LEVEL == 0 && CONN_CLASSES_TRANSLATION == 1 &&
              CONN_CLASSES_ROTATION == 2);
static_assert(CONN_WORK_P2P == 0 && CONN_WORK_P2P_CLOSE == 1 && CONN_WORK_M2L == 2 &&
              CONN_WORK_M2P == 3 && CONN_WORK_P2L == 4 && CONN_WORK_P2M == 5 &&
              CONN_WORK_L2P == 6 && CONN_WORK_M2M == 7 && CONN_WORK_L2L == 8 &&
              CONN_WORK_FROM_SEP_SMALLER_ENTRIES == 9 && CONN_WORK_FROM_SEP_BIGGER_ENTRIES == 10);
static_assert(CONN_STRUCT_TREE_OPTIONS == 11 && CONN_STRUCT_TREE_INPUT == 12 &&
              CONN_STRUCT_TREE_VIEW == 13 && CONN_STRUCT_BOX_LIST_VIEW == 14 &&
              CONN_STRUCT_PARTICLES_VIEW == 15 && CONN_STRUCT_LISTS_OPTIONS == 16 &&
              CONN_STRUCT_CLASSES_VIEW == 17);

}  // namespace
