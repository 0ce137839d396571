// SPDX-License-Identifier: BSD-3-Clause
#include "rows.hpp"

namespace connectivity::detail::device {

namespace {

/// The first place in an ascending list whose value is not below `value`.
KOKKOS_INLINE_FUNCTION int lower_bound(const Slot* list, int n, Offset value) {
    int low = 0;
    while (n > 0) {
        const int half = n / 2;
        if (list[low + half] < value)
            low += half + 1, n -= half + 1;
        else
            n = half;
    }
    return low;
}

/// A node and the list of its leaf.
template <int Dim>
struct NodeOfLeaf {
    Problem<Dim> problem;
    const Slot* lists;
    const Offset* offsets;  // of the first leaf's list
    Offset first_leaf;

    struct Candidates {
        Offset i;  // the node; -1: nothing to find
        const Slot* list;
        int n;
        bool stored;
    };

    KOKKOS_INLINE_FUNCTION Candidates operator()(Offset item) const {
        const Offset leaf = item / leaf_size;
        const Slot i = problem.slot[first_leaf * leaf_size + item];
        Candidates c{-1, nullptr, 0, false};
        if (i < 0 || !problem.layout.is_wanted(i)) return c;
        c.i = i;
        c.n = static_cast<int>(offsets[leaf + 1] - offsets[leaf]);
        c.list = lists + (offsets[leaf] - offsets[0]);
        c.stored = problem.layout.is_stored(i);
        return c;
    }
    KOKKOS_INLINE_FUNCTION bool is_neighbour(const Candidates& c, Offset j) const {
        return j != c.i && problem.see(c.i, j, problem.mode);
    }
    /// Does j after i stand in the half row of i?
    KOKKOS_INLINE_FUNCTION bool is_partner(const Candidates& c, Offset j) const {
        return (c.stored || problem.layout.is_stored(j)) && is_neighbour(c, j);
    }
};

template <class Exec, int Dim>
struct CountRow {
    NodeOfLeaf<Dim> nodes;
    Slot* rows;    // [n_rows * n_lists]
    Slot* halves;  // [n_slots]

    using Member = typename Teams<Exec>::member_type;

    KOKKOS_INLINE_FUNCTION void operator()(const Member& team, Offset item) const {
        const auto c = nodes(item);
        if (c.i < 0) return;
        const Layout& layout = nodes.problem.layout;
        const int later = lower_bound(c.list, c.n, c.i);
        Slot partners = 0;
        if (!layout.rows || !c.stored) {
            partners = count(team, c, later, c.n);
        } else {
            const Offset row = layout.row_of(c.i) * layout.n_lists;
            int begin = 0;
            for (int l = 0; l < layout.n_lists; ++l) {
                const int end = l + 1 < layout.n_lists
                                    ? lower_bound(c.list, c.n, layout.list_offset[l + 1])
                                    : c.n;
                const int middle = later < begin ? begin : later < end ? later : end;
                const Slot before = count(team, c, begin, middle),
                           after = count(team, c, middle, end);
                Kokkos::single(Kokkos::PerThread(team), [&] { rows[row + l] = before + after; });
                partners += after;
                begin = end;
            }
        }
        if (layout.halves) Kokkos::single(Kokkos::PerThread(team), [&] { halves[c.i] = partners; });
    }

private:
    KOKKOS_INLINE_FUNCTION Slot count(const Member& team,
                                      const typename NodeOfLeaf<Dim>::Candidates& c, int begin,
                                      int end) const {
        Slot n = 0;
        Kokkos::parallel_reduce(
            Kokkos::ThreadVectorRange(team, end - begin),
            [&](int k, Slot& sum) { sum += nodes.is_partner(c, c.list[begin + k]) ? 1 : 0; }, n);
        return n;
    }
};

template <class Exec, int Dim>
struct FillRow {
    NodeOfLeaf<Dim> nodes;
    const Offset *row_offsets, *half_offsets;
    Slot *rows, *halves;

    using Member = typename Teams<Exec>::member_type;

