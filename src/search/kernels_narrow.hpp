// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Vector kernels that narrow: from leaves to candidates, from lists to shorter lists. Part of
/// kernels_impl.hpp, which says what V is.

#include "kernels.hpp"

namespace connectivity::detail {
namespace {

/// Does entry s of an upper triangle lie on the diagonal?
template <int Dim>
constexpr bool is_diagonal(int s) {
    return s == 0 || s == metric_size<Dim> - 2 || (Dim == 3 && s == 3);
}

/// A vector of candidates. What their form does not need is not set.
template <class V, int Dim>
struct Candidates {
    typename V::F x[Dim], t, width[Dim], metric[metric_size<Dim>];
    const int* label;
};

/// Appends points whose distance to a box is within reach; of ellipsoids those only whose own box
/// meets it, or that lie as near as the boxes of the nodes in it.
template <class V, int Dim, Form form>
struct BoxFilter {
    typename V::F lo[Dim], hi[Dim], width[Dim], own, widen;

    BoxFilter(const FrameBox<Dim>& box, float widening)
        : own(V::set(box.t * widening)), widen(V::set(widening)) {
        for (int d = 0; d < Dim; ++d) {
            lo[d] = V::set(box.lo[d]), hi[d] = V::set(box.hi[d]);
            if (form == Form::ellipsoids) width[d] = V::set(box.width[d]);
        }
    }

    inline unsigned near(const Candidates<V, Dim>& c) const {
        auto distance2 = V::set(0), beyond_own = V::set(0), beyond_other = V::set(0);
        for (int d = 0; d < Dim; ++d) {
            const auto gap =
                V::max(V::max(V::sub(lo[d], c.x[d]), V::sub(c.x[d], hi[d])), V::set(0));
            distance2 = V::fma(gap, gap, distance2);
            if (form != Form::ellipsoids) continue;
            beyond_own = V::max(beyond_own, V::sub(gap, width[d]));
            beyond_other = V::max(beyond_other, V::sub(gap, c.width[d]));
        }
        const auto reach = form == Form::uniform ? own : V::max(own, V::mul(c.t, widen));
        const unsigned in_reach = V::le(distance2, reach);
        return form == Form::ellipsoids
                   ? in_reach & V::le(V::min(beyond_own, beyond_other), V::set(0))
                   : in_reach;
    }

