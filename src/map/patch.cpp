// SPDX-License-Identifier: BSD-3-Clause
#include "patch.hpp"

namespace connectivity {

namespace {

/// How a new list comes from an old one.
template <class OldRow, class Owner, class Value>
struct RowRule {
    OldRow old_row;  ///< of a new row; -1: it is empty
    Owner owner;     ///< what `value` is told about a new row
    Value value;     ///< (owner, old value) -> new value; -1: dropped
    bool sorts;      ///< new values do not ascend as the old ones did
};
template <class OldRow, class Owner, class Value>
RowRule(OldRow, Owner, Value, bool) -> RowRule<OldRow, Owner, Value>;

/// Reads a list by a rule.
template <class Rule>
class RuleReader {
public:
    RuleReader(const Csr& in, const Rule& rule)
        : rule_(rule), offsets_(in.offsets().data()), values_(in.values().data()) {}

    /// f(new value, old place) for what stays in a new row.
    template <class F>
    void visit(Offset row, const F& f) const {
        const Offset old = rule_.old_row(row);
        if (old < 0 || offsets_[old] == offsets_[old + 1]) return;
        const auto owner = rule_.owner(row);
        for (Offset k = offsets_[old]; k < offsets_[old + 1]; ++k)
            if (const Slot value = rule_.value(owner, values_[k]); value >= 0) f(value, k);
    }

private:
    const Rule& rule_;
    const Offset* offsets_;
    const Slot* values_;
};

/// Makes `out` from `in`; returns its number of values. take_sources(n) gives room for the old
/// place of each, or null.
template <class Rule, class TakeSources>
void derive(const Csr& in, Csr& out, Offset n_rows, const Rule& rule,
            const TakeSources& take_sources) {
    const RuleReader<Rule> reader(in, rule);
    out.prepare(n_rows, [&](Offset row) {
        Offset n = 0;
        reader.visit(row, [&](Slot, Offset) { ++n; });
        return n;
    });
    out.reserve();
    Offset* const sources = take_sources(out.n_prepared());
    out.commit([&](Offset first, Offset last, const Offset* offsets, Slot* values) {
        for (Offset row = first; row < last; ++row) {
            Offset at = offsets[row];
            reader.visit(row, [&](Slot value, Offset old_place) {
                if (sources != nullptr) sources[at] = old_place;
                values[at++] = value;
            });
            if (rule.sorts) std::sort(values + offsets[row], values + at);
        }
    });
}

template <class Rule>
void derive(const Csr& in, Csr& out, Offset n_rows, const Rule& rule) {
    derive(in, out, n_rows, rule, [](Offset) { return static_cast<Offset*>(nullptr); });
}

constexpr auto nobody = [](Offset) { return 0; };

}  // namespace

Offset* Patch::take_sources(Offset n_pairs) {
    ensure_capacity(new_to_old_, "map/patch/new_to_old", n_pairs);
    n_pairs_ = n_pairs;
    return new_to_old_.data();
}

ConstView<Offset> Patch::new_to_old() const {
    return Kokkos::subview(new_to_old_, std::pair<std::size_t, std::size_t>(0, n_pairs_));
}

void Patch::prepare_nodes(const Renumbering& now, const SlotLayout& before, const MapLists& lists,
                          BuiltLists built) {
    const Slot *const new_slot = now.new_slot.data(), *const old_slot = now.old_slot.data();
    const auto renumbered = [=](int, Slot slot) { return new_slot[slot]; };
    const bool sorts = !now.keeps_order && !built.by_key;
    const Offset n_lists = now.layout.n_lists();
    const RowRule by_list{[&, n_lists](Offset segment) {
                              const Offset slot = now.layout.slot_of_row(segment / n_lists);
                              const Offset row = before.row_of_slot(old_slot[slot]);
                              return row < 0 ? row : row * n_lists + segment % n_lists;
                          },
                          nobody, renumbered, sorts};
    const Offset n_segments = now.layout.n_rows() * n_lists;
    renumbers_ = true;
    if (built.by_key) key_order_.assign(lists.key_order, new_slot, now.layout.n_slots());
    if (built.rows) derive(lists.rows, rows_, n_segments, by_list);
    if (built.overlap) derive(lists.overlap, overlap_, n_segments, by_list);
    if (built.pairs) patch_half_rows(now, lists, built);
    if (built.intersection)
        derive(lists.intersection, intersection_, n_pairs_,
               RowRule{[from = new_to_old_.data()](Offset pair) { return from[pair]; }, nobody,
                       renumbered, sorts});
}

void Patch::patch_half_rows(const Renumbering& now, const MapLists& lists, BuiltLists built) {
    if (!now.keeps_order && !built.by_key) return turn_half_rows(now, lists.half_rows);
    const Slot *const new_slot = now.new_slot.data(), *const old_slot = now.old_slot.data();
    const Slot* const slots = built.by_key ? key_order_.slots() : nullptr;
    const Slot* const old_ranks = built.by_key ? lists.key_order.ranks() : nullptr;
    derive(lists.half_rows, half_rows_, now.layout.n_slots(),
           RowRule{[=](Offset row) {
                       return Offset{slots == nullptr ? old_slot[row]
                                                      : old_ranks[old_slot[slots[row]]]};
                   },
                   nobody, [=](int, Slot slot) { return new_slot[slot]; }, false},
           [this](Offset n) { return take_sources(n); });
}

/// Half rows where the first node of a pair may become its second: collected by atomics, then each
/// sorted, so the result does not depend on threads.
void Patch::turn_half_rows(const Renumbering& now, const Csr& old) {
    struct Entry {
        Slot j;
        Offset place;
    };
    const Slot* const new_slot = now.new_slot.data();
    const Offset *const offsets = old.offsets().data(), n = now.layout.n_slots();
    const Slot* const j = old.values().data();
    const auto for_pairs = [&](const auto& f) {
        Kokkos::parallel_for(
            "map/patch/turn",
            Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, old.n_rows()),
            [=](const Offset i) {
                for (Offset k = offsets[i]; k < offsets[i + 1]; ++k) {
                    const Slot a = new_slot[i], b = new_slot[j[k]];
                    if (a >= 0 && b >= 0) f(std::min(a, b), std::max(a, b), k);
                }
            });
        HostExec().fence();
    };
    const auto cursor = allocate_zeroed<Offset>("map/patch/cursor", n);
    for_pairs([=](Slot a, Slot, Offset) { Kokkos::atomic_fetch_add(&cursor(a), Offset{1}); });
    half_rows_.prepare(n, [=](Offset a) { return cursor(a); });
    half_rows_.reserve();
    const Offset n_pairs = half_rows_.n_prepared();
    Offset* const sources = take_sources(n_pairs);
    const auto entries = allocate<Entry>("map/patch/entries", n_pairs);
    std::copy_n(half_rows_.prepared_offsets(), n, cursor.data());
    for_pairs([=](Slot a, Slot b, Offset k) {
        entries(Kokkos::atomic_fetch_add(&cursor(a), Offset{1})) = {b, k};
    });
    half_rows_.commit([=](Offset first, Offset last, const Offset* to, Slot* values) {
        for (Offset row = first; row < last; ++row) {
            std::sort(entries.data() + to[row], entries.data() + to[row + 1],
                      [](const Entry& x, const Entry& y) { return x.j < y.j; });
            for (Offset k = to[row]; k < to[row + 1]; ++k)
                values[k] = entries(k).j, sources[k] = entries(k).place;
        }
    });
}

