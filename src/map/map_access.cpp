// SPDX-License-Identifier: BSD-3-Clause
#include "map_impl.hpp"

namespace connectivity {

RowsView<> ConnectivityMap::rows() const {
    if (generation_ == 0 || !options_.rows)
        throw Error(Status::not_built, "rows: the last rebuild was not asked for them");
    return {rows_.offsets(), rows_.values(), layout_.n_lists(), generation_};
}

const NodePairList& ConnectivityMap::pairs() const {
    if (generation_ == 0 || !options_.wants_pairs())
        throw Error(Status::not_built, "pairs: the last rebuild was not asked for them");
    return pairs_;
}

NodePairList& ConnectivityMap::pairs() {
    return const_cast<NodePairList&>(std::as_const(*this).pairs());
}

RowsView<> ConnectivityMap::overlap() const {
    if (generation_ == 0 || !options_.overlap)
        throw Error(Status::not_built, "overlap: the last rebuild was not asked for it");
    return {overlap_.offsets(), overlap_.values(), layout_.n_lists(), generation_};
}

IntersectionView<> ConnectivityMap::intersection() const {
    if (generation_ == 0 || options_.intersection == IntersectionKind::none)
        throw Error(Status::not_built, "intersection: the last rebuild was not asked for it");
    return {intersection_.offsets(), intersection_.values(),
            options_.intersection == IntersectionKind::in_segment, generation_};
}

KeyOrderView<> ConnectivityMap::key_order() const {
    if (generation_ == 0 || options_.order != ListOrder::key)
        throw Error(Status::not_built, "key_order: the last rebuild was not asked for it");
    return key_order_.view();
}

void ConnectivityMap::check_list(const char* call, int list) const {
    if (list < 0 || list >= layout_.n_lists())
        throw Error(Status::argument, std::string(call) + ": list " + std::to_string(list) +
                                          ", must be in [0, " + std::to_string(layout_.n_lists()) +
                                          ")");
}

NodeTraversal ConnectivityMap::traversal(int list) const {
    check_list("traversal", list);
    if (options_.order == ListOrder::slot) return NodeTraversal(n_internal_[list]);
    const Offset first = layout_.list_offset()[list], last = layout_.list_offset()[list + 1];
    const auto ids = allocate<Slot>("map/traversal", last - first);
    const Slot* const slots = key_order_.slots();
    Offset at = 0;
    for (Offset rank = 0; rank < key_order_.size(); ++rank)
        if (slots[rank] >= first && slots[rank] < last)
            ids(at++) = static_cast<Slot>(slots[rank] - first);
    return NodeTraversal(ids);
}

ConstView<Slot> ConnectivityMap::spatial_order() const {
    if (generation_ == 0 || !options_.spatial_order)
        throw Error(Status::not_built, "spatial_order: the last rebuild was not asked for it");
    return order_;
}

View<Slot> ConnectivityMap::spatial_order(int list) const {
    const ConstView<Slot> all = spatial_order();
    check_list("spatial_order", list);
    const Offset first = layout_.list_offset()[list], last = layout_.list_offset()[list + 1];
    auto ids = allocate<Slot>("map/spatial_order", last - first);
    // Internal nodes keep the front of the list: two passes in the common order.
    const Offset n_internal = n_internal_[list];
    Offset internal = 0, ghost = n_internal;
    for (std::size_t k = 0; k < all.size(); ++k)
        if (all(k) >= first && all(k) < last) {
            const Offset id = all(k) - first;
            ids(id < n_internal ? internal++ : ghost++) = static_cast<Slot>(id);
        }
    return ids;
}

}  // namespace connectivity
