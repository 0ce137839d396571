// SPDX-License-Identifier: BSD-3-Clause
#include <span>

#include "arguments.hpp"
#include "callbacks.hpp"
#include "guard.hpp"
#include "map_work.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

const NodePairList& pairs_of(const conn_map* map) {
    return Registry::instance().get<const conn_map>(map, "map").map->pairs();
}

/// The fields that a patch is to carry on. Throws Error{null | handle | argument | stale}.
std::vector<PairFieldBase*> read_fields(const ConnectivityMap& map, conn_pair_field* const* fields,
                                        std::int32_t n_fields) {
    check_count(fields, n_fields, max_handles, "fields", "n_fields");
    std::vector<PairFieldBase*> ours;
    for (int k = 0; k < n_fields; ++k) {
        const std::string name = "fields[" + std::to_string(k) + "]";
        PairValues& values = Registry::instance().get<conn_pair_field>(fields[k], name).values;
        if (!values.is_current(map.pairs()))
            throw Error(
                Status::stale,
                name + " belongs to another map, or to its pairs before a rebuild or patch");
        ours.push_back(&values);
    }
    return ours;
}

}  // namespace

conn_status conn_pair_field_create(const conn_map* map, int32_t n_components,
                                   conn_pair_field** field) {
    return guarded_with_runtime(__func__, [&] {
        const NodePairList& pairs = pairs_of(map);
        if (n_components < 1 || n_components > PairValues::max_components)
            throw Error(Status::argument, "n_components = " + std::to_string(n_components) +
                                              ", must be in [1, " +
                                              std::to_string(PairValues::max_components) + "]");
        conn_pair_field*& out = required(field, "field");
        auto made = std::make_unique<conn_pair_field>(n_components);
        made->values.reset(pairs);
        out = Registry::instance().add(std::move(made));
    });
}

conn_status conn_pair_field_destroy(conn_pair_field** field) {
    return guarded(__func__, [&] { Registry::instance().destroy(field, "field"); });
}

conn_status conn_pair_field_reset(conn_pair_field* field, const conn_map* map) {
    return guarded_with_runtime(__func__, [&] {
        Registry::instance().get<conn_pair_field>(field, "field").values.reset(pairs_of(map));
    });
}

conn_status conn_pair_field_data(conn_pair_field* field, const conn_map* map, double** data,
                                 int64_t* n_pairs, int32_t* n_components) {
    return guarded_with_runtime(__func__, [&] {
        PairValues& values = Registry::instance().get<conn_pair_field>(field, "field").values;
        values.require_current(pairs_of(map));
        if (data != nullptr) *data = values.size() > 0 ? values.data() : nullptr;
        if (n_pairs != nullptr) *n_pairs = values.size();
        if (n_components != nullptr) *n_components = values.n_components();
    });
}

conn_status conn_map_patch(conn_map* map, const int32_t* keep, const int32_t* old2new,
                           int64_t n_slots, conn_pair_field* const* fields, int32_t n_fields) {
    return guarded_with_runtime(__func__, [&] {
        auto& handle = Registry::instance().get<conn_map>(map, "map");
        work_on(handle, "patch", [&] {
            ConnectivityMap& ours = *handle.map;
            check_count(keep, n_slots, max_slots, "keep", "n_slots");
            check_count(old2new, n_slots, max_slots, "old2new", "n_slots");
            const auto n = static_cast<std::size_t>(n_slots);
            std::vector<Slot> based;
            const bool converts = !handle.base.is_zero() && n_slots == ours.layout().n_slots();
            if (converts) {
                based.assign(old2new, old2new + n);
                for (Slot& node : based) node = handle.base.in(node);
            }
            const Slot* const new_nodes = converts ? based.data() : old2new;
            ours.patch({keep, n}, {new_nodes, n}, read_fields(ours, fields, n_fields));
        });
    });
}

conn_status conn_map_remove_pairs(conn_map* map, conn_pair_predicate predicate, void* user_data,
                                  conn_pair_field* const* fields, int32_t n_fields) {
    return guarded_with_runtime(__func__, [&] {
        auto& handle = Registry::instance().get<conn_map>(map, "map");
        work_on(handle, "remove_pairs", [&] {
            required(predicate, "predicate");
            handle.map->remove_pairs(HostPredicate{predicate, user_data, handle.base},
                                     read_fields(*handle.map, fields, n_fields));
        });
    });
}
