// SPDX-License-Identifier: BSD-3-Clause
// The order of work on the lists, with the kernel that is 1 everywhere: every target receives the
// charge of every source exactly once.

#include <gravity/list_evaluation.hpp>

#include <support/random.hpp>

#include "gravity/list_scene.hpp"

namespace connectivity::test {
namespace {

using detail::BoxEntries;
using detail::SourceRuns;

/// Expansions that know one thing, the sum of charges: 1 for each source, and for a second sum the
/// number of the source, so that one that is missing and one that is twice are no even trade.
struct Counter {
    struct Sum {
        Offset charge = 0, number = 0;
        void operator+=(const Sum& other) {
            charge += other.charge;
            number += other.number;
        }
    };
    const TreeView& tree;
    std::vector<Sum> moments, locals, targets;
    int n_p2m = 0, n_m2m = 0, n_m2l = 0, n_p2l = 0, n_l2l = 0, n_l2p = 0, n_p2p = 0, n_m2p = 0;

    explicit Counter(const TreeView& t) : tree(t) {
        const Sum unknown{1 << 20, 1 << 20};  // whoever does not begin with 0 is found out
        moments.assign(t.n_boxes, unknown);
        locals.assign(t.n_boxes, unknown);
        targets.assign(t.targets.n, unknown);
    }
    Sum of(const SourceRuns& sources) const {
        Sum sum;
        for (const detail::SourceRun& run : sources.runs)
            for (int k = 0; k < run.n; ++k) sum += {1, run.first + k};
        return sum;
    }
    void add_to_own(BoxId b, const Sum& sum) {
        for (int k = 0; k < tree.targets.box_counts_nonchild(b); ++k)
            targets[tree.targets.box_starts(b) + k] += sum;
    }

