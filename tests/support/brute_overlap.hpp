// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Overlap and intersection straight from their definitions, for any numbering of the nodes.

#include <cstdint>
#include <vector>

#include <support/case.hpp>

namespace connectivity::test {

using SlotRows = std::vector<std::vector<Slot>>;

/// Who sees whom in a case, all nodes with all nodes, by slot.
class Sight {
public:
    explicit Sight(const Case& c);

    Slot n() const { return n_; }
    bool sees(Slot i, Slot j) const { return sees_[at(i, j)] != 0; }
    bool neighbours(Slot i, Slot j) const { return i != j && (sees(i, j) || sees(j, i)); }

    /// For every slot the others with whom it shares a node that both see; a node counts as seen by
    /// itself. Ascending slots.
    SlotRows overlap() const;

    /// All common neighbours of i and j, i and j themselves included, once each; ascending slots.
    std::vector<Slot> intersection(Slot i, Slot j) const;

private:
    std::size_t at(Slot i, Slot j) const {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(n_) +
               static_cast<std::size_t>(j);
    }
    Slot n_;
    std::vector<std::uint8_t> sees_;  // [n * n]
};

/// Does the perpendicular foot of node k on the line from i to j lie in the closed segment?
bool is_in_segment(const Case& c, Slot i, Slot j, Slot k);

}  // namespace connectivity::test
