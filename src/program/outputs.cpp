// SPDX-License-Identifier: BSD-3-Clause
#include "program/outputs.hpp"

#include <filesystem>

#include <fmt/format.h>

#include <connectivity/base/error.hpp>
#include <connectivity/io/pending_file.hpp>

namespace connectivity::program {

void check_outputs(const std::string& input, std::initializer_list<std::string> outputs) {
    for (const auto& path : outputs) {
        std::error_code code;
        if (path.empty()) continue;
        if (std::filesystem::equivalent(path, input, code))
            throw Error(Status::argument, fmt::format("'{}' would overwrite the input", path));
        const PendingFile place(path);
    }
}

}  // namespace connectivity::program
