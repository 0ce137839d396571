// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Gravity by the definition, pair by pair in long double: what every method is compared with.
///
/// The constant is 1. No pair of a particle with itself; its images count. Cost: about 20 ns a pair
/// and image, one thread.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <support/gravity_scenes.hpp>

namespace connectivity::test {

/// r: distance of the pair; d: from the target to the source.
enum class BruteLaw {
    newton,  ///< a = m d / r³, p = m / r; nothing at r = 0
    plummer,  ///< e = max(e_i, e_j): a = m d / (r² + e²)^(3/2), p = m / sqrt(r² + e²); nothing at
              ///< r = e = 0
    sph_exa  ///< R = max(r, e_i + e_j): a = m d / R³, p = m r² / R³; nothing at R = 0
};

struct BruteSum {
    long double p = 0;  ///< sum of m/r: positive, the potential is -p
    std::array<long double, 3> a{};
    long double size_p = 0;  ///< sum of the terms' absolute values
    long double size_a = 0;  ///< sum of the terms' lengths
};

using Shift = std::array<double, 3>;

/// What all particles do to those named in `targets`, in that order. `images`: the sources are
/// there once for each, moved by it; without any only where they are.
std::vector<BruteSum> brute_gravity(const GravityScene& scene,
                                    std::span<const std::int64_t> targets,
                                    BruteLaw law = BruteLaw::newton,
                                    std::span<const Shift> images = {});
/// The same for all particles.
std::vector<BruteSum> brute_gravity(const GravityScene& scene, BruteLaw law = BruteLaw::newton,
                                    std::span<const Shift> images = {});

/// All images within `reach` periods of a cubic box along each axis, the box itself included.
std::vector<Shift> image_shifts(double period, int reach);

/// |a - reference|, to divide by size_a or |a|.
long double distance(const BruteSum& reference, double ax, double ay, double az);
long double length(const BruteSum& sum);

/// `count` different indices below n, in ascending order (all of them if there are no more).
std::vector<std::int64_t> sample_targets(std::int64_t n, std::int64_t count,
                                         std::uint64_t seed = 77);

}  // namespace connectivity::test
