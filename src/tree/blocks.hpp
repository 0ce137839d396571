// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Slices of boxes cut into blocks of work: large boxes into several blocks, small ones handed out
/// in groups.

#include <algorithm>
#include <utility>

#include <connectivity/base/parallel.hpp>

#include "raw_boxes.hpp"

namespace connectivity::tree_detail {

struct Block {
    std::int32_t owner = 0;           ///< whose particles: index into the selected boxes
    std::int32_t begin = 0, end = 0;  ///< slice of the particles
};

class Blocks {
public:
    /// A box without particles has no block.
    void cut(const RawLevel& boxes, const std::vector<std::int32_t>& selected) {
        blocks_.clear();
        groups_.clear();
        first_.clear();
        Offset in_group = block_size;
        for (const std::int32_t b : selected) {
            first_.push_back(blocks_.size());
            const RawBox& box = boxes[b];
            const auto owner = static_cast<std::int32_t>(first_.size() - 1);
            for (std::int32_t done = 0; done < box.count;) {
                const std::int32_t size = std::min(box.count - done, block_size);
                if (in_group + size > block_size) {
                    groups_.push_back(blocks_.size());
                    in_group = 0;
                }
                in_group += size;
                blocks_.push_back({owner, box.start + done, box.start + done + size});
                done += size;
            }
        }
        first_.push_back(blocks_.size());
        groups_.push_back(blocks_.size());
    }

    std::size_t size() const { return blocks_.size(); }
    /// [first, last) of a selected box.
    std::pair<std::size_t, std::size_t> of(std::size_t selected) const {
        return {first_[selected], first_[selected + 1]};
    }

    /// body(k, block) for each block, in parallel.
    template <class Body>
    void for_each(const char* label, const Body& body) const {
        for_each_dynamic(label, static_cast<Offset>(groups_.size()) - 1, [&](int, Offset g) {
            for (std::size_t k = groups_[g]; k < groups_[g + 1]; ++k)
                body(static_cast<Offset>(k), blocks_[k]);
        });
    }

private:
    static constexpr std::int32_t block_size = 16384;

    std::vector<Block> blocks_;
    std::vector<std::size_t> first_;   // [selected + 1]
    std::vector<std::size_t> groups_;  // first block of each group, and the end
};

}  // namespace connectivity::tree_detail
