// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The table of a vector type V: lanes, D, load, load_some, store, set, add, sub, mul, fma (a b +
/// c), fnma (c - a b), select_le (a <= b ? yes : no), rsqrt (to the last bits), transpose.

#include "expansion_m2l.hpp"
#include "expansion_walk.hpp"

namespace connectivity::detail {
namespace {

template <class V>
void any_m2l(int order, const CellArrays& cells, const CellList& sources, const Expansion& target) {
    using M2l = void (*)(const CellArrays&, const CellList&, const Expansion&);
    constexpr M2l fixed[] = {
        nullptr,           m2l_direct<V, 1>, m2l_direct<V, 2>,  m2l_direct<V, 3>,
        m2l_turned<V, 4>,  m2l_turned<V, 5>, m2l_turned<V, 6>,  m2l_turned<V, 7>,
        m2l_turned<V, 8>,  m2l_turned<V, 9>, m2l_turned<V, 10>, m2l_turned<V, 11>,
        m2l_turned<V, 12>, nullptr,          m2l_turned<V, 14>, nullptr,
        m2l_turned<V, 16>,
    };
    constexpr int n_fixed = sizeof fixed / sizeof *fixed;
    if (order < n_fixed && fixed[order] != nullptr)
        fixed[order](cells, sources, target);
    else
        m2l<V>(order, cells, sources, target);
}

template <class V>
void any_m2p(int order, const CellArrays& cells, const CellList& sources, const Points& points,
             const Fields& fields) {
    (order <= 2 ? walk_m2p<V> : m2p<V>)(order, cells, sources, points, fields);
}

template <class V>
constexpr ExpansionKernels make_expansion_kernels(const char* name) {
    return {name,   collect<V, true>, m2m<V>,     any_m2l<V>,
            l2l<V>, l2p<V>,           any_m2p<V>, collect<V, false>};
}

}  // namespace
}  // namespace connectivity::detail
