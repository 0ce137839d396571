// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// How slots are numbered, and which of them have a stored row.
///
/// Invariants: slots of list k are [list_offset[k], list_offset[k+1]), internal nodes first; rows
/// of list k are [row_offset[k], row_offset[k+1]) and belong to its first n_stored nodes. Row
/// numbers have no gaps: where only some nodes are active, the others keep their rows, which stay
/// empty.

#include <algorithm>
#include <vector>

#include <connectivity/base/spaces.hpp>

namespace connectivity {

struct ListSize {
    Offset n = 0, n_internal = 0;
};

class SlotLayout {
public:
    SlotLayout() : list_offset_{0}, row_offset_{0} {}
    /// active: [n_slots], 0 or 1, host; empty: all are.
    SlotLayout(const std::vector<ListSize>& lists, bool ghost_rows,
               ConstView<std::uint8_t> active = {});

    int n_lists() const { return static_cast<int>(list_offset_.size()) - 1; }
    Offset n_slots() const { return list_offset_.back(); }
    Offset n_rows() const { return row_offset_.back(); }
    const std::vector<Offset>& list_offset() const { return list_offset_; }  ///< [n_lists + 1]
    const std::vector<Offset>& row_offset() const { return row_offset_; }    ///< [n_lists + 1]

    int list_of_slot(Offset slot) const { return find(list_offset_, slot); }
    int list_of_row(Offset row) const { return find(row_offset_, row); }
    Offset slot_of_row(Offset row) const {
        const int list = list_of_row(row);
        return list_offset_[list] + (row - row_offset_[list]);
    }
    /// Row of a slot, -1 if nothing is to be stored in it: a ghost without a row, or not active.
    Offset row_of_slot(Offset slot) const {
        if (active_.data() != nullptr && active_(slot) == 0) return -1;
        const int list = list_of_slot(slot);
        const Offset row = row_offset_[list] + (slot - list_offset_[list]);
        return row < row_offset_[list + 1] ? row : -1;
    }
    bool is_stored(Offset slot) const { return row_of_slot(slot) >= 0; }
    ConstView<std::uint8_t> active() const { return active_; }  ///< [n_slots]; empty: all

    friend bool operator==(const SlotLayout&, const SlotLayout&) = default;

private:
    /// The list k with offsets[k] <= at < offsets[k+1]; empty lists are skipped. Of few lists each
    /// is looked at: slots come in any order, and a branch would guess wrong every other time.
    static int find(const std::vector<Offset>& offsets, Offset at) {
        constexpr std::size_t few = 8;
        if (offsets.size() <= few + 1) {
            int k = 0;
            for (std::size_t l = 1; l + 1 < offsets.size(); ++l) k += offsets[l] <= at ? 1 : 0;
            return k;
        }
        return static_cast<int>(std::upper_bound(offsets.begin(), offsets.end(), at) -
                                offsets.begin()) -
               1;
    }

    std::vector<Offset> list_offset_, row_offset_;
    ConstView<std::uint8_t> active_;
};

}  // namespace connectivity
