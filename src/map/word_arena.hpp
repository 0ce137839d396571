// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Memory that a worker takes piece by piece and gives back at once: chunks kept from build to
/// build.
///
/// Invariant: what was taken does not move until `reset`.

#include <algorithm>
#include <cstdint>
#include <vector>

#include <connectivity/base/spaces.hpp>

namespace connectivity::detail {

class WordArena {
public:
    /// n words of 64 bits, uninitialised. Throws Error{memory}, std::bad_alloc.
    std::uint64_t* take(Offset n) {
        while (chunk_ < chunks_.size() && top_ + n > size(chunk_)) ++chunk_, top_ = 0;
        if (chunk_ == chunks_.size()) add_chunk(n);
        return chunks_[chunk_].data() + std::exchange(top_, top_ + n);
    }

    /// Forgets what was taken, keeps the chunks.
    void reset() { chunk_ = 0, top_ = 0; }

    Offset bytes() const {
        Offset sum = 0;
        for (const auto& chunk : chunks_) sum += static_cast<Offset>(chunk.size());
        return sum * Offset{sizeof(std::uint64_t)};
    }

private:
    static constexpr Offset smallest = Offset{1} << 15, largest = Offset{1} << 23;

    Offset size(std::size_t chunk) const { return static_cast<Offset>(chunks_[chunk].size()); }

    /// Chunks double, so that small builds hold little and large ones lie in huge pages.
    void add_chunk(Offset n) {
        const Offset held = bytes() / Offset{sizeof(std::uint64_t)};
        chunks_.push_back(
            allocate<std::uint64_t>("map/arena", std::max(n, std::clamp(held, smallest, largest))));
    }

    std::vector<View<std::uint64_t>> chunks_;
    std::size_t chunk_ = 0;
    Offset top_ = 0;
};

}  // namespace connectivity::detail
