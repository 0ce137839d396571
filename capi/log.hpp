// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The log of a context, shared with the maps that were made with it and outlive it.

#include <string>

#include "connectivity.h"
#include "guard.hpp"

namespace connectivity::capi {

struct Log {
    std::int32_t level = CONN_LOG_NONE;
    conn_log_callback callback = nullptr;
    void* user_data = nullptr;

    bool wants(std::int32_t line_level) const { return line_level <= level; }
    void write(std::int32_t line_level, const std::string& line) const {
        if (!wants(line_level)) return;
        CallbackScope scope;
        callback(user_data, line_level, line.c_str());
        scope.clear_error();
    }
};

}  // namespace connectivity::capi
