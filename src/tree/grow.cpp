// SPDX-License-Identifier: BSD-3-Clause
#include "grow.hpp"

#include <array>
#include <numeric>
#include <string>
#include <utility>

#include <connectivity/base/parallel.hpp>

#include "blocks.hpp"
#include "user_name.hpp"

namespace connectivity::tree_detail {

namespace {

template <class Real, int Dim>
class Grower {
public:
    Grower(const Particles<Real, Dim>& particles, const StickOut<Real, Dim>& stick_out,
           const GrowOptions& options, GrowScratch& scratch)
        : particles_(particles), stick_out_(stick_out), options_(options), scratch_(scratch) {}

    RawTree run() {
        begin();
        bool grew = true;
        while (grew && select()) {
            if (level_ == max_level) refuse_depth();
            if (level_ == base_ + key_bits<Dim>) renew_keys();
            blocks_.cut(boxes(), selected_);
            count();
            grew = make_children();
            scatter();
            std::swap(scratch_.entries, scratch_.other);
            if (grew) ++level_;
        }
        if (grew && (level_ == 0 || !options_.adaptive)) flush(all_boxes());
        return std::move(tree_);
    }

private:
    static constexpr int n_children = 1 << Dim;
    static constexpr int own = n_children;  // the bin of those that stay
    static constexpr int n_bins = n_children + 1;
    using Counts = std::array<std::int32_t, n_bins>;
    using Weights = std::array<std::int64_t, n_children>;

    RawLevel& boxes() { return tree_.levels[level_]; }
    std::int64_t weight(std::int32_t id) const {
        return options_.weights == nullptr ? 1 : options_.weights[id];
    }
    Entry* entries() const { return scratch_.entries.data(); }

    /// The child that a particle of a box at level_ moves to, or `own`.
    int bin(const Entry& entry) const {
        if (entry.deepest <= level_) return own;
        return static_cast<int>(entry.key >> shift()) & (n_children - 1);
    }
    int shift() const { return Dim * (base_ + key_bits<Dim> - 1 - level_); }

    void set_key(Entry& entry) const {
        entry.key = stick_out_.frame.key(particles_, entry.id, base_);
        const int last = std::min(base_ + key_bits<Dim>, max_level);
        entry.deepest = static_cast<std::uint8_t>(
            particles_.have_extent() ? stick_out_.deepest(particles_, entry.id, base_, last)
                                     : last);
    }

    void begin() {
        const Offset n = particles_.n();
        ensure_capacity(scratch_.entries, "tree/entries", n);
        ensure_capacity(scratch_.other, "tree/entries", n);
        ensure_capacity(scratch_.order, "tree/order", n);
        tree_.order = scratch_.order;
        std::int64_t total = 0;
        Kokkos::parallel_reduce(
            "tree/keys", Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, n),
            [this](const Offset i, std::int64_t& sum) {
                Entry& entry = entries()[i];
                entry.id = static_cast<std::int32_t>(i);
                set_key(entry);
                sum += weight(entry.id);
            },
            total);
        HostExec().fence();
        const auto count = static_cast<std::int32_t>(n);
        tree_.levels.push_back({RawBox{.start = 0, .count = count, .n_own = count}});
        weights_ = {total};
    }

    /// Chooses the boxes of the level to split. Particles of an adaptive tree have arrived in all
    /// others, but for those that coincide.
    bool select() {
        selected_.clear();
        std::vector<std::int32_t> together;
        for (const std::int32_t b : all_boxes())
            if (weights_[b] > options_.limit)
                (coincide(boxes()[b]) ? together : selected_).push_back(b);
        if (options_.adaptive)
            flush(together);
        else if (!selected_.empty())
            selected_ = all_boxes();
        return !selected_.empty();
    }

    std::vector<std::int32_t> all_boxes() {
        std::vector<std::int32_t> all(boxes().size());
        std::iota(all.begin(), all.end(), 0);
        return all;
    }

    void flush(const std::vector<std::int32_t>& leaves) {
        for_each_dynamic("tree/arrive", static_cast<Offset>(leaves.size()),
                         [&](int, Offset k) { arrive(boxes()[leaves[k]]); });
    }
    void arrive(const RawBox& box) const {
        for (std::int32_t i = box.start; i < box.start + box.count; ++i)
            tree_.order(i) = entries()[i].id;
    }

