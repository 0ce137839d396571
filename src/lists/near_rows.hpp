// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// For every box T, in depth-first order, the boxes of its level that are near (and T itself), and
/// those as large or larger whose own sources no list 4 of T or its ancestors has taken. All lists
/// follow from a box's row, or from its parent's.
///
/// A row is made of the parent's: what is near T is a child of what is near the parent, what T has
/// to deal with the parent has left. Nothing but offsets between near boxes is needed, twice the
/// offset of the parents plus the difference of two bits, and these are small at any depth. Whether
/// boxes of different levels touch is told by where they touched when they were of one level: along
/// an axis on which they lay side by side only children on that side keep touching.
///
/// Cost: 12 bytes an entry, 40 a box; one pass over the entries, and one over those of the parents,
/// which by bit counts finds the sizes of list 2 and of nws rows, and room for each row that is
/// larger than the row only by what list 4 takes.

#include <array>
#include <bit>
#include <vector>

#include <connectivity/lists/traversal_options.hpp>

#include "chunks.hpp"
#include "separation.hpp"
#include "tree_tables.hpp"

namespace connectivity::detail {

/// One box seen from another one, T.
struct Near {
    /// Of `state`: the 3 lowest bits are axes on which the boxes lie side by side, the next 3 those
    /// of them on which the child that keeps touching is the upper one. The smaller box of the two
    /// has that child: `box`, unless it is bigger than T.
    static constexpr unsigned is_bigger = 0x80, is_apart = 0x40;  // apart: does not touch T
    static constexpr unsigned is_open = 1;  // of what is apart: own sources T has to deal with

    BoxId box;
    std::array<std::int16_t, 3> offset;  ///< box minus T, in boxes; for those of T's level
    std::uint8_t state;
    ImageCode image;

    bool bigger() const { return state & is_bigger; }
    bool apart() const { return state & is_apart; }
    bool open() const { return apart() && (state & is_open); }
};

/// Does child number m of the smaller of two boxes that touch, touch the other?
inline bool child_touches(unsigned state, unsigned m) {
    return ((m ^ (state >> 3)) & state & 7u) == 0;
}

/// The row of a box, and what its making counted.
struct NearRow {
    const Near *first = nullptr, *last = nullptr;
    Offset n_same_level = 0, n_from_sep_siblings = 0, n_from_sep_bigger = 0;
    const Near* begin() const { return first; }
    const Near* end() const { return last; }
};

/// What is kept for the next build.
struct NearScratch {
    View<NearRow> rows;              ///< [n_boxes]
    std::vector<View<Near>> levels;  ///< entries of the rows of each level
    std::vector<Offset> starts;      ///< of chunks of the level that is being made
    /// [axis][bit of the target][offset of the parents + n]: children that are near along the axis.
    std::array<std::array<std::vector<std::uint8_t>, 2>, 3> near;

    Offset bytes() const;
};

class NearRows {
public:
    using Row = NearRow;

    /// Boxes without targets below have rows only if nws rows are asked for. Throws Error: budget,
    /// memory.
    NearRows(const TreeTables& tables, const Separation& separation,
             const TraversalOptions& options, NearScratch& scratch);

    const Row& row(BoxId b) const { return rows_[b]; }
    /// Of entries, rows and tables: what a build must hold.
    Offset bytes() const { return bytes_; }

    /// Boxes of the level of b that are near it: all of them in the row but b itself.
    static bool is_same_level(BoxId b, const Near& e) {
        return !e.bigger() && !(e.box == b && e.image == no_image);
    }

    /// f(box, image) for each box in list 2 of b.
    template <class F>
    void from_sep_siblings(BoxId b, const F& f) const;

