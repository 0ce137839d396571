// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// M2L with the order known to the compiler: every loop is unrolled and every matrix entry is a
/// constant in the instruction stream. The steps are those of m2l in expansion_cells.hpp.

#include "expansion_cells.hpp"
#include "expansion_unroll.hpp"

namespace connectivity::detail {
namespace {

/// turn_about_z of a degree.
template <class V, bool Conjugate, int N>
CONNECTIVITY_INLINE inline void turn_degree(const Complex<V>* power, const typename V::D* in,
                                            typename V::D* out) {
    out[0] = in[0];
    each<1, N>([&](auto m) CONNECTIVITY_INLINE {
        const auto re = in[2 * m - 1], im = in[2 * m], c = power[m].re, s = power[m].im;
        const auto a = V::mul(re, c), b = V::mul(im, c);
        out[2 * m - 1] = Conjugate ? V::fma(im, s, a) : V::fnma(im, s, a);
        out[2 * m] = Conjugate ? V::fnma(re, s, b) : V::fma(re, s, b);
    });
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
        if constexpr (L > 0) out[2 * L] = swap_row<V, Locals, true, N, L, odd + 1, In>(in);
    });
}

/// The orders m <= used of degree N are what the middle of M2L reads and writes.
template <int P, int N>
constexpr int used = N < P - N ? N : P - N;

template <class V, int N, int Out>
__attribute__((noinline)) void degree_to_axis(const Frame<V>& frame, const typename V::D* in,
                                              typename V::D* out) {
    typename V::D a[2 * N + 1], b[2 * N + 1];
    turn_degree<V, false, N>(frame.azimuth, in, a);
    swap_degree<V, false, N, N, N>(a, b);
    turn_degree<V, false, N>(frame.height, b, a);
    swap_degree<V, false, N, N, Out>(a, out);
}

/// Adds factor times the turned degree to `sums`.
template <class V, int N, int In>
__attribute__((noinline)) void degree_from_axis(const Frame<V>& frame, typename V::D factor,
                                                const typename V::D* in, typename V::D* sums) {
    typename V::D a[2 * N + 1], b[2 * N + 1];
    swap_degree<V, true, N, In, N>(in, a);
    turn_degree<V, true, N>(frame.height, a, b);
    swap_degree<V, true, N, N, N>(b, a);
    turn_degree<V, true, N>(frame.azimuth, a, b);
    each<0, 2 * N>([&](auto j) CONNECTIVITY_INLINE { sums[j] = V::fma(factor, b[j], sums[j]); });
}

/// degree_from_axis of m = 0 alone: what is exchanged again has only real parts for even m, and
/// only imaginary parts for odd m.
template <class V, int N>
__attribute__((noinline)) void zone_from_axis(const Frame<V>& frame, typename V::D factor,
                                              typename V::D in, typename V::D* sums) {
    typename V::D a[2 * N + 1], b[2 * N + 1];
    each<N % 2, N, 2>([&](auto m) CONNECTIVITY_INLINE {
        const auto x = V::mul(V::set(swaps.locals.cosines(N, m, 0)), in);
        a[m > 0 ? 2 * m - 1 : 0] = m > 0 ? V::mul(x, frame.height[m].re) : x;
        if constexpr (m > 0) a[2 * m] = V::mul(x, frame.height[m].im);  // not yet conjugated
    });
    each<0, N>([&](auto l) CONNECTIVITY_INLINE {
        constexpr int L = l;
        constexpr bool sine = L % 2 == 1;
        constexpr int lowest = sine && N % 2 == 0 ? 2 : N % 2;
        b[L] = swap_row<V, true, sine, N, L, lowest, N>(a);
    });
    sums[0] = V::fma(factor, b[0], sums[0]);
    each<1, N>([&](auto l) CONNECTIVITY_INLINE {
        constexpr int L = l;
        const auto x = V::mul(factor, b[L]), c = frame.azimuth[L].re, s = frame.azimuth[L].im;
        if constexpr (L % 2 == 0) {
            sums[2 * L - 1] = V::fma(x, c, sums[2 * L - 1]);
            sums[2 * L] = V::fnma(x, s, sums[2 * L]);
        } else {
            sums[2 * L - 1] = V::fnma(x, s, sums[2 * L - 1]);
            sums[2 * L] = V::fnma(x, c, sums[2 * L]);
        }
    });
}