    KOKKOS_INLINE_FUNCTION void operator()(const Member& team, Offset item) const {
        const auto c = nodes(item);
        if (c.i < 0) return;
        const Layout& layout = nodes.problem.layout;
        if (!layout.rows || !c.stored) {
            const int later = lower_bound(c.list, c.n, c.i);
            return write(team, c, later, nullptr, 0, halves + half_offsets[c.i]);
        }
        const Offset row = layout.row_of(c.i) * layout.n_lists, first = row_offsets[row];
        // The half row is the end of the row.
        Offset before = row_offsets[row + layout.n_lists] - first;
        Slot* half = nullptr;
        if (layout.halves) {
            half = halves + half_offsets[c.i];
            before -= half_offsets[c.i + 1] - half_offsets[c.i];
        }
        write(team, c, 0, rows + first, before, half);
    }

private:
    /// Partners from place `begin` on go to `row`; from the entry `before` on they go to `half`.
    KOKKOS_INLINE_FUNCTION void write(const Member& team,
                                      const typename NodeOfLeaf<Dim>::Candidates& c, int begin,
                                      Slot* row, Offset before, Slot* half) const {
        Kokkos::parallel_scan(Kokkos::ThreadVectorRange(team, c.n - begin),
                              [&](int k, Offset& sum, bool final) {
                                  const Slot j = c.list[begin + k];
                                  if (!nodes.is_partner(c, j)) return;
                                  if (final && row != nullptr) row[sum] = j;
                                  if (final && half != nullptr && sum >= before)
                                      half[sum - before] = j;
                                  ++sum;
                              });
    }
};

}  // namespace

template <class Exec, int Dim>
void Rows<Exec, Dim>::begin(const Problem<Dim>& problem, const SlotLayout& layout) {
    has_rows_ = problem.layout.rows;
    has_halves_ = problem.layout.halves;
    n_row_counts_ = has_rows_ ? layout.n_rows() * layout.n_lists() : 0;
    n_slots_ = has_halves_ ? layout.n_slots() : 0;
    row_count_ = row_counts_.reserve("search/device/row_counts", n_row_counts_);
    half_count_ = half_counts_.reserve("search/device/half_counts", n_slots_);
    row_counts_.clear(n_row_counts_);
    half_counts_.clear(n_slots_);
}

template <class Exec, int Dim>
void Rows<Exec, Dim>::count(const Problem<Dim>& problem, const LeafLists<Exec, Dim>& lists,
                            Offset first, Offset last) {
    const NodeOfLeaf<Dim> nodes{problem, lists.slots(), lists.offsets(), first};
    for_each_vector<Exec>("search/device/rows/count", (last - first) * leaf_size,
                          CountRow<Exec, Dim>{nodes, row_count_, half_count_});
}

template <class Exec, int Dim>
Counts Rows<Exec, Dim>::counts() {
    return {has_rows_,
            has_halves_,
            {row_counts_.fetch(n_row_counts_), 1},
            {half_counts_.fetch(n_slots_), 1}};
}

template <class Exec, int Dim>
void Rows<Exec, Dim>::Output::reserve(const char* label, const Csr& list, Offset n_rows) {
    offsets = upload("search/device/offsets", list.prepared_offsets(), n_rows + 1);
    if constexpr (is_host<Exec>) {
        values = list.prepared_values();
    } else {
        ensure_capacity(copy, label, list.n_prepared());
        values = copy.data();
    }
}

template <class Exec, int Dim>
void Rows<Exec, Dim>::Output::finish(const Csr& list) const {
    if constexpr (!is_host<Exec>) {
        if (list.n_prepared() == 0) return;
        Kokkos::deep_copy(
            Kokkos::View<Slot*, Kokkos::LayoutRight, HostMemory, Kokkos::MemoryUnmanaged>(
                list.prepared_values(), list.n_prepared()),
            front(copy, list.n_prepared()));
    }
}

template <class Exec, int Dim>
void Rows<Exec, Dim>::reserve(const Products& products) {
    if (has_rows_) rows_.reserve("search/device/rows", products.rows, n_row_counts_);
    if (has_halves_) halves_.reserve("search/device/half_rows", products.halves, n_slots_);
}

template <class Exec, int Dim>
void Rows<Exec, Dim>::fill(const Problem<Dim>& problem, const LeafLists<Exec, Dim>& lists,
                           Offset first, Offset last) {
    const NodeOfLeaf<Dim> nodes{problem, lists.slots(), lists.offsets(), first};
    for_each_vector<Exec>(
        "search/device/rows/fill", (last - first) * leaf_size,
        FillRow<Exec, Dim>{nodes, rows_.offsets, halves_.offsets, rows_.values, halves_.values});
}

template <class Exec, int Dim>
void Rows<Exec, Dim>::finish(const Products& products) {
    Exec().fence();
    if (has_rows_) rows_.finish(products.rows);
    if (has_halves_) halves_.finish(products.halves);
}

template <class Exec, int Dim>
Offset Rows<Exec, Dim>::bytes() const {
    return row_counts_.bytes() + half_counts_.bytes() + rows_.bytes() + halves_.bytes();
}

template class Rows<Kokkos::DefaultExecutionSpace, 1>;
template class Rows<Kokkos::DefaultExecutionSpace, 2>;
template class Rows<Kokkos::DefaultExecutionSpace, 3>;

}  // namespace connectivity::detail::device
