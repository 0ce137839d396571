// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Accelerations and potentials of particles that attract each other, to a tolerance.
///
/// Invariants: the same bits for any number of threads; a solution that throws leaves the one
/// before as it was; views handed out stay valid and unchanged. Nothing is allocated before the
/// first solution; later ones of the same size reuse its memory, but for names and some tables of
/// the tree's builder. Sources: Dehnen, Comput. Astrophys. Cosmol. 1 (2014) 1; Salmon & Warren,
/// J. Comput. Phys. 111 (1994) 136.

#include <memory>

#include <connectivity/base/report.hpp>
#include <connectivity/gravity/options.hpp>
#include <connectivity/gravity/particles.hpp>

namespace connectivity {

/// Of the error of one quantity over the sample.
struct GravityErrors {
    double rms = 0, p99 = 0, max = 0;
};

/// What was done, and how well.
struct GravityInfo {
    GravityMethod method = GravityMethod::direct;  ///< never automatic
    int order = 0;                                 ///< of expansions; 0 for direct
    Acceptance acceptance = Acceptance::field;
    double epsilon = 0;
    NearPrecision near = NearPrecision::float64;
    /// 0: the errors are unknown, or rounding only (direct). What far images of a periodic box err
    /// by, at most a hundredth of the tolerance times sum |m| / V^(2/3), is not in them.
    Offset n_samples = 0;
    GravityErrors acceleration;  ///< |error of a| / |a|
    GravityErrors field;         ///< |error of a| / sum m/r², which has no zeros
    GravityErrors potential;     ///< |error of phi| / sum m/r
    bool reached = true;         ///< acceleration.p99 <= tolerance
    Offset n_near = 0;           ///< pairs of particles
    Offset n_far = 0;            ///< pairs of cells (fmm), of particle and cell (walk)
};

class Gravity {
public:
    Gravity();
    ~Gravity();
    Gravity(Gravity&&) noexcept;  ///< what was moved from may only be assigned to
    Gravity& operator=(Gravity&&) noexcept;

    /// Throws Error: argument (options, strides, sizes), null, nonfinite (first particle), box,
    /// unsupported (some axes periodic and others not), too_many (2^31 particles; walk or fmm by
    /// hand: more than 254 levels), budget, memory.
    void solve(const GravityParticles& particles, const GravityOptions& options = {});

    Offset n() const;
    ConstView<double> acceleration() const;  ///< [n][3], the host's order
    ConstView<double> potential() const;     ///< [n]; per unit mass, negative near masses
    /// [n]: no error of |a| is above it but for rounding, by the sum over all expansions that
    /// reached the particle of what their remainders are at most; empty unless asked for. Near sums
    /// in float32, which are taken then only by hand, round to 1e-6 of the sum of their terms; far
    /// images of a periodic box are not in it.
    ConstView<double> error_bound() const;

    const GravityInfo& info() const;
    /// Phases (tree, moments, lists, near, far, sample ...): ms and bytes; 0 for what was not
    /// built.
    const Report& report() const;
    Offset scratch_bytes() const;  ///< kept for the next solution
    void release_scratch();        ///< gives that back

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace connectivity
