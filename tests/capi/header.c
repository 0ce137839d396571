/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Compiled as C99, C11 and C++17 with every warning an error: the header alone is enough. */
#include <connectivity.h>
#include <connectivity_boundary.h>

int main(void) {
    conn_context_options context = CONN_CONTEXT_OPTIONS_INIT;
    conn_map_options map = CONN_MAP_OPTIONS_INIT;
    conn_map_info info = CONN_MAP_INFO_INIT;
    conn_rows_view rows = CONN_ROWS_VIEW_INIT;
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    conn_report_entry entry = CONN_REPORT_ENTRY_INIT;
    conn_intersection_view common = CONN_INTERSECTION_VIEW_INIT;
    conn_boundary_nodes ghosts = CONN_BOUNDARY_NODES_INIT;
    conn_estimate estimate = CONN_ESTIMATE_INIT;
    const double x[4] = {0, 1, 2, 3};
    const float f[4] = {0, 1, 2, 3};
    const int32_t narrow[4] = {0, 1, 2, 3};
    const int64_t wide[4] = {0, 1, 2, 3};
    const conn_array vector = conn_array_vector(x, 4), matrix = conn_array_matrix(x, 2, 2),
                     floats = conn_array_matrix_float(f, 2, 2), column = conn_array_planar(x, 2, 2),
                     columns = conn_array_planar_float(f, 2, 2);
    const int types = conn_array_vector_float(f, 4).dtype == CONN_FLOAT32 &&
                      conn_array_vector_int32(narrow, 4).dtype == CONN_INT32 &&
                      conn_array_vector_int64(wide, 4).dtype == CONN_INT64 &&
                      floats.dtype == CONN_FLOAT32 && floats.stride[0] == 2 &&
                      column.stride[1] == 2 && columns.stride[0] == 1 && columns.stride[1] == 2;
    const int ok =
        context.device_id == -1 && map.mode == CONN_GATHER_SCATTER && map.rows == 1 &&
        map.pairs == 1 && info.struct_size == sizeof info && rows.owner == NULL &&
        pairs.owner == NULL && entry.struct_size == sizeof entry && vector.extent[0] == 4 &&
        matrix.stride[0] == 2 && matrix.stride[1] == 1 && common.struct_size == sizeof common &&
        common.owner == NULL && ghosts.struct_size == sizeof ghosts && ghosts.global_id == NULL &&
        map.order == CONN_ORDER_SLOT && map.active == NULL && map.n_active == 0 &&
        map.interactions == NULL && pairs.ranks == NULL && context.stream == NULL &&
        map.index_base == 0 && map.reserved_3 == 0 && estimate.struct_size == sizeof estimate &&
        estimate.relative_error == 0 && types && conn_version() == CONN_VERSION && CONN_OK == 0;
    return ok ? 0 : 1;
}
