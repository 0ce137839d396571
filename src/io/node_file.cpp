// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/io/node_file.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <connectivity/io/pending_file.hpp>

#include "io/readers.hpp"

namespace connectivity {

namespace io {

namespace {

[[noreturn]] void fail(const std::string& text) { throw Error(Status::format, text); }

/// An attribute that is a whole number in [low, high].
Offset whole_number(const hdf5::Group& group, const std::string& name, Offset low, Offset high) {
    const double value = group.number(name);
    if (!(value >= static_cast<double>(low) && value <= static_cast<double>(high)) ||
        value != static_cast<double>(static_cast<Offset>(value)))
        fail(fmt::format("{}: {} = {}, must be a whole number from {} to {}", group.where(), name,
                         value, low, high));
    return static_cast<Offset>(value);
}

class NodeFile : public SnapshotReader {
public:
    NodeFile(const hdf5::Group& root, SnapshotInfo info, const ReadOptions& options)
        : info_(std::move(info)), lists_(root.group("node_lists")) {
        info_.format = "node file";
        info_.dim = static_cast<int>(whole_number(root, "dim", 1, 3));
        read_contents();
        read_extents(root, options.kernel_extent);
        if (!options.open && root.has_attribute("periodic")) read_domain(root);
    }

    const SnapshotInfo& info() const override { return info_; }
    ListData read(const std::string& list, const FieldRequest& fields) override;

private:
    void read_contents();
    ListInfo read_entry(const std::string& name) const;
    void read_extents(const hdf5::Group& root, std::optional<double> instead);
    void read_domain(const hdf5::Group& root);

