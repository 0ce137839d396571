// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Strided arrays of the host: checked, then copied once into our interleaved double layout.

#include <array>

#include <connectivity/base/spaces.hpp>

#include "connectivity.h"

namespace connectivity::capi {

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

}  // namespace connectivity::capi
