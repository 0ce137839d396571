// SPDX-License-Identifier: BSD-3-Clause
/// Lists of the library's own trees: coverage and separation on random particles, and at the limits
/// of depth and number.

#include <connectivity/tree/box_tree.hpp>

#include "lists/coverage.hpp"
#include "lists/random_lists_case.hpp"

namespace connectivity::test {
namespace {

/// Particles of one kind as a host has them.
struct HostArray {
    HostArray(const std::vector<SlowParticle>& particles, int dim) {
        radii.reserve(1);  // of no particles there is an array of no radii
        float_radii.reserve(1);
        for (const SlowParticle& p : particles) {
            x.insert(x.end(), p.x.begin(), p.x.begin() + dim);
            radii.push_back(p.radius);
        }
        floats.assign(x.begin(), x.end());
        float_radii.assign(radii.begin(), radii.end());
    }
    ParticleArray array(int dim, bool narrow, bool has_radii) const {
        const auto pick = [&](const std::vector<double>& d, const std::vector<float>& f) {
            return narrow ? static_cast<const void*>(f.data()) : d.data();
        };
        auto out =
            ParticleArray::interleaved(pick(x, floats), static_cast<Offset>(radii.size()), dim);
        if (has_radii) out.radii = pick(radii, float_radii);
        return out;
    }
    std::vector<double> x, radii;
    std::vector<float> floats, float_radii;
};

BoxTree built(const SlowInput& in, bool narrow, TreeOptions options) {
    const HostArray sources(in.sources, in.dim), targets(in.targets, in.dim);
    TreeInput input;
    input.dim = in.dim;
    input.coordinates = narrow ? CoordinateType::float32 : CoordinateType::float64;
    input.sources = sources.array(in.dim, narrow, in.source_radii);
    if (!in.sources_are_targets) input.targets = targets.array(in.dim, narrow, in.target_radii);
    options.kind = in.kind == SlowKind::adaptive       ? TreeKind::adaptive
                   : in.kind == SlowKind::non_adaptive ? TreeKind::non_adaptive
                                                       : TreeKind::adaptive_level_restricted;
    options.max_particles_in_box = in.kind == SlowKind::non_adaptive ? in.leaf + 10 : in.leaf;
    if (in.source_radii || in.target_radii) options.stick_out_factor = in.stick_out;
    options.extent_norm = in.norm;
    options.coincident = Coincident::leaf;
    options.periodic = in.periodic;
    BoxTree tree;
    tree.build(input, options);
    return tree;
}

/// From the nearest of a box's own particles to a point.
double nearest(const TreeView& tree, const TreeParticles& particles, BoxId box, const Point& point,
               bool l2) {
    double least = std::numeric_limits<double>::infinity();
    const Offset first = particles.box_starts(box);
    for (Offset i = first; i < first + particles.box_counts_nonchild(box); ++i) {
        double square = 0, cube = 0;
        for (int k = 0; k < tree.dim; ++k) {
            const double x = std::abs(particles.positions(k * particles.n + i) - point[k]);
            square += x * x;
            cube = std::max(cube, x);
        }
        const double radius = particles.have_extent() ? particles.radii(i) : 0;
        least = std::min(least, (l2 ? std::sqrt(square) : cube) - radius);
    }
    return least;
}

void expect_separation(const FMMTraversalInfo& lists, const Rows& smaller_of, bool l2) {
    const TreeView& tree = lists.tree();
    const double eps = tree.coordinates == CoordinateType::float32 ? 1e-6 : 1e-14;
    double size = tree.root_extent;
    for (int k = 0; k < tree.dim; ++k) size = std::max(size, std::abs(tree.bounding_box_min[k]));
    const auto center = [&](BoxId b, ImageCode image, int sign) {
        Point c{};
        for (int k = 0; k < tree.dim; ++k)
            c[k] = tree.center(k, b) + sign * image_shift(image)[k] * tree.root_extent;
        return c;
    };
    const auto reach = [&](const TreeParticles& kind, BoxId b) {
        const double s = kind.have_extent() ? tree.stick_out_factor : 0;
        return 3 * (1 + s) * tree.half_width(b) * (1 - 100 * eps) - eps * size;
    };
    for (const BoxId t : std::span(lists.target_boxes().data(), lists.target_boxes().size()))
        for (const Entry& e : smaller_of.at(t))
            ASSERT_GE(nearest(tree, tree.targets, t, center(e.box, e.image, 1), l2),
                      reach(tree.sources, e.box))
                << "multipole of box " << e.box << " at the targets of " << t;
    const auto boxes = lists.target_or_target_parent_boxes();
    for (Offset i = 0; i < lists.ntarget_or_target_parent_boxes(); ++i)
        for (const Entry& e : row_of(lists.from_sep_bigger(), i))
            ASSERT_GE(nearest(tree, tree.sources, e.box, center(boxes(i), e.image, -1), l2),
                      reach(tree.targets, boxes(i)))
                << "sources of box " << e.box << " in the local expansion of " << boxes(i);
}

std::vector<ImageCode> images_of(const TreeView& tree) {
    std::vector<ImageCode> images;
    for (ImageCode image = 0; image < 27; ++image) {
        bool exists = true;
        for (int k = 0; k < 3; ++k)
            exists &= image_shift(image)[k] == 0 || (k < tree.dim && tree.periodic[k]);
        if (exists) images.push_back(image);
    }
    return images;
}

void expect_laws(const FMMTraversalInfo& lists, bool l2) {
    const Rows smaller_of = smaller_rows(lists);
    const auto images = images_of(lists.tree());
    expect_coverage(lists, smaller_of, images);
    expect_constant_one(lists, smaller_of, images.size());
    expect_separation(lists, smaller_of, l2);
}

void check_case(std::uint64_t seed, bool periodic) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    ListsCase c = random_lists_case(seed, periodic);
    Random random(seed + 1);
    const bool narrow = random.chance(0.2);
    TreeOptions options;
    options.hulls = Hulls::always;
    options.skip_prune = random.chance(0.1);
    if (random.chance(0.05)) c.tree.stick_out *= 1000;
    if (random.chance(0.05)) c.options.well_sep_is_n_away = 50;
    const bool any_periodic = c.tree.periodic[0] || c.tree.periodic[1] || c.tree.periodic[2];
    if (any_periodic || (!c.tree.source_radii && !c.tree.target_radii && random.chance(0.5))) {
        options.bounding_box.emplace();
        for (int k = 0; k < c.tree.dim; ++k) {
            options.bounding_box->lo[k] = c.tree.lo;
            options.bounding_box->hi[k] = c.tree.lo + c.tree.extent;
        }
    }
    if (any_periodic)  // those with a radius may stick out of the open faces only if there are none
        for (int k = 0; k < c.tree.dim; ++k)
            c.tree.periodic[k] = c.tree.source_radii || c.tree.target_radii || c.tree.periodic[k];
    options.budget.bytes = 80'000;
    BoxTree tree;
    try {
        tree = built(c.tree, narrow, options);
    } catch (const Error& error) {  // 400 boxes: to count pairs would take too long
        ASSERT_EQ(error.status(), Status::too_many) << error.what();
        return;
    }
    expect_laws(FMMTraversalInfo(tree.view(), c.options),
                c.options.from_sep_smaller_crit == FromSepSmallerCrit::static_l2);
}

TEST(RandomLists, of_the_librarys_trees_cover_every_pair_once) {
    for (int seed = 0; seed < n_cases(2000); ++seed) {
        check_case(200000 + seed, false);
        if (HasFatalFailure()) return;
    }
}

TEST(RandomLists, of_the_librarys_periodic_trees_cover_every_image_once) {
    for (int seed = 0; seed < n_cases(2000) / 10; ++seed) {
        check_case(500000 + seed, true);
        if (HasFatalFailure()) return;
    }
}

/// Dynamic ranges 1e10, 1e14 and 1e70: the last is as deep as trees go.
TEST(DeepTrees, cover_every_pair_once) {
    for (const double ratio : {1e-10, 1e-14, 1e-70})
        for (const int dim : {1, 2, 3})
            for (const bool radii : {false, true}) {
                SCOPED_TRACE(testing::Message()
                             << dim << "D, ratio " << ratio << ", radii " << radii);
                Random random(3);
                SlowInput in;
                in.dim = dim;
                in.leaf = 2;
                in.target_radii = radii;
                in.stick_out = radii ? 0.25 : 0;
                for (int i = 0; i < 40; ++i) {
                    SlowParticle p;
                    for (int k = 0; k < dim; ++k)
                        p.x[k] = (i % 4 == 0 ? 1 : ratio) * random.uniform();
                    in.sources.push_back(p);
                    if (radii)  // no particle reaches below 0, where coordinates would no more be
                                // fine
                        p.radius = *std::min_element(p.x.begin(), p.x.begin() + dim) *
                                   random.log_uniform(1e-3, 0.5);
                    in.targets.push_back(p);
                }
                const BoxTree tree = built(in, false, {});
                EXPECT_GE(tree.view().n_levels, std::log2(1 / ratio));
                expect_laws(FMMTraversalInfo(tree.view()), false);
                if (HasFatalFailure()) return;
            }
}

/// Among these are trees where nothing touches and close lists hold all there is.
TEST(SmallTrees, merged_lists_keep_the_images_where_list_1_was_empty) {
    int n_empty = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Random random(seed);
        SlowInput in;
        in.dim = 1;
        in.leaf = 1;
        in.target_radii = true;
        in.stick_out = 1;
        in.periodic[0] = true;
        for (int i = 0; i < 2; ++i) {
            in.sources.push_back({{0.2 + 0.1 * random.uniform(), 0, 0}});
            in.targets.push_back({{0.95 + 0.04 * random.uniform(), 0, 0}, 0.02});
        }
        TreeOptions options;
        options.bounding_box = {{}, {1, 0, 0}};
        const BoxTree tree = built(in, false, options);
        const FMMTraversalInfo lists(tree.view());
        n_empty += lists.neighbor_source_boxes().lists.size() == 0 &&
                   lists.from_sep_close_smaller()->lists.size() +
                           lists.from_sep_close_bigger()->lists.size() >
                       0;
        expect_laws(lists, false);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(n_empty, 0);
}

TEST(SmallTrees, have_lists_without_particles_of_either_kind) {
    for (const int n_sources : {0, 1, 7})
        for (const int n_targets : {0, 1, 7})
            for (const bool periodic : {false, true})
                for (const bool radii : {false, true}) {
                    SCOPED_TRACE(std::to_string(n_sources) + " and " + std::to_string(n_targets));
                    Random random(8);
                    SlowInput in;
                    in.leaf = 1;
                    in.source_radii = in.target_radii = radii;
                    in.periodic = {periodic, periodic, false};
                    const auto point = [&] {
                        return SlowParticle{{random.uniform(), random.uniform(), 0},
                                            0.3 * random.uniform()};
                    };
                    for (int i = 0; i < n_sources; ++i) in.sources.push_back(point());
                    for (int i = 0; i < n_targets; ++i) in.targets.push_back(point());
                    TreeOptions options;
                    if (periodic) options.bounding_box = {{}, {1, 1, 1}};
                    const BoxTree tree = built(in, false, options);
                    expect_laws(FMMTraversalInfo(tree.view()), false);
                    if (HasFatalFailure()) return;
                }
}

}  // namespace
}  // namespace connectivity::test
