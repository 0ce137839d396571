// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// M2P of orders 1 and 2, the tree walk's kernel: Cartesian, about 50 vector operations for a
/// vector of points and a cell.
///
/// With d = x - c, u = s d / |d|², dipole D and quadrupole Q (symmetric, without trace) in units of
/// the scale s, and v = D + Q u:
///     p = (m + D.u + u.Q u / 2) / |d|        a = (s v - (m + 3 D.u + 5/2 u.Q u) d) / |d|³

#include "expansion_points.hpp"
#include "expansion_unroll.hpp"

namespace connectivity::detail {
namespace {

struct Quadrupole {
    double centre[3], scale, mass, dipole[3], xx, yy, zz, xy, xz, yz;

    /// From moments: R_10 = z, R_11 = (x + iy)/2, R_20 = (2z² - x² - y²)/4, R_21 = (x + iy) z/2,
    /// R_22 = (x + iy)²/8; Q is sum m (3 x x - r²).
    void set(int order, const CellArrays& cells, const CellList& list, std::int64_t k) {
        place(cells, list, k, centre);
        const std::int32_t c = list.id[k];
        const double* const M = cells.coefficients + c * cells.stride;
        scale = cells.scale[c];
        mass = M[0];
        dipole[0] = 2 * M[2], dipole[1] = 2 * M[3], dipole[2] = M[1];
        xx = yy = zz = xy = xz = yz = 0;
        if (order < 2) return;
        zz = 4 * M[4];
        xz = 6 * M[5], yz = 6 * M[6];
        xx = 12 * M[7] - zz / 2, yy = -12 * M[7] - zz / 2, xy = 12 * M[8];
    }
};

template <class V>
struct WalkSums {
    using D = typename V::D;
    D p, a[3];
    CONNECTIVITY_INLINE void add(const Quadrupole& q, const D (&x)[3]) {
        const D d[3] = {V::sub(x[0], V::set(q.centre[0])), V::sub(x[1], V::set(q.centre[1])),
                        V::sub(x[2], V::set(q.centre[2]))};
        const D inverse = V::rsqrt(V::fma(d[0], d[0], V::fma(d[1], d[1], V::mul(d[2], d[2]))));
        const D inverse2 = V::mul(inverse, inverse), scale = V::set(q.scale);
        const D unit = V::mul(scale, inverse2);
        const D u[3] = {V::mul(d[0], unit), V::mul(d[1], unit), V::mul(d[2], unit)};
        const auto row = [&](double c, double x0, double x1, double x2) CONNECTIVITY_INLINE {
            return V::fma(V::set(x0), u[0],
                          V::fma(V::set(x1), u[1], V::fma(V::set(x2), u[2], V::set(c))));
        };
        const D v[3] = {row(q.dipole[0], q.xx, q.xy, q.xz), row(q.dipole[1], q.xy, q.yy, q.yz),
                        row(q.dipole[2], q.xz, q.yz, q.zz)};
        const D uv = V::fma(u[0], v[0], V::fma(u[1], v[1], V::mul(u[2], v[2])));
        const D ud = V::fma(V::set(q.dipole[0]), u[0],
                            V::fma(V::set(q.dipole[1]), u[1], V::mul(V::set(q.dipole[2]), u[2])));
        const D half = V::mul(V::set(0.5), V::add(uv, ud)), mass = V::set(q.mass);
        p = V::fma(inverse, V::add(mass, half), p);
        const D cube = V::mul(inverse2, inverse), side = V::mul(cube, scale),
                back = V::mul(cube, V::add(mass, V::fma(V::set(2), uv, half)));
        for (int k = 0; k < 3; ++k) a[k] = V::fnma(back, d[k], V::fma(side, v[k], a[k]));
    }
};

template <class V>
void walk_m2p(int order, const CellArrays& cells, const CellList& sources, const Points& points,
              const Fields& fields) {
    using D = typename V::D;
    constexpr int chunk = 32;
    Quadrupole quadrupoles[chunk];
    const double origin[3] = {0, 0, 0};
    for (std::int64_t begin = 0; begin < sources.n; begin += chunk) {
        const int n = static_cast<int>(sources.n - begin < chunk ? sources.n - begin : chunk);
        for (int k = 0; k < n; ++k) quadrupoles[k].set(order, cells, sources, begin + k);
        for (std::int64_t first = 0; first < points.n; first += V::lanes) {
            D x[3];
            const int some = load_points<V>(points, first, origin, x);
            WalkSums<V> sums{V::set(0), {V::set(0), V::set(0), V::set(0)}};
            for (int k = 0; k < n; ++k) sums.add(quadrupoles[k], x);
            add_fields<V>({sums.p, sums.a[0], sums.a[1], sums.a[2]}, first, some, fields);
        }
    }
}

}  // namespace
}  // namespace connectivity::detail
