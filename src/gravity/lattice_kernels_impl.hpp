// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What the files of lattice_kernels.hpp have in common, for a vector type V: lanes, load, store,
/// set, add, fma, fnma.
///
/// With M_k,-l = (-1)^l conj(M_kl) the terms l and -l of a sum are Re M_kl S + i Im M_kl D, where
/// S, D = ±conj-or-not T of order q - l, plus or minus T of order q + l: a small table of scalars
/// that all j + k = n share.

#include "lattice_kernels.hpp"

namespace connectivity::detail {
namespace {

constexpr int max_lattice_order = 20;
/// Triples (n, q, l) with q + l <= n <= order.
constexpr int n_lattice_terms(int order) { return (order + 1) * (order + 2) * (order + 3) / 6; }
/// Where the terms (n, q, 0 ... n - q) begin.
constexpr int lattice_term(int n, int q) {
    return n_lattice_terms(n - 1) + q * (n + 1) - q * (q - 1) / 2;
}

struct LatticeTerm {
    double s_re, s_im, d_re, d_im;
};

/// T_nm for m >= 0.
inline void coefficient(const double* sums, int n, int m, double& re, double& im) {
    re = m == 0 ? sums[n * n] : sums[n * n + 2 * m - 1];
    im = m == 0 ? 0 : sums[n * n + 2 * m];
}

inline void make_terms(int order, const double* sums, LatticeTerm* terms) {
    for (int n = 0; n <= order; ++n)
        for (int q = 0; q <= n; ++q)
            for (int l = 0; l <= n - q; ++l, ++terms) {
                double plus_re, plus_im, minus_re, minus_im;
                coefficient(sums, n, q + l, plus_re, plus_im);
                if (l == 0) {
                    *terms = {plus_re, plus_im, 0, 0};
                    continue;
                }
                coefficient(sums, n, q >= l ? q - l : l - q, minus_re, minus_im);
                if (q < l) minus_im = -minus_im;
                if ((q >= l ? l : q) % 2 != 0) minus_re = -minus_re, minus_im = -minus_im;
                *terms = {plus_re + minus_re, plus_im + minus_im, minus_re - plus_re,
                          minus_im - plus_im};
            }
}

/// One coefficient (j, q) of `vectors` vectors of lanes.
template <class V, int vectors>
inline void add_local(int order, int j, int q, const LatticeTerm* terms, const double* moments,
                      double* locals) {
    using D = typename V::D;
    D re[vectors], im[vectors], re2[vectors], im2[vectors];
    for (int v = 0; v < vectors; ++v) re[v] = im[v] = re2[v] = im2[v] = V::set(0);
    for (int k = 0; k <= order - j; ++k) {
        const LatticeTerm* const t = terms + lattice_term(j + k, q);
        const double* const m = moments + n_reflections * k * k;
        for (int v = 0; v < vectors; ++v) {
            const D real = V::load(m + v * V::lanes);
            re[v] = V::fma(real, V::set(t->s_re), re[v]);
            im[v] = V::fma(real, V::set(t->s_im), im[v]);
        }
        for (int l = 1; l <= k; ++l) {
            const D s_re = V::set(t[l].s_re), s_im = V::set(t[l].s_im);
            const D d_re = V::set(t[l].d_re), d_im = V::set(t[l].d_im);
            for (int v = 0; v < vectors; ++v) {
                const D a = V::load(m + n_reflections * (2 * l - 1) + v * V::lanes);
                const D b = V::load(m + n_reflections * 2 * l + v * V::lanes);
                re[v] = V::fma(a, s_re, re[v]);
                im[v] = V::fma(a, s_im, im[v]);
                re2[v] = V::fnma(b, d_im, re2[v]);
                im2[v] = V::fma(b, d_re, im2[v]);
            }
        }
    }
    const D sign = V::set(j % 2 == 0 ? 1 : -1);
    double* const out = locals + n_reflections * (q == 0 ? j * j : j * j + 2 * q - 1);
    for (int v = 0; v < vectors; ++v) {
        double* const to = out + v * V::lanes;
        V::store(to, V::fma(sign, V::add(re[v], re2[v]), V::load(to)));
        if (q == 0) continue;  // real
        double* const next = to + n_reflections;
        V::store(next, V::fma(sign, V::add(im[v], im2[v]), V::load(next)));
    }
}

template <class V, int vectors>
inline void apply_lattice(int order, const double* sums, const double* moments, double* locals) {
    LatticeTerm terms[n_lattice_terms(max_lattice_order)];
    make_terms(order, sums, terms);
    for (int first = 0; first < n_reflections; first += vectors * V::lanes)
        for (int j = 0; j <= order; ++j)
            for (int q = 0; q <= j; ++q)
                add_local<V, vectors>(order, j, q, terms, moments + first, locals + first);
}

}  // namespace
}  // namespace connectivity::detail
