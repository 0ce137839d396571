// SPDX-License-Identifier: BSD-3-Clause
// Datasets: shapes are checked before anything is read, numbers are converted by HDF5.
#include "io/hdf5.hpp"

#include <cmath>

#include <fmt/format.h>

namespace connectivity::hdf5 {

Handle Group::dataset(const std::string& name) const {
    if (!has_dataset(name)) fail(Status::format, {}, fmt::format("lacks the dataset {}", name));
    Handle handle(H5Dopen2(group_, name.c_str(), H5P_DEFAULT), H5Dclose);
    if (!handle.valid()) fail_io(name, "cannot open");
    return handle;
}

Shape Group::shape(const std::string& name) const {
    const Handle data = dataset(name);
    const Handle type(H5Dget_type(data), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    if (kind != H5T_INTEGER && kind != H5T_FLOAT)
        fail(Status::format, name, "does not hold numbers");
    const Handle space(H5Dget_space(data), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 0) fail_io(name, "cannot read the shape of");
    std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
    H5Sget_simple_extent_dims(space, extents.data(), nullptr);
    return {extents.begin(), extents.end()};
}

/// HDF5 reads what was never written as zeros, as many as the dataset claims to hold: wrong, and
/// more than any memory if the claim is.
void Group::require_data(const std::string& name, const Shape& shape) const {
    const Handle data = dataset(name);
    const Handle list(H5Dget_create_plist(data), H5Pclose);
    const H5D_layout_t layout = H5Pget_layout(list);
    double blocks = 1;  // chunks, or the one block, that the shape takes
    std::vector<hsize_t> chunk(shape.size(), 1);
    if (layout == H5D_CHUNKED) H5Pget_chunk(list, static_cast<int>(chunk.size()), chunk.data());
    for (std::size_t d = 0; d < shape.size(); ++d)
        blocks *= layout == H5D_CHUNKED
                      ? std::ceil(static_cast<double>(shape[d]) / static_cast<double>(chunk[d]))
                      : (shape[d] > 0 ? 1 : 0);
    hsize_t found = 1;
    if (layout == H5D_CHUNKED) {
        const Handle space(H5Dget_space(data), H5Sclose);
        if (H5Dget_num_chunks(data, space, &found) < 0) fail_io(name, "cannot read");
    } else if (layout == H5D_CONTIGUOUS && H5Pget_external_count(list) == 0) {
        found = H5Dget_storage_size(data) > 0 ? 1 : 0;
    }
    if (static_cast<double>(found) < blocks)
        fail(Status::format, name,
             fmt::format("has shape {}, but not all of its data were written", text_of(shape)));
}

void Group::require(const std::string& name, const Shape& expected, bool integer) const {
    const Shape found = shape(name);
    if (found != expected)
        fail(Status::format, name,
             fmt::format("has shape {}, must be {}", text_of(found), text_of(expected)));
    require_data(name, found);
    const Handle type(H5Dget_type(dataset(name)), H5Tclose);
    if (integer && H5Tget_class(type) != H5T_INTEGER)
        fail(Status::format, name, "does not hold whole numbers");
}

bool Group::is_uint64(const std::string& name) const {
    const Handle type(H5Dget_type(dataset(name)), H5Tclose);
    return H5Tget_class(type) == H5T_INTEGER && H5Tget_size(type) == 8 &&
           H5Tget_sign(type) == H5T_SGN_NONE;
}

void Group::read_raw(const std::string& name, hid_t type, void* out, Offset n,
                     Offset columns) const {
    const Shape found = shape(name);
    const bool fits =
        (found.size() == 1 && columns == 1) || (found.size() == 2 && found[1] >= columns);
    if (!fits || found[0] != n)
        fail(Status::format, name,
             fmt::format("has shape {}, must be {}", text_of(found),
                         columns == 1 ? text_of({n}) : text_of({n, columns})));
    if (n == 0) return;
    const Handle data = dataset(name);
    const Handle space(H5Dget_space(data), H5Sclose);
    const hsize_t start[2] = {0, 0};
    const hsize_t count[2] = {static_cast<hsize_t>(n), static_cast<hsize_t>(columns)};
    const Handle memory(H5Screate_simple(static_cast<int>(found.size()), count, nullptr), H5Sclose);
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr) < 0 ||
        H5Dread(data, type, memory, space, H5P_DEFAULT, out) < 0)
        fail_io(name, "cannot read");
}

void Group::create_raw(const std::string& name, hid_t type, const Shape& shape) {
    const std::vector<hsize_t> extents(shape.begin(), shape.end());
    const Handle space(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr),
                       H5Sclose);
    const Handle data(
        H5Dcreate2(group_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose);
    if (!data.valid()) fail_io(name, "cannot write");
}

void Group::write_raw(const std::string& name, hid_t type, const void* source, Offset first,
                      Offset count) {
    if (count == 0) return;
    const Handle data = dataset(name);
    const Handle space(H5Dget_space(data), H5Sclose);
    const Shape whole = shape(name);
    if (whole.empty()) {
        if (H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, source) < 0)
            fail_io(name, "cannot write");
        return;
    }
    std::vector<hsize_t> start(whole.size(), 0), extent(whole.begin(), whole.end());
    start.at(0) = static_cast<hsize_t>(first);
    extent.at(0) = static_cast<hsize_t>(count);
    const Handle memory(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                        H5Sclose);
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr) <
            0 ||
        H5Dwrite(data, type, memory, space, H5P_DEFAULT, source) < 0)
        fail_io(name, "cannot write");
}

}  // namespace connectivity::hdf5
