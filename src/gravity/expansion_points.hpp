// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Operators between points and expansions: P2M, P2L, L2P, M2P. Vectors of points.
///
/// Particles to an expansion: every coefficient is a vector over particles, summed at the end. An
/// expansion at points: the coefficients of the potential and of its three derivatives are prepared
/// once, and every point sums four products a term.

#include "expansion_harmonics.hpp"
#include "expansion_lanes.hpp"

namespace connectivity::detail {
namespace {

/// Adds mass * harmonics to one vector per coefficient.
template <class V>
struct Collector {
    using D = typename V::D;
    D* sums;
    D mass;
    Complex<V> weight;
    void begin(int, Complex<V> e) { weight = {V::mul(mass, e.re), V::mul(mass, e.im)}; }
    void term(int n, int m, D f) {
        D* const c = sums + n * n + 2 * m;
        if (m > 0) c[-1] = V::fma(f, weight.re, c[-1]);
        *c = V::fma(f, m > 0 ? weight.im : weight.re, *c);
    }
    void end(int, Complex<V>) {}
};

template <class V, bool Regular>
void collect(int order, const Bodies& bodies, const Expansion& to) {
    using D = typename V::D;
    D sums[n_coefficients(max_expansion_order)];
    const int n = n_coefficients(order);
    for (int k = 0; k < n; ++k) sums[k] = V::set(0);
    const double* const position[3] = {bodies.x, bodies.y, bodies.z};
    for (std::int64_t first = 0; first < bodies.n; first += V::lanes) {
        const int some = left<V>(bodies.n, first);
        D r[3];
        for (int a = 0; a < 3; ++a)
            r[a] = V::sub(V::load_some(position[a] + first, some), V::set(to.centre[a]));
        Collector<V> collector{sums, V::load_some(bodies.m + first, some), {}};
        if constexpr (Regular) {
            const D unit = V::set(1 / to.scale);
            // Lanes without a particle are at the centre: far from it, in units of a small cell,
            // they would overflow.
            for (D& x : r) x = first_lanes<V>(some, V::mul(x, unit), V::set(0));
            regular_harmonics<V>(order, r, collector);
        } else {
            if (some < V::lanes) r[0] = first_lanes<V>(some, r[0], V::set(to.scale));
            irregular_harmonics<V>(order, r, to.scale, collector);
        }
    }
    add_sums<V>(sums, n, to.coefficients);
}

/// Coefficients, to be multiplied with harmonics as they are, of the potential and its derivatives:
/// those of harmonic k from 4 k.
struct Gradient {
    double value[4 * n_coefficients(max_expansion_order + 1)];

