// SPDX-License-Identifier: BSD-3-Clause
#include "io/hdf5.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

namespace connectivity::hdf5 {

namespace {

/// What HDF5 itself says went wrong, innermost first; empty if it says nothing.
std::string innermost_reason() {
    std::string reason;
    const H5E_walk2_t first_record = [](unsigned, const H5E_error2_t* record, void* out) -> herr_t {
        auto& text = *static_cast<std::string*>(out);
        if (text.empty() && record->desc) text = record->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, first_record, &reason);
    return reason;
}

void be_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// Says why before HDF5 sees the file: its own messages do not tell these cases apart.
void check_readable(const std::string& path) {
    std::error_code code;
    const auto status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status))
        throw Error(Status::file, fmt::format("cannot open '{}': there is no such file", path));
    if (std::filesystem::is_directory(status))
        throw Error(Status::file, fmt::format("cannot open '{}': it is a folder", path));
    if (!std::filesystem::is_regular_file(status))
        throw Error(Status::file, fmt::format("cannot open '{}': it is no regular file", path));
    if (access(path.c_str(), R_OK) != 0)
        throw Error(Status::file, fmt::format("cannot open '{}': {}", path, std::strerror(errno)));
    if (std::filesystem::file_size(path, code) == 0)
        throw Error(Status::format, fmt::format("'{}' is not an HDF5 file: it is empty", path));
    if (H5Fis_hdf5(path.c_str()) <= 0)
        throw Error(Status::format, fmt::format("'{}' is not an HDF5 file", path));
}

}  // namespace

std::string text_of(const Shape& shape) { return fmt::format("[{}]", fmt::join(shape, ", ")); }

Handle& Handle::operator=(Handle&& other) noexcept {
    if (this != &other) {
        reset();
        id_ = std::exchange(other.id_, -1);
        close_ = other.close_;
    }
    return *this;
}

herr_t Handle::reset() {
    const hid_t id = std::exchange(id_, -1);
    return id >= 0 ? close_(id) : 0;
}

Group Group::open_file(const std::string& path) {
    be_quiet();
    check_readable(path);
    Group root;
    root.file_name_ = path;
    root.file_ =
        std::make_shared<Handle>(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!root.file_->valid()) root.fail_io({}, "cannot open");
    root.group_ = Handle(H5Gopen2(*root.file_, "/", H5P_DEFAULT), H5Gclose);
    if (!root.group_.valid()) root.fail_io({}, "cannot open");
    return root;
}

Group Group::create_file(const std::string& path) {
    be_quiet();
    Group root;
    root.file_name_ = path;
    root.file_ = std::make_shared<Handle>(
        H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
    if (!root.file_->valid()) root.fail_io({}, "cannot create");
    root.group_ = Handle(H5Gopen2(*root.file_, "/", H5P_DEFAULT), H5Gclose);
    if (!root.group_.valid()) root.fail_io({}, "cannot create");
    return root;
}

std::string Group::where(const std::string& name) const {
    const std::string inside = name.empty() ? path_ : path_ + "/" + name;
    return inside.empty() ? fmt::format("'{}'", file_name_)
                          : fmt::format("'{}' {}", file_name_, inside);
}

void Group::fail(Status status, const std::string& name, const std::string& what) const {
    throw Error(status, where(name) + " " + what);
}

void Group::fail_io(const std::string& name, const std::string& what) const {
    const std::string reason = innermost_reason();
    throw Error(Status::file,
                fmt::format("{} {}{}", what, where(name), reason.empty() ? "" : ": " + reason));
}

bool Group::has_group(const std::string& name) const {
    if (H5Lexists(group_, name.c_str(), H5P_DEFAULT) <= 0) return false;
    const Handle object(H5Oopen(group_, name.c_str(), H5P_DEFAULT), H5Oclose);
    return object.valid() && H5Iget_type(object) == H5I_GROUP;
}

bool Group::has_dataset(const std::string& name) const {
    if (H5Lexists(group_, name.c_str(), H5P_DEFAULT) <= 0) return false;
    const Handle object(H5Oopen(group_, name.c_str(), H5P_DEFAULT), H5Oclose);
    return object.valid() && H5Iget_type(object) == H5I_DATASET;
}

Group Group::group(const std::string& name) const {
    if (!has_group(name)) fail(Status::format, {}, fmt::format("lacks the group {}", name));
    Group child;
    child.file_ = file_;
    child.file_name_ = file_name_;
    child.path_ = path_ + "/" + name;
    child.group_ = Handle(H5Gopen2(group_, name.c_str(), H5P_DEFAULT), H5Gclose);
    if (!child.group_.valid()) fail_io(name, "cannot open");
    return child;
}

Group Group::create_group(const std::string& name) {
    if (!Handle(H5Gcreate2(group_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose)
             .valid())
        fail_io(name, "cannot write");
    return group(name);
}

std::vector<std::string> Group::members() const {
    std::vector<std::string> names;
    const H5L_iterate_t add = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
    };
    hsize_t position = 0;
    if (H5Literate(group_, H5_INDEX_NAME, H5_ITER_INC, &position, add, &names) < 0)
        fail_io({}, "cannot read");
    return names;
}

void Group::flush() {
    if (H5Fflush(*file_, H5F_SCOPE_GLOBAL) < 0) fail_io({}, "cannot write");
}

}  // namespace connectivity::hdf5
