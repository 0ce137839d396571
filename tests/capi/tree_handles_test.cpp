// SPDX-License-Identifier: BSD-3-Clause
// Handles and structs of trees and interaction lists: dead, foreign and NULL ones are errors, and
// so are arguments out of their range; older and newer hosts are served.

#include <cstring>
#include <functional>

#include "tree_support.hpp"

namespace connectivity::test {
namespace {

class CapiTreeHandles : public ::testing::Test {
protected:
    CapiTreeHandles() {
        Random random(1);
        cloud.sources = random_points(random, 2, 50);
        EXPECT_TRUE(ok(tree.build(cloud, leaf_of(4))));
        EXPECT_TRUE(ok(conn_lists_rebuild(lists.handle, tree.handle, nullptr)));
    }

    Context context;
    Cloud cloud;
    Tree tree{context};
    InteractionLists lists{context};
    conn_tree_view tree_view = CONN_TREE_VIEW_INIT;
    conn_box_list_view list_view = CONN_BOX_LIST_VIEW_INIT;
    conn_particles_view particles = CONN_PARTICLES_VIEW_INIT;
    conn_classes_view classes = CONN_CLASSES_VIEW_INIT;
};

/// Every function that takes a tree, then every one that takes lists.
template <class Expect>
void with_tree(conn_tree* t, const Expect& expect) {
    conn_tree_view view = CONN_TREE_VIEW_INIT;
    conn_box_list_view list = CONN_BOX_LIST_VIEW_INIT;
    conn_particles_view particles = CONN_PARTICLES_VIEW_INIT;
    conn_tree_input input = CONN_TREE_INPUT_INIT;
    const conn_tree_options options = leaf_of(3);
    const conn_array a = conn_array_vector(nullptr, 0);
    std::int64_t n = 0;
    input.sources = &a;
    expect(conn_tree_build(t, &input, &options));
    expect(conn_tree_memory(t, &n, &n));
    expect(conn_tree_release_scratch(t));
    expect(conn_tree_report_text(t, nullptr, 0, &n));
    expect(conn_tree_acquire(t, CONN_SPACE_HOST, &view));
    expect(conn_tree_set_boxes(t, &view));
    expect(conn_tree_peers(t, &list));
    expect(conn_tree_area_query(t, &a, 1, &a, &list));
    expect(conn_tree_leaves_to_balls(t, &a, 1, &a, &list));
    expect(conn_tree_space_invader(t, &a, 1, &a, nullptr, 0, &n));
    expect(conn_tree_filter_targets(t, nullptr, 0, &list));
    expect(conn_tree_filter_targets_in_tree_order(t, nullptr, 0, &particles));
    expect(conn_tree_link_point_sources(t, nullptr, 0, &a, 1, &particles));
}

template <class Expect>
void with_lists(conn_lists* l, conn_tree* tree, const Expect& expect) {
    conn_box_list_view list = CONN_BOX_LIST_VIEW_INIT;
    conn_classes_view classes = CONN_CLASSES_VIEW_INIT;
    std::int64_t n = 0;
    expect(conn_lists_rebuild(l, tree, nullptr));
    expect(conn_lists_merge_close(l));
    expect(conn_lists_report_text(l, nullptr, 0, &n));
    expect(conn_lists_acquire(l, 0, 0, CONN_SPACE_HOST, &list));
    expect(conn_lists_classes_acquire(l, 0, CONN_SPACE_HOST, &classes));
    expect(conn_lists_work(l, 0, nullptr, 0, &n, nullptr));
}

TEST_F(CapiTreeHandles, dead_foreign_and_null_handles_are_errors_in_every_function) {
    conn_tree* dead_tree = tree.handle;
    conn_lists* dead_lists = lists.handle;
    Tree alive(context);
    const auto handle_error = [](conn_status s) { EXPECT_TRUE(fails(s, CONN_E_HANDLE)); };
    const auto null_error = [](conn_status s) { EXPECT_TRUE(fails(s, CONN_E_NULL)); };
    with_tree(reinterpret_cast<conn_tree*>(lists.handle),
              [](conn_status s) { EXPECT_TRUE(fails(s, CONN_E_HANDLE, {"interaction lists"})); });
    with_lists(reinterpret_cast<conn_lists*>(tree.handle), tree.handle,
               [](conn_status s) { EXPECT_TRUE(fails(s, CONN_E_HANDLE, {"a tree"})); });
    ASSERT_TRUE(ok(conn_tree_destroy(&tree.handle)));
    ASSERT_TRUE(ok(conn_lists_destroy(&lists.handle)));
    with_tree(dead_tree, handle_error);
    with_lists(dead_lists, alive.handle, handle_error);
    with_tree(nullptr, null_error);
    with_lists(nullptr, alive.handle, null_error);
    EXPECT_TRUE(fails(conn_tree_destroy(&dead_tree), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_lists_destroy(&dead_lists), CONN_E_HANDLE));
}

TEST_F(CapiTreeHandles, before_the_first_build_there_is_nothing) {
    const Tree empty(context);
    const InteractionLists none(context);
    std::int64_t n = -1;
    EXPECT_TRUE(ok(conn_tree_memory(empty.handle, &n, nullptr)));
    EXPECT_EQ(n, 0);
    for (const conn_status status :
         {conn_tree_acquire(empty.handle, CONN_SPACE_HOST, &tree_view),
          conn_tree_peers(empty.handle, &list_view), conn_lists_merge_close(none.handle),
          conn_lists_acquire(none.handle, 0, 0, CONN_SPACE_HOST, &list_view),
          conn_lists_classes_acquire(none.handle, 0, CONN_SPACE_HOST, &classes),
          conn_lists_work(none.handle, 0, nullptr, 0, &n, nullptr)})
        EXPECT_EQ(status, CONN_E_NOT_BUILT);
}

TEST_F(CapiTreeHandles, destroying_and_releasing_twice_is_fine) {
    EXPECT_TRUE(ok(conn_tree_destroy(nullptr)));
    EXPECT_TRUE(ok(conn_lists_destroy(nullptr)));
    ASSERT_TRUE(ok(conn_tree_acquire(tree.handle, CONN_SPACE_HOST, &tree_view)));
    EXPECT_TRUE(fails(conn_tree_acquire(tree.handle, CONN_SPACE_HOST, &tree_view), CONN_E_ARGUMENT,
                      {"owner"}));
    list_view.owner = tree_view.owner;
    EXPECT_TRUE(fails(conn_box_list_release(&list_view), CONN_E_HANDLE, {"a tree view"}));
    for (int twice = 0; twice < 2; ++twice) {
        EXPECT_TRUE(ok(conn_tree_release(&tree_view)));
        EXPECT_EQ(tree_view.box_flags, nullptr);
    }
    EXPECT_TRUE(ok(conn_particles_release(&particles)));
    EXPECT_TRUE(ok(conn_lists_classes_release(&classes)));
    EXPECT_TRUE(ok(conn_tree_release(nullptr)));
    ASSERT_TRUE(ok(conn_tree_destroy(&tree.handle)));
    EXPECT_TRUE(ok(conn_tree_destroy(&tree.handle)));
}

TEST_F(CapiTreeHandles, the_context_may_go_before_what_was_made_with_it) {
    ASSERT_TRUE(ok(conn_context_destroy(&context.handle)));
    EXPECT_TRUE(ok(tree.build(cloud, leaf_of(9))));
    EXPECT_TRUE(ok(conn_lists_rebuild(lists.handle, tree.handle, nullptr)));
}

TEST_F(CapiTreeHandles, the_budget_of_the_context_holds_where_the_options_have_none) {
    conn_context_options poor = CONN_CONTEXT_OPTIONS_INIT;
    poor.budget_bytes = 64;
    conn_context* small = nullptr;
    ASSERT_TRUE(ok(conn_context_create(&poor, &small)));
    conn_tree* t = nullptr;
    ASSERT_TRUE(ok(conn_tree_create(small, &t)));
    const conn_array x = conn_array_matrix(cloud.sources.data(), 50, 2);
    conn_tree_input input = CONN_TREE_INPUT_INIT;
    input.dim = 2;
    input.sources = &x;
    conn_tree_options options = leaf_of(4);
    EXPECT_TRUE(fails(conn_tree_build(t, &input, &options), CONN_E_BUDGET, {"64"}));
    options.budget_bytes = 1 << 30;
    EXPECT_TRUE(ok(conn_tree_build(t, &input, &options)));
    EXPECT_TRUE(ok(conn_tree_destroy(&t)));
    EXPECT_TRUE(ok(conn_context_destroy(&small)));
}

TEST_F(CapiTreeHandles, bad_options_and_inputs_are_named_and_the_tree_stays) {
    const std::uint64_t before = TreeArrays(tree.handle)->generation;
    const auto refused = [&](auto spoil) {
        const conn_array x = conn_array_matrix(cloud.sources.data(), 50, 2);
        conn_tree_input input = CONN_TREE_INPUT_INIT;
        input.dim = 2;
        input.sources = &x;
        conn_tree_options options = leaf_of(4);
        spoil(input, options);
        return conn_tree_build(tree.handle, &input, &options);
    };
    using I = conn_tree_input;
    using O = conn_tree_options;
    const conn_array one = conn_array_vector(cloud.sources.data(), 1),
                     single = {cloud.sources.data(), 0, 0, CONN_FLOAT32, 2, {3, 2}, {2, 1}};
    const auto bad = [&](auto spoil, conn_status status, const char* word) {
        EXPECT_TRUE(fails(refused(spoil), status, {word}));
    };
    constexpr conn_status argument = CONN_E_ARGUMENT;
    bad([](I& i, O&) { i.dim = 4; }, argument, "dim = 4");
    bad([](I& i, O&) { i.sources = nullptr; }, CONN_E_NULL, "sources");
    bad([](I& i, O&) { i.n_sources = 3; }, argument, "n_sources = 3");
    bad([](I& i, O&) { i.reserved = 1; }, CONN_E_UNSUPPORTED, "reserved");
    bad([&](I& i, O&) { i.source_radii = &one; }, argument, "source_radii.extent[0] = 1");
    bad([&](I& i, O&) { i.target_radii = &one; }, CONN_E_NULL, "targets");
    bad([&](I& i, O&) { i.targets = &single; }, argument, "targets.dtype");
    bad([&](I& i, O&) { i.refine_weights = &one; }, argument, "refine_weights.dtype");
    bad([](I&, O& o) { o.max_particles_in_box = 0; }, argument, "max_particles_in_box is 0");
    bad([](I&, O& o) { o.max_particles_in_box = -1; }, argument, "neither");
    bad([](I&, O& o) { o.max_leaf_refine_weight = 4; }, argument, "both");
    bad([](I&, O& o) { o.kind = 3; }, argument, "kind = 3");
    bad([](I&, O& o) { o.extent_norm = 0; }, argument, "extent_norm = 0");
    bad([](I&, O& o) { o.stick_out_factor = 0.5; }, argument, "stick_out_factor");
    bad([](I&, O& o) { o.coincident = -1; }, argument, "coincident");
    bad([](I&, O& o) { o.hulls = 7; }, argument, "hulls = 7");
    bad([](I&, O& o) { o.skip_prune = 2; }, argument, "skip_prune");
    bad([](I&, O& o) { o.periodic[1] = 5; }, argument, "periodic[1]");
    bad([](I&, O& o) { o.budget_bytes = -2; }, argument, "-2");
    bad([](I&, O& o) { o.reserved = 1; }, CONN_E_UNSUPPORTED, "reserved");
    bad([](I&, O& o) { o.bounding_box = 1; }, CONN_E_BOX, "");
    EXPECT_TRUE(fails(conn_tree_build(tree.handle, nullptr, nullptr), CONN_E_NULL));
    cloud.sources[7] = std::nan("");
    EXPECT_TRUE(fails(tree.build(cloud, leaf_of(4)), CONN_E_NONFINITE, {"3"}));
    EXPECT_EQ(TreeArrays(tree.handle)->generation, before);
    EXPECT_EQ(TreeArrays(tree.handle)->n_sources, 50);
}

TEST_F(CapiTreeHandles, other_arguments_out_of_range_are_named) {
    std::int64_t n = 0;
    const conn_lists* l = lists.handle;
    EXPECT_TRUE(
        fails(conn_tree_acquire(tree.handle, CONN_SPACE_DEVICE, &tree_view), CONN_E_UNSUPPORTED));
    EXPECT_TRUE(fails(conn_tree_acquire(tree.handle, 9, &tree_view), CONN_E_ARGUMENT, {"9"}));
    EXPECT_TRUE(fails(conn_tree_acquire(tree.handle, 0, nullptr), CONN_E_NULL, {"view"}));
    EXPECT_TRUE(fails(conn_lists_acquire(l, 12, 0, 0, &list_view), CONN_E_ARGUMENT, {"12"}));
    EXPECT_TRUE(fails(conn_lists_acquire(l, 7, 1, 0, &list_view), CONN_E_ARGUMENT, {"level = 1"}));
    for (const int level : {-1, 99})
        EXPECT_TRUE(fails(conn_lists_acquire(l, CONN_LIST_FROM_SEP_SMALLER, level, 0, &list_view),
                          CONN_E_ARGUMENT, {std::to_string(level)}));
    EXPECT_TRUE(
        fails(conn_lists_acquire(l, 0, 0, CONN_SPACE_MANAGED, &list_view), CONN_E_UNSUPPORTED));
    EXPECT_TRUE(
        fails(conn_lists_classes_acquire(l, 3, 0, &classes), CONN_E_ARGUMENT, {"which = 3"}));
    EXPECT_TRUE(fails(conn_lists_work(l, 11, nullptr, 0, &n, nullptr), CONN_E_ARGUMENT, {"11"}));
    EXPECT_TRUE(fails(conn_lists_work(l, 0, nullptr, 0, nullptr, nullptr), CONN_E_NULL, {"n"}));
    EXPECT_TRUE(fails(conn_lists_rebuild(lists.handle, nullptr, nullptr), CONN_E_NULL, {"tree"}));
    conn_tree* made = nullptr;
    EXPECT_TRUE(fails(conn_tree_create(nullptr, &made), CONN_E_NULL, {"context"}));
    EXPECT_TRUE(fails(conn_tree_create(context.handle, nullptr), CONN_E_NULL, {"tree"}));
    EXPECT_TRUE(fails(conn_lists_create(context.handle, nullptr), CONN_E_NULL, {"lists"}));
}

TEST_F(CapiTreeHandles, reports_name_what_was_built) {
    const auto text = [](const auto& call) {
        const std::vector<char> bytes = [&] {
            std::int64_t length = 0;
            EXPECT_TRUE(ok(call(nullptr, 0, &length)));
            std::vector<char> room(static_cast<std::size_t>(length) + 1);
            EXPECT_TRUE(fails(call(room.data(), length, &length), CONN_E_BUFFER));
            EXPECT_TRUE(ok(call(room.data(), length + 1, &length)));
            return room;
        }();
        return std::string(bytes.data());
    };
    EXPECT_NE(text([&](auto... out) {
                  return conn_tree_report_text(tree.handle, out...);
              }).find("particles"),
              std::string::npos);
    EXPECT_NE(text([&](auto... out) {
                  return conn_lists_report_text(lists.handle, out...);
              }).find("from_sep_siblings"),
              std::string::npos);
    std::int64_t bytes = 0, scratch = 0, left = -1;
    ASSERT_TRUE(ok(conn_tree_memory(tree.handle, &bytes, &scratch)));
    EXPECT_GT(bytes, 50 * 8 * 2);
    ASSERT_TRUE(ok(conn_tree_release_scratch(tree.handle)));
    ASSERT_TRUE(ok(conn_tree_memory(tree.handle, nullptr, &left)));
    EXPECT_GT(scratch, left);
    EXPECT_EQ(left, 0);
}

/// The host's struct in more memory than any version of it: sizes it cannot have are errors, a
/// longer one is served if what this library does not know is 0.
template <class T>
void expect_sizes(const T& init, const std::function<conn_status(T*)>& call) {
    struct {
        T value;
        unsigned char more[64];
    } host;
    const auto with = [&](std::size_t size, unsigned char last) {
        std::memset(&host, 0, sizeof host);
        std::memcpy(&host.value, &init, sizeof init);
        std::memcpy(&host.value, &size, sizeof size);
        host.more[63] = last;
        return call(&host.value);
    };
    EXPECT_TRUE(ok(with(sizeof(T), 1)));
    EXPECT_TRUE(ok(with(sizeof(T) + 64, 0)));
    EXPECT_TRUE(fails(with(sizeof(T) + 64, 1), CONN_E_UNSUPPORTED, {"byte"}));
    for (const std::size_t size : {std::size_t{0}, sizeof(T) - 1, std::size_t{4097}})
        EXPECT_TRUE(fails(with(size, 0), CONN_E_STRUCT_SIZE, {std::to_string(size)}));
}

TEST_F(CapiTreeHandles, structs_in_sizes_that_no_host_can_have_are_refused) {
    const conn_array x = conn_array_matrix(cloud.sources.data(), 50, 2);
    conn_tree_input input = CONN_TREE_INPUT_INIT;
    input.dim = 2;
    input.sources = &x;
    const conn_tree_options options = leaf_of(4);
    expect_sizes<conn_tree_input>(
        input, [&](auto* s) { return conn_tree_build(tree.handle, s, &options); });
    expect_sizes<conn_tree_options>(
        options, [&](auto* s) { return conn_tree_build(tree.handle, &input, s); });
    expect_sizes<conn_lists_options>(CONN_LISTS_OPTIONS_INIT, [&](auto* s) {
        return conn_lists_rebuild(lists.handle, tree.handle, s);
    });
    const auto then = [](conn_status status, auto release, auto* view) {
        return status == CONN_OK ? release(view) : status;
    };
    expect_sizes<conn_tree_view>(tree_view, [&](auto* s) {
        return then(conn_tree_acquire(tree.handle, 0, s), conn_tree_release, s);
    });
    expect_sizes<conn_box_list_view>(list_view, [&](auto* s) {
        return then(conn_tree_peers(tree.handle, s), conn_box_list_release, s);
    });
    expect_sizes<conn_classes_view>(classes, [&](auto* s) {
        return then(conn_lists_classes_acquire(lists.handle, 0, 0, s), conn_lists_classes_release,
                    s);
    });
    const std::uint8_t flags[50] = {};
    expect_sizes<conn_particles_view>(particles, [&](auto* s) {
        return then(conn_tree_filter_targets_in_tree_order(tree.handle, flags, 50, s),
                    conn_particles_release, s);
    });
}

TEST_F(CapiTreeHandles, sizes_and_defaults_are_those_of_the_header) {
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_TREE_OPTIONS), sizeof(conn_tree_options));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_TREE_INPUT), sizeof(conn_tree_input));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_TREE_VIEW), sizeof(conn_tree_view));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_BOX_LIST_VIEW), sizeof(conn_box_list_view));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_PARTICLES_VIEW), sizeof(conn_particles_view));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_LISTS_OPTIONS), sizeof(conn_lists_options));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_CLASSES_VIEW), sizeof(conn_classes_view));
    conn_tree_options tree_options;
    conn_lists_options lists_options;
    const conn_tree_options tree_defaults = CONN_TREE_OPTIONS_INIT;
    const conn_lists_options lists_defaults = CONN_LISTS_OPTIONS_INIT;
    ASSERT_TRUE(ok(conn_tree_options_init(&tree_options, sizeof tree_options)));
    ASSERT_TRUE(ok(conn_lists_options_init(&lists_options, sizeof lists_options)));
    EXPECT_EQ(std::memcmp(&tree_options, &tree_defaults, sizeof tree_options), 0);
    EXPECT_EQ(std::memcmp(&lists_options, &lists_defaults, sizeof lists_options), 0);
}

}  // namespace
}  // namespace connectivity::test