    SnapshotInfo info_;
    hdf5::Group lists_;
    std::vector<double> extents_;
};

ListInfo NodeFile::read_entry(const std::string& name) const {
    const auto group = lists_.group(name);
    if (!group.has_dataset("positions")) fail(group.where() + " has no positions");
    const auto shape = group.shape("positions");
    if (shape.size() != 2 || shape[1] != info_.dim)
        fail(fmt::format("{} has shape {}, must be [n, {}]", group.where("positions"),
                         hdf5::text_of(shape), info_.dim));
    check_positions(group, "positions", shape);
    if (group.has_dataset("h") == group.has_dataset("H"))
        fail(fmt::format("{} has {}, must have exactly one of h and H", group.where(),
                         group.has_dataset("h") ? "both h and H" : "neither h nor H"));
    const Offset n = shape[0];
    return {name, n, whole_number(group, "n_internal", 0, n), true, group.has_dataset("mass")};
}

/// Lists stand in the order of their attribute `order`, a permutation of 0 ... n_lists - 1.
void NodeFile::read_contents() {
    const auto names = lists_.members();
    if (names.empty()) fail(lists_.where() + " is empty");
    const auto n_lists = static_cast<Offset>(names.size());
    info_.lists.resize(names.size());
    for (const auto& name : names) {
        const auto entry = read_entry(name);
        auto& place = info_.lists[static_cast<std::size_t>(
            whole_number(lists_.group(name), "order", 0, n_lists - 1))];
        if (!place.name.empty())
            fail(fmt::format("{}: lists '{}' and '{}' have the same order", lists_.where(),
                             place.name, name));
        place = entry;
    }
}

void NodeFile::read_extents(const hdf5::Group& root, std::optional<double> instead) {
    extents_ = instead ? std::vector<double>{*instead} : root.numbers("kernel_extent");
    if (extents_.size() == 1) extents_.resize(info_.lists.size(), extents_[0]);
    if (extents_.size() != info_.lists.size())
        fail(fmt::format("{}: kernel_extent has {} values, must have 1 or {}", root.where(),
                         extents_.size(), info_.lists.size()));
}

void NodeFile::read_domain(const hdf5::Group& root) {
    const auto periodic = root.numbers("periodic");
    const auto n = static_cast<std::size_t>(info_.dim);
    if (periodic.size() != n)
        fail(fmt::format("{}: periodic has {} values, must have {}", root.where(), periodic.size(),
                         n));
    for (std::size_t d = 0; d < n; ++d) {
        if (periodic[d] != 0 && periodic[d] != 1)
            fail(
                fmt::format("{}: periodic[{}] = {}, must be 0 or 1", root.where(), d, periodic[d]));
        info_.domain.periodic[d] = periodic[d] == 1;
    }
    if (!info_.domain.any_periodic(info_.dim)) return;
    const auto lo = root.numbers("box_lo"), hi = root.numbers("box_hi");
    if (lo.size() != n || hi.size() != n)
        fail(fmt::format("{}: box_lo and box_hi have {} and {} values, must have {}", root.where(),
                         lo.size(), hi.size(), n));
    std::copy(lo.begin(), lo.end(), info_.domain.lo.begin());
    std::copy(hi.begin(), hi.end(), info_.domain.hi.begin());
}

ListData NodeFile::read(const std::string& list, const FieldRequest& fields) {
    const std::size_t k = find_list(info_, list);
    const auto& entry = info_.lists[k];
    const auto group = lists_.group(list);
    const Offset n = entry.n;
    auto positions = allocate<double>("io/positions", n * info_.dim);
    group.read("positions", positions.data(), n, info_.dim);
    const auto nodes = [&] {
        if (group.has_dataset("h"))
            return NodeList::with_h(list, info_.dim, entry.n_internal, positions,
                                    read_field(group, "h", n), extents_[k]);
        const Offset width = n_symmetric(info_.dim);
        group.require("H", {n, width});
        auto H = allocate<double>("io/H", n * width);
        group.read("H", H.data(), n, width);
        return NodeList::with_H(list, info_.dim, entry.n_internal, positions, H, extents_[k]);
    };
    ListData data{nodes()};
    if (fields.mass && entry.has_mass) data.mass = read_field(group, "mass", n);
    if (fields.softening && group.has_dataset("softening"))
        data.softening = read_field(group, "softening", n);
    if (fields.global_id && group.has_dataset("global_id"))
        data.global_id = read_ids(group, "global_id", n);
    return data;
}

void write_list(hdf5::Group group, const ListData& list, Offset order) {
    const auto& nodes = list.nodes;
    const Offset n = nodes.n(), dim = nodes.dim();
    const auto optional = [&](const char* name, const auto& values) {
        if (values.size() == 0) return;
        if (static_cast<Offset>(values.size()) != n)
            throw Error(Status::argument,
                        fmt::format("node list '{}': {} has {} values, must have {}", nodes.name(),
                                    name, values.size(), n));
        group.write(name, values.data(), {n});
    };
    group.set<std::int64_t>("n_internal", nodes.n_internal());
    group.set<std::int64_t>("order", order);
    group.write("positions", nodes.positions().data(), {n, dim});
    if (nodes.has_tensor())
        group.write("H", nodes.H().data(), {n, n_symmetric(nodes.dim())});
    else
        group.write("h", nodes.h().data(), {n});
    optional("global_id", list.global_id);
    optional("mass", list.mass);
    optional("softening", list.softening);
}

void write_domain(hdf5::Group& root, const Domain& domain, int dim) {
    if (!domain.any_periodic(dim)) return;
    root.set("periodic",
             std::vector<std::int32_t>(domain.periodic.begin(), domain.periodic.begin() + dim));
    root.set("box_lo", std::vector<double>(domain.lo.begin(), domain.lo.begin() + dim));
    root.set("box_hi", std::vector<double>(domain.hi.begin(), domain.hi.begin() + dim));
}

}  // namespace

bool is_node_file(const hdf5::Group& root) { return root.has_group("node_lists"); }

std::unique_ptr<SnapshotReader> open_node_file(hdf5::Group root, SnapshotInfo info,
                                               const ReadOptions& options) {
    return std::make_unique<NodeFile>(root, std::move(info), options);
}

}  // namespace io

void write_node_file(const std::string& path, std::span<const ListData> lists, const Domain& domain,
                     const std::string& command) {
    if (lists.empty()) throw Error(Status::argument, "a node file needs at least one node list");
    const int dim = lists[0].nodes.dim();
    std::vector<double> extents;
    for (const auto& list : lists) {
        extents.push_back(list.nodes.kernel_extent());
        if (list.nodes.dim() != dim)
            throw Error(Status::argument,
                        fmt::format("node list '{}' has dimension {}, the first list has {}",
                                    list.nodes.name(), list.nodes.dim(), dim));
    }
    PendingFile file(path);
    {
        auto root = hdf5::Group::create_file(file.temporary());
        root.set<std::int32_t>("dim", dim);
        root.set("kernel_extent", extents);
        io::write_domain(root, domain, dim);
        if (!command.empty()) root.set("command", command);
        auto group = root.create_group("node_lists");
        for (std::size_t k = 0; k < lists.size(); ++k)
            io::write_list(group.create_group(lists[k].nodes.name()), lists[k],
                           static_cast<Offset>(k));
        root.flush();
    }
    file.commit();
}

}  // namespace connectivity
