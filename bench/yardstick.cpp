// SPDX-License-Identifier: BSD-3-Clause
#include "yardstick.hpp"

#include <cstdlib>
#include <iostream>

#include <support/process.hpp>

namespace connectivity::bench {
namespace {

const char* program() { return std::getenv("CONNECTIVITY_YARDSTICK"); }

/// The number behind a word; 0 if the word is not there.
double number_after(const std::string& text, const std::string& word) {
    const std::size_t at = text.find(" " + word + " ");
    return at == std::string::npos ? 0 : std::atof(text.c_str() + at + word.size() + 2);
}

}  // namespace

bool yardstick_is_set() { return program() != nullptr && *program() != 0; }

nlohmann::json run_yardstick(const CaseName& c, std::int64_t n_pairs) {
    const std::string mode = c.form == "rows" ? "ar" : c.form == "pairs" ? "br" : "abr";
    const test::RunResult run =
        test::run_command(std::string("'") + program() + "' -w " + c.workload + " -m " + mode +
                          " -t " + c.threads + " -r " + (c.first ? "1" : "5") + " -nocheck");
    const auto found = static_cast<std::int64_t>(
        c.form == "rows" ? number_after(run.out, "rows") / 2 : number_after(run.out, "pairs"));
    const double ms =
        c.first ? 1e3 * number_after(run.out, "first") : number_after(run.out, "steady");
    if (run.status != 0 || ms <= 0 || found <= 0 || (n_pairs >= 0 && found != n_pairs)) {
        std::cerr << "error: " << c.name() << ": exit status " << run.status << ", " << found
                  << " pairs instead of " << n_pairs << '\n';
        return nullptr;
    }
    std::cout << c.name() << "  " << ms << " ms" << std::endl;
    return {
        {"name", c.name()},
        {"run_name", c.name()},
        {"run_type", "iteration"},
        {"real_time", ms},
        {"time_unit", "ms"},
        {"peak_MiB", number_after(run.out, "peak")},
        {"entries_per_s", 1e3 * static_cast<double>(c.form == "pairs" ? found : 2 * found) / ms}};
}

}  // namespace connectivity::bench
