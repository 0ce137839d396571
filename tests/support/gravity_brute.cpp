// SPDX-License-Identifier: BSD-3-Clause
#include <support/gravity_brute.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <support/random.hpp>

namespace connectivity::test {

namespace {

using Real = long double;

/// The pair's factors: a = m * force * d, p = m * potential.
struct Factors {
    Real force = 0, potential = 0;
};

Factors factors(BruteLaw law, Real r2, Real ei, Real ej) {
    if (law == BruteLaw::sph_exa) {
        const Real R = std::max(std::sqrt(r2), ei + ej);
        if (R == 0) return {};
        return {1 / (R * R * R), r2 / (R * R * R)};
    }
    const Real e = law == BruteLaw::plummer ? std::max(ei, ej) : 0;
    const Real R = std::sqrt(r2 + e * e);
    if (R == 0) return {};
    return {1 / (R * R * R), 1 / R};
}

BruteSum sum_of(const GravityScene& scene, std::int64_t i, BruteLaw law,
                std::span<const Shift> images) {
    const auto at = [&](std::int64_t j) { return scene.e.empty() ? Real{0} : Real{scene.e[j]}; };
    BruteSum sum;
    for (const Shift& shift : images)
        for (std::int64_t j = 0; j < scene.n(); ++j) {
            if (j == i && shift == Shift{}) continue;
            const Real d[3] = {Real{scene.x[j]} + shift[0] - scene.x[i],
                               Real{scene.y[j]} + shift[1] - scene.y[i],
                               Real{scene.z[j]} + shift[2] - scene.z[i]};
            const Real r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], m = scene.m[j];
            const Factors f = factors(law, r2, at(i), at(j));
            sum.p += m * f.potential;
            sum.size_p += std::abs(m * f.potential);
            sum.size_a += std::abs(m * f.force) * std::sqrt(r2);
            for (int k = 0; k < 3; ++k) sum.a[k] += m * f.force * d[k];
        }
    return sum;
}

}  // namespace

std::vector<BruteSum> brute_gravity(const GravityScene& scene,
                                    std::span<const std::int64_t> targets, BruteLaw law,
                                    std::span<const Shift> images) {
    const Shift here[1] = {};
    std::vector<BruteSum> sums;
    for (const std::int64_t i : targets)
        sums.push_back(sum_of(scene, i, law, images.empty() ? std::span(here) : images));
    return sums;
}

std::vector<BruteSum> brute_gravity(const GravityScene& scene, BruteLaw law,
                                    std::span<const Shift> images) {
    return brute_gravity(scene, sample_targets(scene.n(), scene.n()), law, images);
}

std::vector<Shift> image_shifts(double period, int reach) {
    std::vector<Shift> shifts;
    for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
            for (int k = -reach; k <= reach; ++k)
                shifts.push_back({i * period, j * period, k * period});
    return shifts;
}

long double distance(const BruteSum& reference, double ax, double ay, double az) {
    return std::hypot(reference.a[0] - ax, reference.a[1] - ay, reference.a[2] - az);
}

long double length(const BruteSum& sum) { return std::hypot(sum.a[0], sum.a[1], sum.a[2]); }

std::vector<std::int64_t> sample_targets(std::int64_t n, std::int64_t count, std::uint64_t seed) {
    std::vector<std::int64_t> sample(static_cast<std::size_t>(n));
    std::iota(sample.begin(), sample.end(), 0);
    if (count >= n) return sample;
    Random random(seed);
    std::set<std::int64_t> chosen;
    while (static_cast<std::int64_t>(chosen.size()) < count)
        chosen.insert(static_cast<std::int64_t>(random.bits() % static_cast<std::uint64_t>(n)));
    return {chosen.begin(), chosen.end()};
}

}  // namespace connectivity::test
