// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>

#include "guard.hpp"
#include "objects.hpp"
#include "structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

const Report& report_of(const conn_map* handle) {
    return Registry::instance().get<const conn_map>(handle, "map").map->report();
}

template <class T>
const T& item(const std::vector<T>& items, std::int32_t index) {
    if (index < 0 || index >= static_cast<std::int64_t>(items.size()))
        throw Error(Status::argument, "index = " + std::to_string(index) + ", must be in [0, " +
                                          std::to_string(items.size()) + ")");
    return items[static_cast<std::size_t>(index)];
}

}  // namespace

conn_status conn_map_report_entry(const conn_map* map, int32_t index, conn_report_entry* entry) {
    return guarded_with_runtime(__func__, [&] {
        const ReportEntry& from = item(report_of(map).entries(), index);
        conn_report_entry out =
            read_struct(entry, conn_report_entry CONN_REPORT_ENTRY_INIT, "entry");
        out.product = from.product.c_str();
        out.asked_by = from.asked_by.c_str();
        out.reason = from.reason.c_str();
        out.bytes = from.bytes;
        out.ms = from.ms;
        out.built = from.built ? 1 : 0;
        out.reused = from.reused ? 1 : 0;
        write_struct(entry, out, out.struct_size);
    });
}

conn_status conn_map_report_counter(const conn_map* map, int32_t index, const char** name,
                                    int64_t* value) {
    return guarded_with_runtime(__func__, [&] {
        const ReportCounter& from = item(report_of(map).counters(), index);
        if (name != nullptr) *name = from.name.c_str();
        if (value != nullptr) *value = from.value;
    });
}

conn_status conn_map_report_text(const conn_map* map, char* buffer, int64_t capacity,
                                 int64_t* length) {
    return guarded_with_runtime(__func__, [&] {
        const std::string text = report_of(map).text();
        if (length == nullptr) throw Error(Status::null, "length is NULL");
        *length = static_cast<std::int64_t>(text.size());
        if (buffer == nullptr) return;
        if (capacity <= *length)
            throw Error(Status::buffer, "capacity = " + std::to_string(capacity) +
                                            ", must be at least " + std::to_string(*length + 1));
        std::memcpy(buffer, text.c_str(), text.size() + 1);
    });
}
