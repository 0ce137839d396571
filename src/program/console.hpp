// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What people see while the program works: a bar on a terminal, plain lines in a log.
///
/// Invariant: everything for people goes to stdout, so that stderr holds the sentence of an error
/// and nothing else; only a terminal sees the bar there, and it is wiped before anything else is
/// written.

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace connectivity::program {

class Console {
public:
    /// `n_phases` is how many times `phase` will be called.
    explicit Console(int n_phases) : n_phases_(n_phases) {}

    /// Runs `work` under a name, then writes one line with its duration.
    void phase(const std::string& name, const std::function<void()>& work);

    /// Writes text and a line break.
    static void line(const std::string& text = {});

    /// Names and milliseconds of the phases so far.
    const std::vector<std::pair<std::string, double>>& durations() const { return durations_; }

private:
    int n_phases_;
    std::vector<std::pair<std::string, double>> durations_;
};

/// "1.35 s", "12 ms"
std::string human_duration(double ms);

}  // namespace connectivity::program
