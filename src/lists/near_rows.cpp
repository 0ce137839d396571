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

NearRows::NearRows(const TreeTables& tables, const Separation& separation,
                   const TraversalOptions& options, bool all_boxes)
    : tables_(tables),
      separation_(separation),
      n_(effective_n(tables.tree, options.well_sep_is_n_away)),
      all_boxes_(all_boxes) {
    for (int k = 0; k < tables.tree.dim; ++k) {
        Axis& axis = axes_[static_cast<std::size_t>(k)];
        axis.bit = static_cast<unsigned>(tables.axis_bit(k));
        for (int bit = 0; bit < 2; ++bit)
            for (int offset = -n_; offset <= n_; ++offset) {
                unsigned near = 0;
                for (unsigned m = 0; m < 8; ++m)
                    if (std::abs(2 * offset + ((m & axis.bit) ? 1 : 0) - bit) <= n_)
                        near |= 1u << m;
                axis.near[static_cast<std::size_t>(bit)].push_back(static_cast<std::uint8_t>(near));
            }
    }
    rows_ = allocate<Row>("lists/near/rows", tables.tree.n_boxes);
    bytes_ = tables.tree.n_boxes * Offset{sizeof(Row)};
    make_root();
    for (int level = 1; level < tables.tree.n_levels; ++level) make_level(level, options);
}

/// The root, and its images in ascending codes.
void NearRows::make_root() {
    std::array<Near, 27> images;
    std::size_t n = 0;
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
        if (exists) images[n++] = e;
    }
    levels_.push_back(allocate<Near>("lists/near", static_cast<Offset>(n)));
    std::copy_n(images.begin(), n, levels_.back().data());
    rows_(0) = {levels_.back().data(), levels_.back().data() + n};
    bytes_ += static_cast<Offset>(n * sizeof(Near));
}

Near NearRows::child_of(const Near& e, unsigned m, unsigned of_target) const {
    Near c{tables_.child(e.box, static_cast<int>(m)), {}, 0, e.image};
    unsigned state = 0;
    for (int k = 0; k < tables_.tree.dim; ++k) {
        const unsigned bit = axes_[static_cast<std::size_t>(k)].bit;
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

Offset NearRows::n_from_sep_siblings(BoxId b) const {
    const unsigned m = tables_.number.data()[b];
    Offset n = 0;
    for (const Near& e : parent_row(b))
        if (!e.bigger()) n += std::popcount(tables_.mask(e.box) & ~near_children(e, m));
    return n;
}

void NearRows::make_level(int level, const TraversalOptions& options) {
    const TreeView& tree = tables_.tree;
    const BoxId start = tree.level_start_box_nrs(level);
    const Offset n_boxes = tree.level_start_box_nrs(level + 1) - start;
    constexpr Offset chunk = 256;
    std::vector<Offset> ends(static_cast<std::size_t>(n_chunks(n_boxes, chunk)) + 1);
    const auto nothing = [](BoxId, ImageCode) {};
    const auto has_row = [&](BoxId b) { return all_boxes_ || (tables_.flags(b) & target_flags); };
    for_each_chunk("lists/near/count", n_boxes, chunk, [&](Offset c, Offset first, Offset last) {
        Offset n = 0;
        for (Offset i = first; i < last; ++i) {
            const auto b = static_cast<BoxId>(start + i);
            if (has_row(b))
                make_row(
                    b, [&](const Near&) { ++n; }, nothing);
        }
        ends[static_cast<std::size_t>(c) + 1] = n;
    });
    for (std::size_t c = 1; c < ends.size(); ++c) ends[c] += ends[c - 1];
    bytes_ += ends.back() * Offset{sizeof(Near)};
    if (!options.budget.allows(bytes_))
        throw Error(Status::budget, "interaction lists: near boxes down to level " +
                                        std::to_string(level) + " need " + human_bytes(bytes_) +
                                        ", the budget allows " +
                                        human_bytes(options.budget.allowed()));
    levels_.push_back(allocate<Near>("lists/near", ends.back()));
    Near* const entries = levels_.back().data();
    for_each_chunk("lists/near/fill", n_boxes, chunk, [&](Offset c, Offset first, Offset last) {
        Near* out = entries + ends[static_cast<std::size_t>(c)];
        for (Offset i = first; i < last; ++i) {
            const auto b = static_cast<BoxId>(start + i);
            Near* const begin = out;
            if (has_row(b))
                make_row(
                    b, [&](const Near& e) { *out++ = e; }, nothing);
            rows_(b) = {begin, out};
        }
    });
}

}  // namespace connectivity::detail
