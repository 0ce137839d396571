// SPDX-License-Identifier: BSD-3-Clause
#include <support/label_case.hpp>

#include <algorithm>
#include <numeric>

#include <support/random.hpp>
#include <support/random_case.hpp>

namespace connectivity::test {
namespace {

std::vector<Slot> permutation(Slot n, bool shuffled, Random& random) {
    std::vector<Slot> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    for (Slot k = n - 1; shuffled && k > 0; --k)
        std::swap(order[static_cast<std::size_t>(k)],
                  order[static_cast<std::size_t>(random.below(k + 1))]);
    return order;
}

SlotLayout layout_of(const Case& c) {
    std::vector<ListSize> sizes;
    for (std::size_t l = 0; l < c.lists.size(); ++l) sizes.push_back({c.n(l), c.n(l)});
    return SlotLayout(sizes, true);
}

}  // namespace

LabelCase::LabelCase(Case source, Numbering numbering, Random& random)
    : c_(std::move(source)),
      sight_(c_),
      layout_(layout_of(c_)),
      numbering_(numbering),
      slot_of_(permutation(sight_.n(), numbering == Numbering::at_random, random)),
      label_of_(slot_of_.size()) {
    for (std::size_t k = 0; k < slot_of_.size(); ++k)
        label_of_[static_cast<std::size_t>(slot_of_[k])] = static_cast<Slot>(k);
}

Labels LabelCase::labels() const {
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

OwnedRows LabelCase::neighbours() const {
    return rows([&](Slot a, Slot b) {
        return sight_.neighbours(slot_of_[static_cast<std::size_t>(a)],
                                 slot_of_[static_cast<std::size_t>(b)]);
    });
}

OwnedRows LabelCase::gather() const {
    return rows([&](Slot a, Slot b) {
        return sight_.sees(slot_of_[static_cast<std::size_t>(a)],
                           slot_of_[static_cast<std::size_t>(b)]);
    });
}

OwnedRows LabelCase::scatter() const {
    return rows([&](Slot a, Slot b) {
        return sight_.sees(slot_of_[static_cast<std::size_t>(b)],
                           slot_of_[static_cast<std::size_t>(a)]);
    });
}

OwnedRows LabelCase::half_rows() const {
    return rows([&](Slot a, Slot b) {
        return a < b && sight_.neighbours(slot_of_[static_cast<std::size_t>(a)],
                                          slot_of_[static_cast<std::size_t>(b)]);
    });
}

std::vector<double> LabelCase::positions() const {
    std::vector<double> by_slot, x;
    for (const ListData& list : c_.lists)
        by_slot.insert(by_slot.end(), list.x.begin(), list.x.end());
    for (const Slot slot : slot_of_)
        for (int d = 0; d < c_.dim; ++d)
            x.push_back(by_slot[static_cast<std::size_t>(slot * c_.dim + d)]);
    return x;
}

std::vector<Slot> LabelCase::random_order(Random& random) const {
    return permutation(sight_.n(), true, random);
}

std::vector<Slot> LabelCase::by_label(std::vector<Slot> slots) const {
    std::sort(slots.begin(), slots.end(), [&](Slot a, Slot b) { return label(a) < label(b); });
    return slots;
}

Case all_rows_case(std::uint64_t seed, int dim, bool periodic, int max_nodes) {
    Case c = random_case(seed, {dim, periodic, max_nodes, 0});
    c.mode = SearchMode::gather_scatter;
    c.ghost_rows = true;
    return c;
}

}  // namespace connectivity::test
