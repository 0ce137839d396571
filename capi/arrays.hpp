// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Strided arrays of the host: checked, and copied once into our own layout where they are kept.

#include <array>
#include <string>

#include <connectivity/base/spaces.hpp>

#include "connectivity.h"

namespace connectivity::capi {

/// Types of elements that an argument may have.
enum class Numbers { real, whole, any };

/// Throws Error: null, argument, too_many, unsupported; n_components 0: any number of them, at
/// least 1; `name` is the argument's.
void check_array(const conn_array& array, Numbers numbers, Offset n_components,
                 const std::string& name);

/// Throws Error{argument} unless every element has a place of its own, as an array that is written
/// must.
void check_distinct(const conn_array& array, const std::string& name);

/// 4 or 8 bytes.
std::size_t element_size(std::int32_t dtype);

/// Component c of node i is the element i * stride[c] from data[c]. All components have one type.
struct Columns {
    static constexpr int max_components = 6;

    int n_components = 0;
    std::int32_t dtype = CONN_FLOAT64;
    Offset n = 0;
    std::array<const void*, max_components> data{};
    std::array<Offset, max_components> stride{};
};

/// One array [n, n_components], or n_components arrays [n]. Throws Error: null, argument, too_many,
/// unsupported; `name` is the argument's.
Columns read_columns(const conn_array* arrays, std::int32_t n_arrays, int n_components,
                     const char* name);

/// out[i * n_components + c] = component c of node i. Cannot fail.
void copy_columns(const Columns& columns, double* out);

/// Whole numbers [n], 32 or 64 bits wide. Throws as check_array.
class WholeNumbers {
public:
    WholeNumbers(const conn_array& array, const std::string& name);

    Offset size() const { return n_; }
    std::int64_t operator[](Offset k) const {
        return is_wide_ ? static_cast<const std::int64_t*>(data_)[k * stride_]
                        : static_cast<const std::int32_t*>(data_)[k * stride_];
    }

private:
    const void* data_;
    Offset n_, stride_;
    bool is_wide_;
};

}  // namespace connectivity::capi
