// SPDX-License-Identifier: BSD-3-Clause
// The same lists, classes and work with any number of threads.

#include <gtest/gtest.h>

#include <connectivity/lists/classes.hpp>
#include <connectivity/lists/work.hpp>
#include <connectivity/tree/box_tree.hpp>
#include <connectivity/tree/peer_lists.hpp>

#include <support/hash.hpp>
#include <support/random.hpp>
#include <support/thread_bits.hpp>

namespace connectivity::test {
namespace {

/// Enough boxes for many chunks on several levels.
BoxTree large_tree(bool radii, bool periodic) {
    constexpr int n = 40000;
    std::vector<double> x, y, r;
    for (int i = 0; i < 3 * n; ++i) x.push_back(std::pow(u01(1, i), 3));
    for (int i = 0; i < 3 * n; ++i) y.push_back(std::pow(u01(2, i), 2));
    for (int i = 0; i < n; ++i) r.push_back(std::exp2(-12 + 10 * u01(3, i)));
    TreeInput input;
    TreeOptions options;
    input.sources = ParticleArray::interleaved(x.data(), n, 3);
    input.targets = ParticleArray::interleaved(y.data(), n, 3);
    if (radii) {
        input.targets->radii = r.data();
        options.stick_out_factor = 0.25;
    }
    options.max_particles_in_box = 16;
    if (periodic) {
        options.periodic = {true, true, true};
        options.bounding_box = {{}, {1, 1, 1}};
    }
    BoxTree tree;
    tree.build(input, options);
    return tree;
}

void add_list(Fnv1a& hash, const BoxList& list) {
    hash.add_view(list.starts);
    hash.add_view(list.lists);
    hash.add_view(list.images);
}

void add_lists(Fnv1a& hash, const FMMTraversalInfo& lists) {
    for (const auto& base : {lists.source_boxes(), lists.target_boxes(),
                             lists.source_parent_boxes(), lists.target_or_target_parent_boxes()})
        hash.add_view(base);
    for (const BoxList& list :
         {lists.same_level_non_well_sep_boxes(), lists.neighbor_source_boxes(),
          lists.from_sep_siblings(), lists.from_sep_bigger()})
        add_list(hash, list);
    for (const auto& close : {lists.from_sep_close_smaller(), lists.from_sep_close_bigger()})
        if (close) add_list(hash, *close);
    for (int level = 0; level < lists.nlevels(); ++level) {
        const LevelBoxList list = lists.from_sep_smaller(level);
        add_list(hash, list);
        hash.add_view(list.nonempty_indices);
    }
    const TranslationClassesInfo translations(lists);
    hash.add_view(translations.from_sep_siblings_translation_classes());
    hash.add_view(translations.from_sep_siblings_translation_class_to_distance_vector());
    hash.add_view(RotationClassesInfo(lists).from_sep_siblings_rotation_classes());
    hash.add_view(count_work(lists).boxes);
}

TEST(ListBits, a_second_time_agrees) {
    std::uint64_t values[2];
    FMMTraversalInfo lists;  // rebuilt in the storage of what was there before
    for (std::uint64_t& value : values) {
        Fnv1a hash;
        for (const bool radii : {false, true})
            for (const bool periodic : {false, true}) {
                const BoxTree tree = large_tree(radii, periodic);
                lists.rebuild(tree.view());
                add_lists(hash, lists);
                add_list(hash, lists.merge_close_lists().neighbor_source_boxes());
                hash.add_view(peer_lists(tree.view()).values());
            }
        value = hash.value();
    }
    EXPECT_EQ(values[0], values[1]);
    print_fingerprint(values[0]);
}

TEST(ListBits, one_two_and_three_threads_agree) {
    expect_same_bits_with_one_two_and_three_threads("ListBits.a_second_time_agrees");
}

}  // namespace
}  // namespace connectivity::test
