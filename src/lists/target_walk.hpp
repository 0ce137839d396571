// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What a target box has to do with boxes that touch it and with what is below those near it: lists
/// 1, 3 and 3 close, in depth-first order.
///
/// Cost: one visit for each entry and for each box that touches T, and its children. Recursion is
/// as deep as the tree.

#include "near_rows.hpp"

namespace connectivity::detail {

/// Sink: near(S, image) for list 1, smaller(S, image) for list 3, close(S, image) for 3 close;
/// wants_apart() is false where lists 3 are not asked for.
template <class Sink>
class TargetWalk {
public:
    TargetWalk(const TreeTables& tables, const Separation& separation, Sink& sink)
        : tables_(tables), separation_(separation), sink_(sink) {}

    void operator()(BoxId target, NearRows::Row row) {
        target_ = target;
        for (const Near& e : row) {
            image_ = e.image;
            if (e.apart()) {
                if (!e.bigger()) each_child(e.box, [&](BoxId c, unsigned) { apart(c); });
            } else if (e.bigger()) {
                sink_.near(e.box, image_);
            } else {
                touching(e.box, e.state);
            }
        }
    }

private:
    template <class F>
    void each_child(BoxId box, const F& f) const {
        for (unsigned left = tables_.mask(box); left != 0; left &= left - 1) {
            const auto m = static_cast<unsigned>(std::countr_zero(left));
            f(tables_.child(box, static_cast<int>(m)), m);
        }
    }

    void touching(BoxId box, unsigned state) {
        const unsigned flags = tables_.flags(box);
        if (flags & box_flag::has_own_sources) sink_.near(box, image_);
        if (!(flags & box_flag::has_child_sources)) return;
        each_child(box, [&](BoxId c, unsigned m) {
            if (child_touches(state, m))
                touching(c, state);
            else
                apart(c);
        });
    }

    void apart(BoxId box) {
        const unsigned flags = tables_.flags(box);
        if (!(flags & source_flags) || !sink_.wants_apart()) return;
        if (separation_.smaller_is_far(target_, box, image_)) return sink_.smaller(box, image_);
        if (flags & box_flag::has_own_sources) sink_.close(box, image_);
        if (flags & box_flag::has_child_sources)
            each_child(box, [&](BoxId c, unsigned) { apart(c); });
    }

    const TreeTables& tables_;
    const Separation& separation_;
    Sink& sink_;
    BoxId target_ = 0;
    ImageCode image_ = no_image;
};

}  // namespace connectivity::detail
