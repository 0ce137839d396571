// SPDX-License-Identifier: BSD-3-Clause
#include <support/process.hpp>

#include <array>
#include <cstdio>
#include <fstream>

#include <sys/wait.h>
#include <unistd.h>

namespace connectivity::test {
namespace {

/// A line "Name:  123 kB" of the process status, in bytes.
std::int64_t status_line(const std::string& name) {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);)
        if (line.rfind(name + ":", 0) == 0) return std::stoll(line.substr(name.size() + 1)) * 1024;
    return 0;
}

}  // namespace

std::int64_t resident_bytes() { return status_line("VmRSS"); }
std::int64_t peak_resident_bytes() { return status_line("VmHWM"); }
void reset_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

std::string program_path() {
    std::array<char, 4096> path{};
    const ssize_t length = readlink("/proc/self/exe", path.data(), path.size() - 1);
    return length > 0 ? std::string(path.data(), static_cast<std::size_t>(length)) : std::string();
}

RunResult run_command(const std::string& shell_command) {
    RunResult result;
    FILE* pipe = popen(shell_command.c_str(), "r");
    if (pipe == nullptr) return result;
    std::array<char, 4096> buffer{};
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
        result.out.append(buffer.data(), n);
    const int status = pclose(pipe);
    if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
    return result;
}

RunResult run_this_test_program(const std::string& gtest_filter, const std::string& environment) {
    return run_command("env " + environment + " '" + program_path() + "' --gtest_filter='" +
                       gtest_filter + "'");
}

}  // namespace connectivity::test
