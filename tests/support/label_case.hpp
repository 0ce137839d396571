// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A case as builders of lists read it: rows by label, for slots in order or in any other order.

#include <support/brute_overlap.hpp>

#include "map/label_rows.hpp"
#include "map/labels.hpp"

namespace connectivity::test {

class Random;

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

/// A random case for lists that need the rows of all nodes.
Case all_rows_case(std::uint64_t seed, int dim, bool periodic, int max_nodes);

}  // namespace connectivity::test
