// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Runs the program as a user would and keeps what it says.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <io/plain_hdf5.hpp>

#include <support/shared_data.hpp>

namespace connectivity::test {

struct Outcome {
    int status = -1;  ///< exit status; -1 if it did not exit by itself
    std::string out, err;

    bool error_is_one_line() const {
        return std::count(err.begin(), err.end(), '\n') == 1 && err.back() == '\n';
    }
};

/// `connectivity` with these arguments; `environment` replaces or adds "NAME=value".
inline Outcome run_program(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& environment = {}) {
    const TemporaryFolder folder;
    const auto words = [](const std::vector<std::string>& texts) {
        std::vector<char*> pointers;
        pointers.reserve(texts.size() + 1);
        for (const auto& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
        pointers.push_back(nullptr);
        return pointers;
    };
    std::vector<std::string> command{CONNECTIVITY_PROGRAM}, variables = environment;
    command.insert(command.end(), arguments.begin(), arguments.end());
    for (char** entry = environ; *entry; ++entry) {
        const std::string text = *entry, name = text.substr(0, text.find('=') + 1);
        const auto is_replaced = [&](const std::string& v) { return v.starts_with(name); };
        if (std::none_of(environment.begin(), environment.end(), is_replaced))
            variables.push_back(text);
    }
    const std::string out = folder / "out", err = folder / "err";
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
    pid_t child = 0;
    int status = 0;
    Outcome outcome;
    if (posix_spawn(&child, CONNECTIVITY_PROGRAM, &actions, nullptr, words(command).data(),
                    words(variables).data()) == 0 &&
        waitpid(child, &status, 0) == child && WIFEXITED(status))
        outcome.status = WEXITSTATUS(status);
    posix_spawn_file_actions_destroy(&actions);
    const auto text_of = [](const std::string& path) {
        std::stringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    };
    outcome.out = text_of(out);
    outcome.err = text_of(err);
    return outcome;
}

}  // namespace connectivity::test
