// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/validate.hpp>

#include <limits>

#include <connectivity/base/runtime.hpp>

#include "pair_filter.hpp"
#include "prepare.hpp"
#include "base/first_exception.hpp"

namespace connectivity {

namespace {

/// The first k of [0, n) for which is_bad(k), or n.
template <class IsBad>
Offset first_bad(Offset n, const IsBad& is_bad) {
    Offset first = n;
    detail::FirstException failure;  // samples are searched, which takes memory
    Kokkos::parallel_reduce(
        "map/validate", Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
        [&](const Offset k, Offset& lowest) {
            try {
                if (k < lowest && is_bad(k)) lowest = k;
            } catch (...) {
                failure.keep();
            }
        },
        Kokkos::Min<Offset>(first));
    failure.rethrow();
    return std::min(first, n);
}

/// A list as all checks read it: row r belongs to slot node(r).
struct ListReader {
    const Offset* offsets;
    const Slot* slots;

    std::span<const Slot> operator[](Offset row) const {
        return {slots + offsets[row], static_cast<std::size_t>(offsets[row + 1] - offsets[row])};
    }
};

template <int Dim>
class Validator {
public:
    Validator(const ConnectivityMap& map, const SearchNodes<Dim>& nodes)
        : map_(map),
          options_(map.options()),
          layout_(map.layout()),
          see_(significance(nodes)),
          filter_(layout_, options_),
          // A predicate knows the slots that there were before a patch.
          knows_pairs_(!map.has_removed_pairs() &&
                       !(map.is_patched() && options_.exclude != nullptr)),
          filters_(knows_pairs_ && filter_.any()),
          by_key_(options_.order == ListOrder::key) {
        if (by_key_) ranks_ = map.key_order().ranks.data();
    }

    std::vector<MapCheck> run() {
        if (by_key_) check_key_order();
        check_traversal();
        if (options_.rows) check_rows();
        if (options_.wants_pairs()) check_pairs();
        if (options_.overlap) check_overlap();
        if (options_.intersection != IntersectionKind::none) check_intersections();
        return std::move(checks_);
    }

private:
    /// Notes a check that runs over [0, n); `describe` names a bad place.
    template <class IsBad, class Describe>
    bool check(const char* name, Offset n, const IsBad& is_bad, const Describe& describe) {
        const Offset bad = first_bad(n, is_bad);
        checks_.push_back({name, bad == n, bad == n ? "" : describe(bad)});
        return bad == n;
    }
    template <class IsBad>
    bool check_slots(const char* name, const IsBad& is_bad) {
        return check(name, layout_.n_slots(), is_bad, [this](Offset slot) {
            const int list = layout_.list_of_slot(slot);
            return "node list " + std::to_string(list) + ", node " +
                   std::to_string(slot - layout_.list_offset()[list]);
        });
    }

    Slot order(Slot slot) const { return by_key_ ? ranks_[slot] : slot; }
    bool before(Slot a, Slot b) const { return order(a) < order(b); }
    bool in_range(Slot slot) const { return slot >= 0 && slot < layout_.n_slots(); }

    /// Shape of a list of rows by (row, list): offsets, ranges, order, no self.
    bool check_row_list(const std::string& name, const RowsView<>& rows);
    bool is_bad_segment(const RowsView<>& rows, Offset segment) const;
    /// Does a row hold a slot? Rows have passed check_row_list.
    bool holds(const RowsView<>& rows, Slot slot, Slot other) const {
        const auto segment = rows(layout_.row_of_slot(slot), layout_.list_of_slot(other));
        return std::binary_search(segment.begin(), segment.end(), other,
                                  [this](Slot a, Slot b) { return before(a, b); });
    }
    /// f(neighbour) for the entries of a slot's row until one is bad.
    template <class IsBad>
    bool any_entry(const RowsView<>& rows, Offset slot, const IsBad& is_bad) const {
        const Offset row = layout_.row_of_slot(slot);
        if (row < 0) return false;
        const auto all = rows[row];
        return std::any_of(all.begin(), all.end(), is_bad);
    }

    bool is_neighbour(Slot a, Slot b) const {
        return see_(a, b, options_.mode) && (!filters_ || filter_.keeps(a, b));
    }
    bool sees(Slot a, Slot b) const {
        return a == b || (see_(a, b, SearchMode::gather) && (!filters_ || filter_.keeps(a, b)));
    }
    template <class MembersOf>
    void check_sample(const char* name, const RowsView<>& rows, const MembersOf& members_of);

    void check_key_order();
    void check_traversal();
    void check_rows();
    void check_pairs();
    void check_overlap();
    void check_intersections();

