// SPDX-License-Identifier: BSD-3-Clause
// Handles and structs: dead, foreign and NULL ones are errors, older and newer hosts are served.

#include <cstddef>
#include <cstring>
#include <thread>

#include <connectivity_boundary.h>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

class CapiHandles : public ::testing::Test {
protected:
    Context context;
    Nodes nodes{context, 3, random_nodes(3, 30, 1)};
    Map map{context};
};

TEST_F(CapiHandles, destroy_sets_null_and_accepts_null) {
    EXPECT_TRUE(ok(conn_map_destroy(&map.handle)));
    EXPECT_EQ(map.handle, nullptr);
    EXPECT_TRUE(ok(conn_map_destroy(&map.handle)));
    EXPECT_TRUE(ok(conn_map_destroy(nullptr)));
    EXPECT_TRUE(ok(conn_nodes_destroy(nullptr)));
    EXPECT_TRUE(ok(conn_context_destroy(nullptr)));
}

TEST_F(CapiHandles, a_dead_handle_is_an_error_in_every_function) {
    conn_map* dead = map.handle;
    ASSERT_TRUE(ok(conn_map_destroy(&map.handle)));
    conn_nodes* lists[] = {nodes.handle};
    std::uint64_t generation = 0;
    std::int64_t count = 0;
    conn_map_info info = CONN_MAP_INFO_INIT;
    conn_rows_view rows = CONN_ROWS_VIEW_INIT;
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    conn_report_entry entry = CONN_REPORT_ENTRY_INIT;
    EXPECT_TRUE(fails(conn_map_rebuild(dead, lists, 1), CONN_E_HANDLE, {"map"}));
    EXPECT_TRUE(fails(conn_map_generation(dead, &generation), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_get_info(dead, &info), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_set_options(dead, nullptr), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_offsets(dead, nullptr, nullptr, 0, &count), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_spatial_order(dead, 0, nullptr, 0, &count), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_rows_acquire(dead, CONN_SPACE_HOST, &rows), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_pairs_acquire(dead, CONN_SPACE_HOST, 0, &pairs), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_report_entry(dead, 0, &entry), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_report_counter(dead, 0, nullptr, nullptr), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_report_text(dead, nullptr, 0, &count), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_destroy(&dead), CONN_E_HANDLE));
}

TEST_F(CapiHandles, dead_nodes_and_contexts_are_errors) {
    conn_nodes* dead = nodes.handle;
    ASSERT_TRUE(ok(conn_nodes_destroy(&nodes.handle)));
    const conn_array none = conn_array_matrix(nullptr, 0, 3), h = conn_array_vector(nullptr, 0);
    EXPECT_TRUE(fails(conn_nodes_set_h(dead, 0, &none, 1, &h), CONN_E_HANDLE, {"nodes"}));
    EXPECT_TRUE(fails(conn_nodes_set_tensor(dead, 0, &none, 1, &h, 1), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_nodes_size(dead, nullptr, nullptr), CONN_E_HANDLE));
    EXPECT_TRUE(fails(map.rebuild({dead}), CONN_E_HANDLE, {"lists[0]"}));
    EXPECT_TRUE(fails(conn_nodes_destroy(&dead), CONN_E_HANDLE));
    conn_context* gone = context.handle;
    ASSERT_TRUE(ok(conn_context_destroy(&context.handle)));
    std::int32_t n_threads = 0;
    conn_map* made = nullptr;
    EXPECT_TRUE(fails(conn_context_threads(gone, &n_threads), CONN_E_HANDLE, {"context"}));
    EXPECT_TRUE(fails(conn_map_create(gone, nullptr, &made), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_nodes_create(gone, "x", 3, 2, &dead), CONN_E_HANDLE));
}

TEST_F(CapiHandles, a_handle_of_another_kind_is_an_error_that_says_which) {
    auto* const as_map = reinterpret_cast<conn_map*>(nodes.handle);
    auto* const as_nodes = reinterpret_cast<conn_nodes*>(map.handle);
    std::uint64_t generation = 0;
    EXPECT_TRUE(fails(conn_map_generation(as_map, &generation), CONN_E_HANDLE, {"a node list"}));
    EXPECT_TRUE(fails(map.rebuild({as_nodes}), CONN_E_HANDLE, {"lists[0]", "a map"}));
    conn_rows_view view = CONN_ROWS_VIEW_INIT;
    view.owner = map.handle;
    EXPECT_TRUE(fails(conn_map_rows_release(&view), CONN_E_HANDLE, {"a map"}));
    int foreign = 0;
    auto* const never_ours = reinterpret_cast<conn_map*>(&foreign);
    EXPECT_TRUE(fails(conn_map_generation(never_ours, &generation), CONN_E_HANDLE));
    EXPECT_TRUE(fails(conn_map_generation(nullptr, &generation), CONN_E_NULL));
    EXPECT_TRUE(fails(conn_map_generation(map.handle, nullptr), CONN_E_NULL));
}