    /// Whether no split can ever tell the particles of a box apart. Those with a radius will stick
    /// out of a small box.
    bool coincide(const RawBox& box) const {
        const Entry* const first = entries() + box.start;
        for (std::int32_t k = 1; k < box.count; ++k)
            if (first[k].key != first->key) return false;
        for (std::int32_t k = 0; k < box.count; ++k)
            if (particles_.radius(first[k].id) > 0 || !same_place(first->id, first[k].id))
                return false;
        if (options_.coincident_leaf) return true;
        throw Error(Status::argument,
                    user_name(particles_, first[0].id) + " and " +
                        user_name(particles_, first[1].id) + " are at one place, with " +
                        std::to_string(box.count) +
                        " particles in all that no box tells apart; a leaf may hold a weight of " +
                        std::to_string(options_.limit) +
                        ": allow more, or let coincident particles be a leaf");
    }
    bool same_place(std::int32_t a, std::int32_t b) const {
        const auto& frame = stick_out_.frame;
        for (int d = 0; d < Dim; ++d)
            if (std::min(frame.scaled(particles_.position(a, d), d), 1.0) !=
                std::min(frame.scaled(particles_.position(b, d), d), 1.0))
                return false;
        return true;
    }

    [[noreturn]] void refuse_depth() {
        const Entry* const first = entries() + boxes()[selected_[0]].start;
        throw Error(Status::too_many,
                    "the tree is deeper than " + std::to_string(max_level) +
                        " levels: " + user_name(particles_, first[0].id) + " and " +
                        user_name(particles_, first[1].id) +
                        " are in one box there, with more weight than a leaf may hold, " +
                        std::to_string(options_.limit));
    }

    void renew_keys() {
        base_ = level_;
        for_each_dynamic("tree/keys", static_cast<Offset>(selected_.size()), [&](int, Offset k) {
            const RawBox& box = boxes()[selected_[k]];
            for (std::int32_t i = box.start; i < box.start + box.count; ++i) set_key(entries()[i]);
        });
    }

    void count() {
        counts_.assign(blocks_.size(), Counts{});
        if (options_.weights != nullptr) block_weights_.assign(blocks_.size(), Weights{});
        blocks_.for_each("tree/count", [&](Offset k, const Block& block) {
            Counts counts{};
            for (std::int32_t i = block.begin; i < block.end; ++i) ++counts[bin(entries()[i])];
            counts_[k] = counts;
            if (options_.weights == nullptr) return;
            for (std::int32_t i = block.begin; i < block.end; ++i)
                if (const int child = bin(entries()[i]); child != own)
                    block_weights_[k][child] += weight(entries()[i].id);
        });
    }

    /// Decides who is split after all, makes the children of the level, and turns the counts of the
    /// blocks into the places where their particles go. False if there are no children.
    bool make_children() {
        check_number(options_.keep_empty ? selected_.size() * n_children : 0);
        RawLevel children;
        std::vector<std::int64_t> weights;
        final_.assign(selected_.size(), nobody_moves);
        for (std::size_t s = 0; s < selected_.size(); ++s) {
            const auto [first, last] = blocks_.of(s);
            Counts total{};
            for (std::size_t k = first; k < last; ++k)
                for (int c = 0; c < n_bins; ++c) total[c] += counts_[k][c];
            const Weights child_weights = weigh(total, first, last);
            if (options_.adaptive && std::accumulate(child_weights.begin(), child_weights.end(),
                                                     std::int64_t{0}) <= options_.limit)
                continue;
            final_[s] = 1u << own;
            RawBox& box = boxes()[selected_[s]];
            box.n_own = total[own];
            box.first_child = static_cast<std::int32_t>(children.size());
            place(box.start, total, first, last);
            if (options_.adaptive)
                for (int c = 0; c < n_children; ++c)
                    if (child_weights[c] <= options_.limit) final_[s] |= 1u << c;
            append_children(selected_[s], total, child_weights, children, weights);
        }
        check_number(children.size());
        n_boxes_ += static_cast<Offset>(children.size());
        weights_ = std::move(weights);
        if (children.empty()) return false;
        tree_.levels.push_back(std::move(children));
        return true;
    }

