// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include <connectivity/base/types.hpp>

#include "connectivity_gravity.h"
#include "connectivity_lists.h"
#include "guard.hpp"
#include "structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

#if defined(NDEBUG)
constexpr bool has_asserts = false;
#else
constexpr bool has_asserts = true;
#endif

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) >= 0x20) out += c;
    }
    return out + "\"";
}

std::string listed(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + quoted(name);
    return "[" + out + "]";
}

std::string describe_build() {
    const auto flag = [](bool value) { return value ? "true" : "false"; };
    const bool has_device = runtime_has_device();
    return "{\"version\": " + quoted(CONN_VERSION_STRING) +
           ", \"kokkos\": " + quoted(runtime_description()) +
           ", \"kokkos_linkage\": " + quoted(CONNECTIVITY_KOKKOS_LINKAGE) +
           ", \"backends\": " + listed(runtime_backends()) + ", \"device\": " + flag(has_device) +
           ", \"spaces\": " + listed({"host", "host_pinned"}) +
           ", \"compiler\": " + quoted(__VERSION__) +
           ", \"max_nodes\": " + std::to_string(max_slots) + ", \"asserts\": " + flag(has_asserts) +
           "}";
}

}  // namespace

const char* conn_status_text(conn_status status) {
    return status_text(static_cast<Status>(status));
}

const char* conn_last_error(void) { return last_error(); }

void conn_set_error(const char* text) {
    if (text == nullptr) return clear_error();
    set_error(text);
}

int32_t conn_version(void) { return CONN_VERSION; }

const char* conn_version_string(void) { return CONN_VERSION_STRING; }

const char* conn_build_info(void) {
    try {
        static const auto* const leaked = new std::string(describe_build());
        return leaked->c_str();
    } catch (...) {
        return "{}";
    }
}

// Not under the call mutex: stopping waits for running calls and empties the registry under it.
conn_status conn_shutdown(void) {
    clear_error();
    try {
        require_no_callback();
        stop_runtime();
        return CONN_OK;
    } catch (const Error& e) {
        return e.status() == Status::finalized ? CONN_OK
                                               : record_error(e.status(), __func__, e.what());
    } catch (const std::exception& e) {
        return record_error(Status::internal, __func__, e.what());
    } catch (...) {
        return record_error(Status::internal, __func__, "unknown exception");
    }
}

int64_t conn_abi_sizeof(int32_t which) {
    switch (which) {
        case CONN_STRUCT_ARRAY: return sizeof(conn_array);
        case CONN_STRUCT_CONTEXT_OPTIONS: return sizeof(conn_context_options);
        case CONN_STRUCT_MAP_OPTIONS: return sizeof(conn_map_options);
        case CONN_STRUCT_MAP_INFO: return sizeof(conn_map_info);
        case CONN_STRUCT_ROWS_VIEW: return sizeof(conn_rows_view);
        case CONN_STRUCT_PAIRS_VIEW: return sizeof(conn_pairs_view);
        case CONN_STRUCT_REPORT_ENTRY: return sizeof(conn_report_entry);
        case CONN_STRUCT_INTERSECTION_VIEW: return sizeof(conn_intersection_view);
        case CONN_STRUCT_BOUNDARY_NODES: return sizeof(conn_boundary_nodes);
        case CONN_STRUCT_ESTIMATE: return sizeof(conn_estimate);
        case CONN_STRUCT_TREE_OPTIONS: return sizeof(conn_tree_options);
        case CONN_STRUCT_TREE_INPUT: return sizeof(conn_tree_input);
        case CONN_STRUCT_TREE_VIEW: return sizeof(conn_tree_view);
        case CONN_STRUCT_BOX_LIST_VIEW: return sizeof(conn_box_list_view);
        case CONN_STRUCT_PARTICLES_VIEW: return sizeof(conn_particles_view);
        case CONN_STRUCT_LISTS_OPTIONS: return sizeof(conn_lists_options);
        case CONN_STRUCT_CLASSES_VIEW: return sizeof(conn_classes_view);
        case CONN_STRUCT_GRAVITY_OPTIONS: return sizeof(conn_gravity_options);
        case CONN_STRUCT_GRAVITY_INFO: return sizeof(conn_gravity_info);
        case CONN_STRUCT_GRAVITY_VIEW: return sizeof(conn_gravity_view);
        default: return 0;
    }
}
