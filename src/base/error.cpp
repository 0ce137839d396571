// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/base/error.hpp>

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

}  // namespace connectivity
