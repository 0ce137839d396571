// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// A box tree over one scene's particles as sources and another's as targets, its lists, and the
/// sums by definition.

#include <optional>

#include <gtest/gtest.h>

#include <connectivity/gravity/list_sums.hpp>
#include <connectivity/tree/box_tree.hpp>

#include <support/gravity_brute.hpp>

namespace connectivity::test {

struct ListScene {
    GravityScene sources;
    std::optional<GravityScene> targets;  ///< absent: the sources
    std::vector<double> source_radii, target_radii;
    int dim = 3;
    TreeOptions tree;
    TraversalOptions lists;

    const GravityScene& at() const { return targets ? *targets : sources; }
};

/// Tree and lists of a scene, and what they read.
struct BuiltLists {
    std::vector<double> source_positions, target_positions;
    BoxTree tree;
    FMMTraversalInfo lists;

    explicit BuiltLists(const ListScene& s) {
        const auto flat = [&](const GravityScene& g) {
            std::vector<double> x;
            const std::vector<double>* const axes[] = {&g.x, &g.y, &g.z};
            for (int d = 0; d < s.dim; ++d) x.insert(x.end(), axes[d]->begin(), axes[d]->end());
            return x;
        };
        source_positions = flat(s.sources);
        TreeInput input;
        input.dim = s.dim;
        input.sources = ParticleArray::separate(source_positions.data(), s.sources.n());
        if (!s.source_radii.empty()) input.sources.radii = s.source_radii.data();
        if (s.targets) {
            target_positions = flat(*s.targets);
            input.targets = ParticleArray::separate(target_positions.data(), s.targets->n());
            if (!s.target_radii.empty()) input.targets->radii = s.target_radii.data();
        }
        TreeOptions options = s.tree;
        if (!options.max_particles_in_box) options.max_particles_in_box = 10;
        options.coincident = Coincident::leaf;
        tree.build(input, options);
        lists.rebuild(tree.view(), s.lists);
    }
};

inline ListMasses masses_of(const ListScene& s) {
    ListMasses masses{.n = s.sources.n(), .masses = s.sources.m.data()};
    if (!s.sources.e.empty()) masses.softening = s.sources.e.data();
    if (s.targets && !s.targets->e.empty()) masses.target_softening = s.targets->e.data();
    return masses;
}

/// What sources do to targets, by definition. Pairs at one place do nothing.
inline std::vector<BruteSum> brute_sums(const ListScene& s, BruteLaw law = BruteLaw::newton,
                                        std::span<const Shift> images = {}) {
    if (!s.targets) return brute_gravity(s.sources, law, images);
    GravityScene all = s.sources;
    all.append(*s.targets);
    all.e.insert(all.e.end(), s.targets->e.begin(), s.targets->e.end());
    std::fill(all.m.begin() + s.sources.n(), all.m.end(), 0.0);
    std::vector<std::int64_t> which;
    for (std::int64_t i = s.sources.n(); i < all.n(); ++i) which.push_back(i);
    return brute_gravity(all, which, law, images);
}

/// |error| / sum of the terms' lengths.
struct ListErrors {
    double max_p = 0, rms_p = 0, max_a = 0, rms_a = 0;
};

inline ListErrors errors_of(const ListSums& sums, const std::vector<BruteSum>& wanted) {
    ListErrors e;
    const auto n = static_cast<Offset>(wanted.size());
    EXPECT_EQ(sums.n(), n);
    for (Offset i = 0; i < n; ++i) {
        const BruteSum& w = wanted[i];
        const auto a = sums.acceleration();
        const double p = static_cast<double>(std::abs(sums.potential()(i) + w.p) /
                                             std::max(w.size_p, 1e-300L)),
                     f = static_cast<double>(distance(w, a(3 * i), a(3 * i + 1), a(3 * i + 2)) /
                                             std::max(w.size_a, 1e-300L));
        e.max_p = std::max(e.max_p, p);
        e.max_a = std::max(e.max_a, f);
        e.rms_p += p * p / static_cast<double>(n);
        e.rms_a += f * f / static_cast<double>(n);
    }
    e.rms_p = std::sqrt(e.rms_p);
    e.rms_a = std::sqrt(e.rms_a);
    return e;
}

/// Entries of list 3.
inline Offset n_smaller(const FMMTraversalInfo& lists) {
    Offset n = 0;
    for (int level = 0; level < lists.nlevels(); ++level)
        n += lists.from_sep_smaller(level).count();
    return n;
}

inline Offset n_bigger(const FMMTraversalInfo& lists) {
    return static_cast<Offset>(lists.from_sep_bigger().lists.size());
}

}  // namespace connectivity::test
