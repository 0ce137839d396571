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

/// Goes down with, for each box, the boxes not smaller than it that touch it. Of those larger than
/// it only such are kept as can still be peers or tell that their parent is none: a box with all
/// its children has one that touches whatever it touches itself.
class PeerFinder {
public:
    explicit PeerFinder(const TreeView& tree)
        : tree_(tree),
          number_(tree.n_boxes),
          full_(tree.n_boxes),
          near_(tree.n_boxes),
          peers_(tree.n_boxes) {
        for (BoxId b = 0; b < tree.n_boxes; ++b) {
            int n_children = 0;
            for (int k = 0; k < 1 << tree.dim; ++k) {
                const BoxId child = tree.child(k, b);
                if (child == 0) continue;
                number_[child] = static_cast<std::uint8_t>(k);
                ++n_children;
            }
            full_[b] = n_children == 1 << tree.dim;
        }
    }

    Csr run() {
        near_[0] = {{0, {}}};
        peers_[0] = {0};
        for (int level = 1; level < tree_.n_levels; ++level) {
            const BoxId above = tree_.level_start_box_nrs(level - 1),
                        first = tree_.level_start_box_nrs(level),
                        last = tree_.level_start_box_nrs(level + 1);
            for (BoxId b = first; b < last; ++b) find(b);
            for (BoxId b = above; b < first; ++b) std::vector<Peer>().swap(near_[b]);
        }
        Csr out("tree/peers");
        out.prepare(tree_.n_boxes, [this](Offset b) { return peers_[b].size(); });
        out.reserve();
        out.commit([this](Offset first, Offset last, const Offset* offsets, Slot* values) {
            for (Offset b = first; b < last; ++b)
                std::copy(peers_[b].begin(), peers_[b].end(), values + offsets[b]);
        });
        return out;
    }

private:
    int bit(BoxId box, int axis) const { return number_[box] >> (tree_.dim - 1 - axis) & 1; }

    /// Depth-first order is kept: a box's children follow it.
    void find(BoxId box) {
        const BoxId parent = tree_.box_parent_ids(box);
        for (const Peer& peer : near_[parent]) {
            const bool kept = !full_[peer.box] || !full_[tree_.box_parent_ids(peer.box)];
            if (kept && keeps_touching(box, peer.side)) near_[box].push_back(peer);
            if (tree_.box_levels(peer.box) == tree_.box_levels(parent)) add_children(box, peer);
        }
        const auto& near = near_[box];
        for (const Peer& peer : near) {
            const bool has_child = std::any_of(near.begin(), near.end(), [&](const Peer& other) {
                return other.box != 0 && tree_.box_parent_ids(other.box) == peer.box;
            });
            const bool same_size = tree_.box_levels(peer.box) == tree_.box_levels(box);
            if (same_size || (!full_[peer.box] && !has_child)) peers_[box].push_back(peer.box);
        }
    }

    bool keeps_touching(BoxId box, const Side& side) const {
        for (int d = 0; d < tree_.dim; ++d)
            if ((side[d] < 0 && bit(box, d) == 0) || (side[d] > 0 && bit(box, d) == 1))
                return false;
        return true;
    }

    void add_children(BoxId box, const Peer& peer) {
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
            if (touches) near_[box].push_back(next);
        }
    }

    const TreeView& tree_;
    std::vector<std::uint8_t> number_;  // which child of its parent a box is
    std::vector<std::uint8_t> full_;    // all its children are there
    std::vector<std::vector<Peer>> near_;
    std::vector<std::vector<BoxId>> peers_;
};

}  // namespace

Csr peer_lists(const TreeView& tree) { return PeerFinder(tree).run(); }

}  // namespace connectivity
