// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Leaving pairs out of lists: by an interaction matrix of node lists, by a host's predicate.
///
/// Invariant: the predicate is asked with the lower slot first, so what it leaves out is symmetric.
/// Cost: two passes over the list, each asking for every entry.

#include <utility>

#include <connectivity/base/csr.hpp>
#include <connectivity/map/map_options.hpp>

#include "labels.hpp"
#include "base/first_exception.hpp"

namespace connectivity {

class PairFilter {
public:
    PairFilter(const SlotLayout& layout, const MapOptions& options)
        : layout_(layout),
          interactions_(options.interactions.data()),
          exclude_(options.exclude.get()) {
        if (options.interactions.empty()) interactions_ = nullptr;
    }

    bool any() const { return interactions_ != nullptr || exclude_ != nullptr; }

    bool keeps(Slot a, Slot b) const {
        if (interactions_ != nullptr &&
            interactions_[Offset{layout_.list_of_slot(a)} * layout_.n_lists() +
                          layout_.list_of_slot(b)] == 0)
            return false;
        return exclude_ == nullptr || !(*exclude_)(std::min(a, b), std::max(a, b));
    }

    /// The same in a parallel loop: the first exception of a predicate is kept for `rethrow`, and
    /// nothing is kept of the pairs after it, so no row becomes longer than it was counted.
    bool keeps_or_notes(Slot a, Slot b) const noexcept {
        if (failure_.any()) return false;
        try {
            return keeps(a, b);
        } catch (...) {
            failure_.keep();
            return false;
        }
    }
    void rethrow() const { failure_.rethrow(); }

    /// Filters a list whose row r belongs to the node with label node_of(r). The storage of the two
    /// changes places. Throws Error{memory} and what the predicate throws; the list is then as
    /// before.
    template <class NodeOf>
    void apply(Csr& list, Csr& spare, const Labels& labels, const NodeOf& node_of) const {
        const Offset* const offsets = list.offsets().data();
        const Slot* const values = list.values().data();
        const auto kept = [=, this](Offset row, const auto& f) {
            if (offsets[row] == offsets[row + 1]) return;
            const Slot self = labels.slot(static_cast<Slot>(node_of(row)));
            for (Offset k = offsets[row]; k < offsets[row + 1]; ++k)
                if (keeps_or_notes(self, labels.slot(values[k]))) f(values[k]);
        };
        spare.prepare(list.n_rows(), [&](Offset row) {
            Offset n = 0;
            kept(row, [&](Slot) { ++n; });
            return n;
        });
        spare.reserve();
        spare.commit([&](Offset first, Offset last, const Offset* to, Slot* out) {
            for (Offset row = first; row < last; ++row) {
                Slot* end = out + to[row];
                kept(row, [&](Slot value) { *end++ = value; });
            }
        });
        rethrow();
        std::swap(list, spare);
    }

private:
    const SlotLayout& layout_;
    const std::uint8_t* interactions_;
    const PairPredicate* exclude_;
    mutable detail::FirstException failure_;
};

}  // namespace connectivity
