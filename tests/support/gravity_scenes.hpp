// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Particles that attract each other, of any number: smooth clouds, and clouds that break codes.
///
/// The same bits for a seed with one mathematics library. Masses add up to 1 unless said otherwise.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace connectivity::test {

struct GravityScene {
    std::vector<double> x, y, z, m;
    std::vector<double> e;  ///< softening lengths; empty: none

    std::int64_t n() const { return static_cast<std::int64_t>(x.size()); }
    void add(double px, double py, double pz, double mass);
    void append(const GravityScene& other);
    GravityScene& shift(double dx, double dy, double dz);
    GravityScene& scale(double lengths, double masses = 1);
};

/// Plummer's model with scale length 1, cut at 50.
GravityScene plummer_scene(std::int64_t n, std::uint64_t seed = 1);
/// Uniform in the unit cube.
GravityScene uniform_scene(std::int64_t n, std::uint64_t seed = 2);
/// The unit ball with density ~ 1/r (Evrard).
GravityScene evrard_scene(std::int64_t n, std::uint64_t seed = 3);
/// Two Plummer models of scale lengths 1 and 1e-4, 1000 apart.
GravityScene two_scales_scene(std::int64_t n, std::uint64_t seed = 4);
/// Salmon & Warren: each of 64 cells has a clump with 99 % of its mass in its low corner and a
/// light one in the opposite corner.
GravityScene corner_clumps_scene(std::int64_t n, std::uint64_t seed = 5);
/// Plummer; n / 64 of the particles are in one place, and two 1e-9 apart.
GravityScene coincident_scene(std::int64_t n, std::uint64_t seed = 6);
/// Nodes of a regular lattice in the unit cube, the n first of the smallest cube that has as many.
GravityScene cold_cube_scene(std::int64_t n);
/// Two Plummer models of scale lengths 1, 10 apart, masses 2/3 and 1/3.
GravityScene two_clusters_scene(std::int64_t n, std::uint64_t seed = 7);
/// One cell of size 1e-3: half of the particles heavy in one corner, half with 1 % of their mass
/// in the opposite one.
GravityScene one_heavy_corner_scene(std::int64_t n, std::uint64_t seed = 8);
/// Radii 2^-i around the origin, i from 0 to `halvings`, on a spiral that is no plane.
GravityScene spiral_scene(std::int64_t n, double halvings = 60);

/// By name: G1 ... G6 (plummer, uniform, evrard, two_scales, corner_clumps, coincident), cold_cube,
/// two_clusters, one_heavy_corner, spiral. Throws std::invalid_argument for another.
GravityScene make_gravity_scene(std::string_view name, std::int64_t n);

inline constexpr const char* all_gravity_scenes[] = {
    "G1", "G2", "G3", "G4", "G5", "G6", "cold_cube", "two_clusters", "one_heavy_corner", "spiral"};

}  // namespace connectivity::test
