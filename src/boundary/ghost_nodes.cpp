// SPDX-License-Identifier: BSD-3-Clause
#include "ghost_nodes.hpp"

#include <algorithm>

#include "launch.hpp"

namespace connectivity::detail {

namespace {

template <class T>
void copy(const char* label, const ConstView<T>& from, const View<T>& to, Offset n) {
    const T* const source = from.data();
    T* const target = to.data();
    if (source != target) for_each_item(label, n, [=](const Offset k) { target[k] = source[k]; });
}

std::pair<std::size_t, std::size_t> first(Offset n) { return {0, static_cast<std::size_t>(n)}; }

}  // namespace

void GhostNodes::take(const NodeList& list) {
    name_ = list.name();
    dim = list.dim();
    tensor = list.has_tensor();
    kernel_extent = list.kernel_extent();
    has_ids_ = list.global_ids().size() > 0;
    n = n_internal = list.n_internal();
    grow(x_, "boundary/positions", 0, n * dim);
    grow(support_, "boundary/supports", 0, n * per_node());
    if (has_ids_) grow(ids_, "boundary/global_ids", 0, n);
    copy_values(list);
}

void GhostNodes::move(const NodeList& list) { copy_values(list); }

void GhostNodes::copy_values(const NodeList& list) {
    copy("boundary/take", list.positions(), x_, n_internal * dim);
    copy("boundary/take", tensor ? list.H() : list.h(), support_, n_internal * per_node());
    if (has_ids_) copy("boundary/take", list.global_ids(), ids_, n_internal);
}

void GhostNodes::append(const GhostBlock& ghosts, const RigidMap& map) {
    const Offset after = ghosts.first + ghosts.n;
    grow(x_, "boundary/positions", n * dim, after * dim);
    grow(support_, "boundary/supports", n * per_node(), after * per_node());
    grow(owner_, "boundary/owners", n - n_internal, after - n_internal);
    if (has_ids_) grow(ids_, "boundary/global_ids", n, after);
    n = after;
    for (Offset k = 0; k < ghosts.n; ++k) {
        const Slot control = ghosts.storage(k);
        owner_(ghosts.first + k - n_internal) =
            control < n_internal ? control : owner_(control - n_internal);
        if (has_ids_) ids_(ghosts.first + k) = ids_(control);
    }
    place(ghosts, map);
}

void GhostNodes::place(const GhostBlock& ghosts, const RigidMap& map) {
    switch (dim) {
        case 1: return place_in<1>(ghosts, map);
        case 2: return place_in<2>(ghosts, map);
        default: return place_in<3>(ghosts, map);
    }
}

template <int Dim>
void GhostNodes::place_in(const GhostBlock& ghosts, const RigidMap& map) {
    double *const x = x_.data(), *const support = support_.data();
    const Slot* const control = ghosts.storage.data();
    const Offset first_ghost = ghosts.first;
    const bool tensors = tensor;
    for_each_item("boundary/place", ghosts.n, [=](const Offset k) {
        const Offset from = control[k], to = first_ghost + k;
        map.position<Dim>(x + from * Dim, x + to * Dim);
        if (tensors)
            map.tensor<Dim>(support + from * n_symmetric(Dim), support + to * n_symmetric(Dim));
        else
            support[to] = support[from];
    });
}

void GhostNodes::copy_node(Offset from, Offset to) {
    std::copy_n(x_.data() + from * dim, dim, x_.data() + to * dim);
    std::copy_n(support_.data() + from * per_node(), per_node(), support_.data() + to * per_node());
    owner_(to - n_internal) = owner_(from - n_internal);
    if (has_ids_) ids_(to) = ids_(from);
}

void GhostNodes::drop(const Slot* keep, const Slot* old2new) {
    Offset kept = n_internal;
    for (Offset g = n_internal; g < n; ++g)
        if (keep[g] != 0) {
            if (old2new[g] != g) copy_node(g, old2new[g]);
            ++kept;
        }
    n = kept;
}

NodeList GhostNodes::list(Offset n_nodes) const {
    const ConstView<double> x = Kokkos::subview(x_, first(n_nodes * dim)),
                            support = Kokkos::subview(support_, first(n_nodes * per_node()));
    NodeList nodes = tensor ? NodeList::with_H(name_, dim, n_internal, x, support, kernel_extent)
                            : NodeList::with_h(name_, dim, n_internal, x, support, kernel_extent);
    if (n_nodes > n_internal)
        nodes.set_owners(Kokkos::subview(owner_, first(n_nodes - n_internal)));
    if (has_ids_) nodes.set_global_ids(Kokkos::subview(ids_, first(n_nodes)));
    return nodes;
}

Offset GhostNodes::bytes() const {
    return static_cast<Offset>((x_.size() + support_.size()) * sizeof(double) +
                               owner_.size() * sizeof(Slot) + ids_.size() * sizeof(std::int64_t));
}

}  // namespace connectivity::detail
