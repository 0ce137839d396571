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
    Offset slot = 0;
    for (Offset first = 0; first < n; first += piece) {
        const Offset count = std::min(piece, n - first);
        for (Offset k = 0; k < count; ++k) {
            while (pairs.offsets(slot + 1) <= first + k) ++slot;
            buffer[static_cast<std::size_t>(k)] = static_cast<Slot>(slot);
        }
        group.write_part("i", buffer.data(), first, count);
    }
}

}  // namespace

ResultFile::ResultFile(const std::string& path) : state_(std::make_unique<State>(path)) {}
ResultFile::~ResultFile() = default;

void ResultFile::write(const ConnectivityMap& map, std::span<const NodeList> lists,
                       const std::string& command) {
    auto& root = *state_->root;
    write_rows(root.create_group("rows"), map.rows());
    write_pairs(root.create_group("pairs"), map.pairs().view());
    std::vector<std::int64_t> n_internal;
    for (const auto& list : lists) n_internal.push_back(list.n_internal());
    root.set("list_offset", map.layout().list_offset());
    root.set("row_offset", map.layout().row_offset());
    root.set("list_names", map.list_names());
    root.set("n_internal", n_internal);
    root.set<std::uint64_t>("generation", map.generation());
    root.set("command", command);
    root.set("library_version", std::string(CONNECTIVITY_VERSION));
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
