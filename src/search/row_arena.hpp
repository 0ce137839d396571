// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Where a worker leaves the rows it found until all are counted: chunks that are kept from build
/// to build.
///
/// Invariant: a row lies in one chunk and does not move; `list_slack` entries behind it may be
/// overwritten until the next row is begun.

#include <atomic>
#include <vector>

#include <connectivity/base/spaces.hpp>

#include "kernels.hpp"

namespace connectivity::detail {

class RowArena {
public:
    static constexpr Offset smallest_bytes = Offset{1} << 20;  ///< once it holds a row

    /// Forgets all rows, keeps the chunks.
    void reset() { chunk_ = 0, top_ = 0, n_used_ = 0; }

    /// Forgets all rows and gives the chunks back.
    void clear() { chunks_.clear(), reset(); }

    /// Room for a row of at most n entries. Newly used chunks are added to `used`. Throws
    /// Error{memory}.
    Slot* begin_row(Offset n, std::atomic<Offset>& used) {
        const Offset room = n + list_slack;
        if (chunk_ == chunks_.size() || top_ + room > size(chunk_)) next_chunk(room);
        for (; n_used_ <= chunk_; ++n_used_)
            used.fetch_add(size(n_used_) * Offset{sizeof(Slot)}, std::memory_order_relaxed);
        return chunks_[chunk_].data() + top_;
    }

    /// Ends the row begun last with n entries.
    void end_row(Offset n) { top_ += n; }

    Offset bytes() const {
        Offset sum = 0;
        for (const auto& chunk : chunks_) sum += static_cast<Offset>(chunk.size() * sizeof(Slot));
        return sum;
    }

private:
    static constexpr Offset smallest_chunk = smallest_bytes / Offset{sizeof(Slot)},
                            largest_chunk = Offset{1} << 24;

    Offset size(std::size_t chunk) const { return static_cast<Offset>(chunks_[chunk].size()); }

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
    std::size_t chunk_ = 0, n_used_ = 0;
    Offset top_ = 0;
};

}  // namespace connectivity::detail
