// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Runs gnuplot on a script, in a folder of its own that is removed afterwards.

#include <filesystem>
#include <string>

namespace connectivity::program {

/// Path of gnuplot in PATH. Throws Error{unsupported} if there is none.
std::string find_gnuplot();

/// A text in single quotes, as gnuplot reads it.
std::string quoted(const std::string& text);

/// A folder for scripts and data, gone when it goes out of scope.
class ScratchFolder {
public:
    ScratchFolder();  ///< throws Error{file}
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::string file(const std::string& name) const { return (path_ / name).string(); }
    void write(const std::string& name, const void* data, std::size_t bytes) const;
    void write(const std::string& name, const std::string& text) const {
        write(name, text.data(), text.size());
    }

private:
    std::filesystem::path path_;
};

/// Runs a script that stands in the folder. Throws Error{file} with what gnuplot said if it fails.
void run_gnuplot(const ScratchFolder& folder, const std::string& script);

}  // namespace connectivity::program