    /// Local (Rise = -1): d/dx R_n,m = (R_n-1,m-1 - R_n-1,m+1) / 2, d/dy R_n,m = i (R_n-1,m-1 +
    /// R_n-1,m+1) / 2, d/dz R_n,m = R_n-1,m. Moments (Rise = 1): the same of T with n + 1, and
    /// -d/dz.
    template <int Rise>
    void prepare(int order, const double* c, double scale) {
        const int top = Rise > 0 ? order + 1 : order;
        for (int k = 0; k < 4 * n_coefficients(top); ++k) value[k] = 0;
        for (int n = 0; n <= order; ++n)
            for (int k = n * n; k < (n + 1) * (n + 1); ++k)
                value[4 * k] = c[k] * (k > n * n ? 2 : 1);
        for (int n = Rise > 0 ? 0 : 1; n <= order; ++n)
            for (int m = 0; m <= n + Rise; ++m) derive<Rise>(n, m, c + n * n, 1 / scale);
    }

private:
    template <int Rise>
    void derive(int n, int m, const double* c, double unit) {
        const auto re = [=](int k) {
            return k > n || -k > n ? 0 : k < 0 ? -c[1] : k == 0 ? c[0] : c[2 * k - 1];
        };
        const auto im = [=](int k) {
            return k > n || -k > n || k == 0 ? 0 : k < 0 ? c[2] : c[2 * k];
        };
        const int to = n + Rise;
        double* const out = value + 4 * (to * to + (m > 0 ? 2 * m - 1 : 0));
        const double weight = m > 0 ? unit : unit / 2;
        out[1] = weight * (re(m + 1) - re(m - 1));
        out[2] = weight * (im(m + 1) + im(m - 1));
        out[3] = (Rise > 0 ? -2 : 2) * weight * re(m);
        if (m == 0) return;
        out[4 + 1] = weight * (im(m + 1) - im(m - 1));
        out[4 + 2] = -weight * (re(m + 1) + re(m - 1));
        out[4 + 3] = (Rise > 0 ? -2 : 2) * weight * im(m);
    }
};

/// Sums the four products at a vector of points.
template <class V>
struct Evaluator {
    using D = typename V::D;
    const double* coefficients;
    D sum[4];
    D re[4], im[4];
    explicit Evaluator(const Gradient& gradient) : coefficients(gradient.value) {
        for (D& s : sum) s = V::set(0);
    }
    void begin(int, Complex<V>) {
        for (int q = 0; q < 4; ++q) re[q] = im[q] = V::set(0);
    }
    void term(int n, int m, D f) {
        const double* const c = coefficients + 4 * (n * n + 2 * m);
        for (int q = 0; q < 4; ++q) {
            if (m > 0) im[q] = V::fma(f, V::set(c[q]), im[q]);
            re[q] = V::fma(f, V::set(c[m > 0 ? q - 4 : q]), re[q]);
        }
    }
    void end(int m, Complex<V> e) {
        for (int q = 0; q < 4; ++q) {
            sum[q] = V::fma(re[q], e.re, sum[q]);
            if (m > 0) sum[q] = V::fma(im[q], e.im, sum[q]);
        }
    }
};

template <class V>
inline void add_fields(const typename V::D (&sum)[4], std::int64_t first, int some,
                       const Fields& fields) {
    double* const field[4] = {fields.p, fields.ax, fields.ay, fields.az};
    for (int q = 0; q < 4; ++q) {
        double* const at = field[q] + first;
        if (some == V::lanes) {
            V::store(at, V::add(V::load(at), sum[q]));
        } else {
            double lane[V::lanes];
            V::store(lane, sum[q]);
            for (int k = 0; k < some; ++k) at[k] += lane[k];
        }
    }
}

/// Coordinates of a vector of points about a centre; lanes without a point repeat the first.
template <class V>
inline int load_points(const Points& points, std::int64_t first, const double* centre,
                       typename V::D (&r)[3]) {
    const int some = left<V>(points.n, first);
    const double* const position[3] = {points.x + first, points.y + first, points.z + first};
    for (int a = 0; a < 3; ++a) {
        r[a] = V::load_some(position[a], some);
        if (some < V::lanes) r[a] = first_lanes<V>(some, r[a], V::set(position[a][0]));
        r[a] = V::sub(r[a], V::set(centre[a]));
    }
    return some;
}

template <class V>
void l2p(int order, const Expansion& local, const Points& points, const Fields& fields) {
    using D = typename V::D;
    Gradient gradient;
    gradient.prepare<-1>(order, local.coefficients, local.scale);
    const D unit = V::set(1 / local.scale);
    for (std::int64_t first = 0; first < points.n; first += V::lanes) {
        D r[3];
        const int some = load_points<V>(points, first, local.centre, r);
        for (D& x : r) x = V::mul(x, unit);
        Evaluator<V> evaluator(gradient);
        regular_harmonics<V>(order, r, evaluator);
        add_fields<V>(evaluator.sum, first, some, fields);
    }
}

template <class V>
void m2p(int order, const CellArrays& cells, const CellList& sources, const Points& points,
         const Fields& fields) {
    using D = typename V::D;
    Gradient gradient;
    for (std::int64_t k = 0; k < sources.n; ++k) {
        double centre[3];
        const std::int32_t c = sources.id[k];
        place(cells, sources, k, centre);
        gradient.prepare<1>(order, cells.coefficients + c * cells.stride, cells.scale[c]);
        for (std::int64_t first = 0; first < points.n; first += V::lanes) {
            D r[3];
            const int some = load_points<V>(points, first, centre, r);
            Evaluator<V> evaluator(gradient);
            irregular_harmonics<V>(order + 1, r, cells.scale[c], evaluator);
            add_fields<V>(evaluator.sum, first, some, fields);
        }
    }
}

}  // namespace
}  // namespace connectivity::detail
