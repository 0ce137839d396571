// SPDX-License-Identifier: BSD-3-Clause
// Attributes: numbers of any type become double, strings of fixed or variable length become
// std::string.
#include "io/hdf5.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace connectivity::hdf5 {

namespace {

Handle string_type() {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, H5T_VARIABLE);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

bool is_number(hid_t type) {
    const H5T_class_t kind = H5Tget_class(type);
    return kind == H5T_INTEGER || kind == H5T_FLOAT ||
           kind == H5T_ENUM;  // an enum is how h5py stores a bool
}

}  // namespace

bool Group::has_attribute(const std::string& name) const {
    return H5Aexists(group_, name.c_str()) > 0;
}

std::vector<double> Group::numbers(const std::string& name) const {
    if (!has_attribute(name)) fail(Status::format, {}, fmt::format("lacks the attribute {}", name));
    const Handle attribute(H5Aopen(group_, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    if (!is_number(type) || n < 0)
        fail(Status::format, {}, fmt::format("attribute {} is no number", name));
    std::vector<double> values(static_cast<std::size_t>(n));
    if (n > 0 && H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) < 0)
        fail_io(name, "cannot read");
    return values;
}

double Group::number(const std::string& name) const {
    const auto values = numbers(name);
    if (values.size() != 1)
        fail(Status::format, {},
             fmt::format("attribute {} has {} values, must be 1", name, values.size()));
    return values[0];
}

double Group::number_or(const std::string& name, double otherwise) const {
    if (!has_attribute(name)) return otherwise;
    const auto values = numbers(name);
    return values.empty() ? otherwise : values[0];
}

std::optional<std::string> Group::text(const std::string& name) const {
    if (!has_attribute(name)) return std::nullopt;
    const Handle attribute(H5Aopen(group_, name.c_str(), H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    if (H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1)
        return std::nullopt;
    if (H5Tis_variable_str(type) > 0) {
        char* data = nullptr;
        if (H5Aread(attribute, type, &data) < 0) return std::nullopt;
        std::string text = data ? data : "";
        H5Dvlen_reclaim(type, space, H5P_DEFAULT, &data);
        return text;
    }
    std::string text(H5Tget_size(type), '\0');
    if (H5Aread(attribute, type, text.data()) < 0) return std::nullopt;
    text.resize(std::min(text.find('\0'), text.size()));
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

void Group::set_raw(const std::string& name, hid_t type, const void* data, Offset n, bool scalar) {
    const auto extent = static_cast<hsize_t>(n);
    const Handle space(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &extent, nullptr),
                       H5Sclose);
    const Handle attribute(H5Acreate2(group_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    if (!attribute.valid() || (n > 0 && H5Awrite(attribute, type, data) < 0))
        fail_io(name, "cannot write");
}

void Group::set(const std::string& name, const std::string& text) {
    const char* const data = text.c_str();
    set_raw(name, string_type(), &data, 1, true);
}

void Group::set(const std::string& name, const std::vector<std::string>& texts) {
    std::vector<const char*> data;
    data.reserve(texts.size());
    for (const auto& text : texts) data.push_back(text.c_str());
    set_raw(name, string_type(), data.data(), static_cast<Offset>(data.size()), false);
}

void Group::set_on(const std::string& name, const std::string& attribute, const std::string& text) {
    Group as_group;  // attributes of datasets and groups are made alike
    as_group.file_ = file_;
    as_group.file_name_ = file_name_;
    as_group.path_ = path_ + "/" + name;
    as_group.group_ = dataset(name);
    as_group.set(attribute, text);
}

}  // namespace connectivity::hdf5
