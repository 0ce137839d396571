// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Codes of the translations in list 2, see classes.hpp.
///
/// Invariant: a number of each box modulo 2^32, idx_x + idx_y B + idx_z B^2 with the cell index
/// modulo 2^32 and B = 4n + 3, is made from the parent's; the code of a pair is the difference of
/// theirs, plus a constant. Cost: 4 bytes a box, 4 bytes for each code and level.

#include <array>
#include <vector>

#include <connectivity/lists/traversal.hpp>

namespace connectivity::detail {

class TranslationCodes {
public:
    /// Throws Error: not_built, argument, budget, memory.
    TranslationCodes(const FMMTraversalInfo& traversal, bool per_level);

    Offset n_codes() const { return n_codes_; }
    /// Levels that are told apart, 1 if none are.
    int n_levels() const { return n_levels_; }
    /// v = idx(T) - idx(S).
    std::array<int, 3> vector_of(Offset code) const;

    /// Whether the code occurs on the level.
    bool is_used(int level, Offset code) const { return table_(level * n_codes_ + code) != 0; }
    void set_class(int level, Offset code, std::int32_t number) {
        table_(level * n_codes_ + code) = number;
    }
    /// Classes of all entries: every used code must have one. The codes are gone after it.
    View<std::int32_t> take_classes();

private:
    void number_boxes(const TreeView& tree);
    void make_codes(const FMMTraversalInfo& traversal);

    Offset n_codes_ = 0;
    int dim_, reach_, n_levels_;  // reach: 2n + 1
    std::array<std::uint32_t, 3> powers_{};
    View<std::uint32_t> numbers_;
    View<std::int32_t> table_;  // [level][code]: occurs, later its class
    View<std::int32_t> codes_;  // of the entries
    ConstView<BoxId> targets_;
    ConstView<Offset> starts_;
    ConstView<std::uint8_t> box_levels_;
};

}  // namespace connectivity::detail