    const ConnectivityMap& map_;
    const MapOptions& options_;
    const SlotLayout& layout_;
    Significance<Dim> see_;
    PairFilter filter_;
    bool knows_pairs_, filters_, by_key_;
    const Slot* ranks_ = nullptr;
    std::vector<MapCheck> checks_;
};

template <int Dim>
bool Validator<Dim>::is_bad_segment(const RowsView<>& rows, Offset segment) const {
    const Offset n_lists = layout_.n_lists(), row = segment / n_lists;
    const int list = static_cast<int>(segment % n_lists);
    const Slot self = static_cast<Slot>(layout_.slot_of_row(row));
    const auto entries = rows(row, list);
    if (entries.size() > 0 && layout_.row_of_slot(self) < 0) return true;  // not active
    for (const Slot* at = entries.begin(); at != entries.end(); ++at)
        if (!in_range(*at) || *at == self || layout_.list_of_slot(*at) != list ||
            (at != entries.begin() && !before(at[-1], *at)))
            return true;
    return false;
}

template <int Dim>
bool Validator<Dim>::check_row_list(const std::string& name, const RowsView<>& rows) {
    const Offset n_lists = layout_.n_lists(), n = layout_.n_rows() * n_lists;
    const auto segment_text = [&](Offset segment) {
        return "row " + std::to_string(segment / n_lists) + ", list " +
               std::to_string(segment % n_lists);
    };
    const bool right_size = static_cast<Offset>(rows.offsets.size()) == n + 1 &&
                            rows.offsets(0) == 0 && rows.offsets(n) == rows.size();
    checks_.push_back({name + "_have_a_segment_for_each_list", right_size,
                       right_size ? "" : std::to_string(rows.offsets.size()) + " offsets"});
    return right_size &&
           check((name + "_offsets_ascend").c_str(), n,
                 [&](Offset s) { return rows.offsets(s + 1) < rows.offsets(s); }, segment_text) &&
           check((name + "_ascend_without_self").c_str(), n,
                 [&](Offset s) { return is_bad_segment(rows, s); }, segment_text);
}

/// Nodes spread over all slots, each against all others: members_of(a) is a function that tells
/// who belongs in the row of a.
template <int Dim>
template <class MembersOf>
void Validator<Dim>::check_sample(const char* name, const RowsView<>& rows,
                                  const MembersOf& members_of) {
    constexpr Offset most = 64;
    const Offset n = layout_.n_slots(), n_sampled = std::min(n, most);
    check(
        name, n_sampled,
        [&](Offset k) {
            const auto a = static_cast<Slot>(k * n / n_sampled);
            if (layout_.row_of_slot(a) < 0) return false;
            const auto is_member = members_of(a);
            for (Slot b = 0; b < n; ++b)
                if (a != b && is_member(b) != holds(rows, a, b)) return true;
            return false;
        },
        [&](Offset k) { return "slot " + std::to_string(k * n / n_sampled); });
}

template <int Dim>
void Validator<Dim>::check_key_order() {
    const KeyOrderView<> keys = map_.key_order();
    const Offset n = layout_.n_slots();
    const auto rank_text = [](Offset rank) { return "rank " + std::to_string(rank); };
    check(
        "ranks_and_slots_undo_each_other", n,
        [&](Offset rank) {
            const Slot slot = keys.slots(rank);
            return !in_range(slot) || keys.ranks(slot) != rank;
        },
        rank_text);
    check(
        "keys_ascend", n - 1, [&](Offset rank) { return keys.keys(rank + 1) < keys.keys(rank); },
        rank_text);
}

template <int Dim>
void Validator<Dim>::check_traversal() {
    for (int list = 0; list < layout_.n_lists(); ++list) {
        const NodeTraversal nodes = map_.traversal(list);
        std::vector<Slot> ids(nodes.begin(), nodes.end());
        std::sort(ids.begin(), ids.end());
        Offset bad = 0;
        const Offset n = by_key_ ? layout_.list_offset()[list + 1] - layout_.list_offset()[list]
                                 : map_.n_internal()[list];
        while (bad < std::min(n, nodes.size()) && ids[bad] == bad) ++bad;
        const bool passed = bad == n && nodes.size() == n;
        checks_.push_back(
            {"traversal_visits_each_node_once", passed,
             passed ? "" : "node list " + std::to_string(list) + ", node " + std::to_string(bad)});
    }
}

template <int Dim>
void Validator<Dim>::check_rows() {
    const RowsView<> rows = map_.rows();
    if (!check_row_list("rows", rows)) return;
    check_slots("rows_hold_neighbours_only", [&](Offset a) {
        return any_entry(rows, a, [&](Slot b) { return !is_neighbour(static_cast<Slot>(a), b); });
    });
    if (options_.mode == SearchMode::gather_scatter)
        check_slots("rows_are_symmetric", [&](Offset a) {
            return any_entry(rows, a, [&](Slot b) {
                return layout_.is_stored(b) && !holds(rows, b, static_cast<Slot>(a));
            });
        });
    if (!knows_pairs_) return;
    check_sample("rows_miss_nobody", rows,
                 [&](Slot a) { return [this, a](Slot b) { return is_neighbour(a, b); }; });
}

template <int Dim>
void Validator<Dim>::check_pairs() {
    const auto pairs = map_.pairs().view();
    const ListReader halves{pairs.offsets.data(), pairs.j.data()};
    const Offset n = layout_.n_slots();
    const auto row_text = [](Offset row) { return "half row " + std::to_string(row); };
    if (!check(
            "pairs_ascend_each_once", n,
            [&](Offset row) {
                if (pairs.offsets(row + 1) < pairs.offsets(row)) return true;
                Slot last = pairs.node(row);
                for (const Slot j : halves[row]) {
                    if (!in_range(j) || !before(last, j)) return true;
                    last = j;
                }
                return false;
            },
            row_text))
        return;
    check(
        "pairs_are_neighbours_with_a_stored_row", n,
        [&](Offset row) {
            const Slot i = pairs.node(row);
            return std::any_of(halves[row].begin(), halves[row].end(), [&](Slot j) {
                return !is_neighbour(i, j) || (!layout_.is_stored(i) && !layout_.is_stored(j));
            });
        },
        row_text);
    check(
        "couplings_are_in_0_1", static_cast<Offset>(pairs.coupling.size()),
        [&](Offset k) { return !(pairs.coupling(k) >= 0 && pairs.coupling(k) <= 1); },
        [](Offset k) { return "pair " + std::to_string(k); });
    if (!options_.rows) return;
    const RowsView<> rows = map_.rows();
    check_slots("pairs_are_all_of_the_rows", [&](Offset a) {
        return any_entry(rows, a, [&](Slot b) { return pairs.find(static_cast<Slot>(a), b) < 0; });
    });
}

template <int Dim>
void Validator<Dim>::check_overlap() {
    const RowsView<> overlap = map_.overlap();
    if (!check_row_list("overlap_rows", overlap)) return;
    check_slots("overlap_is_symmetric", [&](Offset a) {
        return any_entry(overlap, a,
                         [&](Slot b) { return !holds(overlap, b, static_cast<Slot>(a)); });
    });
    if (!map_.is_patched() && knows_pairs_)
        check_sample("overlap_misses_nobody_with_a_witness", overlap, [&](Slot a) {
            std::vector<Slot> witnesses;
            for (Slot k = 0; k < layout_.n_slots(); ++k)
                if (sees(a, k)) witnesses.push_back(k);
            return [this, witnesses](Slot b) {
                return std::any_of(witnesses.begin(), witnesses.end(),
                                   [this, b](Slot k) { return sees(b, k); });
            };
        });
    if (options_.rows) {
        const RowsView<> rows = map_.rows();
        check_slots("overlap_holds_all_neighbours", [&](Offset a) {
            return any_entry(rows, a,
                             [&](Slot b) { return !holds(overlap, static_cast<Slot>(a), b); });
        });
    }
}

template <int Dim>
void Validator<Dim>::check_intersections() {
    const IntersectionView<> common = map_.intersection();
    const auto pairs = map_.pairs().view();
    const bool right_size = common.n_pairs() == pairs.size();
    checks_.push_back({"intersections_have_a_row_for_each_pair", right_size,
                       right_size ? "" : std::to_string(common.n_pairs()) + " rows"});
    if (!right_size) return;
    check(
        "intersections_hold_both_ends_and_common_neighbours", pairs.size(),
        [&](Offset k) {
            const auto [i, j] = pairs[k];
            bool has_i = false, has_j = false;
            Slot last = -1;
            for (const Slot slot : common[k]) {
                if (!in_range(slot) || (last >= 0 && !before(last, slot))) return true;
                last = slot;
                has_i = has_i || slot == i, has_j = has_j || slot == j;
                if (slot != i && slot != j && (!is_neighbour(i, slot) || !is_neighbour(j, slot)))
                    return true;
            }
            return !has_i || !has_j;
        },
        [](Offset k) { return "pair " + std::to_string(k); });
}

template <int Dim>
std::vector<MapCheck> validate_in(const ConnectivityMap& map, std::span<const NodeList> lists) {
    PreparedStorage storage;
    const SearchNodes<Dim> nodes =
        prepare_nodes<Dim>(lists, map.options().domain, storage, map.options().skin);
    return Validator<Dim>(map, nodes).run();
}

}  // namespace

std::vector<MapCheck> validate(const ConnectivityMap& map, std::span<const NodeList> lists) {
    if (map.generation() == 0)
        throw Error(Status::not_built, "validate: the map was never rebuilt");
    const SlotLayout& layout = map.layout();
    bool same = static_cast<int>(lists.size()) == layout.n_lists();
    for (std::size_t l = 0; same && l < lists.size(); ++l)
        same = lists[l].dim() == map.dim() &&
               lists[l].n() == layout.list_offset()[l + 1] - layout.list_offset()[l];
    if (!same)
        throw Error(Status::argument,
                    "validate: lists differ from the map's in number, dimension or size");
    std::vector<MapCheck> checks;
    run_kernels("validate", [&] {
        checks = map.dim() == 1   ? validate_in<1>(map, lists)
                 : map.dim() == 2 ? validate_in<2>(map, lists)
                                  : validate_in<3>(map, lists);
    });
    return checks;
}

bool all_passed(const std::vector<MapCheck>& checks, std::string* text) {
    bool passed = true;
    for (const MapCheck& check : checks) {
        if (check.passed) continue;
        passed = false;
        if (text != nullptr) *text += check.name + ": not at " + check.first + "\n";
    }
    return passed;
}

}  // namespace connectivity
