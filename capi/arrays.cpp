// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.hpp"

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>

namespace connectivity::capi {

namespace {

[[noreturn]] void refuse(Status status, const std::string& what, std::int64_t value,
                         const std::string& allowed) {
    throw Error(status, what + " = " + std::to_string(value) + ", must be " + allowed);
}

void check_dtype(std::int32_t dtype, Numbers numbers, const std::string& name) {
    const bool is_real = dtype == CONN_FLOAT64 || dtype == CONN_FLOAT32,
               is_whole = dtype == CONN_INT32 || dtype == CONN_INT64;
    if (numbers == Numbers::real && !is_real)
        refuse(Status::argument, name + ".dtype", dtype, "CONN_FLOAT64 or CONN_FLOAT32");
    if (numbers == Numbers::whole && !is_whole)
        refuse(Status::argument, name + ".dtype", dtype, "CONN_INT32 or CONN_INT64");
    if (!is_real && !is_whole)
        refuse(Status::argument, name + ".dtype", dtype,
               "CONN_FLOAT64, CONN_FLOAT32, CONN_INT32 or CONN_INT64");
}

void check_kind(const conn_array& a, Numbers numbers, const std::string& name) {
    if (a.space == CONN_SPACE_DEVICE || a.space == CONN_SPACE_MANAGED)
        throw Error(Status::unsupported,
                    name +
                        ".space is device memory, which this build does not read; give host "
                        "memory");
    if (a.space != CONN_SPACE_HOST && a.space != CONN_SPACE_HOST_PINNED)
        refuse(Status::argument, name + ".space", a.space, "one of CONN_SPACE_*");
    check_dtype(a.dtype, numbers, name);
    for (int d = 0; d < -a.ndim && d < 2; ++d)
        if (const auto size = static_cast<Offset>(element_size(a.dtype)); a.stride[d] % size != 0)
            throw Error(Status::argument, name + ": elements are " + std::to_string(a.stride[d]) +
                                              " bytes apart, which is no whole number of elements "
                                              "of " +
                                              std::to_string(size) + " bytes");
    if (a.ndim != 1 && a.ndim != 2) refuse(Status::argument, name + ".ndim", a.ndim, "1 or 2");
}

// The last element must be addressable: |stride| * (extent - 1) elements fit half the address
// space.
void check_reach(Offset extent, Offset stride, const std::string& name) {
    const Offset limit = std::numeric_limits<Offset>::max() / 32;
    if (extent > 1 && (stride > limit / extent || stride < -(limit / extent)))
        refuse(Status::argument, name, stride, "small enough to address all elements");
}

}  // namespace

std::size_t element_size(std::int32_t dtype) {
    return dtype == CONN_FLOAT32 || dtype == CONN_INT32 ? 4 : 8;
}

void check_array(const conn_array& a, Numbers numbers, Offset n_components,
                 const std::string& name) {
    check_kind(a, numbers, name);
    if (a.extent[0] < 0) refuse(Status::argument, name + ".extent[0]", a.extent[0], ">= 0");
    if (a.extent[0] > max_slots)
        refuse(Status::too_many, name + ".extent[0]", a.extent[0],
               "at most " + std::to_string(max_slots));
    const Offset components = a.ndim == 2 ? a.extent[1] : 1;
    if (n_components == 0 && (components < 1 || components > max_slots))
        refuse(Status::argument, name + ".extent[1]", components,
               "in [1, " + std::to_string(max_slots) + "]");
    if (n_components != 0 && components != n_components)
        refuse(Status::argument, name + (a.ndim == 2 ? ".extent[1]" : ".ndim = 1: components"),
               components, std::to_string(n_components));
    check_reach(a.extent[0], a.stride[0], name + ".stride[0]");
    if (a.ndim == 2) check_reach(components, a.stride[1], name + ".stride[1]");
    if (a.extent[0] > 0 && a.data == nullptr)
        throw Error(Status::null,
                    name + ".data is NULL, but it has " + std::to_string(a.extent[0]) + " nodes");
    if (reinterpret_cast<std::uintptr_t>(a.data) % element_size(a.dtype) != 0)
        throw Error(Status::argument, name + ".data is not aligned to its " +
                                          std::to_string(element_size(a.dtype)) + "-byte elements");
}

void check_distinct(const conn_array& a, const std::string& name) {
    const Offset n = a.extent[0], n_components = a.ndim == 2 ? a.extent[1] : 1,
                 component = a.ndim == 2 ? a.stride[1] : 1;
    const Offset node_step = std::abs(a.stride[0]), component_step = std::abs(component);
    const bool nested = n <= 1 || n_components <= 1 ||
                        node_step > component_step * (n_components - 1) ||
                        component_step > node_step * (n - 1);
    if ((n > 1 && node_step == 0) || (n_components > 1 && component_step == 0) || !nested)
        throw Error(
            Status::argument,
            name + ".stride = {" + std::to_string(a.stride[0]) + ", " + std::to_string(component) +
                "} puts two elements in one place or mixes nodes with components; one of the two "
                "must step over all of the other");
}

namespace {

const void* element(const conn_array& a, Offset index) {
    if (a.extent[0] == 0) return nullptr;
    return a.dtype == CONN_FLOAT32
               ? static_cast<const void*>(static_cast<const float*>(a.data) + index)
               : static_cast<const double*>(a.data) + index;
}

template <class T>
void copy_as(const Columns& columns, double* out) {
    Kokkos::parallel_for("capi/copy",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, columns.n),
                         [=](const Offset i) {
                             for (int c = 0; c < columns.n_components; ++c)
                                 out[i * columns.n_components + c] = static_cast<double>(
                                     static_cast<const T*>(columns.data[c])[i * columns.stride[c]]);
                         });
    HostExec().fence();
}

}  // namespace

Columns read_columns(const conn_array* arrays, std::int32_t n_arrays, int n_components,
                     const char* name) {
    const std::string count = std::string("n_") + name;
    if (n_arrays != 1 && n_arrays != n_components)
        refuse(Status::argument, count, n_arrays, "1 or " + std::to_string(n_components));
    if (arrays == nullptr) throw Error(Status::null, std::string(name) + " is NULL");
    Columns columns;
    columns.n_components = n_components;
    columns.dtype = arrays[0].dtype;
    columns.n = arrays[0].extent[0];
    for (int k = 0; k < n_arrays; ++k) {
        const conn_array& a = arrays[k];
        const std::string which =
            n_arrays == 1 ? std::string(name) : std::string(name) + "[" + std::to_string(k) + "]";
        check_array(a, Numbers::real, n_components / n_arrays, which);
        if (a.extent[0] != columns.n)
            refuse(Status::argument, which + ".extent[0]", a.extent[0],
                   std::to_string(columns.n) + " as in the first");
        if (a.dtype != columns.dtype)
            refuse(Status::argument, which + ".dtype", a.dtype, "that of the first");
        for (int c = 0; c < n_components / n_arrays; ++c) {
            columns.data[k + c] = element(a, a.ndim == 2 ? c * a.stride[1] : 0);
            columns.stride[k + c] = a.stride[0];
        }
    }
    return columns;
}

WholeNumbers::WholeNumbers(const conn_array& array, const std::string& name) {
    check_array(array, Numbers::whole, 1, name);
    data_ = array.data;
    n_ = array.extent[0];
    stride_ = array.stride[0];
    is_wide_ = array.dtype == CONN_INT64;
}

void copy_columns(const Columns& columns, double* out) {
    if (columns.dtype == CONN_FLOAT32)
        copy_as<float>(columns, out);
    else
        copy_as<double>(columns, out);
}

}  // namespace connectivity::capi
