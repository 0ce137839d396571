// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/io/snapshot.hpp>

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <connectivity/base/runtime.hpp>

#include "io/readers.hpp"

namespace connectivity {

namespace {

std::vector<std::string> names_of(const SnapshotInfo& info) {
    std::vector<std::string> names;
    for (const auto& list : info.lists) names.push_back(list.name);
    return names;
}

}  // namespace

std::unique_ptr<SnapshotReader> open_snapshot(const std::string& path, const ReadOptions& options) {
    start_runtime();
    auto root = hdf5::Group::open_file(path);
    SnapshotInfo info;
    info.path = path;
    const bool h5part = io::is_h5part_file(root);
    if (options.step && !h5part)
        throw Error(Status::argument,
                    fmt::format("'{}' has no steps: a step can be chosen in H5Part files", path));
    if (io::is_node_file(root))
        return io::open_node_file(std::move(root), std::move(info), options);
    if (h5part) return io::open_h5part(std::move(root), std::move(info), options);
    if (io::is_particle_type_file(root))
        return io::open_particle_types(std::move(root), std::move(info), options);
    throw Error(
        Status::format,
        fmt::format(
            "'{}' is HDF5 but no GADGET, SWIFT, H5Part or node file: it has none of the groups "
            "PartType<k>, Step#<k>, node_lists",
            path));
}

std::vector<std::string> select_lists(const SnapshotInfo& info,
                                      const std::vector<std::string>& asked) {
    for (auto name = asked.begin(); name != asked.end(); ++name) {
        io::find_list(info, *name);
        if (std::find(asked.begin(), name, *name) != name)
            throw Error(Status::argument, fmt::format("list '{}' is named twice", *name));
    }
    if (!asked.empty()) return asked;
    std::vector<std::string> with_support;
    for (const auto& list : info.lists)
        if (list.has_support) with_support.push_back(list.name);
    if (with_support.empty())
        throw Error(Status::format,
                    fmt::format("'{}': no list has smoothing lengths (there are: {})", info.path,
                                fmt::join(names_of(info), ", ")));
    return with_support;
}

std::vector<std::string> all_or_selected(const SnapshotInfo& info,
                                         const std::vector<std::string>& asked) {
    return asked.empty() ? names_of(info) : select_lists(info, asked);
}

std::string file_library() {
    unsigned major = 0, minor = 0, release = 0;
    H5get_libversion(&major, &minor, &release);
    return fmt::format("HDF5 {}.{}.{}", major, minor, release);
}

namespace io {

std::size_t find_list(const SnapshotInfo& info, const std::string& name) {
    const auto names = names_of(info);
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
        throw Error(Status::argument, fmt::format("'{}' has no list '{}' (there are: {})",
                                                  info.path, name, fmt::join(names, ", ")));
    return static_cast<std::size_t>(at - names.begin());
}

void check_positions(const hdf5::Group& group, const std::string& name, const hdf5::Shape& shape) {
    constexpr Offset most = std::numeric_limits<Slot>::max();
    if (shape[0] > most)
        throw Error(Status::too_many, fmt::format("{} has {} nodes, at most {} fit",
                                                  group.where(name), shape[0], most));
    group.require(name, shape);
}

ConstView<double> read_field(const hdf5::Group& group, const std::string& name, Offset n) {
    group.require(name, {n});
    auto values = allocate<double>("io/" + name, n);
    group.read(name, values.data(), n);
    return values;
}

ConstView<std::int64_t> read_ids(const hdf5::Group& group, const std::string& name, Offset n) {
    group.require(name, {n}, true);
    auto ids = allocate<std::int64_t>("io/" + name, n);
    if (!group.is_uint64(name)) {
        group.read(name, ids.data(), n);
        return ids;
    }
    group.read(name, reinterpret_cast<std::uint64_t*>(ids.data()), n);
    for (Offset i = 0; i < n; ++i)
        if (ids(i) < 0)
            throw Error(Status::format,
                        fmt::format("{}: number {} of node {} is above {}", group.where(name),
                                    static_cast<std::uint64_t>(ids(i)), i,
                                    std::numeric_limits<std::int64_t>::max()));
    return ids;
}

}  // namespace io
}  // namespace connectivity
