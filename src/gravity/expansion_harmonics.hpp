// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Solid harmonics at a vector of points, degree by degree along each m, without storing them.
///
/// Both kinds are a real factor f_nm, common to real and imaginary part, times a complex factor
/// e_m. A visitor is told `begin(m, e)`, then `term(n, m, f)` for n = m..order, then `end(m, e)`.
/// Cost: 4 vector operations a term.

#include "expansion_constants.hpp"

namespace connectivity::detail {
namespace {

template <class V>
struct Complex {
    using D = typename V::D;
    D re, im;
    friend Complex operator*(Complex a, Complex b) {
        return {V::fnma(a.im, b.im, V::mul(a.re, b.re)), V::fma(a.re, b.im, V::mul(a.im, b.re))};
    }
};

/// R_nm(x, y, z) for n = 0..order.
template <class V, class Visitor>
inline void regular_harmonics(int order, const typename V::D (&r)[3], Visitor& visitor) {
    using D = typename V::D;
    const D r2 = V::fma(r[0], r[0], V::fma(r[1], r[1], V::mul(r[2], r[2])));
    Complex<V> e{V::set(1), V::set(0)};
    for (int m = 0; m <= order; ++m) {
        if (m > 0) {
            const D half = V::set(0.5 / m);
            e = e * Complex<V>{V::mul(half, r[0]), V::mul(half, r[1])};
        }
        visitor.begin(m, e);
        D below = V::set(0), f = V::set(1);
        visitor.term(m, m, f);
        for (int n = m + 1; n <= order; ++n) {
            const D a = V::mul(V::set(recurrence.first[m][n]), r[2]),
                    b = V::mul(V::set(recurrence.second[m][n]), r2);
            const D next = V::fnma(b, below, V::mul(a, f));
            below = f;
            f = next;
            visitor.term(n, m, f);
        }
        visitor.end(m, e);
    }
}

/// T_nm(r / s) / s for n = 0..order, at distances r from a centre.
template <class V, class Visitor>
inline void irregular_harmonics(int order, const typename V::D (&r)[3], double scale,
                                Visitor& visitor) {
    using D = typename V::D;
    const D inverse = V::rsqrt(V::fma(r[0], r[0], V::fma(r[1], r[1], V::mul(r[2], r[2]))));
    const D ratio = V::mul(inverse, V::set(scale)), both = V::mul(inverse, ratio);
    const D x = V::mul(r[0], both), y = V::mul(r[1], both), z = V::mul(r[2], both),
            ratio2 = V::mul(ratio, ratio);
    Complex<V> e{inverse, V::set(0)};
    for (int m = 0; m <= order; ++m) {
        if (m > 0) {
            const D odd = V::set(2 * m - 1);
            e = e * Complex<V>{V::mul(odd, x), V::mul(odd, y)};
        }
        visitor.begin(m, e);
        D below = V::set(0), f = V::set(1);
        visitor.term(m, m, f);
        for (int n = m + 1; n <= order; ++n) {
            const D a = V::mul(V::set(2 * n - 1), z),
                    b = V::mul(V::set((n - 1) * (n - 1) - m * m), ratio2);
            const D next = V::fnma(b, below, V::mul(a, f));
            below = f;
            f = next;
            visitor.term(n, m, f);
        }
        visitor.end(m, e);
    }
}

}  // namespace
}  // namespace connectivity::detail