TEST_F(CapiHandles, the_context_may_go_before_what_was_made_with_it) {
    ASSERT_TRUE(ok(conn_context_destroy(&context.handle)));
    EXPECT_TRUE(ok(map.rebuild({nodes.handle})));
    EXPECT_EQ(map.generation(), 1u);
}

TEST_F(CapiHandles, the_last_error_belongs_to_its_thread) {
    EXPECT_TRUE(fails(conn_map_rebuild(map.handle, nullptr, 1), CONN_E_NULL));
    const std::string here = conn_last_error();
    std::string before = "?", after, cleared = "?";
    std::thread([&] {
        before = conn_last_error();
        conn_map_rebuild(map.handle, nullptr, -7);
        after = conn_last_error();
        map.generation();
        cleared = conn_last_error();
    }).join();
    EXPECT_EQ(before, "");
    EXPECT_NE(after.find("-7"), std::string::npos);
    EXPECT_EQ(cleared, "");
    EXPECT_EQ(conn_last_error(), here);
    EXPECT_NE(here.find("conn_map_rebuild: "), std::string::npos);
}

TEST_F(CapiHandles, threads_with_their_own_handles_get_the_right_lists) {
    std::vector<std::thread> threads;
    std::vector<std::string> failures(4);
    for (std::size_t t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            const NodeSet set = random_nodes(3, 150, 20 + t);
            const Lists expected = brute_force(3, {set});
            for (int k = 0; k < 5; ++k)
                if (lists_of(context, 3, {set}) != expected) failures[t] = conn_last_error();
        });
    for (std::thread& thread : threads) thread.join();
    for (const std::string& failure : failures) EXPECT_EQ(failure, "");
}

TEST(CapiStructs, sizes_are_those_of_the_header) {
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_ARRAY), sizeof(conn_array));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_CONTEXT_OPTIONS), sizeof(conn_context_options));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_MAP_OPTIONS), sizeof(conn_map_options));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_MAP_INFO), sizeof(conn_map_info));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_ROWS_VIEW), sizeof(conn_rows_view));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_PAIRS_VIEW), sizeof(conn_pairs_view));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_REPORT_ENTRY), sizeof(conn_report_entry));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_INTERSECTION_VIEW), sizeof(conn_intersection_view));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_BOUNDARY_NODES), sizeof(conn_boundary_nodes));
    EXPECT_EQ(conn_abi_sizeof(CONN_STRUCT_ESTIMATE), sizeof(conn_estimate));
    for (const int unknown : {-1, 0, 1000, 1 << 30}) EXPECT_EQ(conn_abi_sizeof(unknown), 0);
}

TEST(CapiStructs, a_host_of_the_first_pairs_view_gets_no_more_than_it_has_room_for) {
    const Context context;
    conn_map_options options = CONN_MAP_OPTIONS_INIT;
    options.order = CONN_ORDER_KEY;
    const Built built(context, 3, {random_nodes(3, 30, 1)}, options);
    conn_pairs_view pairs = CONN_PAIRS_VIEW_INIT;
    pairs.struct_size = offsetof(conn_pairs_view, slots);
    ASSERT_TRUE(ok(conn_map_pairs_acquire(built.map.handle, CONN_SPACE_HOST, 0, &pairs)));
    EXPECT_EQ(pairs.struct_size, offsetof(conn_pairs_view, slots));
    EXPECT_GT(pairs.n_pairs, 0);
    EXPECT_EQ(pairs.slots, nullptr);
    EXPECT_EQ(pairs.ranks, nullptr);
    EXPECT_TRUE(ok(conn_map_pairs_release(&pairs)));
}

