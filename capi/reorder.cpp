// SPDX-License-Identifier: BSD-3-Clause
// Fields of the host in another order.

#include <algorithm>
#include <limits>

#include "arrays.hpp"
#include "guard.hpp"
#include "index_base.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

using Loop = Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>;

/// A field as it lies in memory, of in and of out.
struct Layout {
    Offset n, n_components, node, component;  // strides

    Offset at(Offset i, Offset c) const { return i * node + c * component; }
    /// Elements from that of component 0 of node 0 to the first and to the one behind the last.
    Offset begin() const {
        return std::min<Offset>(0, (n - 1) * node) +
               std::min<Offset>(0, (n_components - 1) * component);
    }
    Offset end() const {
        return std::max<Offset>(0, (n - 1) * node) +
               std::max<Offset>(0, (n_components - 1) * component) + 1;
    }
};

/// Throws Error{argument} unless every element has a place of its own.
Layout read_layout(const conn_array& in) {
    check_array(in, Numbers::any, 0, "in");
    check_distinct(in, "in");
    Layout layout{in.extent[0], 1, in.stride[0], 1};
    if (in.ndim == 2) layout.n_components = in.extent[1], layout.component = in.stride[1];
    return layout;
}

/// Throws Error{argument} unless out is in->data, or far enough from it, and from the order.
void check_places(const Layout& layout, const conn_array& in, const std::int32_t* order,
                  const void* out) {
    const std::size_t size = element_size(in.dtype);
    const auto from = reinterpret_cast<std::uintptr_t>(in.data),
               to = reinterpret_cast<std::uintptr_t>(out);
    if (to % size != 0)
        throw Error(Status::argument,
                    "out is not aligned to its " + std::to_string(size) + "-byte elements");
    const std::uintptr_t between = from < to ? to - from : from - to;
    const auto length = static_cast<std::uintptr_t>(layout.end() - layout.begin()) * size;
    if (from != to && between < length)
        throw Error(Status::argument, "out overlaps in: " + std::to_string(between) +
                                          " bytes apart, must be 0 or at least " +
                                          std::to_string(length));
    const auto numbers = reinterpret_cast<std::uintptr_t>(order),
               end = numbers + static_cast<std::uintptr_t>(layout.n) * sizeof *order,
               first = to + static_cast<std::uintptr_t>(layout.begin()) * size;
    if (first < end && numbers < first + length)
        throw Error(Status::argument, "out overlaps order, which is read while out is written");
}

/// Throws Error{argument} for the first number out of range, or the least that is not there once.
void check_permutation(const std::int32_t* order, Offset n, IndexBase base) {
    constexpr Offset none = std::numeric_limits<Offset>::max();
    const auto times = allocate_zeroed<std::int32_t>("capi/reorder/times", n);
    Offset bad = none;
    Kokkos::parallel_reduce(
        "capi/reorder/range", Loop(0, n),
        [=](const Offset k, Offset& first) {
            const Offset node = base.in(order[k]);
            if (node < 0 || node >= n)
                first = std::min(first, k);
            else
                Kokkos::atomic_add(&times(node), 1);
        },
        Kokkos::Min<Offset>(bad));
    if (bad != none)
        throw Error(Status::argument, "order[" + std::to_string(bad) +
                                          "] = " + std::to_string(order[bad]) + ", must be in [" +
                                          std::to_string(base.out(0)) + ", " +
                                          std::to_string(n + base.out(0)) + ")");
    Kokkos::parallel_reduce(
        "capi/reorder/once", Loop(0, n),
        [=](const Offset node, Offset& first) {
            if (times(node) != 1) first = std::min(first, node);
        },
        Kokkos::Min<Offset>(bad));
    if (bad != none)
        throw Error(Status::argument, "order names node " + std::to_string(bad + base.out(0)) +
                                          " " + std::to_string(times(bad)) +
                                          " times, must do so once");
}

template <class T>
void gather(const Layout& from, const T* in, const std::int32_t* order, IndexBase base,
            const Layout& to, T* out) {
    Kokkos::parallel_for("capi/reorder", Loop(0, from.n), [=](const Offset k) {
        const Offset node = base.in(order[k]);
        for (Offset c = 0; c < from.n_components; ++c) out[to.at(k, c)] = in[from.at(node, c)];
    });
    HostExec().fence();
}

template <class T>
void reorder(const Layout& layout, const void* from, const std::int32_t* order, IndexBase base,
             void* to) {
    const T* const in = static_cast<const T*>(from);
    T* const out = static_cast<T*>(to);
    if (from != to) return gather(layout, in, order, base, layout, out);
    const Layout dense{layout.n, layout.n_components, layout.n_components, 1};
    const auto copy = allocate<T>("capi/reorder/copy", layout.n * layout.n_components);
    gather(layout, in, order, base, dense, copy.data());
    Kokkos::parallel_for("capi/reorder/back", Loop(0, layout.n), [=](const Offset k) {
        for (Offset c = 0; c < layout.n_components; ++c)
            out[layout.at(k, c)] = copy(dense.at(k, c));
    });
    HostExec().fence();
}

}  // namespace

conn_status conn_reorder(const conn_array* in, const int32_t* order, int64_t n, int32_t index_base,
                         void* out) {
    return guarded_with_runtime(__func__, [&] {
        if (in == nullptr) throw Error(Status::null, "in is NULL");
        const Layout layout = read_layout(*in);
        const IndexBase base(index_base, "index_base");
        if (n != layout.n)
            throw Error(Status::argument, "n = " + std::to_string(n) + ", must be " +
                                              std::to_string(layout.n) + " as in.extent[0]");
        if (n == 0) return;
        if (order == nullptr || out == nullptr)
            throw Error(Status::null, std::string(order == nullptr ? "order" : "out") + " is NULL");
        check_places(layout, *in, order, out);
        check_permutation(order, n, base);
        switch (in->dtype) {
            case CONN_FLOAT32: return reorder<float>(layout, in->data, order, base, out);
            case CONN_INT32: return reorder<std::int32_t>(layout, in->data, order, base, out);
            case CONN_INT64: return reorder<std::int64_t>(layout, in->data, order, base, out);
            default: return reorder<double>(layout, in->data, order, base, out);
        }
    });
}
