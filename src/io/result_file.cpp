// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/io/result_file.hpp>

#include <algorithm>

#include <connectivity/io/pending_file.hpp>

#include "io/hdf5.hpp"

namespace connectivity {

struct ResultFile::State {
    explicit State(const std::string& path)
        : file(path), root(hdf5::Group::create_file(file.temporary())) {}
    PendingFile file;  // before root: HDF5 closes the file before it is removed
    std::optional<hdf5::Group> root;
};

namespace {

void write_rows(hdf5::Group group, const RowsView<>& rows) {
    group.write("offsets", rows.offsets.data(), {static_cast<Offset>(rows.offsets.size())});
    group.write("slots", rows.slots.data(), {rows.size()});
}

/// Writes i piece by piece: as long as j, but nobody needs it in memory.
void write_pairs(hdf5::Group group, const NodePairList::View<>& pairs) {
    constexpr Offset piece = Offset{1} << 22;
    const Offset n = pairs.size();
    group.write("j", pairs.j.data(), {n});
    group.create<Slot>("i", {n});
    std::vector<Slot> buffer(static_cast<std::size_t>(std::min(piece, n)));
    Offset row = 0;
    for (Offset first = 0; first < n; first += piece) {
        const Offset count = std::min(piece, n - first);
        for (Offset k = 0; k < count; ++k) {
            while (pairs.offsets(row + 1) <= first + k) ++row;
            buffer[static_cast<std::size_t>(k)] = pairs.node(row);
        }
        group.write_part("i", buffer.data(), first, count);
    }
    if (pairs.coupling.size() > 0) group.write("coupling", pairs.coupling.data(), {n});
}

void write_intersection(hdf5::Group group, const IntersectionView<>& common) {
    group.write("offsets", common.offsets.data(), {static_cast<Offset>(common.offsets.size())});
    group.write("slots", common.slots.data(), {common.size()});
    group.set<std::int32_t>("filtered", common.in_segment ? 1 : 0);
}

void write_order(hdf5::Group group, const KeyOrderView<>& order) {
    group.write("slots", order.slots.data(), {static_cast<Offset>(order.slots.size())});
    group.write("keys", order.keys.data(), {static_cast<Offset>(order.keys.size())});
}

}  // namespace

ResultFile::ResultFile(const std::string& path) : state_(std::make_unique<State>(path)) {}
ResultFile::~ResultFile() = default;

void ResultFile::write(const ConnectivityMap& map, const std::string& command) {
    auto& root = *state_->root;
    const MapOptions& options = map.options();
    write_rows(root.create_group("rows"), map.rows());
    write_pairs(root.create_group("pairs"), map.pairs().view());
    if (options.overlap) write_rows(root.create_group("overlap"), map.overlap());
    if (options.intersection != IntersectionKind::none)
        write_intersection(root.create_group("intersection"), map.intersection());
    if (options.order == ListOrder::key) write_order(root.create_group("order"), map.key_order());
    root.set("list_offset", map.layout().list_offset());
    root.set("row_offset", map.layout().row_offset());
    root.set("list_names", map.list_names());
    root.set("n_internal", map.n_internal());
    root.set<std::uint64_t>("generation", map.generation());
    root.set("command", command);
    root.set("library_version", std::string(CONNECTIVITY_VERSION));
}

void ResultFile::write_cull(std::span<const Slot> old2new) {
    state_->root->create_group("cull").write("old2new", old2new.data(),
                                             {static_cast<Offset>(old2new.size())});
}

void ResultFile::write_density(const std::string& list, const ConstView<double>& density,
                               const std::string& units) {
    auto& root = *state_->root;
    auto group = root.has_group("density") ? root.group("density") : root.create_group("density");
    group.write(list, density.data(), {static_cast<Offset>(density.size())});
    group.set_on(list, "units", units);
}

void ResultFile::commit() {
    state_->root->flush();
    state_->root.reset();
    state_->file.commit();
}

}  // namespace connectivity
