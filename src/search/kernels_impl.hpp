// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Bodies of the vector kernels over a type `V` of vector operations. Included once by each
/// instruction set's file, after its V; everything lives in an anonymous namespace, so that no two
/// instruction sets share a function.
///
/// V has: lanes, F (vector of floats), load, set, sub, mul, fma, max, le (mask), pack (store the
/// lanes of a mask to the front; may write all lanes), wide_lanes, load_wide, set_wide, gather_rows
/// (columns of dense rows), nearest and the arithmetic for vectors D of doubles, deposit (the k-th
/// bit goes to where the k-th set bit of a word is), load_doubles (16 doubles -> floats in a
/// frame), places.

#include "kernels.hpp"

namespace connectivity::detail {
namespace {

/// Squared distance of points to a box.
template <class V, int Dim>
inline typename V::F box_distance2(const typename V::F (&x)[Dim], const typename V::F (&lo)[Dim],
                                   const typename V::F (&hi)[Dim]) {
    typename V::F sum = V::set(0);
    for (int d = 0; d < Dim; ++d) {
        const auto gap = V::max(V::max(V::sub(lo[d], x[d]), V::sub(x[d], hi[d])), V::set(0));
        sum = V::fma(gap, gap, sum);
    }
    return sum;
}

/// Appends points whose distance to a box is within reach.
template <class V, int Dim, bool Uniform>
struct BoxFilter {
    typename V::F lo[Dim], hi[Dim], own, widen;

    BoxFilter(const FrameBox<Dim>& box, float widening)
        : own(V::set(box.t * widening)), widen(V::set(widening)) {
        for (int d = 0; d < Dim; ++d) lo[d] = V::set(box.lo[d]), hi[d] = V::set(box.hi[d]);
    }

