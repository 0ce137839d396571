// SPDX-License-Identifier: BSD-3-Clause
#include "translation_codes.hpp"

#include <atomic>
#include <string>

#include "chunks.hpp"

namespace connectivity::detail {

TranslationCodes::TranslationCodes(const FMMTraversalInfo& traversal, bool per_level)
    : dim_(traversal.tree().dim),
      reach_(0),
      n_levels_(per_level ? traversal.nlevels() : 1),
      targets_(traversal.target_or_target_parent_boxes()),
      starts_(traversal.from_sep_siblings().starts),
      box_levels_(traversal.tree().box_levels) {
    const Offset n_entries = static_cast<Offset>(traversal.from_sep_siblings().lists.size());
    codes_ = allocate<std::int32_t>("lists/classes", n_entries);
    if (n_entries == 0) return;
    const Offset n = traversal.well_sep_is_n_away(), base = 4 * n + 3;
    n_codes_ = 1;
    for (int k = 0; k < dim_; ++k) {
        powers_[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(n_codes_);
        n_codes_ *= base;
        if (n_codes_ > max_slots)
            throw Error(Status::argument, "translation classes: well_sep_is_n_away is " +
                                              std::to_string(n) + ", (4 n + 3)^" +
                                              std::to_string(dim_) + " must be below 2^31");
    }
    reach_ = static_cast<int>(2 * n + 1);
    const Budget& budget = traversal.budget();
    const Offset bytes = 4 * (n_entries + n_levels_ * n_codes_ + traversal.nboxes());
    if (!budget.allows(bytes))
        throw Error(Status::budget, "translation classes need " + human_bytes(bytes) +
                                        ", the budget allows " + human_bytes(budget.allowed()));
    table_ = allocate_zeroed<std::int32_t>("lists/classes/table", n_levels_ * n_codes_);
    number_boxes(traversal.tree());
    make_codes(traversal);
}

std::array<int, 3> TranslationCodes::vector_of(Offset code) const {
    std::array<int, 3> v{};
    for (int k = 0; k < dim_; ++k, code /= 2 * reach_ + 1)
        v[static_cast<std::size_t>(k)] = static_cast<int>(code % (2 * reach_ + 1)) - reach_;
    return v;
}

void TranslationCodes::number_boxes(const TreeView& tree) {
    numbers_ = allocate<std::uint32_t>("lists/classes/numbers", tree.n_boxes);
    std::array<std::uint32_t, 8> step{};
    for (unsigned m = 0; m < 8; ++m)
        for (int k = 0; k < dim_; ++k)
            if (m >> (dim_ - 1 - k) & 1u) step[m] += powers_[static_cast<std::size_t>(k)];
    numbers_(0) = 0;
    for (int level = 0; level + 1 < tree.n_levels; ++level) {
        const BoxId start = tree.level_start_box_nrs(level);
        for_each_chunk("lists/classes/number", tree.level_start_box_nrs(level + 1) - start, 4096,
                       [&](Offset, Offset first, Offset last) {
                           for (int m = 0; m < 1 << dim_; ++m)
                               for (Offset b = start + first; b < start + last; ++b)
                                   if (const BoxId c = tree.child(m, static_cast<BoxId>(b)); c != 0)
                                       numbers_(c) =
                                           2 * numbers_(b) + step[static_cast<unsigned>(m)];
                       });
    }
}

void TranslationCodes::make_codes(const FMMTraversalInfo& traversal) {
    const BoxList list = traversal.from_sep_siblings();
    std::uint32_t constant = 0;
    for (const std::uint32_t power : powers_)
        constant += static_cast<std::uint32_t>(reach_) * power;
    // What an image of the root is away, in boxes of a level: 2^level times this, modulo 2^32.
    std::array<std::uint32_t, 27> shifts{};
    for (ImageCode image = 0; image < 27; ++image)
        for (std::size_t k = 0; k < 3; ++k)
            shifts[image] += static_cast<std::uint32_t>(image_shift(image)[k]) * powers_[k];
    const std::uint32_t* const numbers = numbers_.data();
    const BoxId* const sources = list.lists.data();
    for_each_chunk("lists/classes/codes", list.size(), 256, [&](Offset, Offset first, Offset last) {
        for (Offset i = first; i < last; ++i) {
            const int level = box_levels_(targets_(i));
            const std::uint32_t own = numbers[targets_(i)] + constant;
            std::int32_t* const table = table_.data() + (n_levels_ > 1 ? level : 0) * n_codes_;
            for (Offset e = list.starts(i); e < list.starts(i + 1); ++e) {
                std::uint32_t code = own - numbers[sources[e]];
                if (list.images.size() > 0 && level < 32) code -= shifts[list.images(e)] << level;
                codes_(e) = static_cast<std::int32_t>(code);
                const std::atomic_ref<std::int32_t> used(table[code]);
                if (used.load(std::memory_order_relaxed) == 0)
                    used.store(1, std::memory_order_relaxed);
            }
        }
    });
}

View<std::int32_t> TranslationCodes::take_classes() {
    const Offset n_rows = starts_.size() > 0 ? static_cast<Offset>(starts_.size()) - 1 : 0;
    if (n_codes_ > 0)
        for_each_chunk("lists/classes/fill", n_rows, 1024, [&](Offset, Offset first, Offset last) {
            for (Offset i = first; i < last; ++i) {
                const int level = n_levels_ > 1 ? box_levels_(targets_(i)) : 0;
                const std::int32_t* const table = table_.data() + level * n_codes_;
                for (Offset e = starts_(i); e < starts_(i + 1); ++e) codes_(e) = table[codes_(e)];
            }
        });
    return codes_;
}

}  // namespace connectivity::detail
