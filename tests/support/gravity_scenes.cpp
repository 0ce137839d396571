// SPDX-License-Identifier: BSD-3-Clause
#include <support/gravity_scenes.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <support/random.hpp>

namespace connectivity::test {

namespace {

std::array<double, 3> direction(Random& random) {
    const double z = random.uniform(-1, 1), phi = random.uniform(0, 2 * std::numbers::pi);
    const double s = std::sqrt((1 - z) * (1 + z));
    return {s * std::cos(phi), s * std::sin(phi), z};
}

void add_on_sphere(GravityScene& scene, double r, double mass, Random& random) {
    const auto u = direction(random);
    scene.add(r * u[0], r * u[1], r * u[2], mass);
}

}  // namespace

void GravityScene::add(double px, double py, double pz, double mass) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
    m.push_back(mass);
}

void GravityScene::append(const GravityScene& other) {
    for (std::size_t i = 0; i < other.x.size(); ++i)
        add(other.x[i], other.y[i], other.z[i], other.m[i]);
}

GravityScene& GravityScene::shift(double dx, double dy, double dz) {
    for (double& v : x) v += dx;
    for (double& v : y) v += dy;
    for (double& v : z) v += dz;
    return *this;
}

GravityScene& GravityScene::scale(double lengths, double masses) {
    for (auto* const axis : {&x, &y, &z, &e})
        for (double& v : *axis) v *= lengths;
    for (double& v : m) v *= masses;
    return *this;
}

GravityScene plummer_scene(std::int64_t n, std::uint64_t seed) {
    Random random(seed);
    GravityScene scene;
    while (scene.n() < n) {
        // Mass inside r is (1 + r^-2)^(-3/2).
        const double r = 1 / std::sqrt(std::pow(random.uniform(), -2.0 / 3.0) - 1);
        if (r < 50) add_on_sphere(scene, r, 1.0 / static_cast<double>(n), random);
    }
    return scene;
}

GravityScene uniform_scene(std::int64_t n, std::uint64_t seed) {
    Random random(seed);
    GravityScene scene;
    for (std::int64_t i = 0; i < n; ++i) {
        const double px = random.uniform(), py = random.uniform(), pz = random.uniform();
        scene.add(px, py, pz, 1.0 / static_cast<double>(n));
    }
    return scene;
}

GravityScene evrard_scene(std::int64_t n, std::uint64_t seed) {
    Random random(seed);
    GravityScene scene;
    for (std::int64_t i = 0; i < n; ++i)
        add_on_sphere(scene, std::sqrt(random.uniform()), 1.0 / static_cast<double>(n), random);
    return scene;
}

GravityScene two_scales_scene(std::int64_t n, std::uint64_t seed) {
    GravityScene scene = plummer_scene(n - n / 2, seed).scale(1, 0.5);
    scene.append(plummer_scene(n / 2, seed + 1000).scale(1e-4, 0.5).shift(900, 400, 170));
    return scene;
}

GravityScene corner_clumps_scene(std::int64_t n, std::uint64_t seed) {
    constexpr double cell = 0.25, clump = 0.02 * cell;
    Random random(seed);
    GravityScene scene;
    for (std::int64_t i = 0; i < n; ++i) {
        const auto c = static_cast<int>(i % 64);
        const bool heavy = i / 64 % 2 == 0;
        double p[3];
        for (int d = 0; d < 3; ++d) {
            const double inside = clump * random.uniform();
            p[d] = (c >> 2 * d & 3) * cell + (heavy ? inside : cell * 0.999999 - inside);
        }
        scene.add(p[0], p[1], p[2], heavy ? 0.99 : 0.01);
    }
    double mass = 0;
    for (const double m : scene.m) mass += m;
    return n > 0 ? scene.scale(1, 1 / mass) : scene;
}

GravityScene coincident_scene(std::int64_t n, std::uint64_t seed) {
    const std::int64_t n_together = n / 64, n_close = n >= 2 ? 2 : 0;
    GravityScene scene = plummer_scene(n - n_together - n_close, seed);
    const double mass = 1.0 / static_cast<double>(n);
    for (double& m : scene.m) m = mass;
    for (std::int64_t i = 0; i < n_together; ++i) scene.add(0.3, 0.2, 0.1, mass);
    for (std::int64_t i = 0; i < n_close; ++i)
        scene.add(0.7 + 1e-9 * static_cast<double>(i), 0.2, -0.1, mass);
    return scene;
}

GravityScene cold_cube_scene(std::int64_t n) {
    std::int64_t side = 1;
    while (side * side * side < n) ++side;
    GravityScene scene;
    for (std::int64_t i = 0; i < n; ++i) {
        const auto at = [&](std::int64_t k) {
            return (static_cast<double>(k % side) + 0.5) / static_cast<double>(side);
        };
        scene.add(at(i / (side * side)), at(i / side), at(i), 1.0 / static_cast<double>(n));
    }
    return scene;
}

GravityScene two_clusters_scene(std::int64_t n, std::uint64_t seed) {
    GravityScene scene = plummer_scene(n - n / 2, seed).scale(1, 2.0 / 3.0);
    scene.append(plummer_scene(n / 2, seed + 1000).scale(1, 1.0 / 3.0).shift(8, 5, 3.3));
    return scene;
}

GravityScene one_heavy_corner_scene(std::int64_t n, std::uint64_t seed) {
    constexpr double cell = 1e-3, clump = 0.02 * cell;
    Random random(seed);
    GravityScene scene;
    for (std::int64_t i = 0; i < n; ++i) {
        const bool heavy = i < n - n / 2;
        double p[3];
        for (double& v : p) {
            const double inside = clump * random.uniform();
            v = heavy ? inside : cell - inside;
        }
        scene.add(p[0], p[1], p[2], heavy ? 1 : 0.01);
    }
    double mass = 0;
    for (const double m : scene.m) mass += m;
    return n > 0 ? scene.scale(1, 1 / mass) : scene;
}

GravityScene spiral_scene(std::int64_t n, double halvings) {
    GravityScene scene;
    for (std::int64_t i = 0; i < n; ++i) {
        const double t = static_cast<double>(i),
                     r = std::exp2(-halvings * t / static_cast<double>(n));
        const double z = 0.6 * std::sin(0.37 * t), s = std::sqrt(1 - z * z);
        scene.add(r * s * std::cos(t), r * s * std::sin(t), r * z, 1.0 / static_cast<double>(n));
    }
    return scene;
}

GravityScene make_gravity_scene(std::string_view name, std::int64_t n) {
    if (name == "G1" || name == "plummer") return plummer_scene(n);
    if (name == "G2" || name == "uniform") return uniform_scene(n);
    if (name == "G3" || name == "evrard") return evrard_scene(n);
    if (name == "G4" || name == "two_scales") return two_scales_scene(n);
    if (name == "G5" || name == "corner_clumps") return corner_clumps_scene(n);
    if (name == "G6" || name == "coincident") return coincident_scene(n);
    if (name == "cold_cube") return cold_cube_scene(n);
    if (name == "two_clusters") return two_clusters_scene(n);
    if (name == "one_heavy_corner") return one_heavy_corner_scene(n);
    if (name == "spiral") return spiral_scene(n);
    throw std::invalid_argument("no gravity scene is called '" + std::string(name) + "'");
}

}  // namespace connectivity::test
