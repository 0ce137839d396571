// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Turns that bring a direction to the axis z, one direction per lane.
///
/// A turn about z by m multiplies coefficients (n, m) by the m-th power of a unit number. So the
/// direction is turned into the plane of y and z, the axes x and z are exchanged, it is turned
/// to the new x, and the axes are exchanged again: constant matrices, with half of the entries 0.
/// Cost: about 2 n² products a degree and lane, O(P³) for an expansion, where a general matrix
/// would have to be made for every direction.

#include "expansion_harmonics.hpp"

namespace connectivity::detail {
namespace {

/// The powers of both turns.
template <class V>
struct Frame {
    using D = typename V::D;
    Complex<V> azimuth[max_expansion_order + 1], height[max_expansion_order + 1];
    D inverse;  ///< of the distance; 0 where it is 0

    /// Directions (x, y, z); a null vector counts as the axis z.
    void set(int order, const D (&r)[3]) {
        const D zero = V::set(0), one = V::set(1);
        const D rho2 = V::fma(r[0], r[0], V::mul(r[1], r[1])), r2 = V::fma(r[2], r[2], rho2);
        // next to the axis the azimuth is lost, and does not matter
        const D least = V::mul(r2, V::set(1e-60));
        const D rho_inverse =
            V::select_le(rho2, least, zero, V::rsqrt(V::select_le(rho2, least, one, rho2)));
        inverse = V::select_le(r2, zero, zero, V::rsqrt(V::select_le(r2, zero, one, r2)));
        const D rho = V::mul(rho2, rho_inverse);
        azimuth[1] = {V::select_le(rho2, least, one, V::mul(r[1], rho_inverse)),
                      V::mul(r[0], rho_inverse)};
        height[1] = {V::select_le(r2, zero, one, V::mul(r[2], inverse)),
                     V::sub(zero, V::mul(rho, inverse))};
        azimuth[0] = height[0] = {one, zero};
        for (int m = 2; m <= order; ++m) {
            azimuth[m] = azimuth[m / 2] * azimuth[m - m / 2];
            height[m] = height[m / 2] * height[m - m / 2];
        }
    }
};

/// in times power (or its conjugate) for each m <= n; in and out may be the same.
template <class V, bool Conjugate>
inline void turn_about_z(int n, const Complex<V>* power, const typename V::D* in,
                         typename V::D* out) {
    out[0] = in[0];
    for (int m = 1; m <= n; ++m) {
        const auto re = in[2 * m - 1], im = in[2 * m];
        const auto c = power[m].re, s = power[m].im;
        const auto a = V::mul(re, c), b = V::mul(im, c);
        out[2 * m - 1] = Conjugate ? V::fma(im, s, a) : V::fnma(im, s, a);
        out[2 * m] = Conjugate ? V::fnma(re, s, b) : V::fma(re, s, b);
    }
}

/// Exchanges x and z for degree n. Input with m <= n_in, output with m <= n_out.
template <class V>
inline void swap_axes(int n, const Swap& swap, int n_in, int n_out, const typename V::D* in,
                      typename V::D* out) {
    using D = typename V::D;
    for (int l = 0; l <= n_out; ++l) {
        D sum = V::set(0);
        const int odd = (n - l) % 2;
        for (int m = odd; m <= n_in; m += 2)
            sum = V::fma(V::set(swap.cosines(n, l, m)), in[m > 0 ? 2 * m - 1 : 0], sum);
        out[l > 0 ? 2 * l - 1 : 0] = sum;
        if (l == 0) continue;
        sum = V::set(0);
        for (int m = odd == 0 ? 1 : 2; m <= n_in; m += 2)
            sum = V::fma(V::set(swap.sines(n, l, m)), in[2 * m], sum);
        out[2 * l] = sum;
    }
}

/// Degree n of coefficients turned so that the direction is the axis z; only m <= n_out.
template <class V>
inline void turn_to_axis(int n, const Swap& swap, const Frame<V>& frame, int n_out,
                         const typename V::D* in, typename V::D* out) {
    typename V::D a[2 * max_expansion_order + 1], b[2 * max_expansion_order + 1];
    turn_about_z<V, false>(n, frame.azimuth, in, a);
    swap_axes<V>(n, swap, n, n, a, b);
    turn_about_z<V, false>(n, frame.height, b, b);
    swap_axes<V>(n, swap, n, n_out, b, out);
}

/// The inverse, of coefficients with m <= n_in.
template <class V>
inline void turn_from_axis(int n, const Swap& swap, const Frame<V>& frame, int n_in,
                           const typename V::D* in, typename V::D* out) {
    typename V::D a[2 * max_expansion_order + 1], b[2 * max_expansion_order + 1];
    swap_axes<V>(n, swap, n_in, n, in, a);
    turn_about_z<V, true>(n, frame.height, a, a);
    swap_axes<V>(n, swap, n, n, a, b);
    turn_about_z<V, true>(n, frame.azimuth, b, out);
}

}  // namespace
}  // namespace connectivity::detail