/// out_nm = (-1)^m sum_k (n+k)! source_k in_km
template <class V, int P>
__attribute__((noinline)) void middle(const typename V::D* source, const typename V::D* in,
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

/// T_nm of the directions from the vectors r, n <= P; returns 1 / |r|.
template <class V, int P>
CONNECTIVITY_INLINE inline typename V::D unit_harmonics(const typename V::D (&r)[3],
                                                        typename V::D* out) {
    using D = typename V::D;
    const D zero = V::set(0);
    const D inverse = V::rsqrt(V::fma(r[0], r[0], V::fma(r[1], r[1], V::mul(r[2], r[2]))));
    const D back = V::sub(zero, inverse);
    const Complex<V> xy{V::mul(r[0], back), V::mul(r[1], back)};
    const D z = V::mul(r[2], back);
    Complex<V> e{V::set(1), zero};
    each<0, P>([&](auto order) CONNECTIVITY_INLINE {
        constexpr int m = order;
        if constexpr (m == 1) e = xy;
        if constexpr (m > 1)
            e = e * Complex<V>{V::mul(V::set(2 * m - 1), xy.re), V::mul(V::set(2 * m - 1), xy.im)};
        D below = zero, f = V::set(1);
        each<m, P>([&](auto degree) CONNECTIVITY_INLINE {
            constexpr int n = degree;
            if constexpr (n == m + 1) {
                below = f;
                f = V::mul(V::set(2 * n - 1), z);
            } else if constexpr (n > m) {
                const D next = V::fma(V::mul(V::set(2 * n - 1), z), f,
                                      V::mul(V::set(m * m - (n - 1) * (n - 1)), below));
                below = f;
                f = next;
            }
            if constexpr (m == 0) {
                out[n * n] = f;
            } else {
                out[n * n + 2 * m - 1] = n == m ? e.re : V::mul(f, e.re);
                out[n * n + 2 * m] = n == m ? e.im : V::mul(f, e.im);
            }
        });
    });
    return inverse;
}

/// Adds factor sum_kl conj(M_kl) T_n+k,m+l to F_nm for one n, without turns: O(P^4) in all, and the
/// fastest for small orders. Terms with l and -l are taken together, M_k,-l = (-1)^l conj(M_kl), so
/// that real vectors are multiplied by real matrices made of sums and differences of T.
template <class V, int P, int n>
CONNECTIVITY_INLINE inline void add_products(const typename V::D* t, const typename V::D* in,
                                             typename V::D factor, typename V::D* sums) {
    using D = typename V::D;
    const auto add = [](D& sum, D a, D b) CONNECTIVITY_INLINE { sum = V::fma(a, b, sum); };
    each<0, n>([&](auto order) CONNECTIVITY_INLINE {
        constexpr int m = order;
        D f_re = V::set(0), f_im = V::set(0);
        each<0, P - n>([&](auto degree) CONNECTIVITY_INLINE {
            constexpr int k = degree;
            const D* const c = in + k * k;
            const D* const T = t + (n + k) * (n + k);
            const auto re = [&](int o) CONNECTIVITY_INLINE { return T[o > 0 ? 2 * o - 1 : 0]; };
            const auto im = [&](int o) CONNECTIVITY_INLINE { return T[2 * o]; };
            add(f_re, c[0], re(m));
            if constexpr (m > 0) add(f_im, c[0], im(m));
            each<1, k>([&](auto l) CONNECTIVITY_INLINE {
                const D c_re = c[2 * l - 1], c_im = c[2 * l];
                if constexpr (m == 0) {
                    add(f_re, c_re, V::add(re(l), re(l)));
                    add(f_re, c_im, V::add(im(l), im(l)));
                } else {
                    // T_m-l is (-1)^d conj(T_d) where m < l
                    constexpr int d = m > l ? m - l : l - m;
                    constexpr bool minus_re = (m >= l ? l : m) % 2 == 1;
                    constexpr bool minus_im = m >= l ? l % 2 == 1 : m % 2 == 0;
                    const D p_re = re(m + l), p_im = im(m + l), q = re(d);
                    add(f_re, c_re, minus_re ? V::sub(p_re, q) : V::add(p_re, q));
                    f_im = minus_re ? V::fnma(c_im, V::add(p_re, q), f_im)
                                    : V::fma(c_im, V::sub(q, p_re), f_im);
                    const D plus = d == 0 ? p_im : V::add(p_im, im(d)),
                            minus = d == 0 ? p_im : V::sub(p_im, im(d));
                    add(f_re, c_im, minus_im ? plus : minus);
                    add(f_im, c_re, minus_im ? minus : plus);
                }
            });
        });
        constexpr int at = n * n + (m > 0 ? 2 * m - 1 : 0);
        sums[at] = V::fma(factor, f_re, sums[at]);
        if constexpr (m > 0) sums[at + 1] = V::fma(factor, f_im, sums[at + 1]);
    });
}

template <class V, int P>
void m2l_direct(const CellArrays& cells, const CellList& sources, const Expansion& target) {
    using D = typename V::D;
    constexpr int n = n_coefficients(P);
    D in[n + 3], t[n], sums[n];
    for (D& sum : sums) sum = V::set(0);
    for (std::int64_t first = 0; first < sources.n; first += V::lanes) {
        Lanes<V> lanes(cells, sources, first, target.centre);
        lanes.gather(cells, n, in);
        const D inverse = unit_harmonics<V, P>(lanes.r, t);
        D from[P + 1], to[P + 1];
        powers<V>(P, lanes.weight, V::mul(lanes.scale, inverse), from);
        powers<V>(P, inverse, V::mul(V::set(-target.scale), inverse), to);
        each<0, P>([&](auto k) CONNECTIVITY_INLINE {
            each<k * k, (k + 1) * (k + 1) - 1>(
                [&](auto j) CONNECTIVITY_INLINE { in[j] = V::mul(in[j], from[k]); });
        });
        each<0, P>([&](auto k) CONNECTIVITY_INLINE { add_products<V, P, k>(t, in, to[k], sums); });
    }
    add_sums<V>(sums, n, target.coefficients);
}

template <class V, int P>
void m2l_turned(const CellArrays& cells, const CellList& sources, const Expansion& target) {
    using D = typename V::D;
    constexpr int n = n_coefficients(P);
    D in[n + 3], turned[n], sums[n];
    for (D& sum : sums) sum = V::set(0);
    for (std::int64_t first = 0; first < sources.n; first += V::lanes) {
        Lanes<V> lanes(cells, sources, first, target.centre);
        lanes.turn_round();
        lanes.gather(cells, n, in);
        Frame<V> frame;
        frame.set(P, lanes.r);
        D from[P + 1], to[P + 1];
        powers<V>(P, lanes.weight, V::mul(lanes.scale, frame.inverse), from);
        powers<V>(P, frame.inverse, V::mul(V::set(-target.scale), frame.inverse), to);
        each<0, P>([&](auto k) CONNECTIVITY_INLINE {
            degree_to_axis<V, k, used<P, k>>(frame, in + k * k, turned + k * k);
        });
        middle<V, P>(from, turned, in);
        each<0, P>([&](auto k) CONNECTIVITY_INLINE {
            if constexpr (used<P, k> == 0)
                zone_from_axis<V, k>(frame, to[k], in[k * k], sums + k * k);
            else
                degree_from_axis<V, k, used<P, k>>(frame, to[k], in + k * k, sums + k * k);
        });
    }
    add_sums<V>(sums, n, target.coefficients);
}

}  // namespace
}  // namespace connectivity::detail
