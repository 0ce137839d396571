// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Masses in a node file, written plainly, and a result of `connectivity gravity` compared with
/// sums over pairs.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <io/plain_hdf5.hpp>
#include <support/gravity_brute.hpp>
#include <support/random.hpp>

namespace connectivity::test {

struct MassList {
    std::string name;
    std::vector<double> x;                ///< [n, dim]
    std::vector<double> mass, softening;  ///< empty: not in the file
    int n_internal = 0;
};

/// n random nodes in the unit cube, the last sixth of them ghosts.
inline MassList random_masses(const std::string& name, int dim, int n, std::uint64_t seed,
                              double softening = 0) {
    Random random(seed);
    MassList list{name, {}, {}, {}, n - n / 6};
    for (int i = 0; i < n * dim; ++i) list.x.push_back(random.uniform());
    for (int i = 0; i < n; ++i) list.mass.push_back(0.5 + random.uniform());
    for (int i = 0; i < n && softening > 0; ++i)
        list.softening.push_back(softening * random.uniform());
    return list;
}

inline void write_masses(const std::string& path, int dim, const std::vector<MassList>& lists) {
    auto file = PlainFile::create(path);
    file.attribute("/", "dim", dim).attribute("/", "kernel_extent", 2.0);
    for (std::size_t k = 0; k < lists.size(); ++k) {
        const auto& list = lists[k];
        const auto n = list.x.size() / static_cast<std::size_t>(dim);
        const std::string group = "node_lists/" + list.name;
        file.data<double>(group + "/positions", list.x, {n, static_cast<hsize_t>(dim)})
            .data(group + "/h", std::vector<double>(n, 0.1));
        if (!list.mass.empty()) file.data(group + "/mass", list.mass);
        if (!list.softening.empty()) file.data(group + "/softening", list.softening);
        file.attribute(group, "n_internal", list.n_internal)
            .attribute(group, "order", static_cast<int>(k));
    }
}

/// Internal nodes of these lists, end to end.
inline GravityScene internal_nodes(int dim, const std::vector<MassList>& lists) {
    GravityScene scene;
    for (const auto& list : lists)
        for (std::size_t i = 0; i < static_cast<std::size_t>(list.n_internal); ++i) {
            double x[3] = {0, 0, 0};
            for (int d = 0; d < dim; ++d)
                x[d] = list.x[i * static_cast<std::size_t>(dim) + static_cast<std::size_t>(d)];
            scene.add(x[0], x[1], x[2], list.mass.at(i));
            scene.e.push_back(list.softening.empty() ? 0 : list.softening[i]);
        }
    return scene;
}

/// What /gravity holds.
struct GravityResult {
    std::vector<double> acceleration, potential;
    explicit GravityResult(const std::string& path)
        : acceleration(PlainFile::open(path).read<double>("gravity/acceleration")),
          potential(PlainFile::open(path).read<double>("gravity/potential")) {}
};

/// Share of the particles in `targets` whose acceleration or potential is off by more than
/// `tolerance` of its length.
inline double share_beyond(double tolerance, const GravityResult& result,
                           const std::vector<BruteSum>& expected,
                           const std::vector<std::int64_t>& targets, double constant = 1) {
    double n_wrong = 0;
    for (std::size_t k = 0; k < targets.size(); ++k) {
        const auto i = static_cast<std::size_t>(targets[k]);
        const double* const a = result.acceleration.data() + 3 * i;
        const auto& sum = expected[k];
        const auto error =
            distance(sum, a[0] / constant, a[1] / constant, a[2] / constant) / length(sum);
        const auto shift = std::abs(-result.potential[i] / constant - sum.p) / std::abs(sum.p);
        n_wrong += !(error <= tolerance && shift <= tolerance);
    }
    return n_wrong / static_cast<double>(targets.size());
}

}  // namespace connectivity::test
