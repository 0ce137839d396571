// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Constants of solid harmonics: factorials, and the matrices that exchange the axes x and z.
///
/// R_nm(z, y, x) = sum_l B_ml R_nl(x, y, z). B is real, and as both sides have the same parity in
/// y, real parts (cosines) and imaginary parts (sines) are exchanged each by a matrix of its own.
/// Half of the entries vanish: the parity in x becomes that in z. The entries are found from degree
/// n-1 by the derivatives of both sides; they are whole multiples of 2^-n, and exact.

#include "expansion_kernels.hpp"

namespace connectivity::detail {
namespace {

struct Factorials {
    double value[2 * max_expansion_order + 3];
    constexpr Factorials() : value{1} {
        for (int n = 1; n < 2 * max_expansion_order + 3; ++n) value[n] = value[n - 1] * n;
    }
};
constexpr Factorials factorial;

/// R_nm = f_nm(z, r²) (x + iy)^m / (2^m m!) with f_mm = 1, f_m+1,m = z and
/// f_n = first z f_n-1 - second r² f_n-2; first and second at [m][n].
struct Recurrence {
    double first[max_expansion_order + 1][max_expansion_order + 1];
    double second[max_expansion_order + 1][max_expansion_order + 1];
    constexpr Recurrence() : first{}, second{} {
        for (int m = 0; m <= max_expansion_order; ++m)
            for (int n = m + 1; n <= max_expansion_order; ++n) {
                first[m][n] = (2.0 * n - 1) / (n * n - m * m);
                second[m][n] = 1.0 / (n * n - m * m);
            }
    }
};
constexpr Recurrence recurrence;

constexpr int swap_offset(int n) { return n * (n + 1) * (2 * n + 1) / 6; }  // sum of k², k <= n

/// out_l = sum_m entry(l, m) in_m, l and m in 0..n.
struct Swap {
    double cosine[swap_offset(max_expansion_order + 1)];
    double sine[swap_offset(max_expansion_order + 1)];
    constexpr double cosines(int n, int l, int m) const {
        return cosine[swap_offset(n) + l * (n + 1) + m];
    }
    constexpr double sines(int n, int l, int m) const {
        return sine[swap_offset(n) + l * (n + 1) + m];
    }
};

struct Swaps {
    Swap moments{};  ///< of R, and so of M
    Swap locals{};   ///< of F, so that sum conj(R) F stays: the transpose, m > 0 counting twice
    constexpr Swaps() {
        double b[2][w][w] = {};
        b[0][o][o] = 1;
        for (int n = 0; n <= max_expansion_order; ++n) {
            double(&now)[w][w] = b[n % 2];
            if (n > 0) next(n, b[1 - n % 2], now);
            for (int l = 0; l <= n; ++l)
                for (int m = 0; m <= n; ++m) enter(n, l, m, now[o + l][o + m], now[o + l][o - m]);
        }
    }

private:
    static constexpr int o = max_expansion_order + 1, w = 2 * o + 1;  // B_ml is at [o + m][o + l]

    static constexpr void next(int n, const double (&old)[w][w], double (&now)[w][w]) {
        for (auto& row : now)
            for (double& entry : row) entry = 0;
        for (int m = -n; m <= n; ++m) {
            const double(&below)[w] = old[o + m - 1];
            const double(&above)[w] = old[o + m + 1];
            for (int l = 1 - n; l < n; ++l) now[o + m][o + l] = (below[o + l] - above[o + l]) / 2;
            const int a = o + n - 1, b = o - n + 1;
            now[o + m][o + n] = (below[a] + above[a]) / 2 + old[o + m][a];
            now[o + m][o - n] = (below[b] + above[b]) / 2 - old[o + m][b];
        }
    }
    constexpr void enter(int n, int l, int m, double plus, double minus) {
        const double sign = m % 2 == 0 ? 1 : -1;
        const double cosine = m == 0 ? plus : plus + sign * minus;
        const double sine = m == 0 ? 0 : plus - sign * minus;
        const int at = swap_offset(n) + l * (n + 1) + m, across = swap_offset(n) + m * (n + 1) + l;
        moments.cosine[at] = cosine;
        moments.sine[at] = l == 0 ? 0 : sine;
        locals.cosine[across] = cosine * (l == 0 ? 1 : 2) / (m == 0 ? 1 : 2);
        locals.sine[across] = l == 0 ? 0 : sine;
    }
};
constexpr Swaps swaps;

}  // namespace
}  // namespace connectivity::detail
