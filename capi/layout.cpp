// SPDX-License-Identifier: BSD-3-Clause
/// The ABI, locked: sizes and offsets of every struct and values of every enumerator that hosts
/// have compiled in. If a line here fails, old programs break.

#include <cstddef>
#include <string_view>
#include <type_traits>

#include <connectivity/base/error.hpp>

#include "connectivity_boundary.h"
#include "connectivity_query.h"

namespace {

template <class T>
constexpr bool is_plain = std::is_standard_layout_v<T>&& std::is_trivially_copyable_v<T>;

static_assert(sizeof(void*) == 8 && sizeof(std::size_t) == 8,
              "layouts are those of 64-bit machines");
static_assert(std::string_view(CONN_VERSION_STRING) == CONNECTIVITY_VERSION);
static_assert(CONN_VERSION == 100);
static_assert(sizeof(conn_status) == 4);

#define CONN_CHECK_OFFSET(type, member, at) static_assert(offsetof(type, member) == (at))

static_assert(is_plain<conn_array> && sizeof(conn_array) == 56);
CONN_CHECK_OFFSET(conn_array, data, 0);
CONN_CHECK_OFFSET(conn_array, space, 8);
CONN_CHECK_OFFSET(conn_array, device_id, 12);
CONN_CHECK_OFFSET(conn_array, dtype, 16);
CONN_CHECK_OFFSET(conn_array, ndim, 20);
CONN_CHECK_OFFSET(conn_array, extent, 24);
CONN_CHECK_OFFSET(conn_array, stride, 40);

static_assert(is_plain<conn_context_options> && sizeof(conn_context_options) == 32);
CONN_CHECK_OFFSET(conn_context_options, struct_size, 0);
CONN_CHECK_OFFSET(conn_context_options, n_threads, 8);
CONN_CHECK_OFFSET(conn_context_options, device_id, 12);
CONN_CHECK_OFFSET(conn_context_options, budget_bytes, 16);
CONN_CHECK_OFFSET(conn_context_options, stream, 24);

static_assert(is_plain<conn_map_options> && sizeof(conn_map_options) == 168);
CONN_CHECK_OFFSET(conn_map_options, struct_size, 0);
CONN_CHECK_OFFSET(conn_map_options, rows, 8);
CONN_CHECK_OFFSET(conn_map_options, pairs, 12);
CONN_CHECK_OFFSET(conn_map_options, ghost_rows, 16);
CONN_CHECK_OFFSET(conn_map_options, spatial_order, 20);
CONN_CHECK_OFFSET(conn_map_options, mode, 24);
CONN_CHECK_OFFSET(conn_map_options, method, 28);
CONN_CHECK_OFFSET(conn_map_options, periodic, 32);
CONN_CHECK_OFFSET(conn_map_options, reserved, 44);
CONN_CHECK_OFFSET(conn_map_options, box_lo, 48);
CONN_CHECK_OFFSET(conn_map_options, box_hi, 72);
CONN_CHECK_OFFSET(conn_map_options, budget_bytes, 96);
CONN_CHECK_OFFSET(conn_map_options, skin, 104);
CONN_CHECK_OFFSET(conn_map_options, overlap, 112);
CONN_CHECK_OFFSET(conn_map_options, intersection, 116);
CONN_CHECK_OFFSET(conn_map_options, order, 120);
CONN_CHECK_OFFSET(conn_map_options, reserved_2, 124);
CONN_CHECK_OFFSET(conn_map_options, active, 128);
CONN_CHECK_OFFSET(conn_map_options, n_active, 136);
CONN_CHECK_OFFSET(conn_map_options, interactions, 144);
CONN_CHECK_OFFSET(conn_map_options, n_interactions, 152);
CONN_CHECK_OFFSET(conn_map_options, index_base, 160);
CONN_CHECK_OFFSET(conn_map_options, reserved_3, 164);

static_assert(is_plain<conn_estimate> && sizeof(conn_estimate) == 64);
CONN_CHECK_OFFSET(conn_estimate, struct_size, 0);
CONN_CHECK_OFFSET(conn_estimate, n_entries, 8);
CONN_CHECK_OFFSET(conn_estimate, n_pairs, 16);
CONN_CHECK_OFFSET(conn_estimate, bytes, 24);
CONN_CHECK_OFFSET(conn_estimate, peak_bytes, 32);
CONN_CHECK_OFFSET(conn_estimate, n_sampled, 40);
CONN_CHECK_OFFSET(conn_estimate, relative_error, 48);
CONN_CHECK_OFFSET(conn_estimate, is_lower_bound, 56);
CONN_CHECK_OFFSET(conn_estimate, reserved, 60);

static_assert(is_plain<conn_map_info> && sizeof(conn_map_info) == 72);
CONN_CHECK_OFFSET(conn_map_info, struct_size, 0);
CONN_CHECK_OFFSET(conn_map_info, generation, 8);
CONN_CHECK_OFFSET(conn_map_info, n_slots, 16);
CONN_CHECK_OFFSET(conn_map_info, n_rows, 24);
CONN_CHECK_OFFSET(conn_map_info, n_entries, 32);
CONN_CHECK_OFFSET(conn_map_info, n_pairs, 40);
CONN_CHECK_OFFSET(conn_map_info, bytes, 48);
CONN_CHECK_OFFSET(conn_map_info, dim, 56);
CONN_CHECK_OFFSET(conn_map_info, n_lists, 60);
CONN_CHECK_OFFSET(conn_map_info, n_report_entries, 64);
CONN_CHECK_OFFSET(conn_map_info, n_report_counters, 68);

static_assert(is_plain<conn_rows_view> && sizeof(conn_rows_view) == 88);
CONN_CHECK_OFFSET(conn_rows_view, struct_size, 0);
CONN_CHECK_OFFSET(conn_rows_view, n_rows, 8);
CONN_CHECK_OFFSET(conn_rows_view, n_entries, 16);
CONN_CHECK_OFFSET(conn_rows_view, generation, 24);
CONN_CHECK_OFFSET(conn_rows_view, n_lists, 32);
CONN_CHECK_OFFSET(conn_rows_view, space, 36);
CONN_CHECK_OFFSET(conn_rows_view, device_id, 40);
CONN_CHECK_OFFSET(conn_rows_view, reserved, 44);
CONN_CHECK_OFFSET(conn_rows_view, offsets, 48);
CONN_CHECK_OFFSET(conn_rows_view, slots, 56);
CONN_CHECK_OFFSET(conn_rows_view, list_offset, 64);
CONN_CHECK_OFFSET(conn_rows_view, row_offset, 72);
CONN_CHECK_OFFSET(conn_rows_view, owner, 80);

static_assert(is_plain<conn_pairs_view> && sizeof(conn_pairs_view) == 112);
CONN_CHECK_OFFSET(conn_pairs_view, struct_size, 0);
CONN_CHECK_OFFSET(conn_pairs_view, n_pairs, 8);
CONN_CHECK_OFFSET(conn_pairs_view, n_slots, 16);
CONN_CHECK_OFFSET(conn_pairs_view, generation, 24);
CONN_CHECK_OFFSET(conn_pairs_view, n_lists, 32);
CONN_CHECK_OFFSET(conn_pairs_view, space, 36);
CONN_CHECK_OFFSET(conn_pairs_view, device_id, 40);
CONN_CHECK_OFFSET(conn_pairs_view, reserved, 44);
CONN_CHECK_OFFSET(conn_pairs_view, offsets, 48);
CONN_CHECK_OFFSET(conn_pairs_view, i, 56);
CONN_CHECK_OFFSET(conn_pairs_view, j, 64);
CONN_CHECK_OFFSET(conn_pairs_view, coupling, 72);
CONN_CHECK_OFFSET(conn_pairs_view, list_offset, 80);
CONN_CHECK_OFFSET(conn_pairs_view, owner, 88);
CONN_CHECK_OFFSET(conn_pairs_view, slots, 96);
CONN_CHECK_OFFSET(conn_pairs_view, ranks, 104);

static_assert(is_plain<conn_intersection_view> && sizeof(conn_intersection_view) == 72);
CONN_CHECK_OFFSET(conn_intersection_view, struct_size, 0);
CONN_CHECK_OFFSET(conn_intersection_view, n_pairs, 8);
CONN_CHECK_OFFSET(conn_intersection_view, n_entries, 16);
CONN_CHECK_OFFSET(conn_intersection_view, generation, 24);
CONN_CHECK_OFFSET(conn_intersection_view, in_segment, 32);
CONN_CHECK_OFFSET(conn_intersection_view, space, 36);
CONN_CHECK_OFFSET(conn_intersection_view, device_id, 40);
CONN_CHECK_OFFSET(conn_intersection_view, reserved, 44);
CONN_CHECK_OFFSET(conn_intersection_view, offsets, 48);
CONN_CHECK_OFFSET(conn_intersection_view, slots, 56);
CONN_CHECK_OFFSET(conn_intersection_view, owner, 64);

static_assert(is_plain<conn_boundary_nodes> && sizeof(conn_boundary_nodes) == 64);
CONN_CHECK_OFFSET(conn_boundary_nodes, struct_size, 0);
CONN_CHECK_OFFSET(conn_boundary_nodes, n, 8);
CONN_CHECK_OFFSET(conn_boundary_nodes, n_internal, 16);
CONN_CHECK_OFFSET(conn_boundary_nodes, x, 24);
CONN_CHECK_OFFSET(conn_boundary_nodes, h, 32);
CONN_CHECK_OFFSET(conn_boundary_nodes, H, 40);
CONN_CHECK_OFFSET(conn_boundary_nodes, owner, 48);
CONN_CHECK_OFFSET(conn_boundary_nodes, global_id, 56);

static_assert(is_plain<conn_report_entry> && sizeof(conn_report_entry) == 56);
CONN_CHECK_OFFSET(conn_report_entry, struct_size, 0);
CONN_CHECK_OFFSET(conn_report_entry, product, 8);
CONN_CHECK_OFFSET(conn_report_entry, asked_by, 16);
CONN_CHECK_OFFSET(conn_report_entry, reason, 24);
CONN_CHECK_OFFSET(conn_report_entry, bytes, 32);
CONN_CHECK_OFFSET(conn_report_entry, ms, 40);
CONN_CHECK_OFFSET(conn_report_entry, built, 48);
CONN_CHECK_OFFSET(conn_report_entry, reused, 52);

#undef CONN_CHECK_OFFSET

// Numbers that hosts compare with; a new status takes a new number.
static_assert(CONN_OK == 0 && CONN_E_ARGUMENT == 1 && CONN_E_NULL == 2 && CONN_E_HANDLE == 3);
static_assert(CONN_E_STRUCT_SIZE == 4 && CONN_E_UNSUPPORTED == 5 && CONN_E_NONFINITE == 6);
static_assert(CONN_E_SUPPORT == 7 && CONN_E_NOT_SPD == 8 && CONN_E_BOX == 9 &&
              CONN_E_HALF_BOX == 10);
static_assert(CONN_E_TOO_MANY == 11 && CONN_E_MEMORY == 12 && CONN_E_BUDGET == 13);
static_assert(CONN_E_NOT_BUILT == 14 && CONN_E_STALE == 15 && CONN_E_BUFFER == 16);
static_assert(CONN_E_FINALIZED == 17 && CONN_E_FORKED == 18 && CONN_E_FILE == 19);
static_assert(CONN_E_FORMAT == 20 && CONN_E_CALLBACK == 21 && CONN_E_INTERNAL == -1);
static_assert(CONN_SPACE_HOST == 0 && CONN_SPACE_HOST_PINNED == 1 && CONN_SPACE_DEVICE == 2 &&
              CONN_SPACE_MANAGED == 3);
static_assert(CONN_FLOAT64 == 0 && CONN_FLOAT32 == 1 && CONN_INT32 == 2 && CONN_INT64 == 3);
static_assert(CONN_LOG_NONE == 0 && CONN_LOG_ERROR == 1 && CONN_LOG_INFO == 2 &&
              CONN_LOG_DEBUG == 3);
static_assert(CONN_GATHER == 1 && CONN_SCATTER == 2 && CONN_GATHER_SCATTER == 3);
static_assert(CONN_METHOD_AUTOMATIC == 0 && CONN_METHOD_BRUTE == 1 && CONN_METHOD_CELLS == 2);
static_assert(CONN_METHOD_GROUPS == 3 && CONN_METHOD_DEVICE == 4);
static_assert(CONN_PAIRS_EXPAND == 1 && CONN_ROWS == 1 && CONN_PAIRS == 2);
static_assert(CONN_INTERSECTION_NONE == 0 && CONN_INTERSECTION_ALL == 1 &&
              CONN_INTERSECTION_IN_SEGMENT == 2);
static_assert(CONN_ORDER_SLOT == 0 && CONN_ORDER_KEY == 1);
static_assert(CONN_ANTISYMMETRIC == 1 && CONN_SYMMETRIC == 2 && CONN_TWO_SIDED == 3);
static_assert(CONN_SUM_DETERMINISTIC == 0 && CONN_SUM_ATOMIC == 1);
static_assert(CONN_BOUNDARY_REFLECTING == 1 && CONN_BOUNDARY_PERIODIC == 2);
static_assert(CONN_GHOSTS_KEEP == 0 && CONN_GHOSTS_CULL == 1 && CONN_GHOSTS_CULL_MOST == 2 &&
              CONN_GHOSTS_REFRESH == 3);
static_assert(CONN_FIELD_SCALAR == 0 && CONN_FIELD_VECTOR == 1 && CONN_FIELD_TENSOR == 2);
static_assert(CONN_CANDIDATES_MASTER == 1 && CONN_CANDIDATES_COARSE == 2 &&
              CONN_CANDIDATES_REFINE == 3);
static_assert(CONN_STRUCT_ARRAY == 1 && CONN_STRUCT_CONTEXT_OPTIONS == 2 &&
              CONN_STRUCT_MAP_OPTIONS == 3 && CONN_STRUCT_MAP_INFO == 4);
static_assert(CONN_STRUCT_ROWS_VIEW == 5 && CONN_STRUCT_PAIRS_VIEW == 6 &&
              CONN_STRUCT_REPORT_ENTRY == 7 && CONN_STRUCT_INTERSECTION_VIEW == 8 &&
              CONN_STRUCT_BOUNDARY_NODES == 9 && CONN_STRUCT_ESTIMATE == 10);

}  // namespace
