// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/pair_field_base.hpp>

namespace connectivity {

void PairFieldBase::require_current(const NodePairList& pairs) const {
    if (is_current(pairs)) return;
    throw Error(Status::stale,
                stamp_ == 0
                    ? std::string("pairwise field: empty, it belongs to no pair list")
                    : "pairwise field: made for another pair list, or for one before a rebuild or "
                      "patch (stamp " +
                          std::to_string(stamp_) + ", the list has " +
                          std::to_string(pairs.stamp()) + ")");
}

void PairFieldBase::require_built(const NodePairList& pairs) {
    if (pairs.stamp() == 0)
        throw Error(Status::not_built, "pairwise field: the pair list was never built");
}

Offset PairFieldBase::find_pair(const NodePairList& pairs, Slot i, Slot j) const {
    require_current(pairs);
    return pairs.find(i, j);
}

Offset PairFieldBase::require_pair(const NodePairList& pairs, Slot i, Slot j) const {
    const Offset k = find_pair(pairs, i, j);
    if (k < 0)
        throw Error(Status::argument, "pairwise field: slots " + std::to_string(i) + " and " +
                                          std::to_string(j) + " are no pair of the list");
    return k;
}

}  // namespace connectivity
