// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A case as builders of lists read it: rows by label, for slots in order or in any other order.

#include <algorithm>
#include <numeric>

#include <support/brute_overlap.hpp>
#include <support/random.hpp>
#include <support/random_case.hpp>

#include "map/label_rows.hpp"
#include "map/labels.hpp"

namespace connectivity::test {

namespace detail {

inline std::vector<Slot> permutation(Slot n, bool shuffled, Random& random) {
    std::vector<Slot> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    for (Slot k = n - 1; shuffled && k > 0; --k)
        std::swap(order[static_cast<std::size_t>(k)],
                  order[static_cast<std::size_t>(random.below(k + 1))]);
    return order;
}

inline SlotLayout layout_of(const Case& c) {
    std::vector<ListSize> sizes;
    for (std::size_t l = 0; l < c.lists.size(); ++l) sizes.push_back({c.n(l), c.n(l)});
    return SlotLayout(sizes, true);
}

}  // namespace detail

/// Rows that own their arrays.
struct OwnedRows {
    std::vector<Offset> offsets{0};
    std::vector<Slot> values;
    LabelRows view() const { return {offsets.data(), values.data()}; }
};

/// Which numbers nodes have.
enum class Numbering { by_slot, at_random };

class LabelCase {
public:
    LabelCase(Case source, Numbering numbering, Random& random);

    const Case& source() const { return c_; }
    const Sight& sight() const { return sight_; }
    const SlotLayout& layout() const { return layout_; }
    Labels labels() const;
    Slot label(Slot slot) const { return label_of_[static_cast<std::size_t>(slot)]; }

    OwnedRows neighbours() const;  ///< gather or scatter
    OwnedRows gather() const;
    OwnedRows scatter() const;
    OwnedRows half_rows() const;  ///< of neighbours those with a larger label

    std::vector<double> positions() const;  ///< by label

    /// Any order of the labels.
    std::vector<Slot> random_order(Random& random) const;

    /// Sorts slots by label.
    std::vector<Slot> by_label(std::vector<Slot> slots) const;

private:
    template <class Related>
    OwnedRows rows(const Related& related) const;

    Case c_;
    Sight sight_;
    SlotLayout layout_;
    Numbering numbering_;
    std::vector<Slot> slot_of_, label_of_;
};

inline LabelCase::LabelCase(Case source, Numbering numbering, Random& random)
    : c_(std::move(source)),
      sight_(c_),
      layout_(detail::layout_of(c_)),
      numbering_(numbering),
      slot_of_(detail::permutation(sight_.n(), numbering == Numbering::at_random, random)),
      label_of_(slot_of_.size()) {
    for (std::size_t k = 0; k < slot_of_.size(); ++k)
        label_of_[static_cast<std::size_t>(slot_of_[k])] = static_cast<Slot>(k);
}

inline Labels LabelCase::labels() const {
    if (numbering_ == Numbering::by_slot) return {layout_};
    return {layout_, slot_of_.data(), label_of_.data()};
}

template <class Related>
OwnedRows LabelCase::rows(const Related& related) const {
    OwnedRows rows;
    for (Slot a = 0; a < sight_.n(); ++a) {
        for (Slot b = 0; b < sight_.n(); ++b)
            if (a != b && related(a, b)) rows.values.push_back(b);
        rows.offsets.push_back(static_cast<Offset>(rows.values.size()));
    }
    return rows;
}

inline OwnedRows LabelCase::neighbours() const {
    return rows([&](Slot a, Slot b) {
        return sight_.neighbours(slot_of_[static_cast<std::size_t>(a)],
                                 slot_of_[static_cast<std::size_t>(b)]);
    });
}

inline OwnedRows LabelCase::gather() const {
    return rows([&](Slot a, Slot b) {
        return sight_.sees(slot_of_[static_cast<std::size_t>(a)],
                           slot_of_[static_cast<std::size_t>(b)]);
    });
}

inline OwnedRows LabelCase::scatter() const {
    return rows([&](Slot a, Slot b) {
        return sight_.sees(slot_of_[static_cast<std::size_t>(b)],
                           slot_of_[static_cast<std::size_t>(a)]);
    });
}

inline OwnedRows LabelCase::half_rows() const {
    return rows([&](Slot a, Slot b) {
        return a < b && sight_.neighbours(slot_of_[static_cast<std::size_t>(a)],
                                          slot_of_[static_cast<std::size_t>(b)]);
    });
}

inline std::vector<double> LabelCase::positions() const {
    std::vector<double> by_slot, x;
    for (const ListData& list : c_.lists)
        by_slot.insert(by_slot.end(), list.x.begin(), list.x.end());
    for (const Slot slot : slot_of_)
        for (int d = 0; d < c_.dim; ++d)
            x.push_back(by_slot[static_cast<std::size_t>(slot * c_.dim + d)]);
    return x;
}

inline std::vector<Slot> LabelCase::random_order(Random& random) const {
    return detail::permutation(sight_.n(), true, random);
}

inline std::vector<Slot> LabelCase::by_label(std::vector<Slot> slots) const {
    std::sort(slots.begin(), slots.end(), [&](Slot a, Slot b) { return label(a) < label(b); });
    return slots;
}

/// A random case for lists that need the rows of all nodes.
inline Case all_rows_case(std::uint64_t seed, int dim, bool periodic, int max_nodes) {
    Case c = random_case(seed, {dim, periodic, max_nodes, 0});
    c.mode = SearchMode::gather_scatter;
    c.ghost_rows = true;
    return c;
}

}  // namespace connectivity::test
