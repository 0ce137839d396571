// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The reference cases of the connectivity map, decided in exact rational arithmetic, as they lie
/// in the repository.

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace connectivity::test {

/// The copy in the repository: {"cases": [...]}.
inline const std::string reference_file =
    CONNECTIVITY_SOURCE_DIR "/tests/support/data/connectivity_cases.json";

/// Values of nested arrays, end to end.
inline std::vector<double> flat(const nlohmann::json& rows) {
    std::vector<double> values;
    for (const nlohmann::json& row : rows)
        for (const nlohmann::json& value : row) values.push_back(value.get<double>());
    return values;
}

/// The case whose name begins so: "c08". Throws std::runtime_error.
inline nlohmann::json reference_case(const std::string& name) {
    std::ifstream file(reference_file);
    if (!file) throw std::runtime_error("missing: " + reference_file);
    const nlohmann::json all = nlohmann::json::parse(file);
    for (const nlohmann::json& source : all["cases"])
        if (source["name"].get<std::string>().starts_with(name)) return source;
    throw std::runtime_error(reference_file + " has no case " + name);
}

}  // namespace connectivity::test
