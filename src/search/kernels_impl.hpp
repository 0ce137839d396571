// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Bodies of the vector kernels over a type `V` of vector operations. Included once by each
/// instruction set's file, after its V; everything lives in an anonymous namespace, so that no two
/// instruction sets share a function.
///
/// V has: lanes, F (vector of floats), load, store, set, sub, mul, div, fma, min, max, sqrt, le
/// (mask), pack (store the lanes of a mask to the front; may write all lanes), wide_lanes,
/// load_wide, set_wide, gather_rows (columns of dense rows), nearest and the arithmetic for vectors
/// D of doubles, deposit (the k-th bit goes to where the k-th set bit of a word is), load_doubles
/// (16 doubles -> floats in a frame), places.

#include "metric.hpp"

namespace connectivity::detail {
namespace {

/// Does entry s of an upper triangle lie on the diagonal?
template <int Dim>
constexpr bool is_diagonal(int s) {
    return s == 0 || s == metric_size<Dim> - 2 || (Dim == 3 && s == 3);
}

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

/// A vector of candidates. What their form does not need is not set.
template <class V, int Dim>
struct Candidates {
    typename V::F x[Dim], t, metric[metric_size<Dim>];
    const int* label;
};

/// Appends points whose distance to a box is within reach.
template <class V, int Dim, Form form>
struct BoxFilter {
    typename V::F lo[Dim], hi[Dim], own, widen;

    BoxFilter(const FrameBox<Dim>& box, float widening)
        : own(V::set(box.t * widening)), widen(V::set(widening)) {
        for (int d = 0; d < Dim; ++d) lo[d] = V::set(box.lo[d]), hi[d] = V::set(box.hi[d]);
    }

