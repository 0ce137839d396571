// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Random cases of box trees, and trees built of them.

#include <support/random.hpp>
#include <tree/slow_tree.hpp>

namespace connectivity::test {

/// Points of a kind that trees find hard: smooth, clustered, on grid planes, many at one place.
inline TreeCase random_tree_case(std::uint64_t seed) {
    Random random(seed);
    TreeCase c;
    c.dim = 1 + random.below(3);
    c.type = random.chance(0.3) ? CoordinateType::float32 : CoordinateType::float64;
    auto& o = c.options;
    o.kind = random.pick({TreeKind::adaptive, TreeKind::adaptive,
                          TreeKind::adaptive_level_restricted, TreeKind::non_adaptive});
    // What takes the definition too long to tell stays small or smooth.
    const bool even = o.kind == TreeKind::non_adaptive,
               restricted = o.kind == TreeKind::adaptive_level_restricted;
    const int most = restricted ? 40 : 150;
    c.n_sources = random.below(random.chance(0.2) ? 3 : most);
    if (random.chance(0.6)) c.n_targets = random.below(random.chance(0.2) ? 3 : most);
    const int cloud = even ? 0 : random.below(restricted ? 3 : 4);
    const double shrink = random.log_uniform(restricted ? 0.02 : 1e-4, 0.1);
    for (int k = 0; k < c.n() * c.dim; ++k) {
        double x = random.uniform(-1, 1);
        if (cloud == 1 && random.chance(0.7)) x = 0.3 + shrink * x;
        if (cloud == 2) x = std::round(8 * x) / 8;
        if (cloud == 3) x = std::round(2 * x) / 2;
        c.x.push_back(c.type == CoordinateType::float32 ? static_cast<float>(x) : x);
    }
    o.coincident = Coincident::leaf;
    o.skip_prune = random.chance(0.2);
    o.hulls = Hulls::always;
    if (c.n_targets >= 0 && random.chance(0.7)) {
        c.source_radii = random.chance(0.5);
        c.target_radii = !c.source_radii || random.chance(0.5);
        o.stick_out_factor = random.pick({0.0, 0.1, 0.25, 1.0});
        o.extent_norm = random.pick({ExtentNorm::linf, ExtentNorm::l2});
        for (int i = 0; i < c.n(); ++i)
            c.radii.push_back(random.chance(0.1) ? 0.0
                                                 : static_cast<float>(random.log_uniform(
                                                       even || restricted ? 0.05 : 1e-5, 1)));
    }
    if (random.chance(0.3)) {
        o.max_leaf_refine_weight = (even ? 30 : 1) + random.below(60);
        for (int i = 0; i < c.n(); ++i)
            c.weights.push_back(random.below(std::min(*o.max_leaf_refine_weight + 1, 9)));
    } else {
        o.max_particles_in_box = (even ? 8 : 1) + random.below(12);
    }
    return c;
}

/// The case in the host's precision, alive as long as it.
class BuiltTree {
public:
    explicit BuiltTree(const TreeCase& c) : case_(c) {
        floats_.assign(c.x.begin(), c.x.end());
        float_radii_.assign(c.radii.begin(), c.radii.end());
        tree_.build(input(), c.options);
    }
    TreeInput input() const {
        TreeInput in;
        in.dim = case_.dim;
        in.coordinates = case_.type;
        in.sources = array(0, case_.n_sources, case_.source_radii);
        if (case_.n_targets >= 0)
            in.targets = array(case_.n_sources, case_.n_targets, case_.target_radii);
        if (!case_.weights.empty()) in.refine_weights = case_.weights.data();
        return in;
    }
    const TreeView& view() const { return tree_.view(); }
    BoxTree& tree() { return tree_; }

private:
    ParticleArray array(int first, int n, bool radii) const {
        const bool narrow = case_.type == CoordinateType::float32;
        const auto at = [&](const std::vector<double>& d, const std::vector<float>& f, int k) {
            return narrow ? static_cast<const void*>(f.data() + k)
                          : static_cast<const void*>(d.data() + k);
        };
        auto out =
            ParticleArray::interleaved(at(case_.x, floats_, first * case_.dim), n, case_.dim);
        if (radii) out.radii = at(case_.radii, float_radii_, first);
        return out;
    }

    const TreeCase& case_;
    std::vector<float> floats_, float_radii_;
    BoxTree tree_;
};

/// Paths of all boxes, by id.
inline std::vector<std::string> paths_of(const TreeView& tree) {
    std::vector<std::string> paths(tree.n_boxes);
    for (BoxId b = 0; b < tree.n_boxes; ++b)
        for (int k = 0; k < 1 << tree.dim; ++k)
            if (const BoxId child = tree.child(k, b); child > 0)
                paths[child] = paths[b] + static_cast<char>('0' + k);
    return paths;
}

}  // namespace connectivity::test
