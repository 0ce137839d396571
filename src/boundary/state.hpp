// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What an update makes: nodes with ghosts, who is whose ghost, and the way each block came.

#include <connectivity/boundary/boundaries.hpp>

#include <algorithm>

#include "ghost_nodes.hpp"

namespace connectivity {

struct Boundaries::State {
    struct Way {
        int boundary;
        RigidMap map;
    };
    std::vector<detail::GhostNodes> nodes;  ///< of each list
    GhostLists ghosts;
    std::vector<Way> ways;
    std::vector<NodeList> lists;

    /// Internal nodes only.
    void take(std::span<const NodeList> from) {
        lists.clear();  // lets go of the storage, so that it can be used again
        ways.clear();
        nodes.resize(from.size());
        std::vector<Offset> n_internal;
        for (std::size_t k = 0; k < from.size(); ++k) {
            nodes[k].take(from[k]);
            n_internal.push_back(nodes[k].n);
        }
        ghosts.reset(n_internal);
    }

    /// Images of the controls of the newest way, in all lists.
    void append_images() {
        const int way = ghosts.n_ways() - 1;
        for (std::size_t k = 0; k < nodes.size(); ++k)
            nodes[k].append(ghosts.block(way, static_cast<int>(k)), ways.back().map);
    }

    void make_lists() {
        lists.clear();
        for (const auto& list : nodes) lists.push_back(list.list(list.n));
    }

    /// What `lists` will be once ghosts with keep = 0 are gone.
    std::vector<NodeList> lists_after(const Slot* keep) const {
        std::vector<NodeList> after;
        for (const auto& list : nodes) {
            after.push_back(list.list(std::count(keep, keep + list.n, 1)));
            keep += list.n;
        }
        return after;
    }

    /// Drops ghosts with keep = 0. Cannot fail.
    void drop(const View<Slot>& keep, const View<Slot>& old2new, std::vector<NodeList>& after) {
        Offset first = 0;
        for (auto& list : nodes) {
            const Offset n = list.n;
            list.drop(keep.data() + first, old2new.data() + first);
            first += n;
        }
        ghosts.drop(keep, old2new);
        lists.swap(after);
    }

    double kernel_extent() const {
        double largest = 0;
        for (const auto& list : nodes) largest = std::max(largest, list.kernel_extent);
        return largest;
    }

    Offset bytes() const {
        Offset sum = ghosts.bytes();
        for (const auto& list : nodes) sum += list.bytes();
        return sum;
    }
};

}  // namespace connectivity
