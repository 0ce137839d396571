// SPDX-License-Identifier: BSD-3-Clause
#include <support/brute_overlap.hpp>

#include <cmath>

#include <support/brute_force.hpp>

namespace connectivity::test {

Sight::Sight(const Case& c)
    : n_(static_cast<Slot>(c.n_slots())),
      sees_(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_), 0) {
    Case gather = c;
    gather.mode = SearchMode::gather;
    gather.ghost_rows = true;
    const Expected rows = brute_force(gather);
    const std::size_t n_lists = c.lists.size();
    for (Slot i = 0; i < n_; ++i) {
        const std::size_t row = static_cast<std::size_t>(i) * n_lists;
        for (Offset k = rows.row_offsets[row]; k < rows.row_offsets[row + n_lists]; ++k)
            sees_[at(i, rows.row_slots[static_cast<std::size_t>(k)])] = 1;
    }
}

SlotRows Sight::overlap() const {
    SlotRows rows(static_cast<std::size_t>(n_));
    for (Slot a = 0; a < n_; ++a) {
        std::vector<bool> shares(static_cast<std::size_t>(n_), false);
        for (Slot k = 0; k < n_; ++k) {
            if (k != a && !sees(a, k)) continue;
            for (Slot b = 0; b < n_; ++b)
                if (b == k || sees(b, k)) shares[static_cast<std::size_t>(b)] = true;
        }
        for (Slot b = 0; b < n_; ++b)
            if (b != a && shares[static_cast<std::size_t>(b)])
                rows[static_cast<std::size_t>(a)].push_back(b);
    }
    return rows;
}

std::vector<Slot> Sight::intersection(Slot i, Slot j) const {
    std::vector<Slot> row;
    for (Slot k = 0; k < n_; ++k)
        if (k == i || k == j || (neighbours(k, i) && neighbours(k, j))) row.push_back(k);
    return row;
}

namespace {

const double* position(const Case& c, Slot slot) {
    Offset node = slot;
    for (std::size_t l = 0;; ++l) {
        if (node < c.n(l)) return c.lists[l].x.data() + node * c.dim;
        node -= c.n(l);
    }
}

}  // namespace

bool is_in_segment(const Case& c, Slot i, Slot j, Slot k) {
    double to_k_along_j = 0, length2 = 0;
    for (int d = 0; d < c.dim; ++d) {
        const auto difference = [&](Slot to) {
            const double r = position(c, to)[d] - position(c, i)[d], L = c.domain.length(d);
            return L > 0 ? r - L * std::rint(r / L) : r;
        };
        const double along = difference(k) * difference(j), square = difference(j) * difference(j);
        to_k_along_j = d == 0 ? along : to_k_along_j + along;
        length2 = d == 0 ? square : length2 + square;
    }
    return 0 <= to_k_along_j && to_k_along_j <= length2;
}

}  // namespace connectivity::test
