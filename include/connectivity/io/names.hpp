// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Words for enumerators: those that are typed on the command line and stand in files.

#include <map>
#include <string>

namespace connectivity {

/// The word of a value; empty if it has none.
template <class Enum>
std::string name_of(Enum value, const std::map<std::string, Enum>& names) {
    for (const auto& [name, meaning] : names)
        if (meaning == value) return name;
    return {};
}

}  // namespace connectivity
