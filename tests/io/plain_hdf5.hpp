// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Files for tests, written and read with plain HDF5 and sharing no code with the io layer.
///
/// Names are paths from the root ("PartType0/Coordinates"); groups on the way are made. The root is
/// "/". Every failure of HDF5 ends the test by an exception.

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <hdf5.h>
#include <unistd.h>

namespace connectivity::test {

/// A folder that is gone when it goes out of scope.
class TemporaryFolder {
public:
    TemporaryFolder() {
        auto pattern =
            (std::filesystem::temp_directory_path() / "connectivity-test-XXXXXX").string();
        if (!mkdtemp(pattern.data())) throw std::runtime_error("mkdtemp");
        path_ = pattern;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string operator/(const std::string& name) const { return (path_ / name).string(); }
    std::string path() const { return path_.string(); }
    /// Names of the files in it.
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path_))
            names.push_back(entry.path().filename().string());
        return names;
    }

private:
    std::filesystem::path path_;
};

using Extents = std::vector<hsize_t>;

template <class T>
hid_t h5_type();
template <>
inline hid_t h5_type<float>() {
    return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t h5_type<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t h5_type<std::uint8_t>() {
    return H5T_NATIVE_UINT8;
}
template <>
inline hid_t h5_type<int>() {
    return H5T_NATIVE_INT;
}
template <>
inline hid_t h5_type<unsigned>() {
    return H5T_NATIVE_UINT;
}
template <>
inline hid_t h5_type<std::int64_t>() {
    return H5T_NATIVE_INT64;
}
template <>
inline hid_t h5_type<std::uint64_t>() {
    return H5T_NATIVE_UINT64;
}

class PlainFile {
public:
    static PlainFile create(const std::string& path) {
        return PlainFile(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    }
    static PlainFile open(const std::string& path) {
        return PlainFile(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
    }
    static PlainFile modify(const std::string& path) {
        return PlainFile(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT));
    }
    ~PlainFile() {
        H5Pclose(make_parents_);
        H5Fclose(file_);
    }
    PlainFile(const PlainFile&) = delete;
    PlainFile& operator=(const PlainFile&) = delete;

    PlainFile& group(const std::string& name) {
        H5Gclose(good(H5Gcreate2(file_, name.c_str(), make_parents_, H5P_DEFAULT, H5P_DEFAULT)));
        return *this;
    }

    template <class T>
    PlainFile& data(const std::string& name, const std::vector<T>& values, Extents extents = {}) {
        if (extents.empty()) extents = {values.size()};
        const hid_t space =
            H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr);
        const hid_t set = good(H5Dcreate2(file_, name.c_str(), h5_type<T>(), space, make_parents_,
                                          H5P_DEFAULT, H5P_DEFAULT));
        if (!values.empty())
            good(H5Dwrite(set, h5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
        H5Dclose(set);
        H5Sclose(space);
        return *this;
    }

    /// Numbers without their values, in chunks if told; in one dimension the first n are written.
    PlainFile& unwritten(const std::string& name, const Extents& extents, const Extents& chunk = {},
                         hsize_t n = 0) {
        const hid_t space = good(H5Screate_simple(static_cast<int>(extents.size()), extents.data(),
                                                  nullptr)),
                    list = H5Pcreate(H5P_DATASET_CREATE);
        if (!chunk.empty()) H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data());
        const hid_t set = good(H5Dcreate2(file_, name.c_str(), H5T_NATIVE_DOUBLE, space,
                                          make_parents_, list, H5P_DEFAULT));
        if (n > 0) {
            const hsize_t first = 0;
            const std::vector<double> values(n, 1.0);
            const hid_t memory = H5Screate_simple(1, &n, nullptr);
            good(H5Sselect_hyperslab(space, H5S_SELECT_SET, &first, nullptr, &n, nullptr));
            good(H5Dwrite(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()));
            H5Sclose(memory);
        }
        H5Dclose(set);
        H5Pclose(list);
        H5Sclose(space);
        return *this;
    }

    /// One-dimensional attribute of a group; the group is made if it is not there.
    template <class T>
    PlainFile& attribute(const std::string& where, const std::string& name,
                         const std::vector<T>& values) {
        const hsize_t extent = values.size();
        put(where, name, h5_type<T>(), H5Screate_simple(1, &extent, nullptr), values.data());
        return *this;
    }
    template <class T>
    PlainFile& attribute(const std::string& where, const std::string& name, const T& value) {
        put(where, name, h5_type<T>(), H5Screate(H5S_SCALAR), &value);
        return *this;
    }
    /// A string of fixed length, as GADGET and SWIFT write them.
    PlainFile& attribute(const std::string& where, const std::string& name, const char* text) {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, std::char_traits<char>::length(text) + 1);
        put(where, name, type, H5Screate(H5S_SCALAR), text);
        H5Tclose(type);
        return *this;
    }

    bool has(const std::string& name) const {
        return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0;
    }

    /// Of what is in the root, ascending.
    std::vector<std::string> names() const {
        H5G_info_t info{};
        good(H5Gget_info(file_, &info));
        std::vector<std::string> names;
        for (hsize_t k = 0; k < info.nlinks; ++k) {
            const auto find = [&](char* text, std::size_t size) {
                return good(H5Lget_name_by_idx(file_, ".", H5_INDEX_NAME, H5_ITER_INC, k, text,
                                               size, H5P_DEFAULT));
            };
            std::string name(static_cast<std::size_t>(find(nullptr, 0)), '\0');
            find(name.data(), name.size() + 1);
            names.push_back(name);
        }
        return names;
    }

    Extents extents(const std::string& name) const {
        const hid_t set = good(H5Dopen2(file_, name.c_str(), H5P_DEFAULT));
        const hid_t space = H5Dget_space(set);
        Extents extents(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
        H5Sget_simple_extent_dims(space, extents.data(), nullptr);
        H5Sclose(space);
        H5Dclose(set);
        return extents;
    }

    template <class T>
    std::vector<T> read(const std::string& name) const {
        hsize_t n = 1;
        for (const hsize_t extent : extents(name)) n *= extent;
        std::vector<T> values(n);
        const hid_t set = good(H5Dopen2(file_, name.c_str(), H5P_DEFAULT));
        if (n > 0) good(H5Dread(set, h5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
        H5Dclose(set);
        return values;
    }

    /// Is the dataset stored as T?
    template <class T>
    bool is_stored_as(const std::string& name) const {
        const hid_t set = good(H5Dopen2(file_, name.c_str(), H5P_DEFAULT));
        const hid_t type = H5Dget_type(set);
        const bool same = H5Tequal(type, h5_type<T>()) > 0;
        H5Tclose(type);
        H5Dclose(set);
        return same;
    }

    template <class T>
    std::vector<T> numbers(const std::string& where, const std::string& name) const {
        const hid_t at =
            good(H5Aopen_by_name(file_, where.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
        const hid_t space = H5Aget_space(at);
        std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
        if (!values.empty()) good(H5Aread(at, h5_type<T>(), values.data()));
        H5Sclose(space);
        H5Aclose(at);
        return values;
    }

    /// Strings of variable length.
    std::vector<std::string> strings(const std::string& where, const std::string& name) const {
        const hid_t at =
            good(H5Aopen_by_name(file_, where.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
        const hid_t space = H5Aget_space(at), type = H5Aget_type(at);
        std::vector<char*> raw(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
        if (H5Tis_variable_str(type) <= 0) throw std::runtime_error(name + " has fixed length");
        good(H5Aread(at, type, raw.data()));
        std::vector<std::string> texts(raw.begin(), raw.end());
        H5Dvlen_reclaim(type, space, H5P_DEFAULT, raw.data());
        H5Tclose(type);
        H5Sclose(space);
        H5Aclose(at);
        return texts;
    }

private:
    explicit PlainFile(hid_t file) : file_(good(file)), make_parents_(H5Pcreate(H5P_LINK_CREATE)) {
        H5Pset_create_intermediate_group(make_parents_, 1);
    }

    template <class Id>
    static Id good(Id id) {
        if (id < 0) throw std::runtime_error("plain HDF5 call failed");
        return id;
    }

    void put(const std::string& where, const std::string& name, hid_t type, hid_t space,
             const void* value) {
        if (where != "/" && !has(where)) group(where);
        const hid_t at = good(H5Acreate_by_name(file_, where.c_str(), name.c_str(), type, space,
                                                H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        if (H5Sget_simple_extent_npoints(space) > 0) good(H5Awrite(at, type, value));
        H5Aclose(at);
        H5Sclose(space);
    }

    hid_t file_, make_parents_;
};

}  // namespace connectivity::test
