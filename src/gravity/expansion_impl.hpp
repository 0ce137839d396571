// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The table of a vector type V: lanes, D, load, load_some, store, set, add, sub, mul, fma (a b +
/// c), fnma (c - a b), select_le (a <= b ? yes : no), rsqrt (to the last bits), transpose.

#include "expansion_cells.hpp"
#include "expansion_points.hpp"

namespace connectivity::detail {
namespace {

template <class V>
constexpr ExpansionKernels make_expansion_kernels(const char* name) {
    return {name, collect<V, true>, m2m<V>, m2l<V>, l2l<V>, l2p<V>, m2p<V>, collect<V, false>};
}

}  // namespace
}  // namespace connectivity::detail