    inline void append(const typename V::F (&x)[Dim], typename V::F t, const int* label,
                       CandidateList<Dim>& out) const {
        const auto reach = Uniform ? own : V::max(own, V::mul(t, widen));
        const unsigned keep = V::le(box_distance2<V, Dim>(x, lo, hi), reach);
        for (int d = 0; d < Dim; ++d) V::pack(out.x[d] + out.n, keep, x[d]);
        if (!Uniform) V::pack(out.t + out.n, keep, t);
        V::pack(out.label + out.n, keep, label);
        out.n += V::count(keep);
    }
};

template <int Dim>
inline void pad(CandidateList<Dim>& list) {
    for (int k = list.n; k < list.n + list_slack; ++k) {
        for (int d = 0; d < Dim; ++d) list.x[d][k] = 1e30f;
        list.t[k] = 0;
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

template <class V, int Dim, bool Uniform>
void collect_as(const LeafArray& array, const int* leaves, int n_leaves, const FrameMap<Dim>& map,
                const FrameBox<Dim>& box, CandidateList<Dim>& out) {
    const BoxFilter<V, Dim, Uniform> filter(box, map.widen);
    for (int k = 0; k < n_leaves; ++k) {
        const double* const nodes = array.nodes + static_cast<long>(leaves[k]) * array.stride;
        const int* const label = array.label + static_cast<long>(leaves[k]) * leaf_size;
        for (int v = 0; v < leaf_size; v += V::lanes) {
            typename V::F x[Dim], t = V::set(0);
            for (int d = 0; d < Dim; ++d)
                x[d] = V::load_doubles(nodes + d * leaf_size + v, map.centre[d], map.scale);
            if (!Uniform) t = V::load_doubles(nodes + Dim * leaf_size + v, 0.0, map.t_scale);
            filter.append(x, t, label + v, out);
        }
    }
}

template <class V, int Dim>
void collect(const LeafArray& array, const int* leaves, int n_leaves, const FrameMap<Dim>& map,
             const FrameBox<Dim>& box, CandidateList<Dim>& out) {
    map.uniform ? collect_as<V, Dim, true>(array, leaves, n_leaves, map, box, out)
                : collect_as<V, Dim, false>(array, leaves, n_leaves, map, box, out);
}

template <class V, int Dim, bool Uniform>
void filter_as(const CandidateList<Dim>& in, const FrameBox<Dim>& box, float widen,
               CandidateList<Dim>& out) {
    const BoxFilter<V, Dim, Uniform> filter(box, widen);
    CandidateList<Dim> list = out;  // a local copy keeps the length in a register
    list.n = 0;
    for (int k = 0; k < in.n; k += V::lanes) {
        typename V::F x[Dim];
        for (int d = 0; d < Dim; ++d) x[d] = V::load(in.x[d] + k);
        filter.append(x, Uniform ? V::set(0) : V::load(in.t + k), in.label + k, list);
    }
    // The padding of the last vector lies at infinity and never passes.
    out.n = list.n;
    pad(out);
}

template <class V, int Dim>
void filter(const CandidateList<Dim>& in, const FrameBox<Dim>& box, float widen, bool uniform,
            CandidateList<Dim>& out) {
    uniform ? filter_as<V, Dim, true>(in, box, widen, out)
            : filter_as<V, Dim, false>(in, box, widen, out);
}

template <class V, int Dim, bool Uniform>
int test_as(const LeafTest<Dim>& leaf, const CandidateList<Dim>& list, std::uint64_t* bits,
            Doubt* doubts) {
    const int words = n_words(list.n);
    const auto band = V::set(leaf.band);
    int n_doubts = 0;
    for (int node = 0; node < leaf.n_nodes; ++node) {
        typename V::F x[Dim];
        for (int d = 0; d < Dim; ++d) x[d] = V::set(leaf.x[d][node]);
        const auto own = V::set(leaf.t[node]), own_upper = V::set(leaf.t[node] * leaf.band);
        for (int word = leaf.first_word[node]; word < words; ++word) {
            std::uint64_t sure = 0, maybe = 0;
            for (int v = 0; v < word_size; v += V::lanes) {
                const int k = word * word_size + v;
                const auto dx = V::sub(x[0], V::load(list.x[0] + k));
                auto d2 = V::mul(dx, dx);
                for (int d = 1; d < Dim; ++d) {
                    const auto dy = V::sub(x[d], V::load(list.x[d] + k));
                    d2 = V::fma(dy, dy, d2);
                }
                const auto lower = Uniform ? own : V::max(own, V::load(list.t + k));
                const auto upper = Uniform ? own_upper : V::mul(lower, band);
                sure |= static_cast<std::uint64_t>(V::le(d2, lower)) << v;
                maybe |= static_cast<std::uint64_t>(V::le(d2, upper)) << v;
            }
            bits[node * words + word] = leaf.superset ? maybe : sure;
            if (maybe != sure && !leaf.superset) doubts[n_doubts++] = {node, word, maybe & ~sure};
        }
    }
    return n_doubts;
}

template <class V, int Dim>
int test(const LeafTest<Dim>& leaf, const CandidateList<Dim>& list, std::uint64_t* bits,
         Doubt* doubts) {
    return leaf.uniform ? test_as<V, Dim, true>(leaf, list, bits, doubts)
                        : test_as<V, Dim, false>(leaf, list, bits, doubts);
}

/// H of one node or of several, and the difference it is applied to.
template <class V, int Dim>
inline typename V::D eta2(const typename V::D (&h)[Dim * (Dim + 1) / 2],
                          const typename V::D (&r)[Dim]) {
    // Packed by rows of the upper triangle: where (row, column) stands.
    constexpr int at[3][3] = {{0, 1, 2}, {1, Dim == 2 ? 2 : 3, 4}, {2, 4, 5}};
    typename V::D sum{};
    for (int a = 0; a < Dim; ++a) {
        auto e = V::mul(h[at[a][0]], r[0]);
        for (int b = 1; b < Dim; ++b) e = V::add(e, V::mul(h[at[a][b]], r[b]));
        sum = a == 0 ? V::mul(e, e) : V::add(sum, V::mul(e, e));
    }
    return sum;
}

/// The double predicate of one node against several.
template <class V, int Dim>
struct Predicate {
    static constexpr int n_h = Dim * (Dim + 1) / 2;
    using D = typename V::D;

    const PredicateData<Dim>& nodes;
    D x[Dim], h[n_h], reach2, extent2;
    bool tensor;

    Predicate(const PredicateData<Dim>& data, long slot)
        : nodes(data),
          reach2(V::set_wide(data.reach2[slot])),
          extent2(V::set_wide(data.extent2)),
          tensor(data.H != nullptr && data.H[slot * n_h] != 0.0) {
        for (int d = 0; d < Dim; ++d) x[d] = V::set_wide(data.positions[slot * Dim + d]);
        for (int k = 0; k < n_h; ++k) h[k] = V::set_wide(tensor ? data.H[slot * n_h + k] : 0.0);
    }

    unsigned seen_by(const int* other, const D (&r)[Dim], D r2) const {
        D reach2_of[1];
        V::gather_rows(nodes.reach2, other, reach2_of);
        const unsigned in_ball = V::le(r2, reach2_of[0]);
        if (nodes.H == nullptr) return in_ball;
        D g[n_h];
        V::gather_rows(nodes.H, other, g);
        const unsigned scalar = V::equal(g[0], V::set_wide(0));
        return (in_ball & scalar) | (V::le(eta2<V, Dim>(g, r), extent2) & ~scalar);
    }

    /// Which of the next few others are neighbours.
    unsigned operator()(const int* other) const {
        D r[Dim];
        V::gather_rows(nodes.positions, other, r);
        for (int d = 0; d < Dim; ++d) {
            r[d] = V::sub(x[d], r[d]);
            if (nodes.period[d] > 0) {
                const D length = V::set_wide(nodes.period[d]);
                r[d] = V::sub(r[d], V::mul(length, V::nearest(V::div(r[d], length))));
            }
        }
        D r2 = V::mul(r[0], r[0]);
        for (int d = 1; d < Dim; ++d) r2 = V::add(r2, V::mul(r[d], r[d]));
        constexpr unsigned all = (1u << V::wide_lanes) - 1;
        unsigned found = 0;
        if (nodes.own) found = tensor ? V::le(eta2<V, Dim>(h, r), extent2) : V::le(r2, reach2);
        return nodes.others && found != all ? found | seen_by(other, r, r2) : found;
    }
};

template <class V, int Dim>
void confirm(const PredicateData<Dim>& nodes, int slot, const int* label, int words,
             std::uint64_t* bits) {
    const Predicate<V, Dim> sees(nodes, slot);
    int other[word_size + list_slack];
    for (int w = 0; w < words; ++w) {
        const int n = V::unpack(other, bits[w], label + w * word_size);
        for (int k = n; k < n + V::wide_lanes; ++k) other[k] = slot;
        std::uint64_t found = 0;
        for (int k = 0; k < n; k += V::wide_lanes)
            found |= static_cast<std::uint64_t>(sees(other + k)) << k;
        bits[w] = V::deposit(found, bits[w]);
    }
}

template <class V>
int expand(const std::uint64_t* bits, int words, const int* label, int* out) {
    int n = 0;
    for (int w = 0; w < words; ++w) n += V::unpack(out + n, bits[w], label + w * word_size);
    return n;
}

// Compiled with the population count of V's instruction set.
template <class V>
int count(const std::uint64_t* bits, int place) {
    int n = 0;
    for (int w = 0; w < place / word_size; ++w) n += __builtin_popcountll(bits[w]);
    const int rest = place % word_size;
    return rest > 0 ? n + __builtin_popcountll(bits[place / word_size] << (word_size - rest)) : n;
}

template <class V, int Dim>
constexpr Kernels<Dim> make_kernels(const char* name) {
    return {name,      near<V, Dim>, collect<V, Dim>, filter<V, Dim>, test<V, Dim>, confirm<V, Dim>,
            expand<V>, count<V>,     V::places};
}

}  // namespace
}  // namespace connectivity::detail

#define CONNECTIVITY_DEFINE_KERNELS(function, V, name)                    \
    namespace connectivity::detail {                                      \
    template <int Dim>                                                    \
    const Kernels<Dim>& function() {                                      \
        static constexpr Kernels<Dim> table = make_kernels<V, Dim>(name); \
        return table;                                                     \
    }                                                                     \
    template const Kernels<1>& function<1>();                             \
    template const Kernels<2>& function<2>();                             \
    template const Kernels<3>& function<3>();                             \
    }
