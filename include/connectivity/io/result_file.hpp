// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Writer of the result of `connectivity pairs`: rows, pairs, and what was computed from them, in
/// HDF5.
///
///     /rows/offsets [n_rows*n_lists+1] int64, /rows/slots int32
///     /pairs/i, /pairs/j [n_pairs] int32, i before j, sorted by (i, j); /pairs/coupling float64
///     /overlap/{offsets,slots} as rows; /intersection/offsets [n_pairs+1], slots, attr filtered
///     /order/{slots,keys} of key order; /cull/old2new [n_slots before] int32, -1: dropped
///     /density/<list> [n] float64, attr units
///     attrs: list_offset, row_offset [n_lists+1], list_names, n_internal [n_lists], generation,
///     command,
///            library_version

#include <memory>
#include <span>
#include <string>

#include <connectivity/map/connectivity_map.hpp>

namespace connectivity {

class ResultFile {
public:
    /// Opens a temporary file beside `path`. Throws Error{file}.
    explicit ResultFile(const std::string& path);
    ~ResultFile();  ///< removes what was not committed

    /// Rows, pairs, what else the map holds, and attributes. Pairs are written in pieces: the i
    /// array is never held whole. Throws Error: file (the disk is full, say), not_built.
    void write(const ConnectivityMap& map, const std::string& command);

    /// New slot of every node before culling, -1: dropped. Throws Error{file}.
    void write_cull(std::span<const Slot> old2new);

    /// Density of the nodes of one list. Throws Error{file}.
    void write_density(const std::string& list, const ConstView<double>& density,
                       const std::string& units);

    /// Closes the file and puts it in its place. Throws Error{file}.
    void commit();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace connectivity