    /// Entries of the row of b: f(const Near&), and taken(box, image) for those in its list 4.
    template <class F, class Taken>
    void make_row(BoxId b, const F& f, const Taken& taken) const;

private:
    /// Which children of an entry of the parent's row are near a child of the parent.
    struct NearChildren {
        std::array<const std::uint8_t*, 3> of_offset;
        unsigned operator()(const Near& e) const {
            return of_offset[0][e.offset[0]] & of_offset[1][e.offset[1]] &
                   of_offset[2][e.offset[2]];
        }
    };
    NearChildren near_children(unsigned m) const {
        NearChildren children;
        for (std::size_t k = 0; k < 3; ++k)
            children.of_offset[k] =
                scratch_.near[k][(m & axis_bits_[k]) ? 1 : 0].data() + (axis_bits_[k] ? n_ : 0);
        return children;
    }
    Row parent_row(BoxId b) const {
        return b == 0 ? Row{} : row(tables_.tree.box_parent_ids.data()[b]);
    }
    bool has_targets(BoxId b) const { return tables_.flags(b) & target_flags; }
    bool has_row(BoxId b) const { return all_boxes_ || has_targets(b); }
    Near child_of(const Near& e, unsigned m, unsigned of_target) const;
    template <class F, class Taken>
    void settle(BoxId b, Near e, const F& f, const Taken& taken) const;
    void make_axes();
    void make_root();
    void make_level(int level, const Budget& budget);
    Offset count_row(BoxId b);
    View<Near>& take_entries(int level, Offset n, const Budget& budget);

    const TreeTables& tables_;
    const Separation& separation_;
    NearScratch& scratch_;
    int n_ = 1;
    bool all_boxes_ = true;
    std::array<unsigned, 3> axis_bits_{};  // in child numbers; 0: there is no such axis
    Row* rows_ = nullptr;
    Offset bytes_ = 0;
};

template <class F>
void NearRows::from_sep_siblings(BoxId b, const F& f) const {
    const NearChildren near = near_children(tables_.number.data()[b]);
    for (const Near& e : parent_row(b)) {
        if (e.bigger()) continue;
        const BoxId* const children = tables_.children.data() + Offset{e.box} * tables_.n_children;
        for (unsigned far = tables_.mask(e.box) & ~near(e); far != 0; far &= far - 1)
            f(children[std::countr_zero(far)], e.image);
    }
}

/// Keeps a box larger than b, with own sources, that touches its parent or was left by it.
template <class F, class Taken>
void NearRows::settle(BoxId b, Near e, const F& f, const Taken& taken) const {
    if (!e.apart() && child_touches(e.state, tables_.number.data()[b])) return f(e);
    if (separation_.bigger_is_far(b, e.box, e.image)) return taken(e.box, e.image);
    e.state = Near::is_bigger | Near::is_apart | Near::is_open;
    f(e);
}

template <class F, class Taken>
void NearRows::make_row(BoxId b, const F& f, const Taken& taken) const {
    const unsigned m = tables_.number.data()[b];
    const bool targets = has_targets(b);
    const NearChildren near_to = near_children(m);
    for (const Near& e : parent_row(b)) {
        if (targets && e.bigger()) settle(b, e, f, taken);
        if (e.bigger()) continue;
        if (targets && tables_.owns_sources(e.box) && (!e.apart() || e.open())) {
            Near bigger = e;  // from here on children of T are the smaller ones
            if (!e.apart()) bigger.state ^= static_cast<std::uint8_t>((e.state & 7u) << 3);
            bigger.state |= Near::is_bigger;
            settle(b, bigger, f, taken);
        }
        for (unsigned near = tables_.mask(e.box) & near_to(e); near != 0; near &= near - 1) {
            Near c = child_of(e, static_cast<unsigned>(std::countr_zero(near)), m);
            if (c.apart() && targets && tables_.owns_sources(c.box)) {
                if (separation_.bigger_is_far(b, c.box, c.image))
                    taken(c.box, c.image);
                else
                    c.state |= Near::is_open;
            }
            f(c);
        }
    }
}

}  // namespace connectivity::detail
