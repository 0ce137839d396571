// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/io/pending_file.hpp>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include <connectivity/base/error.hpp>

namespace connectivity {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw Error(Status::file, fmt::format("cannot write '{}': {}", path, why));
}

}  // namespace

PendingFile::PendingFile(std::string path) : path_(std::move(path)) {
    namespace fs = std::filesystem;
    std::error_code code;
    if (path_.empty()) fail(path_, "the name is empty");
    if (fs::is_symlink(path_, code)) {  // the file it names is replaced, not the link
        const fs::path target = fs::weakly_canonical(path_, code);
        if (!code) path_ = target.string();
    }
    if (fs::is_directory(path_, code)) fail(path_, "it is a folder");
    if (fs::exists(path_, code) && !fs::is_regular_file(path_, code))
        fail(path_, "it is no regular file");
    const fs::path parent = fs::path(path_).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    if (!fs::is_directory(folder, code))
        fail(path_, fmt::format("there is no folder '{}'", folder));
    if (access(folder.c_str(), W_OK) != 0)
        fail(path_, fmt::format("folder '{}': {}", folder, std::strerror(errno)));
    temporary_ = fmt::format("{}.{}.part", path_, getpid());
}

PendingFile::~PendingFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void PendingFile::commit() {
    std::error_code code;
    std::filesystem::rename(temporary_, path_, code);
    if (code) fail(path_, code.message());
    committed_ = true;
}

}  // namespace connectivity
