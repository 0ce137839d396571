// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/map/pair_colours.hpp>

#include <algorithm>
#include <bit>
#include <numeric>

namespace connectivity {
namespace {

/// Colours blocks greedily: the lowest colour that no block with a common node has yet.
class Greedy {
public:
    Greedy(const NodePairList::View<>& pairs, const ConstView<Slot>& order, Offset block_size)
        : pairs_(pairs),
          order_(order),
          block_size_(block_size),
          taken_(allocate<std::uint64_t>("map/pair_colours/taken", pairs.n_slots())) {}

    /// A colour for each block.
    std::vector<int> run() {
        constexpr int colours_a_round = 64;  // bits of a word
        const Offset n = pairs_.n_slots();
        std::vector<int> colour(static_cast<std::size_t>((n + block_size_ - 1) / block_size_), -1);
        auto left = static_cast<Offset>(colour.size());
        for (int first = 0; left > 0; first += colours_a_round) {
            std::fill_n(taken_.data(), n, 0);
            for (std::size_t b = 0; b < colour.size(); ++b) {
                if (colour[b] >= 0) continue;
                const int free = take(static_cast<Offset>(b));
                if (free == colours_a_round) continue;
                colour[b] = first + free;
                --left;
            }
        }
        return colour;
    }

private:
    /// Calls f for the nodes of all pairs of a block until it says false.
    template <class F>
    void for_each_node(Offset block, const F& f) {
        const Offset begin = block * block_size_,
                     end = std::min(begin + block_size_, pairs_.n_slots());
        for (Offset s = begin; s < end; ++s) {
            const Slot i = order_.size() > 0 ? order_(s) : static_cast<Slot>(s);
            const Slot row = pairs_.half_row(i);
            const Offset first = pairs_.offsets(row), last = pairs_.offsets(row + 1);
            if (first < last && !f(i)) return;
            for (Offset k = first; k < last; ++k)
                if (!f(pairs_.j(k))) return;
        }
    }

    /// Takes the lowest colour of this round that is free at all nodes of the block; 64 if none is.
    int take(Offset block) {
        std::uint64_t* const taken = taken_.data();
        std::uint64_t all = 0;
        for_each_node(block, [&](Slot s) { return ~(all |= taken[s]) != 0; });
        if (~all == 0) return 64;
        const int free = std::countr_one(all);
        const std::uint64_t bit = std::uint64_t{1} << free;
        for_each_node(block, [&](Slot s) {
            taken[s] |= bit;
            return true;
        });
        return free;
    }

    NodePairList::View<> pairs_;
    ConstView<Slot> order_;
    Offset block_size_;
    View<std::uint64_t> taken_;  // [n_slots], colours of this round at a node
};

void check_order(const ConstView<Slot>& order, Offset n_slots) {
    if (order.size() == 0) return;
    if (static_cast<Offset>(order.size()) != n_slots)
        throw Error(Status::argument, "pair colours: an order of " + std::to_string(order.size()) +
                                          " slots, must be 0 or " + std::to_string(n_slots));
    std::vector<bool> seen(order.size());
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Slot s = order(k);
        if (s < 0 || s >= n_slots || seen[static_cast<std::size_t>(s)])
            throw Error(Status::argument, "pair colours: order[" + std::to_string(k) + "] = " +
                                              std::to_string(s) + ", must name every slot once");
        seen[static_cast<std::size_t>(s)] = true;
    }
}

}  // namespace

void PairColours::rebuild(const NodePairList& pair_list, const ConstView<Slot>& order,
                          Offset block_size) {
    if (pair_list.stamp() == 0)
        throw Error(Status::not_built, "pair colours: the pair list was never built");
    if (block_size < 1)
        throw Error(Status::argument, "pair colours: blocks of " + std::to_string(block_size) +
                                          " slots, must be at least 1");
    const auto pairs = pair_list.view();
    const Offset n = pairs.n_slots();
    check_order(order, n);
    const std::vector<int> colour = Greedy(pairs, order, block_size).run();
    std::vector<Offset> blocks(colour.size());
    std::iota(blocks.begin(), blocks.end(), 0);
    std::stable_sort(blocks.begin(), blocks.end(), [&](Offset a, Offset b) {
        return colour[static_cast<std::size_t>(a)] < colour[static_cast<std::size_t>(b)];
    });

    auto slots = allocate<Slot>("map/pair_colours/slots", n);
    auto block_offset =
        allocate<Offset>("map/pair_colours/blocks", static_cast<Offset>(blocks.size()) + 1);
    std::vector<Offset> colour_offset;
    Offset at = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        block_offset(b) = at;
        if (b == 0 || colour[static_cast<std::size_t>(blocks[b])] !=
                          colour[static_cast<std::size_t>(blocks[b - 1])])
            colour_offset.push_back(static_cast<Offset>(b));
        const Offset begin = blocks[b] * block_size, end = std::min(begin + block_size, n);
        for (Offset s = begin; s < end; ++s)
            slots(at++) = order.size() > 0 ? order(s) : static_cast<Slot>(s);
    }
    block_offset(blocks.size()) = at;
    colour_offset.push_back(static_cast<Offset>(blocks.size()));
    slots_ = slots;
    block_offset_ = block_offset;
    colour_offset_.swap(colour_offset);
    stamp_ = pairs.stamp;
}

Offset PairColours::bytes() const {
    return static_cast<Offset>(slots_.size() * sizeof(Slot) +
                               block_offset_.size() * sizeof(Offset));
}

}  // namespace connectivity