    void clear_moments(BoxId b) { moments[b] = {}; }
    void p2m(BoxId b) {
        SourceRuns runs;
        runs.add(tree.sources, {&b, 1});
        moments[b] += of(runs);
        __atomic_fetch_add(&n_p2m, 1, __ATOMIC_RELAXED);
    }
    void m2m(BoxId b, const BoxEntries& children) {
        for (Offset k = 0; k < children.n; ++k) moments[b] += moments[children.boxes[k]];
        __atomic_fetch_add(&n_m2m, 1, __ATOMIC_RELAXED);
    }
    void clear_local(BoxId b) { locals[b] = {}; }
    void m2l(BoxId b, const BoxEntries& sources) {
        for (Offset k = 0; k < sources.n; ++k) locals[b] += moments[sources.boxes[k]];
        __atomic_fetch_add(&n_m2l, 1, __ATOMIC_RELAXED);
    }
    void p2l(int, BoxId b, const SourceRuns& sources) {
        locals[b] += of(sources);
        __atomic_fetch_add(&n_p2l, 1, __ATOMIC_RELAXED);
    }
    void l2l(BoxId b, const BoxEntries& children) {
        for (Offset k = 0; k < children.n; ++k) locals[children.boxes[k]] += locals[b];
        __atomic_fetch_add(&n_l2l, 1, __ATOMIC_RELAXED);
    }
    void begin_targets(BoxId b) {
        for (int k = 0; k < tree.targets.box_counts_nonchild(b); ++k)
            targets[tree.targets.box_starts(b) + k] = {};
    }
    void l2p(BoxId b) {
        add_to_own(b, locals[b]);
        __atomic_fetch_add(&n_l2p, 1, __ATOMIC_RELAXED);
    }
    void p2p(int, BoxId b, const SourceRuns& sources) {
        add_to_own(b, of(sources));
        __atomic_fetch_add(&n_p2p, 1, __ATOMIC_RELAXED);
    }
    void m2p(BoxId b, const BoxEntries& sources) {
        for (Offset k = 0; k < sources.n; ++k) add_to_own(b, moments[sources.boxes[k]]);
        __atomic_fetch_add(&n_m2p, 1, __ATOMIC_RELAXED);
    }
};

/// Particles at all scales around a few corners, so that leaves of all sizes touch.
GravityScene adaptive_cloud(Random& random, int n, int dim) {
    GravityScene s;
    const double depth = random.pick({1e-1, 1e-3, 1e-6});
    for (int i = 0; i < n; ++i) {
        double x[3] = {};
        for (int d = 0; d < dim; ++d) {
            const double u = std::pow(depth, random.uniform());
            x[d] = random.chance(0.5) ? 0.3 * u : 0.9 - 0.4 * u;
        }
        s.add(x[0], x[1], x[2], 1);
    }
    return s;
}

std::vector<double> radii(Random& random, std::int64_t n) {
    std::vector<double> r;
    for (std::int64_t i = 0; i < n; ++i)
        r.push_back(random.chance(0.2) ? 0 : random.log_uniform(1e-3, 0.2));
    return r;
}

ListScene random_scene(std::uint64_t seed, FromSepSmallerCrit crit) {
    Random random(seed);
    ListScene s;
    s.dim = seed % 4 == 3 ? 1 + random.below(2) : 3;
    s.sources = adaptive_cloud(random, 300 + random.below(700), s.dim);
    const bool extents = seed % 2 == 0;
    if (extents || random.chance(0.5))
        s.targets = adaptive_cloud(random, 200 + random.below(500), s.dim);
    if (extents) {
        s.target_radii = radii(random, s.targets->n());
        if (random.chance(0.5)) s.source_radii = radii(random, s.sources.n());
        s.tree.stick_out_factor = random.pick({0.0, 0.25, 0.5});
        if (crit != FromSepSmallerCrit::static_linf && random.chance(0.5))
            s.tree.extent_norm = ExtentNorm::l2;
    } else if (random.chance(0.3)) {
        s.tree.bounding_box.emplace();
        for (int d = 0; d < s.dim; ++d) s.tree.bounding_box->hi[d] = 1;
        for (int d = 0; d < s.dim; ++d) s.tree.periodic[d] = random.chance(0.7);
    }
    s.tree.hulls = Hulls::always;
    s.tree.skip_prune = seed % 5 == 0;  // boxes without particles
    s.tree.max_particles_in_box = 1 + random.below(12);
    s.lists.well_sep_is_n_away = 1 + random.below(2);
    s.lists.from_sep_smaller_crit = crit;
    if (random.chance(0.3)) s.lists.from_sep_smaller_min_nsources_cumul = random.below(8);
    return s;
}

TEST(SourceRuns, join_where_sources_and_images_do) {
    SourceRuns runs;
    for (const detail::SourceRun& run :
         {detail::SourceRun{0, 5, 13}, {5, 0, 4}, {5, 2, 13}, {7, 3, 14}, {10, 1, 14}, {12, 1, 14}})
        runs.add(run);
    ASSERT_EQ(runs.runs.size(), 3u);
    EXPECT_EQ(runs.n, 12);
    const int wanted[3][3] = {{0, 7, 13}, {7, 4, 14}, {12, 1, 14}};
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(runs.runs[k].first, wanted[k][0]);
        EXPECT_EQ(runs.runs[k].n, wanted[k][1]);
        EXPECT_EQ(runs.runs[k].image, wanted[k][2]);
    }
}

class ListCount : public ::testing::TestWithParam<FromSepSmallerCrit> {};

TEST_P(ListCount, each_target_meets_each_source_exactly_once) {
    int n_operators[8] = {}, n_close = 0, n_empty = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const ListScene scene = random_scene(seed, GetParam());
        const BuiltLists built(scene);
        const TreeView& tree = built.lists.tree();
        Counter counter(tree);
        Report report;
        detail::ListEvaluation<Counter>().run(built.lists, counter, report);
        Offset n_images = 1;
        for (const bool periodic : tree.periodic) n_images *= periodic ? 3 : 1;
        const Offset n = scene.sources.n();
        for (const Counter::Sum& sum : counter.targets) {
            ASSERT_EQ(sum.charge, n * n_images);
            ASSERT_EQ(sum.number, n * (n - 1) / 2 * n_images);
        }
        const int counts[] = {counter.n_p2m, counter.n_m2m, counter.n_m2l, counter.n_p2l,
                              counter.n_l2l, counter.n_l2p, counter.n_p2p, counter.n_m2p};
        for (int k = 0; k < 8; ++k) n_operators[k] += counts[k] > 0;
        if (const auto close = built.lists.from_sep_close_smaller())
            n_close +=
                close->lists.size() > 0 && built.lists.from_sep_close_bigger()->lists.size() > 0;
        for (BoxId b = 0; b < tree.n_boxes; ++b)
            if (tree.sources.box_counts_cumul(b) == 0 && tree.targets.box_counts_cumul(b) == 0) {
                ++n_empty;
                break;
            }
    }
    for (const int n : n_operators) EXPECT_GE(n, 15) << "an operator that few trees have used";
    EXPECT_GE(n_close, 5) << "trees with close lists";
    EXPECT_GE(n_empty, 3) << "trees with empty boxes";
}

std::string name_of(const ::testing::TestParamInfo<FromSepSmallerCrit>& info) {
    const char* const names[] = {"static_linf", "precise_linf", "static_l2"};
    return names[static_cast<int>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(criteria, ListCount,
                         ::testing::Values(FromSepSmallerCrit::static_linf,
                                           FromSepSmallerCrit::precise_linf,
                                           FromSepSmallerCrit::static_l2),
                         name_of);

}  // namespace
}  // namespace connectivity::test