void Patch::prepare_pairs(const PairFilter& filter, const SlotLayout& layout, const MapLists& lists,
                          BuiltLists built) {
    renumbers_ = false;
    const auto same_row = [](Offset row) { return row; };
    const auto kept = [&](Slot self, Slot other) {
        return filter.keeps_or_notes(self, other) ? other : -1;
    };
    const Offset n_lists = layout.n_lists();
    if (built.rows)
        derive(lists.rows, rows_, lists.rows.n_rows(),
               RowRule{same_row,
                       [&](Offset segment) {
                           return static_cast<Slot>(layout.slot_of_row(segment / n_lists));
                       },
                       kept, false});
    if (built.pairs)
        derive(lists.half_rows, half_rows_, lists.half_rows.n_rows(),
               RowRule{same_row,
                       [&](Offset row) {
                           return built.by_key ? lists.key_order.slots()[row]
                                               : static_cast<Slot>(row);
                       },
                       kept, false},
               [this](Offset n) { return take_sources(n); });
    filter.rethrow();
}

void Patch::commit(MapLists lists, BuiltLists built) {
    if (built.rows) std::swap(lists.rows, rows_);
    if (built.pairs) std::swap(lists.half_rows, half_rows_);
    if (built.overlap) std::swap(lists.overlap, overlap_);
    if (built.intersection) std::swap(lists.intersection, intersection_);
    if (built.by_key && renumbers_) std::swap(lists.key_order, key_order_);
    // What the map has not, is of an older one.
    if (!built.rows) rows_.clear();
    if (!built.pairs) half_rows_.clear();
    if (!built.overlap) overlap_.clear();
    if (!built.intersection) intersection_.clear();
    if (!built.by_key) key_order_.clear();
}

Offset Patch::bytes() const {
    return rows_.bytes() + half_rows_.bytes() + overlap_.bytes() + intersection_.bytes() +
           key_order_.bytes() + static_cast<Offset>(new_to_old_.size() * sizeof(Offset));
}

}  // namespace connectivity