    void append_children(std::int32_t parent, const Counts& counts, const Weights& child_weights,
                         RawLevel& children, std::vector<std::int64_t>& weights) {
        RawBox& box = boxes()[parent];
        std::int32_t start = box.start + box.n_own;
        for (int c = 0; c < n_children; ++c) {
            if (counts[c] == 0 && !options_.keep_empty) continue;
            box.children = static_cast<std::uint8_t>(box.children | 1 << c);
            children.push_back({.start = start,
                                .count = counts[c],
                                .n_own = counts[c],
                                .parent = parent,
                                .number = static_cast<std::uint8_t>(c)});
            weights.push_back(child_weights[c]);
            start += counts[c];
        }
    }

    void check_number(std::size_t n_new) const {
        if (n_boxes_ + static_cast<Offset>(n_new) <= options_.max_boxes) return;
        throw Error(Status::too_many,
                    "the tree has more than " + std::to_string(options_.max_boxes) +
                        " boxes at level " + std::to_string(level_ + 1) +
                        ", the most that numbers of 32 bits and the memory budget allow: raise "
                        "the limit of a leaf, or choose an adaptive tree");
    }

    Weights weigh(const Counts& total, std::size_t first, std::size_t last) const {
        Weights sum{};
        if (options_.weights == nullptr)
            for (int c = 0; c < n_children; ++c) sum[c] = total[c];
        else
            for (std::size_t k = first; k < last; ++k)
                for (int c = 0; c < n_children; ++c) sum[c] += block_weights_[k][c];
        return sum;
    }

    /// Own particles first, then those of the children.
    void place(std::int32_t start, const Counts& total, std::size_t first, std::size_t last) {
        for (int b = 0; b < n_bins; ++b) {
            const int c = b == 0 ? own : b - 1;
            std::int32_t next = start;
            for (std::size_t k = first; k < last; ++k) next += std::exchange(counts_[k][c], next);
            start += total[c];
        }
    }

    void scatter() {
        blocks_.for_each("tree/scatter", [&](Offset k, const Block& block) {
            const std::uint32_t arrives = final_[block.owner];
            Counts next = counts_[k];
            std::int32_t* const order = tree_.order.data();
            Entry* const other = scratch_.other.data();
            for (std::int32_t i = block.begin; i < block.end; ++i) {
                const Entry& entry = entries()[i];
                if (arrives == nobody_moves) {
                    order[i] = entry.id;
                    continue;
                }
                const int c = bin(entry);
                const std::int32_t place = next[c]++;
                if ((arrives >> c & 1u) != 0)
                    order[place] = entry.id;
                else
                    other[place] = entry;
            }
        });
    }

    static constexpr std::uint32_t nobody_moves = ~0u;

    const Particles<Real, Dim>& particles_;
    const StickOut<Real, Dim>& stick_out_;
    const GrowOptions& options_;
    GrowScratch& scratch_;
    RawTree tree_;
    int level_ = 0, base_ = 0;  // being split; from which keys count
    Offset n_boxes_ = 1;
    std::vector<std::int64_t> weights_;   // [boxes of the level]
    std::vector<std::int32_t> selected_;  // ascending boxes of the level
    std::vector<std::uint32_t> final_;    // [selected]: bins whose particles have arrived
    Blocks blocks_;                       // of the selected
    std::vector<Counts> counts_;          // [blocks], later places
    std::vector<Weights> block_weights_;  // [blocks]
};

}  // namespace

template <class Real, int Dim>
RawTree grow(const Particles<Real, Dim>& particles, const StickOut<Real, Dim>& stick_out,
             const GrowOptions& options, GrowScratch& scratch) {
    return Grower<Real, Dim>(particles, stick_out, options, scratch).run();
}

#define CONNECTIVITY_INSTANTIATE(Real, Dim)                                        \
    template RawTree grow(const Particles<Real, Dim>&, const StickOut<Real, Dim>&, \
                          const GrowOptions&, GrowScratch&);
CONNECTIVITY_EACH_REAL_AND_DIM(CONNECTIVITY_INSTANTIATE)
#undef CONNECTIVITY_INSTANTIATE

}  // namespace connectivity::tree_detail
