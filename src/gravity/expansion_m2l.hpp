// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// M2L with the order known to the compiler: every loop is unrolled and every matrix entry is a
/// constant in the instruction stream. The steps are those of m2l in expansion_cells.hpp.

#include "expansion_cells.hpp"

#define CONNECTIVITY_INLINE __attribute__((always_inline))

namespace connectivity::detail {
namespace {

template <int K>
struct Int {
    constexpr operator int() const { return K; }
};

/// f(Int<First>), f(Int<First + Step>), ... up to Last.
template <int First, int Last, int Step = 1, class F>
CONNECTIVITY_INLINE inline void each(F&& f) {
    if constexpr (First <= Last) {
        f(Int<First>{});
        each<First + Step, Last, Step>(f);
    }
}

/// Row l of the exchange of x and z of degree N: input with m = First, First + 2, ..., at most In.
template <class V, bool Locals, bool Sine, int N, int L, int First, int In>
CONNECTIVITY_INLINE inline typename V::D swap_row(const typename V::D* in) {
    constexpr auto entry = [](int m) {
        const Swap& swap = Locals ? swaps.locals : swaps.moments;
        return Sine ? swap.sines(N, L, m) : swap.cosines(N, L, m);
    };
    if constexpr (First > In) {
        return V::set(0);
    } else {
        constexpr int shift = Sine || First == 0 ? 0 : -1;
        auto sum = V::mul(V::set(entry(First)), in[2 * First + shift]);
        each<First + 2, In, 2>([&](auto m) CONNECTIVITY_INLINE {
            constexpr double factor = entry(m);
            sum = V::fma(V::set(factor), in[Sine ? 2 * m : 2 * m - 1], sum);
        });
        return sum;
    }
}

template <class V, bool Locals, int N, int In, int Out>
CONNECTIVITY_INLINE inline void swap_degree(const typename V::D* in, typename V::D* out) {
    each<0, Out>([&](auto l) CONNECTIVITY_INLINE {
        constexpr int L = l, odd = (N - L) % 2;
        out[L > 0 ? 2 * L - 1 : 0] = swap_row<V, Locals, false, N, L, odd, In>(in);
        if constexpr (L > 0)
            out[2 * L] = swap_row < V, Locals, true, N, L, odd == 0 ? 1 : 2, In > (in);
    });
}

/// The degree N and least(N, P - N), which orders of m the middle of M2L uses.
template <int P, int N>
constexpr int used = N < P - N ? N : P - N;

template <class V, int N, int Out>
CONNECTIVITY_INLINE inline void degree_to_axis(const Frame<V>& frame, const typename V::D* in,
                                               typename V::D* out) {
    typename V::D a[2 * N + 1], b[2 * N + 1];
    turn_about_z<V, false>(N, frame.azimuth, in, a);
    swap_degree<V, false, N, N, N>(a, b);
    turn_about_z<V, false>(N, frame.height, b, a);
    swap_degree<V, false, N, N, Out>(a, out);
}

/// Adds factor times the turned degree to `sums`.
template <class V, int N, int In>
CONNECTIVITY_INLINE inline void degree_from_axis(const Frame<V>& frame, typename V::D factor,
                                                 const typename V::D* in, typename V::D* sums) {
    typename V::D a[2 * N + 1], b[2 * N + 1];
    swap_degree<V, true, N, In, N>(in, a);
    turn_about_z<V, true>(N, frame.height, a, b);
    swap_degree<V, true, N, N, N>(b, a);
    turn_about_z<V, true>(N, frame.azimuth, a, b);
    each<0, 2 * N>([&](auto j) CONNECTIVITY_INLINE { sums[j] = V::fma(factor, b[j], sums[j]); });
}

/// out_nm = (-1)^m sum_k (n+k)! source_k in_km
template <class V, int P>
CONNECTIVITY_INLINE inline void middle(const typename V::D* source, const typename V::D* in,
                                       typename V::D* out) {
    each<0, P / 2>([&](auto m) CONNECTIVITY_INLINE {
        constexpr int M = m;
        each<M == 0 ? 0 : -1, 0>([&](auto part) CONNECTIVITY_INLINE {
            constexpr int at = 2 * M + part;
            typename V::D scaled[P - 2 * M + 1];
            each<M, P - M>([&](auto k) CONNECTIVITY_INLINE {
                scaled[k - M] = V::mul(in[k * k + at], source[k]);
            });
            each<M, P - M>([&](auto n) CONNECTIVITY_INLINE {
                constexpr int N = n;
                constexpr double sign = M % 2 == 0 ? 1 : -1;
                constexpr double first = sign * factorial.value[N + M];
                auto sum = V::mul(V::set(first), scaled[0]);
                each<M + 1, P - N>([&](auto k) CONNECTIVITY_INLINE {
                    constexpr double factor = sign * factorial.value[N + k];
                    sum = V::fma(V::set(factor), scaled[k - M], sum);
                });
                out[N * N + at] = sum;
            });
        });
    });
}

template <class V, int P>
void m2l_turned(const CellArrays& cells, const CellList& sources, const Expansion& target) {
    using D = typename V::D;
    constexpr int n = n_coefficients(P);
    D in[n + 7], turned[n], sums[n];
    for (D& sum : sums) sum = V::set(0);
    for (std::int64_t first = 0; first < sources.n; first += V::lanes) {
        const Lanes<V> lanes(cells, sources, first, target.centre, -1);
        lanes.gather(cells, n, in);
        const Frame<V> frame(P, lanes.r);
        D from[P + 1], to[P + 1];
        powers<V>(P, V::set(1), V::mul(lanes.scale, frame.inverse), from);
        powers<V>(P, frame.inverse, V::mul(V::set(-target.scale), frame.inverse), to);
        each<0, P>([&](auto k) CONNECTIVITY_INLINE {
            degree_to_axis<V, k, used<P, k>>(frame, in + k * k, turned + k * k);
        });
        middle<V, P>(from, turned, in);
        each<0, P>([&](auto k) CONNECTIVITY_INLINE {
            degree_from_axis<V, k, used<P, k>>(frame, to[k], in + k * k, sums + k * k);
        });
    }
    add_sums<V>(sums, n, target.coefficients);
}

}  // namespace
}  // namespace connectivity::detail
