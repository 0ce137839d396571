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
    /// Forgets all rows, keeps the chunks.
    void reset() { chunk_ = 0, top_ = 0, n_used_ = 0; }

    /// Forgets all rows and gives the chunks back.
    void clear() { chunks_.clear(), reset(); }

    /// Room for a row of at most n entries. Newly taken chunks are added to `used`. Throws
    /// Error{memory}.
    Slot* begin_row(Offset n, std::atomic<Offset>& used) {
        while (chunk_ < chunks_.size() &&
               top_ + n + list_slack > static_cast<Offset>(chunks_[chunk_].size()))
            ++chunk_, top_ = 0;
        if (chunk_ == chunks_.size())
            chunks_.push_back(
                allocate<Slot>("search/groups/arena", std::max(n + list_slack, chunk_size)));
        for (; n_used_ <= chunk_; ++n_used_)
            used.fetch_add(static_cast<Offset>(chunks_[n_used_].size() * sizeof(Slot)),
                           std::memory_order_relaxed);
        return chunks_[chunk_].data() + top_;
    }

    /// Ends the row begun last: n entries are kept.
    void end_row(Offset n) { top_ += n; }

    Offset bytes() const {
        Offset sum = 0;
        for (const auto& chunk : chunks_) sum += static_cast<Offset>(chunk.size() * sizeof(Slot));
        return sum;
    }

private:
    static constexpr Offset chunk_size = Offset{1} << 20;
    std::vector<View<Slot>> chunks_;
    std::size_t chunk_ = 0, n_used_ = 0;
    Offset top_ = 0;
};

}  // namespace connectivity::detail
