// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// HDF5 for the readers and writers: handles that close themselves, failures that are Error with
/// file and path.
///
/// Invariants: HDF5 prints nothing; a Group keeps its file open. Numbers are converted by HDF5 to
/// the type asked for.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <hdf5.h>

#include <connectivity/base/error.hpp>
#include <connectivity/base/types.hpp>

namespace connectivity::hdf5 {

using Shape = std::vector<Offset>;

/// "[32768, 3]"
std::string text_of(const Shape& shape);

/// Owns one HDF5 identifier.
class Handle {
public:
    using Close = herr_t (*)(hid_t);
    Handle() = default;
    Handle(hid_t id, Close close) : id_(id), close_(close) {}
    Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = -1; }
    Handle& operator=(Handle&& other) noexcept;
    ~Handle() { reset(); }

    operator hid_t() const { return id_; }
    bool valid() const { return id_ >= 0; }
    herr_t reset();

private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

template <class T>
hid_t native_type();
template <>
inline hid_t native_type<double>() {
    return H5T_NATIVE_DOUBLE;
}
template <>
inline hid_t native_type<float>() {
    return H5T_NATIVE_FLOAT;
}
template <>
inline hid_t native_type<std::uint8_t>() {
    return H5T_NATIVE_UINT8;
}
template <>
inline hid_t native_type<std::int32_t>() {
    return H5T_NATIVE_INT32;
}
template <>
inline hid_t native_type<std::int64_t>() {
    return H5T_NATIVE_INT64;
}
template <>
inline hid_t native_type<std::uint64_t>() {
    return H5T_NATIVE_UINT64;
}

/// A file or a group in it.
class Group {
public:
    /// Throws Error: file (missing, unreadable, truncated), format (not HDF5).
    static Group open_file(const std::string& path);
    /// Throws Error{file}.
    static Group create_file(const std::string& path);

    /// "'snapshot.hdf5' /PartType0", for messages.
    std::string where(const std::string& name = {}) const;

    bool has_group(const std::string& name) const;
    bool has_dataset(const std::string& name) const;
    Group group(const std::string& name) const;  ///< throws Error{format}
    Group create_group(const std::string& name);
    std::vector<std::string> members() const;  ///< names, ascending

    /// Throws Error{format} if there is no such dataset or it does not hold numbers.
    Shape shape(const std::string& name) const;
    /// Also checks the shape, and that the data are there: Error{format}. `integer`: only whole
    /// numbers will do.
    void require(const std::string& name, const Shape& expected, bool integer = false) const;

    /// Reads a dataset of which shape()[0] = n; of a two-dimensional one the first `columns`
    /// columns. Throws Error: format (shape), file (the read fails).
    template <class T>
    void read(const std::string& name, T* out, Offset n, Offset columns = 1) const {
        read_raw(name, native_type<T>(), out, n, columns);
    }
    /// True if the dataset has unsigned 64-bit numbers.
    bool is_uint64(const std::string& name) const;

    template <class T>
    void create(const std::string& name, const Shape& shape) {
        create_raw(name, native_type<T>(), shape);
    }
    /// Writes count rows from row `first` on.
    template <class T>
    void write_part(const std::string& name, const T* data, Offset first, Offset count) {
        write_raw(name, native_type<T>(), data, first, count);
    }
    /// A shape without extents is that of a single value.
    template <class T>
    void write(const std::string& name, const T* data, const Shape& shape) {
        create<T>(name, shape);
        write_part(name, data, 0, shape.empty() ? 1 : shape[0]);
    }

    bool has_attribute(const std::string& name) const;
    std::vector<double> numbers(
        const std::string& name) const;  ///< throws Error{format} if missing or no numbers
    double number(const std::string& name) const;  ///< of one value
    double number_or(const std::string& name, double otherwise) const;
    std::optional<std::string> text(
        const std::string& name) const;  ///< none if missing or no string

    template <class T>
    void set(const std::string& name, const std::vector<T>& values) {
        set_raw(name, native_type<T>(), values.data(), static_cast<Offset>(values.size()), false);
    }
    template <class T>
    void set(const std::string& name, const T& value) {
        set_raw(name, native_type<T>(), &value, 1, true);
    }
    void set(const std::string& name, const std::string& text);
    void set(const std::string& name, const std::vector<std::string>& texts);
    /// Attribute of a dataset in this group.
    void set_on(const std::string& dataset, const std::string& name, const std::string& text);

    /// Flushes to disk. Throws Error{file}.
    void flush();

private:
    Group() = default;
    Handle dataset(const std::string& name) const;
    void require_data(const std::string& name, const Shape& shape) const;
    [[noreturn]] void fail(Status status, const std::string& name, const std::string& what) const;
    [[noreturn]] void fail_io(const std::string& name, const std::string& what) const;
    void read_raw(const std::string&, hid_t type, void* out, Offset n, Offset columns) const;
    void create_raw(const std::string&, hid_t type, const Shape& shape);
    void write_raw(const std::string&, hid_t type, const void* data, Offset first, Offset count);
    void set_raw(const std::string&, hid_t type, const void* data, Offset n, bool scalar);

    std::shared_ptr<Handle> file_;
    Handle group_;
    std::string file_name_, path_;
};

}  // namespace connectivity::hdf5
