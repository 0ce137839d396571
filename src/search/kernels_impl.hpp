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

#include "kernels_confirm.hpp"
#include "kernels_narrow.hpp"
#include "metric.hpp"

namespace connectivity::detail {
namespace {

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
    return {name,
            near<V, Dim>,
            collect<V, Dim>,
            filter<V, Dim, false>,
            filter<V, Dim, true>,
            metrics<V, Dim>,
            test<V, Dim>,
            confirm<V, Dim>,
            expand<V>,
            count<V>,
            V::places};
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
