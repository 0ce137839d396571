// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/boundary/ghost_lists.hpp>

#include <algorithm>
#include <numeric>

namespace connectivity {

void GhostLists::reset(const std::vector<Offset>& n_internal) {
    n_ = n_internal_ = n_internal;
    was_control_.resize(n_.size());
    n_ways_ = 0;
}

void GhostLists::begin_way(bool may_cull) {
    if (ways_.size() == static_cast<std::size_t>(n_ways_)) ways_.emplace_back();
    Way& way = ways_[static_cast<std::size_t>(n_ways_++)];
    way.may_cull = may_cull;
    way.blocks.resize(n_.size());
    for (std::size_t list = 0; list < n_.size(); ++list)
        way.blocks[list].first = n_[list], way.blocks[list].n = 0;
}

Slot* GhostLists::append(int list, Offset n) {
    GhostBlock& block = block_of(n_ways_ - 1, list);
    ensure_capacity(block.storage, "boundary/controls", n);
    block.n = n;
    n_[static_cast<std::size_t>(list)] += n;
    return block.storage.data();
}

void GhostLists::finish() {
    for (int list = 0; list < n_lists(); ++list) {
        auto& flags = was_control_[static_cast<std::size_t>(list)];
        const Offset internal = n_internal(list), n_ghosts = n(list) - internal;
        ensure_capacity(flags, "boundary/was_control", n_ghosts);
        std::fill_n(flags.data(), n_ghosts, std::uint8_t{0});
        for (int way = 0; way < n_ways_; ++way) {
            const GhostBlock& ghosts = block(way, list);
            for (Offset k = 0; k < ghosts.n; ++k)
                if (ghosts.storage(k) >= internal) flags(ghosts.storage(k) - internal) = 1;
        }
    }
}

Offset GhostLists::n_ghosts() const {
    Offset sum = 0;
    for (int list = 0; list < n_lists(); ++list) sum += n(list) - n_internal(list);
    return sum;
}

SlotLayout GhostLists::layout() const {
    std::vector<ListSize> sizes;
    for (int list = 0; list < n_lists(); ++list) sizes.push_back({n(list), n_internal(list)});
    return SlotLayout(sizes, false);
}

Offset GhostLists::bytes() const {
    std::size_t sum = 0;
    for (const Way& way : ways_)
        for (const GhostBlock& block : way.blocks) sum += block.storage.size() * sizeof(Slot);
    for (const auto& flags : was_control_) sum += flags.size();
    return static_cast<Offset>(sum);
}

void GhostLists::keep_needed(const View<Slot>& keep, CullRule rule) const {
    Slot* flags = keep.data();
    for (int list = 0; list < n_lists(); flags += n(list++)) {
        const Offset internal = n_internal(list);
        std::fill_n(flags, internal, 1);
        const auto& was_control = was_control_[static_cast<std::size_t>(list)];
        if (rule == CullRule::controls_as_made)
            for (Offset g = internal; g < n(list); ++g)
                if (was_control(g - internal) != 0) flags[g] = 1;
        // Controls come before their ghosts: backwards, one pass reaches all of a chain.
        for (int way = n_ways_ - 1; way >= 0; --way) {
            const GhostBlock& ghosts = block(way, list);
            const bool may_cull = ways_[static_cast<std::size_t>(way)].may_cull;
            for (Offset k = 0; k < ghosts.n; ++k) {
                if (!may_cull) flags[ghosts.first + k] = 1;
                if (flags[ghosts.first + k] != 0) flags[ghosts.storage(k)] = 1;
            }
        }
    }
}

Offset GhostLists::renumber(const ConstView<Slot>& keep, const View<Slot>& old2new) const {
    const Slot* flags = keep.data();
    Slot* to = old2new.data();
    Offset removed = 0;
    for (int list = 0; list < n_lists(); flags += n(list), to += n(list), ++list) {
        std::iota(to, to + n(list), 0);
        auto next = static_cast<Slot>(n_internal(list));
        for (Offset g = n_internal(list); g < n(list); ++g)
            if (flags[g] != 0) to[g] = next++;
        removed += n(list) - next;
    }
    return removed;
}

void GhostLists::drop(const ConstView<Slot>& keep, const ConstView<Slot>& old2new) {
    const Slot* flags = keep.data();
    const Slot* to = old2new.data();
    for (int list = 0; list < n_lists(); ++list) {
        const Offset internal = n_internal(list), n_before = n(list);
        auto& was_control = was_control_[static_cast<std::size_t>(list)];
        Offset first = internal;
        for (int way = 0; way < n_ways_; ++way) {
            GhostBlock& ghosts = block_of(way, list);
            Offset kept = 0;
            for (Offset k = 0; k < ghosts.n; ++k) {
                const Offset g = ghosts.first + k;
                if (flags[g] == 0) continue;
                was_control(to[g] - internal) = was_control(g - internal);
                ghosts.storage(kept++) = to[ghosts.storage(k)];
            }
            ghosts.first = first;
            ghosts.n = kept;
            first += kept;
        }
        n_[static_cast<std::size_t>(list)] = first;
        flags += n_before, to += n_before;
    }
}

}  // namespace connectivity
