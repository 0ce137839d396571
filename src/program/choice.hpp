// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Options of the command line whose value is one of some names.

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

namespace connectivity::program {

/// CLI11's own transformers take, and list in their message, the numbers of enumerators, too.
template <class Target, class Enum>
CLI::Option* add_choice(CLI::App& sub, const std::string& flag, Target& target,
                        const std::map<std::string, Enum>& names, const std::string& text) {
    std::vector<std::string> words;
    for (const auto& [name, value] : names) words.push_back(name);
    const auto number_of = [names, words](std::string& word) {
        const auto at = names.find(word);
        if (at == names.end())
            return fmt::format("'{}', must be one of {}", word, fmt::join(words, ", "));
        word = std::to_string(static_cast<int>(at->second));
        return std::string();
    };
    return sub.add_option(flag, target, text)
        ->transform(CLI::Validator(number_of, ""))
        ->type_name(fmt::format("{}", fmt::join(words, "|")));
}

}  // namespace connectivity::program