TEST(CapiStructs, hosts_of_older_map_options_get_the_defaults_of_what_they_do_not_know) {
    const Context context;
    const std::uint8_t none[1] = {7};
    for (const std::size_t size :
         {offsetof(conn_map_options, skin), offsetof(conn_map_options, overlap),
          offsetof(conn_map_options, active), offsetof(conn_map_options, interactions),
          offsetof(conn_map_options, index_base)}) {
        conn_map_options options = CONN_MAP_OPTIONS_INIT;
        if (size <= offsetof(conn_map_options, overlap)) options.overlap = options.order = -5;
        if (size <= offsetof(conn_map_options, active)) options.active = none;
        if (size <= offsetof(conn_map_options, interactions)) options.interactions = none;
        options.index_base = -5;
        options.struct_size = size;
        conn_map* map = nullptr;
        EXPECT_TRUE(ok(conn_map_create(context.handle, &options, &map)));
        EXPECT_TRUE(ok(conn_map_destroy(&map)));
        options.struct_size = sizeof options;
        EXPECT_EQ(conn_map_create(context.handle, &options, &map), CONN_E_ARGUMENT);
    }
}

TEST(CapiStructs, sizes_that_no_host_can_have_are_not_initialised) {
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{8}, offsetof(conn_context_options, stream) - 1,
          std::size_t{4097}, ~std::size_t{0}}) {
        conn_context_options c = CONN_CONTEXT_OPTIONS_INIT;
        conn_map_options o = CONN_MAP_OPTIONS_INIT;
        EXPECT_TRUE(fails(conn_map_options_init(&o, size), CONN_E_STRUCT_SIZE));
        EXPECT_TRUE(fails(conn_context_options_init(&c, size), CONN_E_STRUCT_SIZE));
    }
}

template <class T>
std::string bytes_of(const T& object) {
    return {reinterpret_cast<const char*>(&object), sizeof object};
}

TEST(CapiStructs, init_functions_give_what_the_macros_give) {
    const conn_map_options from_macro = CONN_MAP_OPTIONS_INIT;
    conn_map_options from_function;
    std::memset(&from_function, 0xff, sizeof from_function);
    ASSERT_TRUE(ok(conn_map_options_init(&from_function, sizeof from_function)));
    EXPECT_EQ(bytes_of(from_macro), bytes_of(from_function));
    const conn_context_options c_macro = CONN_CONTEXT_OPTIONS_INIT;
    conn_context_options c_function;
    std::memset(&c_function, 0xff, sizeof c_function);
    ASSERT_TRUE(ok(conn_context_options_init(&c_function, sizeof c_function)));
    EXPECT_EQ(bytes_of(c_macro), bytes_of(c_function));
    EXPECT_TRUE(fails(conn_map_options_init(nullptr, sizeof from_macro), CONN_E_NULL));
}

TEST(CapiLibrary, version_texts_and_numbers_agree) {
    EXPECT_EQ(conn_version(), CONN_VERSION);
    EXPECT_STREQ(conn_version_string(), CONN_VERSION_STRING);
    EXPECT_TRUE(CONN_VERSION_GE(0, 1, 0));
    EXPECT_FALSE(CONN_VERSION_GE(99, 0, 0));
    EXPECT_NE(std::string(conn_build_info()).find(CONN_VERSION_STRING), std::string::npos);
    EXPECT_NE(std::string(conn_build_info()).find("Kokkos"), std::string::npos);
}

TEST(CapiLibrary, every_status_has_a_text_of_its_own) {
    std::vector<std::string> texts;
#define CONN_TEXT(NAME, name, value, text) texts.emplace_back(conn_status_text(CONN_##NAME));
    CONN_STATUS_LIST(CONN_TEXT)
#undef CONN_TEXT
    for (std::size_t a = 0; a < texts.size(); ++a) {
        EXPECT_NE(texts[a], "");
        EXPECT_NE(texts[a], "unknown status");
        for (std::size_t b = 0; b < a; ++b) EXPECT_NE(texts[a], texts[b]);
    }
    for (const int unknown : {-2, 1000, -2147483647})
        EXPECT_STREQ(conn_status_text(unknown), "unknown status");
}

TEST(CapiLibrary, the_context_runs_with_the_threads_asked_for) {
    const Context context(2);
    std::int32_t n_threads = 0;
    ASSERT_TRUE(ok(conn_context_threads(context.handle, &n_threads)));
    EXPECT_EQ(n_threads, 2);
    EXPECT_TRUE(fails(conn_context_threads(context.handle, nullptr), CONN_E_NULL));
}

}  // namespace
}  // namespace connectivity::test
