// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Sums over pairs of particles, one table of functions per instruction set, chosen at run time.
///
/// Raw pointers only, as in search/kernels.hpp, so that no wide code can leak into the baseline.
/// A pair gives the same bits in both directions, but for the sign and the masses. Nothing is
/// allocated or read beyond the arrays. Of the sum of the terms' absolute values errors are near
/// 1e-15 in double and 5e-7 in float; at worst, where all terms are the same, 3e-14 and 1.5e-5 with
/// a million sources.

#include <cstdint>

namespace connectivity::detail {

/// What a source of mass m at distance r does to a target, d: from the target to the source. A pair
/// at r = 0 does nothing at all, whatever the law.
enum class PairLaw {
    newton,   ///< a = m d / r³, p = m / r
    plummer,  ///< e = max(e_i, e_j): a = m d / (r² + e²)^(3/2), p = m / sqrt(r² + e²)
    sph_exa   ///< R = max(r, e_i + e_j): a = m d / R³, p = m r² / R³
};

template <class T>
struct NearSources {
    const T *x, *y, *z, *m;
    const T* e;  ///< softening lengths; not read for newton
    std::int64_t n;
};

template <class T>
struct NearTargets {
    const T *x, *y, *z;
    const T* e;  ///< softening lengths; not read for newton
    T *p, *ax, *ay, *az;
    std::int64_t n;
};

/// Consecutive particles, and the image of the box in which they act.
struct SourceRun {
    std::int32_t first, n, image;
};

/// What runs are of, and how it is copied: (x + shift of the image - centre) * scale, mass,
/// softening * scale.
struct GatherFrom {
    const double* x[3];
    const double *mass, *softening;  ///< softening: null where there is none
    const double* shift;             ///< [images][3]
    double centre[3] = {0, 0, 0};
    double scale = 1;
};

/// A row of gathered numbers is written beyond its end by less than so many.
constexpr std::int64_t gather_slack = 8;

struct DirectKernels {
    const char* name;
    /// Adds to p and a of every target what every source does. Coordinates, masses and lengths are
    /// finite and below 2^60 in double, 2^20 in float. Distances below 1e-150 in double, 1e-18 in
    /// float lose digits, and count as 0 below 1e-162 and 1e-22.
    void (*add64)(PairLaw law, const NearSources<double>&, const NearTargets<double>&);
    void (*add32)(PairLaw law, const NearSources<float>&, const NearTargets<float>&);
    /// Copies runs one after the other into rows `stride` apart: x, y, z, mass, softening (not
    /// written where there is none). `stride` is at least their particles and gather_slack.
    void (*gather64)(const GatherFrom& from, const SourceRun* runs, std::int64_t n_runs, double* to,
                     std::int64_t stride);
    void (*gather32)(const GatherFrom& from, const SourceRun* runs, std::int64_t n_runs, float* to,
                     std::int64_t stride);
};

/// The table for this processor, or the one that CONNECTIVITY_ISA names.
const DirectKernels& direct_kernels();

extern const DirectKernels portable_direct_kernels;
extern const DirectKernels avx2_direct_kernels, avx512_direct_kernels;  // on x86-64

}  // namespace connectivity::detail
