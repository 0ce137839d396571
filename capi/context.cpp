// SPDX-License-Identifier: BSD-3-Clause
#include "guard.hpp"
#include "objects.hpp"
#include "structs.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

constexpr std::int32_t max_threads = 512;  // what Kokkos 3.4 has room for

void check_options(const conn_context_options& o) {
    if (o.n_threads < 0 || o.n_threads > max_threads)
        throw Error(Status::argument, "options->n_threads = " + std::to_string(o.n_threads) +
                                          ", must be in [0, " + std::to_string(max_threads) + "]");
    if (o.device_id < -1)
        throw Error(Status::argument,
                    "options->device_id = " + std::to_string(o.device_id) + ", must be >= -1");
    if (o.budget_bytes < 0)
        throw Error(Status::argument,
                    "options->budget_bytes = " + std::to_string(o.budget_bytes) + ", must be >= 0");
    const bool has_device = runtime_has_device();
    if (o.stream != nullptr)
        throw Error(Status::unsupported,
                    has_device ? "options->stream is set, but this version runs its kernels in the "
                                 "stream of its own; use NULL"
                               : "options->stream is set, but this build has no device backend; "
                                 "use NULL");
    if (o.device_id >= 0 && !has_device)
        throw Error(Status::unsupported, "options->device_id = " + std::to_string(o.device_id) +
                                             ", but this build has no device backend; use -1");
}

void check_threads(std::int32_t asked) {
    if (asked != 0 && asked != runtime_threads())
        throw Error(Status::unsupported, "options->n_threads = " + std::to_string(asked) +
                                             ", but the library already runs with " +
                                             std::to_string(runtime_threads()) +
                                             " in this process");
}

}  // namespace

conn_status conn_context_options_init(conn_context_options* options, size_t size) {
    return guarded(__func__, [&] {
        init_struct(options, size, conn_context_options CONN_CONTEXT_OPTIONS_INIT, "options");
    });
}

conn_status conn_context_create(const conn_context_options* options, conn_context** context) {
    return guarded(__func__, [&] {
        if (context == nullptr) throw Error(Status::null, "context is NULL");
        conn_context_options ours = CONN_CONTEXT_OPTIONS_INIT;
        if (options != nullptr) ours = read_struct(options, ours, "options");
        check_options(ours);
        start_runtime({ours.n_threads, ours.device_id});
        Registry::instance().watch_runtime();
        check_threads(ours.n_threads);
        auto made = std::make_unique<conn_context>();
        made->budget_bytes = ours.budget_bytes;
        *context = Registry::instance().add(std::move(made));
    });
}

conn_status conn_context_destroy(conn_context** context) {
    return guarded(__func__, [&] { Registry::instance().destroy(context, "context"); });
}

conn_status conn_context_set_log(conn_context* context, int32_t level, conn_log_callback callback,
                                 void* user_data) {
    return guarded_with_runtime(__func__, [&] {
        auto& ours = Registry::instance().get<conn_context>(context, "context");
        if (level < CONN_LOG_NONE || level > CONN_LOG_DEBUG)
            throw Error(Status::argument,
                        "level = " + std::to_string(level) + ", must be one of CONN_LOG_*");
        if (level != CONN_LOG_NONE && callback == nullptr)
            throw Error(Status::null, "callback is NULL, but level is not CONN_LOG_NONE");
        *ours.log = {level, callback, user_data};
    });
}

conn_status conn_context_threads(const conn_context* context, int32_t* n_threads) {
    return guarded_with_runtime(__func__, [&] {
        Registry::instance().get<const conn_context>(context, "context");
        if (n_threads == nullptr) throw Error(Status::null, "n_threads is NULL");
        *n_threads = runtime_threads();
    });
}
