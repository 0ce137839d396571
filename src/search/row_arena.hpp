// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Where a worker leaves the rows it found until all are counted: chunks that are kept from build
/// to build, cut into blocks, each of which holds rows of one range of slots.
///
/// Rows are found in spatial order and wanted in slot order. With a stream of blocks for each range
/// of slots, the rows of a range are read back one block after the other, and memory is never read
/// a few lines here and there: twice as fast where rows outgrow the caches (measured).
///
/// Invariants: a row lies in one block and does not move; `list_slack` entries behind it may be
/// overwritten until the next row is begun. Cost: a started block for each range.

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include <connectivity/base/spaces.hpp>

#include "kernels.hpp"

namespace connectivity::detail {

class RowArena {
public:
    static constexpr Offset smallest_bytes = Offset{1} << 20;  ///< once it holds a row

    /// Forgets all rows, keeps the chunks. Blocks have `block` entries, or what a row needs.
    void reset(std::size_t n_ranges, Offset block) {
        chunk_ = 0, top_ = 0, n_used_ = 0, block_ = block;
        ranges_.resize(n_ranges);
        for (Range& range : ranges_) range.next = range.end = nullptr, range.blocks.clear();
    }

    /// Forgets all rows and gives the chunks back.
    void clear() { chunks_.clear(), reset(ranges_.size(), block_); }

    /// Room for a row of at most n entries. Newly used chunks are added to `used`. Throws
    /// Error{memory}.
    Slot* begin_row(std::size_t range, Offset n, std::atomic<Offset>& used) {
        Range& rows = ranges_[range];
        if (rows.end - rows.next < n + list_slack) next_block(rows, n + list_slack, used);
        return rows.next;
    }

    /// Ends the row begun last in this range with n entries, and asks for the memory of the next
    /// one, which will be written much later.
    void end_row(std::size_t range, Offset n) {
        Range& rows = ranges_[range];
        rows.next += n;
        constexpr Offset line = 64 / sizeof(Slot), most = 16 * line;
        for (Offset k = 0; k < std::min(n + line, most); k += line)
            __builtin_prefetch(rows.next + k, 1);
    }

    /// Calls f(first, last) for all memory that holds rows of a range.
    template <class F>
    void for_each_block(std::size_t range, const F& f) const {
        const Range& rows = ranges_[range];
        for (std::size_t b = 0; b < rows.blocks.size(); ++b)
            f(rows.blocks[b].data(), b + 1 < rows.blocks.size()
                                         ? rows.blocks[b].data() + rows.blocks[b].size()
                                         : static_cast<const Slot*>(rows.next));
    }

    Offset bytes() const {
        Offset sum = 0;
        for (const auto& chunk : chunks_) sum += static_cast<Offset>(chunk.size() * sizeof(Slot));
        return sum;
    }

private:
    static constexpr Offset smallest_chunk = smallest_bytes / Offset{sizeof(Slot)},
                            largest_chunk = Offset{1} << 24;
    struct Range {
        Slot *next = nullptr, *end = nullptr;  // the rest of the last block
        std::vector<std::span<const Slot>> blocks;
    };

    Offset size(std::size_t chunk) const { return static_cast<Offset>(chunks_[chunk].size()); }

    void next_block(Range& range, Offset room, std::atomic<Offset>& used) {
        const Offset wanted = std::max(room, block_);
        if (chunk_ == chunks_.size() || top_ + wanted > size(chunk_)) next_chunk(wanted);
        for (; n_used_ <= chunk_; ++n_used_)
            used.fetch_add(size(n_used_) * Offset{sizeof(Slot)}, std::memory_order_relaxed);
        Slot* const first = chunks_[chunk_].data() + top_;
        range.blocks.emplace_back(first, static_cast<std::size_t>(wanted));
        range.next = first, range.end = first + wanted;
        top_ += wanted;
    }

    /// Chunks double, so that small searches hold little and large ones lie in huge pages.
    void next_chunk(Offset room) {
        if (!chunks_.empty() && top_ > 0) ++chunk_;
        top_ = 0;
        while (chunk_ < chunks_.size() && size(chunk_) < room) ++chunk_;
        if (chunk_ < chunks_.size()) return;
        Offset n = smallest_chunk;
        for (const auto& chunk : chunks_) n += static_cast<Offset>(chunk.size());
        chunks_.push_back(
            allocate<Slot>("search/groups/arena", std::max(room, std::min(n, largest_chunk))));
    }

    std::vector<View<Slot>> chunks_;
    std::vector<Range> ranges_;
    std::size_t chunk_ = 0, n_used_ = 0;
    Offset top_ = 0, block_ = 0;
};

}  // namespace connectivity::detail
