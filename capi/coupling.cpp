// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.hpp"
#include "callbacks.hpp"
#include "guard.hpp"
#include "map_work.hpp"

using namespace connectivity;
using namespace connectivity::capi;

conn_status conn_map_set_coupling(conn_map* map, const double* values, int64_t n_pairs) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        NodePairList& pairs = ours.map->pairs();
        if (values == nullptr && n_pairs == 0) return pairs.clear_coupling();
        required(values, "values");
        if (n_pairs != pairs.size())
            throw Error(Status::argument, "n_pairs = " + std::to_string(n_pairs) + ", must be " +
                                              std::to_string(pairs.size()) +
                                              " as in the pair list");
        pairs.set_coupling(std::span(values, static_cast<std::size_t>(n_pairs)));
        note_memory(ours);
    });
}

conn_status conn_map_set_coupling_function(conn_map* map, conn_pair_function function,
                                           void* user_data) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_map>(map, "map");
        NodePairList& pairs = ours.map->pairs();
        required(function, "function");
        pairs.set_coupling(HostFunction{function, user_data, ours.base});
        note_memory(ours);
    });
}
