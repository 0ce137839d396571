// SPDX-License-Identifier: BSD-3-Clause
#include "near_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace connectivity::detail {
namespace {

/// The largest offset that occurs in so many levels is below 2^levels: a larger n changes nothing.
int effective_n(const TreeView& tree, int n) {
    constexpr int largest = 16383;
    if (n < 1)
        throw Error(Status::argument,
                    "well_sep_is_n_away is " + std::to_string(n) + ", must be at least 1");
    if (tree.n_levels <= 13) return std::min(n, 1 << tree.n_levels);
    if (n > largest)
        throw Error(Status::unsupported, "well_sep_is_n_away is " + std::to_string(n) +
                                             ", must be at most " + std::to_string(largest) +
                                             " in a tree of more than 13 levels");
    return n;
}

}  // namespace

Offset NearScratch::bytes() const {
    std::size_t bytes = rows.size() * sizeof(NearRow) + starts.capacity() * sizeof(Offset);
    for (const View<Near>& level : levels) bytes += level.size() * sizeof(Near);
    for (const auto& axis : near)
        for (const auto& offsets : axis) bytes += offsets.capacity();
    return static_cast<Offset>(bytes);
}

NearRows::NearRows(const TreeTables& tables, const Separation& separation,
                   const TraversalOptions& options, NearScratch& scratch)
    : tables_(tables),
      separation_(separation),
      scratch_(scratch),
      n_(effective_n(tables.tree, options.well_sep_is_n_away)),
      all_boxes_(options.same_level_non_well_sep_boxes),
      bytes_(tables.bytes() + tables.tree.n_boxes * Offset{sizeof(Row)}) {
    make_axes();
    ensure_capacity(scratch.rows, "lists/near/rows", tables.tree.n_boxes);
    rows_ = scratch.rows.data();
    const auto n_levels = static_cast<std::size_t>(tables.tree.n_levels);
    if (scratch.levels.size() < n_levels) scratch.levels.resize(n_levels);
    take_entries(0, 27, options.budget);
    make_root();
    for (int level = 1; level < tables.tree.n_levels; ++level) make_level(level, options.budget);
}

void NearRows::make_axes() {
    for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        const bool exists = k < tables_.tree.dim;
        axis_bits_[axis] = exists ? static_cast<unsigned>(tables_.axis_bit(k)) : 0;
        const int n = exists ? n_ : 0;
        for (int bit = 0; bit < 2; ++bit) {
            auto& near = scratch_.near[axis][static_cast<std::size_t>(bit)];
            near.clear();
            for (int offset = -n; offset <= n; ++offset) {
                unsigned children = 0;
                for (unsigned m = 0; m < 8; ++m)
                    if (std::abs(2 * offset + ((m & axis_bits_[axis]) ? 1 : 0) - bit) <= n_)
                        children |= 1u << m;
                near.push_back(static_cast<std::uint8_t>(children));
            }
        }
    }
}

/// Storage for the entries of a level.
View<Near>& NearRows::take_entries(int level, Offset n, const Budget& budget) {
    bytes_ += n * Offset{sizeof(Near)};
    if (!budget.allows(bytes_))
        throw Error(Status::budget, "interaction lists: near boxes down to level " +
                                        std::to_string(level) + " need " + human_bytes(bytes_) +
                                        ", the budget allows " + human_bytes(budget.allowed()));
    View<Near>& entries = scratch_.levels[static_cast<std::size_t>(level)];
    ensure_capacity(entries, "lists/near", n);
    return entries;
}

