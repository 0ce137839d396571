// SPDX-License-Identifier: BSD-3-Clause
#include <support/key_order.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace connectivity::test {

namespace {

struct Node {
    std::vector<double> x;
    std::uint64_t key;
    std::size_t list;
    std::int64_t id;
    Slot slot;

    auto rank_by() const { return std::tie(key, x, list, id, slot); }
};

std::uint64_t key_of(const std::vector<double>& x, const std::vector<double>& lo,
                     const std::vector<double>& hi) {
    const auto dim = static_cast<int>(x.size());
    const int bits = dim == 1 ? 63 : dim == 2 ? 31 : 21;
    std::uint64_t key = 0;
    for (int d = 0; d < dim; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        const double width = hi[axis] - lo[axis];
        std::uint64_t cell = 0;
        if (width > 0) {
            const double at = std::floor(std::ldexp((x[axis] - lo[axis]) / width, bits));
            const double last = std::ldexp(1.0, bits) - 1;
            cell = at >= last ? (std::uint64_t{1} << bits) - 1 : static_cast<std::uint64_t>(at);
        }
        for (int bit = 0; bit < bits; ++bit) key |= (cell >> bit & 1) << (bit * dim + d);
    }
    return key;
}

}  // namespace

ExpectedOrder key_order_of(const Case& c, const NodeNames& names) {
    const auto dim = static_cast<std::size_t>(c.dim);
    std::vector<Node> nodes;
    std::vector<double> lo(dim, HUGE_VAL), hi(dim, -HUGE_VAL);
    const auto position = [&](std::size_t list, Offset node) {
        const auto first = c.lists[list].x.begin() + node * c.dim;
        return std::vector<double>(first, first + c.dim);
    };
    const auto owner = [&](std::size_t list, Offset node) {
        const Offset ghost = node - c.lists[list].n_internal;
        if (ghost < 0 || names.owner.empty() || names.owner[list].empty()) return node;
        const Slot own = names.owner[list][static_cast<std::size_t>(ghost)];
        return own < 0 ? node : Offset{own};
    };
    for (std::size_t l = 0; l < c.lists.size(); ++l)
        for (Offset a = 0; a < c.n(l); ++a)
            for (std::size_t d = 0; d < dim; ++d) {
                lo[d] = std::min(lo[d], position(l, owner(l, a))[d]);
                hi[d] = std::max(hi[d], position(l, owner(l, a))[d]);
            }
    for (std::size_t l = 0; l < c.lists.size(); ++l)
        for (Offset a = 0; a < c.n(l); ++a) {
            const Offset named = owner(l, a);
            const bool has_id = !names.global_id.empty() && !names.global_id[l].empty();
            nodes.push_back({position(l, a), key_of(position(l, named), lo, hi), l,
                             has_id ? names.global_id[l][static_cast<std::size_t>(named)] : named,
                             static_cast<Slot>(nodes.size())});
        }
    std::sort(nodes.begin(), nodes.end(),
              [](const Node& a, const Node& b) { return a.rank_by() < b.rank_by(); });
    ExpectedOrder order;
    order.ranks.resize(nodes.size());
    for (const Node& node : nodes) {
        order.ranks[static_cast<std::size_t>(node.slot)] = static_cast<Slot>(order.slots.size());
        order.slots.push_back(node.slot);
        order.keys.push_back(node.key);
    }
    return order;
}

Expected in_key_order(const Expected& by_slot, const ExpectedOrder& order) {
    const auto rank = [&](Slot s) { return order.ranks[static_cast<std::size_t>(s)]; };
    const auto before = [&](Slot a, Slot b) { return rank(a) < rank(b); };
    Expected out = by_slot;
    for (std::size_t r = 0; r + 1 < out.row_offsets.size(); ++r)
        std::sort(out.row_slots.begin() + out.row_offsets[r],
                  out.row_slots.begin() + out.row_offsets[r + 1], before);
    std::vector<std::vector<Slot>> partners(order.slots.size());
    for (std::size_t i = 0; i + 1 < by_slot.pair_offsets.size(); ++i)
        for (Offset p = by_slot.pair_offsets[i]; p < by_slot.pair_offsets[i + 1]; ++p) {
            const Slot a = static_cast<Slot>(i), b = by_slot.pair_j[static_cast<std::size_t>(p)];
            partners[static_cast<std::size_t>(std::min(rank(a), rank(b)))].push_back(
                before(a, b) ? b : a);
        }
    out.pair_offsets = {0};
    out.pair_j.clear();
    for (auto& row : partners) {
        std::sort(row.begin(), row.end(), before);
        out.pair_j.insert(out.pair_j.end(), row.begin(), row.end());
        out.pair_offsets.push_back(static_cast<Offset>(out.pair_j.size()));
    }
    return out;
}

}  // namespace connectivity::test
