// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// The operators of the fast multipole method in solid harmonics, one table per instruction set,
/// chosen at run time. Raw pointers only; nothing is allocated; all results are added to.
///
/// Harmonics, after Dehnen 2014 (Comput. Astrophys. 1, 1), with R_n,-m = (-1)^m conj(R_n,m):
///
///     regular    R_nm(r) = r^n P_nm(cos) e^(i m phi) / (n+m)!     R_00 = 1, R_11 = (x + iy) / 2
///     irregular  T_nm(r) = (n-m)! P_nm(cos) e^(i m phi) / r^(n+1) T_00 = 1/r, T_11 = (x + iy) / r³
///     1 / |x - y| = sum_nm conj(R_nm(y)) T_nm(x),  |y| < |x|
///
/// An expansion of order P has (P+1)² doubles: (n,0) at n², Re(n,m) at n² + 2m - 1, Im(n,m) at
/// n² + 2m. It has a centre c and a scale s > 0, a length not much below the cell's radius:
///
///     moments  M_nm = sum_i m_i R_nm((x_i - c) / s),
///              p(x) = sum_nm conj(M_nm) T_nm((x - c) / s) / s
///     local    p(x) = sum_nm conj(R_nm((x - c) / s)) F_nm
///
/// Potentials are p = sum m/r, accelerations a = grad p. Only ratios of scales and distances are
/// raised to powers: nothing overflows for any scales, as long as distances stay in [1e-120, 1e120]
/// and s / R is below about 10. m2l keeps the terms n + k <= P, which makes the force of A on B and
/// of B on A opposite to round-off.
///
/// Sources must not be in the ball of targets: r_A + r_B < R. Nothing checks this here.

#include <cstdint>

namespace connectivity::detail {

constexpr int max_expansion_order = 20;

constexpr int n_coefficients(int order) { return (order + 1) * (order + 1); }

/// Doubles from one cell's expansion to the next: whole vectors, so that rows can be read in
/// blocks.
constexpr std::int64_t expansion_stride(int order) { return (n_coefficients(order) + 7) / 8 * 8; }

/// Particles with masses (positive, negative or 0).
struct Bodies {
    const double *x, *y, *z, *m;
    std::int64_t n;
};

/// Points, and what is added to at each of them.
struct Points {
    const double *x, *y, *z;
    std::int64_t n;
};
struct Fields {
    double *p, *ax, *ay, *az;
};

/// All cells: centres, scales, and expansions of cell c from `coefficients + c * stride`.
struct CellArrays {
    const double *x, *y, *z, *scale;
    const double* coefficients;
    std::int64_t stride;  ///< a multiple of 8, at least expansion_stride(order)
};

/// Some of the cells. `image`, if not null, tells for each which of the shifts moves it.
struct CellList {
    const std::int32_t* id;
    std::int64_t n;
    const std::uint8_t* image;
    const double* shift;  ///< [n_images][3]
};

/// One cell's expansion, read or added to.
struct Expansion {
    double centre[3];
    double scale;
    double* coefficients;
};

/// Times are per operation with AVX-512 in bench/gravity_expansions.
struct ExpansionKernels {
    const char* name;
    /// Moments of particles. Vectors of particles.
    void (*p2m)(int order, const Bodies& bodies, const Expansion& moments);
    /// Moments of children to their parent's. Vectors of children.
    void (*m2m)(int order, const CellArrays& cells, const CellList& children,
                const Expansion& parent);
    /// Moments of source cells to the local expansion of one target. Vectors of sources.
    void (*m2l)(int order, const CellArrays& cells, const CellList& sources,
                const Expansion& target);
    /// A local expansion to those of children, `locals + child * cells.stride`;
    /// cells.coefficients is not read. Vectors of children.
    void (*l2l)(int order, const Expansion& parent, const CellArrays& cells,
                const CellList& children, double* locals);
    /// A local expansion at points. Vectors of points.
    void (*l2p)(int order, const Expansion& local, const Points& points, const Fields& fields);
    /// Moments of cells at points: the tree walk's kernel. Vectors of points.
    void (*m2p)(int order, const CellArrays& cells, const CellList& sources, const Points& points,
                const Fields& fields);
    /// Distant particles to a local expansion. Vectors of particles.
    void (*p2l)(int order, const Bodies& bodies, const Expansion& local);
};

/// Power of moments per degree, in mass * scale^k: P_k = sqrt(sum_m (k-m)! (k+m)! |M_km|²). It
/// bounds what degree k does: |degree k of p at distance R| <= P_k (s/R)^k / R. out[order + 1].
void expansion_power(int order, const double* moments, double* out);

/// The table for this processor; see base/isa.hpp.
const ExpansionKernels& expansion_kernels();

extern const ExpansionKernels portable_expansion_kernels;
extern const ExpansionKernels avx2_expansion_kernels, avx512_expansion_kernels;  // on x86-64

}  // namespace connectivity::detail
