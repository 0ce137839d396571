// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The readers that `open_snapshot` chooses from, and what they share.

#include <memory>
#include <string>

#include <connectivity/io/snapshot.hpp>

#include "io/hdf5.hpp"

namespace connectivity::io {

bool is_particle_type_file(const hdf5::Group& root);  ///< GADGET or SWIFT
bool is_h5part_file(const hdf5::Group& root);
bool is_node_file(const hdf5::Group& root);

std::unique_ptr<SnapshotReader> open_particle_types(hdf5::Group root, SnapshotInfo info,
                                                    const ReadOptions&);
std::unique_ptr<SnapshotReader> open_h5part(hdf5::Group root, SnapshotInfo info,
                                            const ReadOptions&);
std::unique_ptr<SnapshotReader> open_node_file(hdf5::Group root, SnapshotInfo info,
                                               const ReadOptions&);

/// Position of a list in info.lists. Throws Error{argument} with the names there are.
std::size_t find_list(const SnapshotInfo& info, const std::string& name);

/// Checks before anything is allocated that a file can hold as many nodes as the dataset of their
/// positions claims. Throws Error: too_many (slots have 31 bits), format (its data are not there).
void check_positions(const hdf5::Group& group, const std::string& name, const hdf5::Shape& shape);

/// Reads a field of n values as double.
ConstView<double> read_field(const hdf5::Group& group, const std::string& name, Offset n);

/// Reads n node numbers. Throws Error{format} if one does not fit 63 bits.
ConstView<std::int64_t> read_ids(const hdf5::Group& group, const std::string& name, Offset n);

}  // namespace connectivity::io
