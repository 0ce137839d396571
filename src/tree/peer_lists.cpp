// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/tree/peer_lists.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace connectivity {

namespace {

/// Where a box lies as seen from a peer, by axis: outside and touching the lower face (-1), within
/// its interval (0), outside and touching the upper face (1).
using Side = std::array<std::int8_t, 3>;

struct Peer {
    BoxId box;
    Side side;
};

class PeerFinder {
public:
    explicit PeerFinder(const TreeView& tree)
        : tree_(tree), number_(tree.n_boxes), rows_(tree.n_boxes) {
        for (BoxId b = 0; b < tree.n_boxes; ++b)
            for (int k = 0; k < 1 << tree.dim; ++k)
                if (const BoxId child = tree.child(k, b); child > 0)
                    number_[child] = static_cast<std::uint8_t>(k);
    }

    Csr run() {
        rows_[0] = {{0, {}}};
        for (int level = 1; level < tree_.n_levels; ++level) {
            const BoxId first = tree_.level_start_box_nrs(level),
                        last = tree_.level_start_box_nrs(level + 1);
            for (BoxId b = first; b < last; ++b) find(b);
        }
        Csr out("tree/peers");
        out.prepare(tree_.n_boxes, [this](Offset b) { return rows_[b].size(); });
        out.reserve();
        out.commit([this](Offset first, Offset last, const Offset* offsets, Slot* values) {
            for (Offset b = first; b < last; ++b)
                std::transform(rows_[b].begin(), rows_[b].end(), values + offsets[b],
                               [](const Peer& peer) { return peer.box; });
        });
        return out;
    }

private:
    int bit(BoxId box, int axis) const { return number_[box] >> (tree_.dim - 1 - axis) & 1; }

    /// Peers of a box are peers of its parent, or children of those as large as the parent: smaller
    /// boxes around the parent there are none.
    void find(BoxId box) {
        const BoxId parent = tree_.box_parent_ids(box);
        for (const Peer& peer : rows_[parent]) {
            const bool replaced =
                tree_.box_levels(peer.box) == tree_.box_levels(parent) && add_children(box, peer);
            if (!replaced && keeps_touching(box, peer.side)) rows_[box].push_back(peer);
        }
    }

    bool keeps_touching(BoxId box, const Side& side) const {
        for (int d = 0; d < tree_.dim; ++d)
            if ((side[d] < 0 && bit(box, d) == 0) || (side[d] > 0 && bit(box, d) == 1))
                return false;
        return true;
    }

    bool add_children(BoxId box, const Peer& peer) {
        bool any = false;
        for (int k = 0; k < 1 << tree_.dim; ++k) {
            const BoxId child = tree_.child(k, peer.box);
            if (child == 0) continue;
            Peer next{child, {}};
            bool touches = true;
            for (int d = 0; d < tree_.dim; ++d) {
                const int step = 2 * peer.side[d] + bit(box, d) - bit(child, d);
                touches = touches && step >= -1 && step <= 1;
                next.side[d] = static_cast<std::int8_t>(step);
            }
            if (!touches) continue;
            rows_[box].push_back(next);
            any = true;
        }
        return any;
    }

    const TreeView& tree_;
    std::vector<std::uint8_t> number_;  // which child of its parent a box is
    std::vector<std::vector<Peer>> rows_;
};

}  // namespace

Csr peer_lists(const TreeView& tree) { return PeerFinder(tree).run(); }

}  // namespace connectivity
