// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The one exception of the library: a status and a sentence that says what, where, value and
/// allowed range.
///
/// Invariant: an operation that throws leaves its object as it was before the call.

#include <cstdint>
#include <stdexcept>
#include <string>

#include <connectivity/base/status.h>

namespace connectivity {

enum class Status : std::int32_t {
#define CONN_STATUS_ENUMERATOR(NAME, name, value, text) name = value,
    CONN_STATUS_LIST(CONN_STATUS_ENUMERATOR)
#undef CONN_STATUS_ENUMERATOR
};

/// Static text of a status; "unknown status" for a number that is none.
const char* status_text(Status status) noexcept;

class Error : public std::runtime_error {
public:
    Error(Status status, const std::string& text) : std::runtime_error(text), status_(status) {}
    Status status() const noexcept { return status_; }

private:
    Status status_;
};

/// All digits of a value, for texts.
std::string number(double value);

}  // namespace connectivity
