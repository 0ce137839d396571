// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Reference data that is too large for the repository: a folder beside the checkout, or the one
/// that the environment variable CONNECTIVITY_SHARED_DIR names. Tests skip what needs it where it
/// is absent.

#include <cstdlib>
#include <string>

namespace connectivity::test {

/// Path of a file there; it may not exist.
inline std::string shared_data(const std::string& file) {
    const char* const told = std::getenv("CONNECTIVITY_SHARED_DIR");
    return (told != nullptr ? std::string(told) : CONNECTIVITY_SOURCE_DIR "/../shared") + "/" +
           file;
}

}  // namespace connectivity::test