    /// `Last`: the list is tested next, what only filters read stays behind.
    template <bool Last>
    inline void append(const Candidates<V, Dim>& c, CandidateList<Dim>& out) const {
        constexpr bool ellipsoids = form == Form::ellipsoids;
        const unsigned keep = near(c);
        for (int d = 0; d < Dim; ++d) V::pack(out.x[d] + out.n, keep, c.x[d]);
        if (form != Form::uniform && !(Last && ellipsoids)) V::pack(out.t + out.n, keep, c.t);
        for (int d = 0; d < Dim && ellipsoids && !Last; ++d)
            V::pack(out.width[d] + out.n, keep, c.width[d]);
        for (int k = 0; k < metric_size<Dim> && ellipsoids; ++k)
            V::pack(out.metric[k] + out.n, keep, c.metric[k]);
        V::pack(out.label + out.n, keep, c.label);
        out.n += V::count(keep);
    }
};

template <int Dim, Form form>
inline void pad(CandidateList<Dim>& list) {
    for (int k = list.n; k < list.n + list_slack; ++k) {
        for (int d = 0; d < Dim; ++d) list.x[d][k] = 1e30f;
        list.t[k] = 0;
        if (form == Form::ellipsoids)
            for (float* entry : list.metric) entry[k] = 0;
        list.label[k] = no_label;
    }
}

template <class V, int Dim>
int near(const LeafBoxes& boxes, long first, long last, const BoxQuery<Dim>& query, int* leaves) {
    const auto bound = [&](int k, long leaf) {
        return V::load_wide(boxes.numbers + k * boxes.stride + leaf);
    };
    const auto own = V::set_wide(query.reach2 > 0 ? query.reach2 : 0.0),
               slack = V::set_wide(query.slack), zero = V::set_wide(0);
    int n = 0;
    for (long leaf = first; leaf < last; leaf += V::wide_lanes) {
        auto sum = zero;
        for (int d = 0; d < Dim; ++d) {
            const auto gap = V::max(V::sub(bound(d, leaf), V::set_wide(query.hi[d])),
                                    V::sub(V::set_wide(query.lo[d]), bound(Dim + d, leaf)));
            const auto outside = V::max(V::sub(gap, slack), zero);
            sum = V::add(sum, V::mul(outside, outside));
        }
        for (unsigned found = V::le(sum, V::max(own, bound(2 * Dim, leaf))); found != 0;
             found &= found - 1)
            leaves[n++] = static_cast<int>(leaf) + __builtin_ctz(found);
    }
    while (n > 0 && leaves[n - 1] >= last) --n;  // those belong to the next block
    return n;
}

/// The shapes and boxes of a vector of nodes that starts at `rows`, a place in the first row; balls
/// if that is null.
template <class V, int Dim>
inline void load_shapes(const float* rows, const FrameMap<Dim>& map, Candidates<V, Dim>& c) {
    constexpr int n_shape = metric_size<Dim> - 1;
    const auto row = [rows](int k, float of_ball) {
        return rows != nullptr ? V::load(rows + k * leaf_size) : V::set(of_ball);
    };
    for (int s = 0; s < n_shape; ++s) c.metric[1 + s] = row(s, is_diagonal<Dim>(s) ? 1 : 0);
    const auto reach = V::sqrt(V::mul(V::max(c.t, V::set(0)), V::set(map.widen)));
    for (int d = 0; d < Dim; ++d)
        c.width[d] = V::fma(row(n_shape + d, 1), reach, V::set(map.position_error));
}

template <class V, int Dim, Form form>
void collect_as(const LeafArray& array, const int* leaves, int n_leaves, const FrameMap<Dim>& map,
                const FrameBox<Dim>& box, CandidateList<Dim>& out) {
    const BoxFilter<V, Dim, form> filter(box, map.widen);
    Candidates<V, Dim> c{};
    for (int k = 0; k < n_leaves; ++k) {
        const double* const nodes = array.nodes + static_cast<long>(leaves[k]) * array.stride;
        const int* const label = array.label + static_cast<long>(leaves[k]) * leaf_size;
        for (int v = 0; v < leaf_size; v += V::lanes) {
            for (int d = 0; d < Dim; ++d)
                c.x[d] = V::load_doubles(nodes + d * leaf_size + v, map.centre[d], map.scale);
            if (form != Form::uniform)
                c.t = V::load_doubles(nodes + Dim * leaf_size + v, 0.0, map.t_scale);
            if (form == Form::ellipsoids)
                load_shapes(array.shapes == nullptr
                                ? nullptr
                                : array.shapes +
                                      static_cast<long>(leaves[k]) * shape_rows<Dim> * leaf_size +
                                      v,
                            map, c);
            c.label = label + v;
            filter.template append<false>(c, out);
        }
    }
}

template <class V, int Dim>
void collect(const LeafArray& array, const int* leaves, int n_leaves, const FrameMap<Dim>& map,
             const FrameBox<Dim>& box, CandidateList<Dim>& out) {
    switch (map.form) {
        case Form::uniform:
            return collect_as<V, Dim, Form::uniform>(array, leaves, n_leaves, map, box, out);
        case Form::balls:
            return collect_as<V, Dim, Form::balls>(array, leaves, n_leaves, map, box, out);
        case Form::ellipsoids:
            return collect_as<V, Dim, Form::ellipsoids>(array, leaves, n_leaves, map, box, out);
    }
}

template <class V, int Dim, Form form, bool Last>
void filter_as(const CandidateList<Dim>& in, const FrameBox<Dim>& box, float widen,
               CandidateList<Dim>& out) {
    const BoxFilter<V, Dim, form> filter(box, widen);
    CandidateList<Dim> list = out;  // a local copy keeps the length in a register
    list.n = 0;
    Candidates<V, Dim> c{};
    for (int k = 0; k < in.n; k += V::lanes) {
        for (int d = 0; d < Dim; ++d) c.x[d] = V::load(in.x[d] + k);
        if (form != Form::uniform) c.t = V::load(in.t + k);
        if (form == Form::ellipsoids) {
            for (int d = 0; d < Dim; ++d) c.width[d] = V::load(in.width[d] + k);
            for (int m = 0; m < metric_size<Dim>; ++m) c.metric[m] = V::load(in.metric[m] + k);
        }
        c.label = in.label + k;
        filter.template append<Last>(c, list);
    }
    // The padding of the last vector lies at infinity and never passes.
    out.n = list.n;
    pad<Dim, form>(out);
}

template <class V, int Dim, bool Last>
void filter(const CandidateList<Dim>& in, const FrameBox<Dim>& box, float widen, Form form,
            CandidateList<Dim>& out) {
    switch (form) {
        case Form::uniform: return filter_as<V, Dim, Form::uniform, Last>(in, box, widen, out);
        case Form::balls: return filter_as<V, Dim, Form::balls, Last>(in, box, widen, out);
        case Form::ellipsoids:
            return filter_as<V, Dim, Form::ellipsoids, Last>(in, box, widen, out);
    }
}

}  // namespace
}  // namespace connectivity::detail
