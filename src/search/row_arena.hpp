// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Where a worker leaves the rows it found until all are counted: chunks that are kept from build
/// to build.
///
/// Rows are made in a staging buffer that stays in the first-level cache and move on in whole
/// lines; past the caches where the arenas outgrow them. Expanding bits straight into a chunk would
/// overwrite each of its lines several times and read it from memory first: half of the time of a
/// build was spent there.
///
/// Invariants: a row lies in one chunk and does not move once `flush` ran; the chunk's place of a
/// row is known when the row ends. `list_slack` entries behind a row may be overwritten until the
/// next one is begun.

#include <atomic>
#include <vector>

#include <connectivity/base/spaces.hpp>

#include "candidate_store.hpp"
#include "stream_writer.hpp"

namespace connectivity::detail {

class RowArena {
public:
    static constexpr Offset smallest_bytes = Offset{1} << 20;  ///< once it holds a row

    /// Forgets all rows, keeps the chunks.
    void reset(bool past_caches) {
        chunk_ = 0, top_ = 0, staged_ = 0, n_used_ = 0;
        past_caches_ = past_caches;
    }

    /// Forgets all rows and gives the memory back.
    void clear() {
        chunks_.clear();
        staging_ = {};
        reset(false);
    }

    /// Room for a row of at most n entries. Newly used chunks are added to `used`. Throws
    /// Error{memory} or std::bad_alloc.
    Slot* begin_row(Offset n, std::atomic<Offset>& used) {
        const Offset room = n + list_slack;
        if (chunk_ == chunks_.size() || top_ + staged_ + room > size(chunk_)) next_chunk(room);
        for (; n_used_ <= chunk_; ++n_used_)
            used.fetch_add(size(n_used_) * Offset{sizeof(Slot)}, std::memory_order_relaxed);
        if (staged_ > 0 && staged_ + room > staging_size) move_lines();
        staging_.reserve(std::max(staged_ + room, staging_size), staged_);
        return staging_.data() + staged_;
    }

    /// Ends the row begun last with n entries. Returns where they lie after the next `flush`.
    const Slot* end_row(Offset n) {
        const Slot* const place = chunks_[chunk_].data() + top_ + staged_;
        staged_ += n;
        return place;
    }

    /// Moves everything staged to its place. What a worker streamed before, it has to finish
    /// itself.
    void flush() {
        move(staged_);
        finish_streams();
    }

    Offset bytes() const {
        auto sum = static_cast<Offset>(staging_.bytes());
        for (const auto& chunk : chunks_) sum += static_cast<Offset>(chunk.size() * sizeof(Slot));
        return sum;
    }

private:
    static constexpr Offset staging_size = 1024;
    static constexpr Offset smallest_chunk = smallest_bytes / Offset{sizeof(Slot)},
                            largest_chunk = Offset{1} << 24;

    Offset size(std::size_t chunk) const { return static_cast<Offset>(chunks_[chunk].size()); }

    /// Chunks double, so that small searches hold little and large ones lie in huge pages.
    void next_chunk(Offset room) {
        move(staged_);
        if (!chunks_.empty() && top_ > 0) ++chunk_;
        top_ = 0;
        while (chunk_ < chunks_.size() && size(chunk_) < room) ++chunk_;
        if (chunk_ < chunks_.size()) return;
        Offset n = smallest_chunk;
        for (const auto& chunk : chunks_) n += static_cast<Offset>(chunk.size());
        chunks_.push_back(
            allocate<Slot>("search/groups/arena", std::max(room, std::min(n, largest_chunk))));
    }

    /// Whole lines leave, the rest comes to the front.
    void move_lines() {
        const Offset whole = staged_ / slots_per_line * slots_per_line, rest = staged_ - whole;
        move(whole);
        std::memmove(staging_.data(), staging_.data() + whole, rest * sizeof(Slot));
        staged_ = rest;
    }

    void move(Offset n) {
        if (n == 0) return;
        Slot* const to = chunks_[chunk_].data() + top_;
        if (past_caches_)
            stream_copy(to, staging_.data(), n);
        else
            std::memcpy(to, staging_.data(), n * sizeof(Slot));
        top_ += n;
        staged_ -= n;
    }

    std::vector<View<Slot>> chunks_;
    Buffer<Slot> staging_;
    std::size_t chunk_ = 0, n_used_ = 0;
    Offset top_ = 0, staged_ = 0;
    bool past_caches_ = false;
};

}  // namespace connectivity::detail
