// SPDX-License-Identifier: BSD-3-Clause
#include "program/gnuplot.hpp"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <connectivity/base/error.hpp>

namespace connectivity::program {

std::string find_gnuplot() {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        std::string candidate = (folder.empty() ? "." : folder) + "/gnuplot";
        if (access(candidate.c_str(), X_OK) == 0) return candidate;
    }
    throw Error(
        Status::unsupported,
        "pictures are drawn by gnuplot, which is not in PATH (Debian: apt install gnuplot-nox)");
}

std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? "''" : c == '\n' ? " " : std::string(1, c);
    return out + "'";
}

ScratchFolder::ScratchFolder() {
    std::error_code code;
    auto pattern = (std::filesystem::temp_directory_path(code) / "connectivity-XXXXXX").string();
    if (code || !mkdtemp(pattern.data()))
        throw Error(Status::file,
                    "cannot make a temporary folder: " + std::string(std::strerror(errno)));
    path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void ScratchFolder::write(const std::string& name, const void* data, std::size_t bytes) const {
    std::ofstream out(file(name), std::ios::binary);
    out.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
    if (!out.flush())
        throw Error(Status::file,
                    fmt::format("cannot write '{}': the disk may be full", file(name)));
}

namespace {

/// Exit status of a process whose output goes to a file; -1 if it did not run or was killed.
int run_quietly(const std::string& program, const std::string& argument,
                const std::string& output) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    char* const arguments[] = {const_cast<char*>(program.c_str()),
                               const_cast<char*>(argument.c_str()), nullptr};
    pid_t child = 0;
    int status = -1;
    const int failed = posix_spawn(&child, program.c_str(), &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) return -1;
    return WEXITSTATUS(status);
}

/// Last line with words in it: gnuplot repeats the line at fault first and gives its reason last.
std::string last_line(const std::string& path) {
    std::ifstream in(path);
    std::string last;
    for (std::string line; std::getline(in, line);)
        if (line.find_first_not_of(" ^\t") != std::string::npos)
            last = line.substr(line.find_first_not_of(" \t"));
    return last;
}

}  // namespace

void run_gnuplot(const ScratchFolder& folder, const std::string& script) {
    const std::string log = folder.file("log");
    const int status = run_quietly(find_gnuplot(), folder.file(script), log);
    if (status != 0)
        throw Error(Status::file,
                    fmt::format("gnuplot failed (exit status {}): {}", status, last_line(log)));
}

}  // namespace connectivity::program
