// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/base/error.hpp>

#include <cstdio>

namespace connectivity {

const char* status_text(Status status) noexcept {
    switch (status) {
#define CONN_STATUS_CASE(NAME, name, value, text) \
    case Status::name: return text;
        CONN_STATUS_LIST(CONN_STATUS_CASE)
#undef CONN_STATUS_CASE
    }
    return "unknown status";
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

}  // namespace connectivity
