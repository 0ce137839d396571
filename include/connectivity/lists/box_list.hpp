// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Lists of boxes as readers see them: row i belongs to the i-th box of the base that the list
/// names, and holds box numbers.
///
/// Invariants: starts[0] = 0, starts ascend, starts[n_rows] = number of entries. Host memory, valid
/// and unchanged for as long as it is held. Starts are 64-bit; `starts_as_box_ids` is for files
/// and hosts with 32.

#include <array>
#include <span>

#include <connectivity/tree/tree_view.hpp>

namespace connectivity {

/// Which repetition of the root box an entry lies in, where axes are periodic: the shift of each
/// axis is -1, 0 or 1 root extents, the code is (sx + 1) * 9 + (sy + 1) * 3 + (sz + 1).
using ImageCode = std::uint8_t;
constexpr ImageCode no_image = 13;  ///< the shift (0, 0, 0)

constexpr std::array<int, 3> image_shift(ImageCode code) {
    return {code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1};
}

struct BoxList {
    ConstView<Offset> starts;     ///< [n_rows + 1]
    ConstView<BoxId> lists;       ///< [starts(n_rows)]
    ConstView<ImageCode> images;  ///< beside `lists`; empty unless the tree is periodic

    Offset size() const { return starts.size() > 0 ? static_cast<Offset>(starts.size()) - 1 : 0; }
    std::span<const BoxId> operator[](Offset row) const {
        return {lists.data() + starts(row),
                static_cast<std::size_t>(starts(row + 1) - starts(row))};
    }
    ImageCode image(Offset entry) const { return images.size() > 0 ? images(entry) : no_image; }
};

/// List 3 of all target boxes that have any on one level: row j belongs to
/// target_boxes[nonempty_indices[j]], which is target_boxes_sep_smaller[j].
struct LevelBoxList : BoxList {
    ConstView<std::int32_t> nonempty_indices;   ///< [num_nonempty_lists()], ascending
    ConstView<BoxId> target_boxes_sep_smaller;  ///< [num_nonempty_lists()]
    Offset num_nonempty_lists() const { return size(); }
    Offset count() const { return static_cast<Offset>(lists.size()); }
};

/// Copy of starts in the type of box numbers. Throws Error{too_many} if the list has more than
/// 2^31 - 1 entries, Error{memory}.
View<BoxId> starts_as_box_ids(const ConstView<Offset>& starts);

}  // namespace connectivity
