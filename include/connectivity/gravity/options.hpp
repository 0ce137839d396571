// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// What is asked of gravity: an accuracy, and by hand everything that follows from it.

#include <cstdint>
#include <optional>

#include <connectivity/base/box.hpp>
#include <connectivity/base/budget.hpp>
#include <connectivity/base/spaces.hpp>

namespace connectivity {

enum class GravityMethod {
    automatic,  ///< direct or fmm, whichever is faster
    direct,     ///< every pair
    walk,       ///< multipoles of cells at the particles of a group (tree walk)
    fmm         ///< multipoles of cells as local expansions of cells (fast multipole method)
};

/// When the expansion of order p of a cell B may act on the particles of a cell (or group) A. R is
/// the distance of the centres of mass, r_A and r_B reach the farthest particle from them, and
/// rho_B <= r_B is the radius at which B's masses would have the moment that they have: the q-th
/// root of sum |m| r^q / sum |m|. What the first neglected terms can be at most, as a share of M_B
/// / R²:
///
///     fmm    E = (p + 1) ((r_A + rho_B) / R)^p           q = p      terms n + k <= p are kept
///     walk   E = (p + 2) (rho_B / (R - r_A))^(p + 1)     q = p + 1
///
/// Every criterion also asks for r_A + r_B < R, so that no particle accepts a cell it is in.
enum class Acceptance {
    /// E < epsilon. Errors are a small share of epsilon * sum m/r², whatever the scene, unless
    /// epsilon is so large that cells are accepted where they touch.
    field,
    /// E M_B / R² < epsilon * the smallest |a| in A, where E is divided by (1 - t)² for the
    /// terms that follow, t = (r_A + r_B) / R; |a| is from `previous_acceleration` or, without
    /// it, from a rough solution. Fewer interactions for the same median, a longer tail.
    acceleration,
    /// r_A + r_B < epsilon R: an opening angle, with the offset of the centre of mass in r_B.
    geometric
};

/// r: distance; a pair's force is the derivative of its potential unless said otherwise.
enum class Softening {
    /// a = m r / (r² + e²)^(3/2), potential -m / sqrt(r² + e²), e = the larger of the two lengths
    plummer,
    /// SPH-EXA: a = m r / max(r, h_i + h_j)³, potential -m r² / max(r, h_i + h_j)³, which is
    /// not the integral of the force inside h_i + h_j
    sph_exa
};

/// Of sums over near pairs, in coordinates relative to the target cell.
enum class NearPrecision { automatic, float32, float64 };

struct GravityOptions {
    GravityMethod method = GravityMethod::automatic;
    /// Wanted 99th percentile of |error of a| / |a|, in [1e-12, 0.5]; checked on a sample.
    double tolerance = 1e-4;

    /// By hand; what is absent is chosen so that the tolerance is met.
    std::optional<int> order{};  ///< of expansions, in [1, max_gravity_order]
    std::optional<Acceptance> acceptance{};
    /// Of the acceptance, with `order`: in [1e-15, 1e4], geometric: [1e-15, 0.95].
    std::optional<double> epsilon{};
    std::optional<std::int32_t> leaf{};  ///< most particles in a leaf, in [1, 2^20]
    NearPrecision near = NearPrecision::automatic;

    /// Newton's third law to round-off: B acts on A through its expansion only if A does on B. For
    /// fmm and direct; near pairs are double.
    bool symmetric = false;
    Softening softening = Softening::plummer;
    double constant = 1;  ///< of gravity, > 0
    /// Open, or periodic on all three axes: images of the box without end and a uniform background
    /// that makes the mean density 0 (Ewald's sum with conducting surroundings). Sides differ by a
    /// factor of 10 at most; Plummer's lengths are at most the least side * sqrt(tolerance / 30).
    Domain domain{};
    /// [n] lengths of the accelerations of the step before, for Acceptance::acceleration.
    ConstView<double> previous_acceleration{};
    int n_samples = 300;  ///< targets summed directly to check the error; 0: no check, max 100000
    std::uint64_t seed = 1;    ///< of the sample
    bool error_bound = false;  ///< keep a bound of the error of each particle, see Gravity
    Budget budget{};
};

constexpr int max_gravity_order = 20;

}  // namespace connectivity
