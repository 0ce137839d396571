// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Random trees and options from the whole space of what the lists support.

#include <connectivity/lists/traversal_options.hpp>

#include "lists/slow_tree.hpp"

namespace connectivity::test {

struct ListsCase {
    SlowInput tree;
    TraversalOptions options;
};

inline std::vector<SlowParticle> random_particles(Random& random, const SlowInput& in, int n,
                                                  bool radii) {
    // Level restriction of deep trees makes too many boxes for brute force.
    const int shape =
        in.kind == SlowKind::level_restricted ? random.pick({0, 2, 3}) : random.below(6);
    const double ratio = random.pick({1e-3, 1e-10, 1e-14});
    std::vector<SlowParticle> particles(n);
    for (SlowParticle& p : particles) {
        Point u{};
        for (int k = 0; k < in.dim; ++k) u[k] = random.uniform();
        if (shape == 1)  // two clusters, one of them near a corner where coordinates are fine
            for (double& x : u) x = random.chance(0.5) ? ratio * x : 0.3 + ratio * x;
        if (shape == 2)  // a ring
            u = {0.5 + 0.49 * std::cos(6.283 * u[0]), 0.5 + 0.49 * std::sin(6.283 * u[0]), u[2]};
        if (shape == 3)  // a lattice: particles on faces of boxes
            for (double& x : u) x = std::floor(8 * x) / 8;
        if (shape == 4)  // towards a corner, at all scales
            for (double& x : u) x = std::pow(ratio, x) * 0.999;
        for (int k = 0; k < in.dim; ++k)
            p.x[k] = std::min(in.lo + in.extent * u[k], std::nextafter(in.lo + in.extent, -1e9));
        if (radii && random.chance(0.8))
            p.radius = in.extent * random.log_uniform(1e-3, random.pick({0.01, 0.1, 0.6}));
    }
    return particles;
}

inline ListsCase random_lists_case(std::uint64_t seed, bool periodic) {
    Random random(seed);
    ListsCase c;
    SlowInput& in = c.tree;
    in.dim = 1 + random.below(3);
    in.kind = random.pick({SlowKind::adaptive, SlowKind::adaptive, SlowKind::non_adaptive,
                           SlowKind::level_restricted});
    if (!random.chance(0.8)) in.lo = -0.3, in.extent = 1.7;  // centres are rounded
    const int most = periodic ? 16 : (in.kind == SlowKind::level_restricted ? 25 : 50);
    in.leaf = 1 + random.below(6);
    in.sources_are_targets = random.chance(0.25);
    if (!in.sources_are_targets) {
        in.target_radii = random.chance(0.5);
        in.source_radii = random.chance(0.4);
    }
    in.norm = random.chance(0.5) ? ExtentNorm::linf : ExtentNorm::l2;
    if (in.target_radii || in.source_radii) in.stick_out = random.pick({0.0, 0.1, 0.25, 0.5, 1.0});
    in.exact_flags = random.chance(0.3);
    in.shuffle = random.chance(0.3) ? seed + 1 : 0;
    for (int k = 0; k < in.dim; ++k) in.periodic[k] = periodic && random.chance(0.7);
    in.sources = random_particles(random, in, random.below(most), in.source_radii);
    in.targets = random_particles(random, in, random.below(most), in.target_radii);
    c.options.well_sep_is_n_away = 1 + random.below(3);
    using enum FromSepSmallerCrit;
    if (random.chance(0.7))
        c.options.from_sep_smaller_crit = random.pick({static_linf, precise_linf, static_l2});
    const bool radii = in.target_radii || in.source_radii;
    if (radii && in.norm == ExtentNorm::l2 && c.options.from_sep_smaller_crit == static_linf)
        c.options.from_sep_smaller_crit = static_l2;
    if (random.chance(0.3)) c.options.from_sep_smaller_min_nsources_cumul = random.below(10);
    return c;
}

}  // namespace connectivity::test
