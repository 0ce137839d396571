// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Grows a tree level by level: boxes over the limit are split, their particles partitioned.
///
/// Each particle carries the bits of its position for the next levels (21 in 3D, 31 in 2D, 63 in
/// 1D); what goes deeper gets the next ones. Two streaming passes a level over the particles of the
/// boxes that are split: count, then scatter into the other of two buffers; slices never move
/// between boxes, so particles that have arrived are written to the final order at once. Large
/// boxes are worked on in blocks whose counts are scanned, so the order is stable and the same for
/// any number of threads.

#include "frame.hpp"
#include "raw_boxes.hpp"

namespace connectivity::tree_detail {

/// A particle on its way down.
struct Entry {
    std::uint64_t key = 0;     ///< bits of the levels below `base`, first axis most significant
    std::int32_t id = 0;       ///< sources, then targets
    std::uint8_t deepest = 0;  ///< level it may enter, for those the key tells
};

struct GrowScratch {
    View<Entry> entries, other;  ///< [n]
    View<std::int32_t> order;    ///< [n]

    Offset bytes() const {
        return static_cast<Offset>((entries.size() + other.size()) * sizeof(Entry) +
                                   order.size() * sizeof(std::int32_t));
    }
};

struct GrowOptions {
    bool adaptive = true;
    bool keep_empty = false;
    bool coincident_leaf = false;
    std::int64_t limit = 0;                 ///< of weight
    const std::int32_t* weights = nullptr;  ///< nullptr: 1 each
    Offset max_boxes = max_slots;           ///< more: Error
};

/// Throws Error{argument} for coincident particles, {too_many}, {memory}.
template <class Real, int Dim>
RawTree grow(const Particles<Real, Dim>& particles, const StickOut<Real, Dim>& stick_out,
             const GrowOptions& options, GrowScratch& scratch);

}  // namespace connectivity::tree_detail
