// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The reference cases as search problems.

#include <support/case.hpp>
#include <support/reference_files.hpp>

namespace connectivity::test {

/// The nodes of a case; with rows of ghosts if the file stores them.
inline Case case_of(const nlohmann::json& source) {
    Case c;
    c.dim = source["dim"].get<int>();
    c.text = source["name"].get<std::string>();
    for (const nlohmann::json& list : source["nodeLists"]) {
        ListData data;
        data.name = list["name"].get<std::string>();
        data.n_internal = list["nInternal"].get<Offset>();
        data.extent = list["kernelExtent"].get<double>();
        data.x = flat(list["positions"]);
        data.H = flat(list["H"]);
        data.tensor = true;
        c.lists.push_back(std::move(data));
    }
    const nlohmann::json& stored = source["expected"]["numStored"];
    for (std::size_t k = 0; k < c.lists.size(); ++k)
        c.ghost_rows = c.ghost_rows || stored[k].get<Offset>() != c.lists[k].n_internal;
    return c;
}

}  // namespace connectivity::test
