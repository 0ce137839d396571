// SPDX-License-Identifier: BSD-3-Clause
// Sums over the lists of a traversal against sums by definition, and how their errors fall.

#include <string_view>

#include <support/random.hpp>

#include "gravity/list_scene.hpp"
#include "gravity/list_series.hpp"

namespace connectivity::test {
namespace {

constexpr FromSepSmallerCrit criteria[] = {FromSepSmallerCrit::static_linf,
                                           FromSepSmallerCrit::precise_linf,
                                           FromSepSmallerCrit::static_l2};

ListErrors errors(const ListScene& scene, const BuiltLists& built,
                  const std::vector<BruteSum>& wanted, int order,
                  Softening softening = Softening::plummer) {
    ListSums sums;
    sums.evaluate(built.lists, masses_of(scene), {.order = order, .softening = softening});
    return errors_of(sums, wanted);
}

/// The unit cube in 8³ leaves.
ListScene regular_scene(int n_away) {
    ListScene s;
    s.sources = uniform_scene(3000);
    s.tree.kind = TreeKind::non_adaptive;
    s.tree.max_particles_in_box = 20;
    s.tree.bounding_box = {{}, {1, 1, 1}};
    s.lists.well_sep_is_n_away = n_away;
    return s;
}

/// Which box of 2^level along an axis.
int box_of(double x, int level) { return static_cast<int>(std::ldexp(x, level)); }

/// The theory that the code is held to: what order P makes of 1 / |s - t| on a regular tree whose
/// leaves are at level 3. The coarsest boxes that are more than n apart act by the offsets of both
/// particles from their centres (list 2); leaves that are closer, and do not touch, by the
/// target's alone (list 4).
double expanded(const double (&t)[3], const double (&s)[3], int n_away, int order) {
    double R[3], d[3];
    int level = 1, apart = 0;
    while (apart <= n_away && level < 3) {
        ++level;
        apart = 0;
        for (int k = 0; k < 3; ++k)
            apart = std::max(apart, std::abs(box_of(s[k], level) - box_of(t[k], level)));
    }
    const bool direct = apart <= 1, from_particle = apart <= n_away;
    for (int k = 0; k < 3; ++k) {
        const double to = std::ldexp(box_of(t[k], level) + 0.5, -level),
                     from = std::ldexp(box_of(s[k], level) + 0.5, -level);
        const double source = direct || from_particle ? s[k] : from;
        const double target = direct ? t[k] : to;
        R[k] = target - source;
        d[k] = (s[k] - source) - (t[k] - target);
    }
    if (!direct) return series(R, d, order);
    const double r2 = R[0] * R[0] + R[1] * R[1] + R[2] * R[2];
    return r2 > 0 ? 1 / std::sqrt(r2) : 0;
}

double slope(const std::vector<double>& errors) {
    return std::log(errors.back() / errors.front()) / static_cast<double>(errors.size() - 1);
}

TEST(ListSums, errors_are_what_legendres_series_leaves_out) {
    for (const int n_away : {1, 2}) {
        const ListScene scene = regular_scene(n_away);
        const BuiltLists built(scene);
        ASSERT_EQ(built.lists.nlevels(), 4);
        const auto wanted = brute_sums(scene);
        std::vector<double> measured, theory, forces;
        const GravityScene& g = scene.sources;
        for (int order = 1; order <= 10; ++order) {
            ListSums sums;
            sums.evaluate(built.lists, masses_of(scene), {.order = order});
            double square = 0;
            for (Offset i = 0; i < g.n(); i += 30) {
                double p = 0;
                for (Offset j = 0; j < g.n(); ++j)
                    p += g.m[j] * expanded({g.x[i], g.y[i], g.z[i]}, {g.x[j], g.y[j], g.z[j]},
                                           n_away, order);
                ASSERT_NEAR(-sums.potential()(i) / p, 1, 2e-14) << "order " << order;
                const double error = p / static_cast<double>(wanted[i].size_p) - 1;
                square += error * error / 100;
            }
            const ListErrors e = errors_of(sums, wanted);
            measured.push_back(e.rms_p);
            forces.push_back(e.rms_a);
            theory.push_back(std::sqrt(square));
        }
        const double worst = std::log(std::sqrt(3.0) / (n_away + 1));
        EXPECT_NEAR(slope(measured) / slope(theory), 1, 0.1) << n_away;
        EXPECT_LT(slope(measured), worst) << n_away;
        EXPECT_NEAR(slope(forces) / slope(theory), 1, 0.2) << n_away;
    }
}

/// Targets with radii of all sizes, which stay in boxes of all sizes.
ListScene scene_with_extents(bool sources_too, FromSepSmallerCrit crit, ExtentNorm norm) {
    ListScene s;
    s.sources = plummer_scene(1200, 11);
    s.targets = plummer_scene(900, 12);
    Random random(13);
    for (int i = 0; i < 900; ++i) s.target_radii.push_back(std::exp2(random.uniform(-10, -1)));
    for (int i = 0; i < 1200 && sources_too; ++i)
        s.source_radii.push_back(std::exp2(random.uniform(-10, -1)));
    s.tree.stick_out_factor = 0.25;
    s.tree.extent_norm = norm;
    s.lists.from_sep_smaller_crit = crit;
    return s;
}

/// Every list, to every degree: nothing but the series, whatever the tree.
TEST(ListSums, each_list_is_legendres_series_about_its_boxes) {
    for (const int kind : {0, 1, 2}) {
        ListScene scene;
        scene.sources = plummer_scene(700, 21);
        scene.lists.well_sep_is_n_away = kind == 1 ? 2 : 1;
        if (kind == 2) {
            scene = scene_with_extents(true, FromSepSmallerCrit::precise_linf, ExtentNorm::linf);
            scene.tree.max_particles_in_box = 5;
        }
        const BuiltLists built(scene);
        EXPECT_GT(n_smaller(built.lists), 0);
        EXPECT_GT(n_bigger(built.lists), 0);
        for (const int order : {1, 2, 3, 4, 7, 12, 20}) {
            ListSums sums;
            sums.evaluate(built.lists, masses_of(scene), {.order = order});
            const auto wanted = series_over_lists(built.lists, scene.sources.m, order);
            for (Offset i = 0; i < sums.n(); i += 9)
                ASSERT_NEAR(-sums.potential()(i) / wanted[i], 1, 2e-13)
                    << "kind " << kind << ", order " << order << ", target " << i;
        }
    }
}

TEST(ListSums, errors_end_at_round_off) {
    ListScene scene = regular_scene(1);  // 4³ leaves, particles near their centres
    scene.sources = uniform_scene(1280);
    scene.tree.max_particles_in_box = 20;
    int i = 0;
    for (std::vector<double>* x : {&scene.sources.x, &scene.sources.y, &scene.sources.z}) {
        for (std::size_t k = 0; k < x->size(); ++k)
            (*x)[k] = (static_cast<double>(k >> 2 * i & 3) + 0.5) / 4 + 0.01 * ((*x)[k] - 0.5);
        ++i;
    }
    const BuiltLists built(scene);
    ASSERT_EQ(built.lists.nlevels(), 3);
    ASSERT_EQ(built.lists.from_sep_siblings().lists.size(), 3096u);
    const ListErrors e = errors(scene, built, brute_sums(scene), 12);
    EXPECT_LT(e.max_p, 1e-14);
    EXPECT_LT(e.max_a, 1e-14);
}

TEST(ListSums, errors_fall_in_adaptive_trees) {
    for (const char* name : {"G1", "G3", "G4", "G5", "G6", "spiral"})
        for (const int n_away : {1, 2}) {
            SCOPED_TRACE(std::string(name) + ", n = " + std::to_string(n_away));
            ListScene scene;
            scene.sources = std::string(name) == "spiral" ? spiral_scene(1500, 30)
                                                          : make_gravity_scene(name, 1500);
            scene.lists.well_sep_is_n_away = n_away;
            const BuiltLists built(scene);
            EXPECT_GT(n_smaller(built.lists), 0);
            EXPECT_GT(n_bigger(built.lists), 0);
            const auto wanted = brute_sums(scene);
            // In G5 the masses are where boxes touch: the worst case at every order.
            const double bound = std::sqrt(3.0) / (n_away + 1);
            const double theta = n_away == 1 && std::string_view(name) != "G5" ? 0.65 : bound;
            const ListErrors first = errors(scene, built, wanted, 2);
            const ListErrors last = errors(scene, built, wanted, 18);
            EXPECT_LT(last.rms_p / first.rms_p, std::pow(theta, 16));
            EXPECT_LT(last.rms_a / first.rms_a, std::pow(theta, 16));
            EXPECT_LT(last.max_p / first.max_p, std::pow(bound, 16));
            EXPECT_LT(last.max_a / first.max_a, std::pow(bound, 16));
            const ListErrors middle = errors(scene, built, wanted, 10);
            EXPECT_LT(middle.rms_a / first.rms_a, std::pow(theta, 8));
            EXPECT_LT(last.rms_a / middle.rms_a, theta == bound && n_away == 1 ? 1 : 0.1);
        }
}

TEST(ListSums, errors_fall_with_extents_and_every_criterion) {
    for (const bool sources_too : {false, true})
        for (const FromSepSmallerCrit crit : criteria)
            for (const ExtentNorm norm : {ExtentNorm::linf, ExtentNorm::l2}) {
                if (norm == ExtentNorm::l2 && crit == FromSepSmallerCrit::static_linf) continue;
                const ListScene scene = scene_with_extents(sources_too, crit, norm);
                const BuiltLists built(scene);
                EXPECT_GT(n_smaller(built.lists), 0);
                EXPECT_GT(built.lists.from_sep_close_smaller()->lists.size(), 0);
                EXPECT_GT(built.lists.from_sep_close_bigger()->lists.size(), 0);
                const auto wanted = brute_sums(scene);
                const ListErrors first = errors(scene, built, wanted, 4);
                const ListErrors last = errors(scene, built, wanted, 20);
                EXPECT_LT(first.rms_a, 4e-3);
                EXPECT_LT(last.rms_p / first.rms_p, std::pow(0.65, 16));
                EXPECT_LT(last.rms_a / first.rms_a, std::pow(0.7, 16));
                EXPECT_LT(last.max_a / first.max_a, std::pow(0.75, 16));
            }
}

TEST(ListSums, targets_need_not_be_sources) {
    ListScene scene;
    scene.sources = plummer_scene(1500);
    scene.lists.well_sep_is_n_away = 2;
    scene.targets = uniform_scene(700).scale(30).shift(-15, -15, -15);
    scene.targets->append(plummer_scene(300, 5));
    // Some at the very place of a source: it does nothing to them.
    for (int i = 0; i < 20; ++i)
        scene.targets->add(scene.sources.x[i], scene.sources.y[i], scene.sources.z[i], 0);
    const BuiltLists built(scene);
    const auto wanted = brute_sums(scene);
    EXPECT_LT(errors(scene, built, wanted, 10).max_a, 3e-4);
    EXPECT_LT(errors(scene, built, wanted, 20).max_a, 3e-6);
}

TEST(ListSums, masses_may_be_negative_or_0) {
    ListScene scene;
    scene.sources = plummer_scene(1500);
    for (std::size_t i = 0; i < scene.sources.m.size(); ++i)
        scene.sources.m[i] *= static_cast<double>(i % 3) - 1;
    scene.lists.well_sep_is_n_away = 2;
    const BuiltLists built(scene);
    const auto wanted = brute_sums(scene);
    EXPECT_LT(errors(scene, built, wanted, 10).max_a, 3e-4);
    EXPECT_LT(errors(scene, built, wanted, 20).max_a, 3e-6);
    std::fill(scene.sources.m.begin(), scene.sources.m.end(), 0.0);
    ListSums sums;
    sums.evaluate(built.lists, masses_of(scene));
    for (Offset i = 0; i < 3 * sums.n(); ++i) ASSERT_EQ(sums.acceleration()(i), 0);
}

TEST(ListSums, missing_dimensions_are_0) {
    for (const int dim : {1, 2}) {
        ListScene scene;
        scene.dim = dim;
        scene.lists.well_sep_is_n_away = 2;
        scene.sources = plummer_scene(1000);
        std::fill(scene.sources.z.begin(), scene.sources.z.end(), 0.0);
        if (dim == 1) std::fill(scene.sources.y.begin(), scene.sources.y.end(), 0.0);
        const BuiltLists built(scene);
        const auto wanted = brute_sums(scene);
        EXPECT_LT(errors(scene, built, wanted, 10).max_a, 1e-4) << dim;
        EXPECT_LT(errors(scene, built, wanted, 20).max_a, 1e-6) << dim;
    }
}

TEST(ListSums, images_of_periodic_trees_act_once_each) {
    for (const int axes : {1, 5, 7}) {
        ListScene scene;
        scene.sources = plummer_scene(600).scale(0.01).shift(0.51, 0.02, 0.98);
        scene.sources.append(uniform_scene(300));
        for (std::vector<double>* x : {&scene.sources.x, &scene.sources.y, &scene.sources.z})
            for (double& value : *x) value -= std::floor(value);
        scene.tree.bounding_box = {{}, {1, 1, 1}};
        scene.lists.well_sep_is_n_away = 2;
        std::vector<Shift> images;
        for (int d = 0; d < 3; ++d) scene.tree.periodic[d] = (axes >> d & 1) != 0;
        for (const Shift& shift : image_shifts(1, 1)) {
            bool exists = true;
            for (int d = 0; d < 3; ++d) exists &= shift[d] == 0 || scene.tree.periodic[d];
            if (exists) images.push_back(shift);
        }
        const auto wanted = brute_sums(scene, BruteLaw::newton, images);
        scene.tree.max_particles_in_box = 400;  // a box and its image act on the same targets
        EXPECT_LT(errors(scene, BuiltLists(scene), wanted, 20).max_a, 3e-6) << axes;
        scene.tree.max_particles_in_box = 10;
        const BuiltLists built(scene);
        EXPECT_GT(n_smaller(built.lists), 0);
        EXPECT_GT(n_bigger(built.lists), 0);
        EXPECT_LT(errors(scene, built, wanted, 10).max_a, 3e-4) << axes;
        EXPECT_LT(errors(scene, built, wanted, 20).max_a, 3e-6) << axes;
    }
}

TEST(ListSums, direct_lists_are_softened) {
    for (const bool probes : {false, true})
        for (const Softening law : {Softening::plummer, Softening::sph_exa}) {
            ListScene scene;
            GravityScene& g = scene.sources = uniform_scene(1000);
            scene.tree.max_particles_in_box = 40;
            scene.lists.well_sep_is_n_away = 2;
            for (int i = 0; i < 30; ++i) {  // three at one place, one inside the softening
                for (int k = 0; k < 2; ++k) g.add(g.x[i], g.y[i], g.z[i], 1e-3);
                g.add(g.x[i] + 1e-4, g.y[i], g.z[i], 1e-3);
            }
            Random random(3);
            for (Offset i = 0; i < g.n(); ++i)
                g.e.push_back(i % 7 == 0 ? 0 : random.uniform(0, 2e-4));
            if (probes) scene.targets = scene.sources;
            const BuiltLists built(scene);
            const bool plummer = law == Softening::plummer;
            const auto wanted = brute_sums(scene, plummer ? BruteLaw::plummer : BruteLaw::sph_exa);
            const ListErrors e = errors(scene, built, wanted, 20, law);
            EXPECT_LT(e.max_a, 1e-6);
            EXPECT_LT(e.max_p, 1e-6);
            // It is the softening that is seen: Newton's law is far off.
            EXPECT_GT(errors(scene, built, brute_sums(scene), 20, law).max_p, 1e-2);
        }
}

}  // namespace
}  // namespace connectivity::test