/// The root, and its images in ascending codes.
void NearRows::make_root() {
    Near* const first = scratch_.levels[0].data();
    Near* last = first;
    const auto& periodic = tables_.tree.periodic;
    for (ImageCode code = 0; code < 27; ++code) {
        const auto shift = image_shift(code);
        Near e{0, {}, 0, code};
        bool exists = true;
        for (int k = 0; k < 3; ++k) {
            const int s = shift[static_cast<std::size_t>(k)];
            if (s == 0) continue;
            exists = exists && k < tables_.tree.dim && periodic[static_cast<std::size_t>(k)];
            if (!exists) break;
            e.offset[static_cast<std::size_t>(k)] = static_cast<std::int16_t>(s);
            const int bit = tables_.axis_bit(k);
            e.state |= static_cast<std::uint8_t>(bit | (s < 0 ? bit << 3 : 0));
        }
        if (exists) *last++ = e;
    }
    rows_[0] = {first, last, last - first - 1, 0, 0};
}

Near NearRows::child_of(const Near& e, unsigned m, unsigned of_target) const {
    Near c{tables_.child(e.box, static_cast<int>(m)), {}, 0, e.image};
    unsigned state = 0;
    for (int k = 0; k < tables_.tree.dim; ++k) {
        const unsigned bit = axis_bits_[static_cast<std::size_t>(k)];
        const int offset = 2 * e.offset[static_cast<std::size_t>(k)] + ((m & bit) ? 1 : 0) -
                           ((of_target & bit) ? 1 : 0);
        c.offset[static_cast<std::size_t>(k)] = static_cast<std::int16_t>(offset);
        if (offset < -1 || offset > 1) state |= Near::is_apart;
        if (offset != 0) state |= bit;
        if (offset < 0) state |= bit << 3;
    }
    c.state = static_cast<std::uint8_t>((state & Near::is_apart) ? Near::is_apart : state);
    return c;
}

/// Counts what the parent's row tells without a look at extents; returns room for the row.
Offset NearRows::count_row(BoxId b) {
    const NearChildren near = near_children(tables_.number.data()[b]);
    const bool targets = has_targets(b);
    Offset n_near = 0, n_children = 0, n_bigger = 0;
    for (const Near& e : parent_row(b)) {
        n_bigger += e.bigger() || tables_.owns_sources(e.box);
        if (e.bigger()) continue;
        n_near += std::popcount(tables_.mask(e.box) & near(e));
        n_children += std::popcount(tables_.mask(e.box));
    }
    // One of those that are near is b itself.
    rows_[b] = {nullptr, nullptr, n_near - 1, n_children - n_near, 0};
    return n_near + (targets ? n_bigger : 0);
}

void NearRows::make_level(int level, const Budget& budget) {
    const TreeView& tree = tables_.tree;
    const BoxId start = tree.level_start_box_nrs(level);
    const Offset n_boxes = tree.level_start_box_nrs(level + 1) - start;
    constexpr Offset chunk = 256;
    auto& starts = scratch_.starts;
    starts.assign(static_cast<std::size_t>(n_chunks(n_boxes, chunk)) + 1, 0);
    for_each_chunk("lists/near/count", n_boxes, chunk, [&](Offset c, Offset first, Offset last) {
        Offset n = 0;
        for (auto b = static_cast<BoxId>(start + first); b < start + last; ++b)
            if (has_row(b))
                n += count_row(b);
            else
                rows_[b] = {};
        starts[static_cast<std::size_t>(c) + 1] = n;
    });
    for (std::size_t c = 1; c < starts.size(); ++c) starts[c] += starts[c - 1];
    Near* const entries = take_entries(level, starts.back(), budget).data();
    for_each_chunk("lists/near/fill", n_boxes, chunk, [&](Offset c, Offset first, Offset last) {
        Near* out = entries + starts[static_cast<std::size_t>(c)];
        for (auto b = static_cast<BoxId>(start + first); b < start + last; ++b) {
            if (!has_row(b)) continue;
            Row& row = rows_[b];
            row.first = out;
            make_row(
                b, [&](const Near& e) { *out++ = e; },
                [&](BoxId, ImageCode) { ++row.n_from_sep_bigger; });
            row.last = out;
        }
    });
}

}  // namespace connectivity::detail