    inline void append(const Candidates<V, Dim>& c, CandidateList<Dim>& out) const {
        const auto reach = form == Form::uniform ? own : V::max(own, V::mul(c.t, widen));
        const unsigned keep = V::le(box_distance2<V, Dim>(c.x, lo, hi), reach);
        for (int d = 0; d < Dim; ++d) V::pack(out.x[d] + out.n, keep, c.x[d]);
        if (form != Form::uniform) V::pack(out.t + out.n, keep, c.t);
        if (form == Form::ellipsoids)
            for (int k = 0; k < metric_size<Dim>; ++k)
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

template <class V, int Dim, Form form>
void collect_as(const LeafArray& array, const int* leaves, int n_leaves, const FrameMap<Dim>& map,
                const FrameBox<Dim>& box, CandidateList<Dim>& out) {
    constexpr int n_shape = metric_size<Dim> - 1;
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
                for (int s = 0; s < n_shape; ++s)
                    c.metric[1 + s] =
                        array.shapes != nullptr
                            ? V::load(array.shapes +
                                      (static_cast<long>(leaves[k]) * n_shape + s) * leaf_size + v)
                            : V::set(is_diagonal<Dim>(s) ? 1 : 0);
            c.label = label + v;
            filter.append(c, out);
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

template <class V, int Dim, Form form>
void filter_as(const CandidateList<Dim>& in, const FrameBox<Dim>& box, float widen,
               CandidateList<Dim>& out) {
    const BoxFilter<V, Dim, form> filter(box, widen);
    CandidateList<Dim> list = out;  // a local copy keeps the length in a register
    list.n = 0;
    Candidates<V, Dim> c{};
    for (int k = 0; k < in.n; k += V::lanes) {
        for (int d = 0; d < Dim; ++d) c.x[d] = V::load(in.x[d] + k);
        if (form != Form::uniform) c.t = V::load(in.t + k);
        if (form == Form::ellipsoids)
            for (int m = 0; m < metric_size<Dim>; ++m) c.metric[m] = V::load(in.metric[m] + k);
        c.label = in.label + k;
        filter.append(c, list);
    }
    // The padding of the last vector lies at infinity and never passes.
    out.n = list.n;
    pad<Dim, form>(out);
}

template <class V, int Dim>
void filter(const CandidateList<Dim>& in, const FrameBox<Dim>& box, float widen, Form form,
            CandidateList<Dim>& out) {
    switch (form) {
        case Form::uniform: return filter_as<V, Dim, Form::uniform>(in, box, widen, out);
        case Form::balls: return filter_as<V, Dim, Form::balls>(in, box, widen, out);
        case Form::ellipsoids: return filter_as<V, Dim, Form::ellipsoids>(in, box, widen, out);
    }
}

/// The metric of a node whose float test would not be good, or that sees nobody.
template <int Dim>
inline void set_ball_metric(CandidateList<Dim>& list, int k, const MetricMap& map) {
    const bool blind = list.t[k] < 0;
    const float wide =
        blind ? 0 : __builtin_sqrtf(list.t[k] * map.unit) + map.position_error + 1e-18f;
    list.metric[0][k] = blind ? 2 : 0;
    for (int s = 0; s + 1 < metric_size<Dim>; ++s)
        list.metric[1 + s][k] = is_diagonal<Dim>(s) && !blind ? (1 - 0x1p-20f) / (wide * wide) : 0;
}

template <class V, int Dim>
void metrics(CandidateList<Dim>& list, const MetricMap& map) {
    constexpr unsigned all = (1u << V::lanes) - 1;
    for (int k = 0; k < list.n; k += V::lanes) {
        const auto t = V::mul(V::load(list.t + k), V::set(map.unit));
        auto trace = V::set(0);
        for (int s = 0; s + 1 < metric_size<Dim>; ++s)
            if (is_diagonal<Dim>(s))
                trace = V::fma(V::load(list.metric[1 + s] + k), V::set(1), trace);
        const auto moved =
            V::mul(V::set(position_error * map.position_error), V::sqrt(V::div(trace, t)));
        const auto error = V::fma(V::set(shape_error), trace, moved);
        const auto per_error = V::div(V::set(1), error), scale = V::div(per_error, t);
        unsigned good = V::le(error, V::set(largest_metric_error)) & V::le(V::set(1e-30f), t);
        V::store(list.metric[0] + k, V::sub(V::set(0), per_error));
        for (int s = 0; s + 1 < metric_size<Dim>; ++s) {
            const auto twice = is_diagonal<Dim>(s) ? scale : V::mul(V::set(2), scale);
            float* const entry = list.metric[1 + s] + k;
            V::store(entry, V::mul(V::load(entry), twice));
        }
        for (good |= ~all; ~good != 0; good |= good + 1)
            set_ball_metric(list, k + __builtin_ctz(~good), map);
    }
}

/// Balls: the larger threshold decides.
template <class V, int Dim, bool Uniform>
int test_balls(const LeafTest<Dim>& leaf, const CandidateList<Dim>& list, std::uint64_t* bits,
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
            bits[node * words + word] = sure;
            if (maybe != sure) doubts[n_doubts++] = {node, word, maybe & ~sure};
        }
    }
    return n_doubts;
}

/// The value of a metric, of one node or of several, for the products of a difference.
template <class V, int Dim>
inline typename V::F value(const typename V::F (&metric)[metric_size<Dim>],
                           const typename V::F (&product)[metric_size<Dim> - 1]) {
    auto sum = metric[0];
    for (int s = 0; s + 1 < metric_size<Dim>; ++s) sum = V::fma(metric[1 + s], product[s], sum);
    return sum;
}

/// Ellipsoids: either side decides, or one.
template <class V, int Dim, bool Others>
int test_ellipsoids(const LeafTest<Dim>& leaf, const CandidateList<Dim>& list, std::uint64_t* bits,
                    Doubt* doubts) {
    constexpr int size = metric_size<Dim>;
    const int words = n_words(list.n);
    const auto certain = V::set(-1), possible = V::set(1);
    int n_doubts = 0;
    for (int node = 0; node < leaf.n_nodes; ++node) {
        const int place = leaf.place[node];
        typename V::F x[Dim], own[size];
        for (int d = 0; d < Dim; ++d) x[d] = V::set(list.x[d][place]);
        for (int m = 0; m < size; ++m)
            own[m] = V::set(leaf.own ? list.metric[m][place] : m == 0 ? 2 : 0);
        for (int word = leaf.first_word[node]; word < words; ++word) {
            std::uint64_t sure = 0, maybe = 0;
            for (int v = 0; v < word_size; v += V::lanes) {
                const int k = word * word_size + v;
                typename V::F r[Dim], product[size - 1], other[size];
                for (int d = 0; d < Dim; ++d) r[d] = V::sub(x[d], V::load(list.x[d] + k));
                for (int a = 0, s = 0; a < Dim; ++a)
                    for (int b = a; b < Dim; ++b) product[s++] = V::mul(r[a], r[b]);
                auto q = value<V, Dim>(own, product);
                if (Others) {
                    for (int m = 0; m < size; ++m) other[m] = V::load(list.metric[m] + k);
                    q = V::min(value<V, Dim>(other, product), q);  // q if the other is NaN
                }
                sure |= static_cast<std::uint64_t>(V::le(q, certain)) << v;
                maybe |= static_cast<std::uint64_t>(V::le(q, possible)) << v;
            }
            bits[node * words + word] = sure;
            if (maybe != sure) doubts[n_doubts++] = {node, word, maybe & ~sure};
        }
    }
    return n_doubts;
}

template <class V, int Dim>
int test(const LeafTest<Dim>& leaf, const CandidateList<Dim>& list, std::uint64_t* bits,
         Doubt* doubts) {
    switch (leaf.form) {
        case Form::uniform: return test_balls<V, Dim, true>(leaf, list, bits, doubts);
        case Form::balls: return test_balls<V, Dim, false>(leaf, list, bits, doubts);
        default:
            return leaf.others ? test_ellipsoids<V, Dim, true>(leaf, list, bits, doubts)
                               : test_ellipsoids<V, Dim, false>(leaf, list, bits, doubts);
    }
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
    return {name,         near<V, Dim>,    collect<V, Dim>, filter<V, Dim>, metrics<V, Dim>,
            test<V, Dim>, confirm<V, Dim>, expand<V>,       count<V>,       V::places};
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
