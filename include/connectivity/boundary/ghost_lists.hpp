// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Who is whose ghost: for every way across a boundary and every node list, the nodes that have an
/// image there (controls) and where the images stand. And which ghosts nobody needs.
///
/// Invariants: ghosts of one way are consecutive at the end of their list at that time; ghost
/// first + k is the image of controls()(k), which comes before it. Culling keeps the order, and
/// internal nodes never move. Cost: 4 bytes and one flag a ghost; storage is kept.

#include <cstdint>
#include <vector>

#include <connectivity/base/spaces.hpp>
#include <connectivity/search/layout.hpp>

namespace connectivity {

/// Which ghosts that no internal row names stay nevertheless. Either way a second cull of the same
/// map drops nothing.
enum class CullRule {
    /// Ghosts that were controls when the ghosts were made, also of ghosts that go now.
    controls_as_made,
    /// Ghosts whose own ghosts stay: the fewest. Boundaries that may not be culled keep all theirs.
    controls_of_kept
};

struct GhostBlock {
    Offset first = 0;  ///< node id of the first ghost
    Offset n = 0;
    View<Slot> storage;  ///< n controls, then spare room

    ConstView<Slot> controls() const {  ///< [n], host
        return Kokkos::subview(storage, std::pair<std::size_t, std::size_t>(0, n));
    }
};

class GhostLists {
public:
    /// No ghosts, no ways; storage stays.
    void reset(const std::vector<Offset>& n_internal);

    /// Makes room for the ghosts of a new way. may_cull: whether nobody's ghosts may go.
    void begin_way(bool may_cull);

    /// Appends n ghosts of the newest way to a list, once for each list; the caller fills what is
    /// returned with n node ids that come before them. Throws Error{memory}.
    Slot* append(int list, Offset n);

    /// After the last way: remembers who is a control. Throws Error{memory}.
    void finish();

    int n_lists() const { return static_cast<int>(n_.size()); }
    int n_ways() const { return n_ways_; }
    Offset n(int list) const { return n_[static_cast<std::size_t>(list)]; }
    Offset n_internal(int list) const { return n_internal_[static_cast<std::size_t>(list)]; }
    const GhostBlock& block(int way, int list) const {
        return ways_[static_cast<std::size_t>(way)].blocks[static_cast<std::size_t>(list)];
    }
    Offset n_ghosts() const;
    SlotLayout layout() const;
    Offset bytes() const;

    /// keep [n_slots]: 1 for every ghost that internal rows name, 0 for the others. Adds internal
    /// nodes, controls by the rule, and ghosts that may not be culled.
    void keep_needed(const View<Slot>& keep, CullRule rule) const;

    /// old2new [n_slots]: new node ids within the list for nodes with keep = 1; the others keep
    /// their id, which means nothing. Returns how many go.
    Offset renumber(const ConstView<Slot>& keep, const View<Slot>& old2new) const;

    /// Drops ghosts with keep = 0 and renames the rest, controls and blocks too. Cannot fail.
    void drop(const ConstView<Slot>& keep, const ConstView<Slot>& old2new);

private:
    struct Way {
        bool may_cull = true;
        std::vector<GhostBlock> blocks;
    };
    GhostBlock& block_of(int way, int list) {
        return ways_[static_cast<std::size_t>(way)].blocks[static_cast<std::size_t>(list)];
    }

    std::vector<Offset> n_, n_internal_;
    std::vector<Way> ways_;
    int n_ways_ = 0;
    std::vector<View<std::uint8_t>> was_control_;  // of each list's ghosts
};

}  // namespace connectivity
