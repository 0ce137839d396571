// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/row_pairs.hpp>

#include <algorithm>
#include <limits>

#include <connectivity/map/pair_field_base.hpp>

namespace connectivity {
namespace {

using Rows = Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>;

/// Gives each entry of the rows its pair, by cursors that move along the rows. Entries stand by
/// list, then ascending as the half rows do: in slot order one cursor a row is enough, in key order
/// each list in it needs its own.
struct Numbering {
    RowsView<> rows;
    NodePairList::View<> pairs;
    const SlotLayout* layout;
    int n_cursors;   ///< of a row
    Offset* cursor;  ///< [n_slots * n_cursors]: where the next entry goes; -1 where there is none
    Slot* slot;
    std::uint32_t* pair;

    int list_of(Slot s) const { return n_cursors > 1 ? layout->list_of_slot(s) : 0; }
    bool is_empty(Offset row) const {  // that of a node that is not active, too
        return rows.offsets(row * rows.n_lists) == rows.offsets((row + 1) * rows.n_lists);
    }

    void start(Offset row, Slot a) const {
        slot[row] = a;
        for (int c = 0; c < n_cursors; ++c)
            cursor[Offset{a} * n_cursors + c] =
                is_empty(row) ? -1 : rows.offsets(row * rows.n_lists + c);
    }

    /// Entries that come before their row's node, for the nodes of half rows [first, last): half
    /// rows in ascending order meet them in the order they stand in.
    void earlier(Slot first, Slot last) const {
        const Slot* const j = pairs.j.data();
        const auto is_before = [&](Slot node, Slot row) { return pairs.half_row(node) < row; };
        for (Slot half = 0; half < last; ++half) {
            const Slot *partner = j + pairs.offsets(half), *const end = j + pairs.offsets(half + 1);
            if (partner == end || is_before(end[-1], first)) continue;
            if (is_before(*partner, first))
                partner = std::lower_bound(partner, end, first, is_before);
            const int list = list_of(pairs.node(half));
            for (; partner < end && is_before(*partner, last); ++partner)
                number(*partner, list, partner - j);
        }
    }

    /// The others, after these.
    void later(Offset row) const {
        const Slot a = slot[row], half = pairs.half_row(a);
        for (Offset k = pairs.offsets(half); k < pairs.offsets(half + 1); ++k)
            number(a, list_of(pairs.j(k)), k);
    }

private:
    void number(Slot s, int list, Offset k) const {
        Offset& at = cursor[Offset{s} * n_cursors + list];
        if (at >= 0) pair[at++] = static_cast<std::uint32_t>(k);
    }
};

/// The half row where the part-th of n_parts parts of about equally many entries begins.
Slot begin_of_part(int part, int n_parts, const RowsView<>& rows, const SlotLayout& layout,
                   bool key_order) {
    const Offset n = layout.n_slots();
    if (part == 0) return 0;
    if (part == n_parts) return static_cast<Slot>(n);
    if (key_order) return static_cast<Slot>(n / n_parts * part);  // all nodes have rows
    const Offset wanted = rows.size() / n_parts * part;
    Offset first = 0, last = rows.n_rows();
    while (first < last) {
        const Offset middle = first + (last - first) / 2;
        if (rows.offsets(middle * rows.n_lists) < wanted)
            first = middle + 1;
        else
            last = middle;
    }
    return static_cast<Slot>(first < rows.n_rows() ? layout.slot_of_row(first) : n);
}

}  // namespace

void RowPairs::rebuild(const ConnectivityMap& map) {
    const auto rows = map.rows();
    const auto pairs = map.pairs().view();
    constexpr Offset limit = std::numeric_limits<std::uint32_t>::max();
    if (pairs.size() > limit)
        throw Error(Status::too_many, "row pairs: " + std::to_string(pairs.size()) +
                                          " pairs, must be at most " + std::to_string(limit));
    const SlotLayout& layout = map.layout();
    stamp_ = 0;
    ensure_capacity(pair_, "map/row_pairs", rows.size());
    ensure_capacity(slot_, "map/row_pairs/slots", rows.n_rows());
    const bool by_key = pairs.ranks.size() > 0;
    const int n_cursors = by_key ? layout.n_lists() : 1;
    ensure_capacity(cursor_, "map/row_pairs/cursor", layout.n_slots() * n_cursors);
    detail::fill_pairs(cursor_.data(), layout.n_slots() * n_cursors, Offset{-1});
    const Numbering numbering{rows,           pairs,        &layout,     n_cursors,
                              cursor_.data(), slot_.data(), pair_.data()};
    shim::outside_parallel_region([&] {
        const Rows all(0, rows.n_rows());
        Kokkos::parallel_for("map/row_pairs/start", all, [=](const Offset row) {
            numbering.start(row, static_cast<Slot>(numbering.layout->slot_of_row(row)));
        });
        HostExec().fence();
        const int n_parts = n_workers();
        for_each_dynamic("map/row_pairs/earlier", n_parts, [&](int, Offset p) {
            const int part = static_cast<int>(p);
            numbering.earlier(begin_of_part(part, n_parts, rows, layout, by_key),
                              begin_of_part(part + 1, n_parts, rows, layout, by_key));
        });
        Kokkos::parallel_for("map/row_pairs/later", all,
                             [=](const Offset row) { numbering.later(row); });
        HostExec().fence();
    });
    stamp_ = pairs.stamp;
}

bool RowPairs::is_current(const ConnectivityMap& map) const {
    return stamp_ != 0 && stamp_ == map.pairs().stamp();
}

RowPairs::View<> RowPairs::view(const ConnectivityMap& map) const {
    if (!is_current(map))
        throw Error(Status::stale, "row pairs: made for another map, or before a rebuild or patch");
    const auto rows = map.rows();
    const auto head = [](const auto& values, Offset n) {
        return Kokkos::subview(values, std::pair<Offset, Offset>(0, n));
    };
    return {rows, map.pairs().view(), head(pair_, rows.size()), head(slot_, rows.n_rows())};
}

Offset RowPairs::bytes() const {
    return static_cast<Offset>(pair_.size() * sizeof(std::uint32_t) + slot_.size() * sizeof(Slot) +
                               cursor_.size() * sizeof(Offset));
}

}  // namespace connectivity
