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

/// Coefficients (j, q) ... (j, q + columns - 1) of one vector of lanes. Columns share the loads of
/// moments, and sums run in four parts each, so that additions need not wait for each other.
template <class V, int columns>
inline void add_locals(int order, int j, int q, const LatticeTerm* terms, const double* moments,
                       double* locals) {
    using D = typename V::D;
    D re[columns], im[columns], re2[columns], im2[columns];
    for (int c = 0; c < columns; ++c) re[c] = im[c] = re2[c] = im2[c] = V::set(0);
    for (int k = 0; k <= order - j; ++k) {
        const LatticeTerm* t[columns];
        const double* const m = moments + n_reflections * k * k;
        const D real = V::load(m);
        for (int c = 0; c < columns; ++c) {
            t[c] = terms + lattice_term(j + k, q + c);
            re[c] = V::fma(real, V::set(t[c]->s_re), re[c]);
            im[c] = V::fma(real, V::set(t[c]->s_im), im[c]);
        }
        for (int l = 1; l <= k; ++l) {
            const D a = V::load(m + n_reflections * (2 * l - 1));
            const D b = V::load(m + n_reflections * 2 * l);
            for (int c = 0; c < columns; ++c) {
                const LatticeTerm& term = t[c][l];
                re[c] = V::fma(a, V::set(term.s_re), re[c]);
                im[c] = V::fma(a, V::set(term.s_im), im[c]);
                re2[c] = V::fnma(b, V::set(term.d_im), re2[c]);
                im2[c] = V::fma(b, V::set(term.d_re), im2[c]);
            }
        }
    }
    const D sign = V::set(j % 2 == 0 ? 1 : -1);
    for (int c = 0; c < columns; ++c) {
        const bool real = q + c == 0;
        double* const to = locals + n_reflections * (real ? j * j : j * j + 2 * (q + c) - 1);
        V::store(to, V::fma(sign, V::add(re[c], re2[c]), V::load(to)));
        if (real) continue;
        double* const next = to + n_reflections;
        V::store(next, V::fma(sign, V::add(im[c], im2[c]), V::load(next)));
    }
}

template <class V>
inline void apply_lattice(int order, const double* sums, const double* moments, double* locals) {
    LatticeTerm terms[n_lattice_terms(max_lattice_order)];
    make_terms(order, sums, terms);
    for (int first = 0; first < n_reflections; first += V::lanes)
        for (int j = 0; j <= order; ++j)
            for (int q = 0; q <= j; q += 2) {
                const double* const from = moments + first;
                if (q < j) {
                    add_locals<V, 2>(order, j, q, terms, from, locals + first);
                } else {
                    add_locals<V, 1>(order, j, q, terms, from, locals + first);
                }
            }
}

}  // namespace
}  // namespace connectivity::detail
