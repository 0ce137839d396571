// SPDX-License-Identifier: BSD-3-Clause
// List sums at the limits: nothing, one particle, extreme scales, input that is refused; the same
// bits; what stays when a call fails.

#include <limits>

#include <support/expect_error.hpp>
#include <support/hash.hpp>
#include <support/thread_bits.hpp>

#include "gravity/list_scene.hpp"

namespace connectivity::test {
namespace {

ListScene plummer_lists(std::int64_t n) {
    ListScene scene;
    scene.sources = plummer_scene(n);
    return scene;
}

TEST(ListSumsLimits, nothing_and_one) {
    for (const int n : {0, 1, 2}) {
        const ListScene scene = plummer_lists(n);
        const BuiltLists built(scene);
        ListSums sums;
        sums.evaluate(built.lists, masses_of(scene));
        ASSERT_EQ(sums.n(), n);
        ASSERT_EQ(static_cast<int>(sums.acceleration().size()), 3 * n);
        const auto wanted = brute_sums(scene);
        EXPECT_LT(errors_of(sums, wanted).max_a, 1e-15);
        if (n == 1) {
            EXPECT_EQ(sums.potential()(0), 0);
        }
    }
    for (const bool sources : {false, true}) {  // the other kind is not there
        ListScene scene = plummer_lists(sources ? 100 : 0);
        scene.targets = plummer_scene(sources ? 0 : 100);
        const BuiltLists built(scene);
        ListSums sums;
        sums.evaluate(built.lists, masses_of(scene));
        ASSERT_EQ(sums.n(), sources ? 0 : 100);
        for (Offset i = 0; i < sums.n(); ++i) ASSERT_EQ(sums.potential()(i), 0);
    }
}

TEST(ListSumsLimits, a_power_of_two_changes_no_bit) {
    const ListScene scene = plummer_lists(2000);
    const BuiltLists built(scene);
    ListSums sums;
    sums.evaluate(built.lists, masses_of(scene), {.order = 6});
    for (const int power : {-400, 40, 400}) {  // beyond the range of 1/r³
        ListScene scaled = scene;
        scaled.sources.scale(std::ldexp(1.0, power), std::ldexp(1.0, -power / 4));
        const BuiltLists other(scaled);
        ListSums result;
        result.evaluate(other.lists, masses_of(scaled), {.order = 6, .constant = 4});
        for (Offset i = 0; i < sums.n(); ++i) {
            ASSERT_EQ(std::ldexp(result.potential()(i), 5 * power / 4), 4 * sums.potential()(i));
            for (int d = 0; d < 3; ++d)
                ASSERT_EQ(std::ldexp(result.acceleration()(3 * i + d), 9 * power / 4),
                          4 * sums.acceleration()(3 * i + d));
        }
    }
}

TEST(ListSumsLimits, all_scales_and_places) {
    for (const double length : {1e-12, 1e12})
        for (const double mass : {1e-30, 1e30})
            for (const double offset : {0.0, 100.0}) {
                ListScene scene;
                scene.sources = plummer_scene(800).shift(offset, -offset, offset);
                scene.sources.scale(length, mass);
                scene.lists.well_sep_is_n_away = 2;
                const BuiltLists built(scene);
                ListSums sums;
                sums.evaluate(built.lists, masses_of(scene), {.order = 20});
                const ListErrors e = errors_of(sums, brute_sums(scene));
                EXPECT_LT(e.max_a, 3e-6);
                EXPECT_LT(e.max_p, 3e-7);
            }
}

TEST(ListSumsLimits, all_in_one_place) {
    ListScene scene;
    for (int i = 0; i < 40; ++i) scene.sources.add(1e9, -3, 0.1, 1);
    const BuiltLists built(scene);
    ListSums sums;
    sums.evaluate(built.lists, masses_of(scene));
    for (Offset i = 0; i < 3 * sums.n(); ++i) ASSERT_EQ(sums.acceleration()(i), 0);
}

TEST(ListSumsLimits, float32_numbers_and_strides_are_read) {
    const ListScene scene = plummer_lists(300);
    const BuiltLists built(scene);
    std::vector<float> masses(900);
    std::vector<double> same(300);
    for (int i = 0; i < 300; ++i) same[i] = masses[3 * i] = 0.5F + static_cast<float>(i);
    ListSums a, b;
    a.evaluate(
        built.lists,
        {.type = CoordinateType::float32, .n = 300, .masses = masses.data(), .mass_stride = 3});
    b.evaluate(built.lists, {.n = 300, .masses = same.data()});
    for (Offset i = 0; i < 300; ++i) ASSERT_EQ(a.potential()(i), b.potential()(i));
}

TEST(ListSumsLimits, what_was_there_stays_when_a_call_fails) {
    const ListScene scene = plummer_lists(500), other = plummer_lists(700);
    const BuiltLists built(scene), larger(other);
    ListSums sums;
    sums.evaluate(built.lists, masses_of(scene));
    const auto held = sums.potential();
    const std::vector<double> before(held.data(), held.data() + held.size());
    ListMasses bad = masses_of(other);
    bad.masses = nullptr;
    EXPECT_TRUE(fails_with(Status::null, {"mass"}, [&] { sums.evaluate(larger.lists, bad); }));
    ASSERT_EQ(sums.n(), 500);
    EXPECT_EQ(sums.potential().data(), held.data());
    ListScene heavier = scene;
    heavier.sources.scale(1, 2);
    sums.evaluate(built.lists, masses_of(heavier));  // of the size of what is held
    sums.evaluate(larger.lists, masses_of(other));
    sums.evaluate(built.lists, masses_of(scene));
    for (std::size_t i = 0; i < before.size(); ++i) ASSERT_EQ(held(i), before[i]);
    for (Offset i = 0; i < 500; ++i) ASSERT_EQ(sums.potential()(i), before[i]);
}

TEST(ListSumsLimits, storage_is_used_again) {
    const ListScene scene = plummer_lists(3000);
    const BuiltLists built(scene);
    ListSums sums;
    sums.evaluate(built.lists, masses_of(scene));
    const double* const place = sums.acceleration().data();
    const Offset bytes = sums.scratch_bytes();
    EXPECT_GT(bytes, 0);
    for (int k = 0; k < 3; ++k) sums.evaluate(built.lists, masses_of(scene));
    EXPECT_EQ(sums.acceleration().data(), place);
    EXPECT_LT(sums.scratch_bytes(), 1.2 * static_cast<double>(bytes));
    sums.release_scratch();
    EXPECT_EQ(sums.scratch_bytes(), 0);
    EXPECT_EQ(sums.n(), 3000);
}

struct Bad {
    const char* word;
    Status status;
    void (*spoil)(ListScene&, ListMasses&, ListSumOptions&);
};

const double nan_mass = std::numeric_limits<double>::quiet_NaN();

TEST(ListSumsLimits, bad_input_is_refused_by_name) {
    using S = ListScene;
    using M = ListMasses;
    using O = ListSumOptions;
    const Bad table[] = {
        {"list 1", Status::not_built, [](S& s, M&, O&) { s.lists.neighbor_source_boxes = false; }},
        {"list 2", Status::not_built, [](S& s, M&, O&) { s.lists.from_sep_siblings = false; }},
        {"list 3", Status::not_built, [](S& s, M&, O&) { s.lists.from_sep_smaller = false; }},
        {"list 4", Status::not_built, [](S& s, M&, O&) { s.lists.from_sep_bigger = false; }},
        {"order is 0", Status::argument, [](S&, M&, O& o) { o.order = 0; }},
        {"order is 21", Status::argument, [](S&, M&, O& o) { o.order = 21; }},
        {"constant is", Status::argument, [](S&, M&, O& o) { o.constant = 0; }},
        {"constant is", Status::argument, [](S&, M&, O& o) { o.constant = nan_mass; }},
        {"softening is", Status::argument, [](S&, M&, O& o) { o.softening = Softening(7); }},
        {"budget", Status::budget, [](S&, M&, O& o) { o.budget.bytes = 1000; }},
        {"99 sources", Status::argument, [](S&, M& m, O&) { m.n = 99; }},
        {"-1 sources", Status::argument, [](S&, M& m, O&) { m.n = -1; }},
        {"mass", Status::null, [](S&, M& m, O&) { m.masses = nullptr; }},
        {"stride", Status::argument, [](S&, M& m, O&) { m.mass_stride = 0; }},
        {"target_softening", Status::argument, [](S&, M& m, O&) { m.target_softening = m.masses; }},
        {"source 7: mass = nan", Status::nonfinite,
         [](S& s, M&, O&) { s.sources.m[7] = nan_mass; }},
        {"sum to inf", Status::argument,
         [](S& s, M&, O&) { s.sources.m[7] = s.sources.m[8] = 1e308; }},
        {"source 7: softening = -1", Status::argument,
         [](S& s, M& m, O&) {
             s.sources.e.assign(100, 0.0);
             s.sources.e[7] = -1;
             m.softening = s.sources.e.data();
         }},
        {"overflow", Status::nonfinite,
         [](S&, M&, O& o) { o.constant = std::numeric_limits<double>::max(); }},
    };
    for (const Bad& bad : table) {
        SCOPED_TRACE(bad.word);
        ListScene scene = plummer_lists(100);
        ListMasses masses = masses_of(scene);
        ListSumOptions options;
        bad.spoil(scene, masses, options);
        const BuiltLists built(scene);
        ListSums sums;
        EXPECT_TRUE(fails_with(bad.status, {bad.word},
                               [&] { sums.evaluate(built.lists, masses, options); }));
    }
}

TEST(ListSumsLimits, lists_of_nothing_are_refused) {
    EXPECT_TRUE(fails_with(Status::not_built, {"list 1"},
                           [] { ListSums().evaluate(FMMTraversalInfo(), {}); }));
}

TEST(ListSumsBits, a_second_time_agrees) {
    std::uint64_t values[2];
    for (std::uint64_t& value : values) {
        Fnv1a hash;
        ListSums sums;
        for (const bool extents : {false, true}) {
            ListScene scene = plummer_lists(20000);
            scene.lists.well_sep_is_n_away = extents ? 2 : 1;
            if (extents) {
                scene.targets = uniform_scene(5000).scale(4).shift(-2, -2, -2);
                for (int i = 0; i < 5000; ++i) scene.target_radii.push_back(1e-3 * (i % 100));
                scene.tree.stick_out_factor = 0.25;
            }
            const BuiltLists built(scene);
            sums.evaluate(built.lists, masses_of(scene), {.order = 5});
            hash.add_view(sums.acceleration());
            hash.add_view(sums.potential());
        }
        value = hash.value();
    }
    EXPECT_EQ(values[0], values[1]);
    print_fingerprint(values[0]);
}

TEST(ListSumsBits, one_two_and_three_threads_agree) {
    expect_same_bits_with_one_two_and_three_threads("ListSumsBits.a_second_time_agrees");
}

}  // namespace
}  // namespace connectivity::test
