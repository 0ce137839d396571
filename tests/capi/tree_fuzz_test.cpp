// SPDX-License-Identifier: BSD-3-Clause
// Garbage in the arguments of trees and interaction lists: any status may come back, but the
// library stays whole.

#include "fuzz_garbage.hpp"
#include "tree_support.hpp"

namespace connectivity::test {
namespace {

class TreeFuzz : public Garbage {
public:
    explicit TreeFuzz(std::uint64_t seed) : Garbage(seed) {
        EXPECT_TRUE(ok(conn_tree_create(context(), &dead_tree_)));
        conn_tree* tree = dead_tree_;
        EXPECT_TRUE(ok(conn_tree_destroy(&tree)));
    }

    int n_built = 0, n_lists = 0, n_views = 0, n_looked_up = 0;

    void call() {
        switch (random_.below(8)) {
            case 0:
            case 1: return build();
            case 2: return rebuild();
            case 3: return acquire();
            case 4: return look_up();
            case 5: return choose_particles();
            case 6: return numbers_out();
            default: return release_garbage();
        }
    }

private:
    conn_context* context() { return context_.handle; }
    conn_tree* tree() {
        const int k = random_.below(12);
        return k == 0   ? nullptr
               : k == 1 ? dead_tree_
               : k == 2 ? reinterpret_cast<conn_tree*>(lists_.handle)
                        : tree_.handle;
    }
    conn_lists* lists() {
        const int k = random_.below(12);
        return k == 0   ? nullptr
               : k == 1 ? reinterpret_cast<conn_lists*>(dead_tree_)
               : k == 2 ? reinterpret_cast<conn_lists*>(tree_.handle)
                        : lists_.handle;
    }
    template <class T>
    T* mostly(T* pointer) {
        return random_.chance(0.95) ? pointer : nullptr;
    }
    /// What the library can use, in most calls.
    conn_array points(int dim) {
        if (random_.chance(0.2)) return array();
        return conn_array_matrix(memory_.data(), random_.below(room / dim), dim);
    }
    conn_array radii(const conn_array& x) {
        if (random_.chance(0.2)) return array();
        return conn_array_vector(memory_.data(), x.extent[0] < room ? x.extent[0] : 1);
    }

    void build() {
        const int dim = 1 + random_.below(3);
        const conn_array x[4] = {points(dim), array(), array(), array()},
                         y[4] = {points(dim), array(), array(), array()}, r = radii(x[0]),
                         s = radii(y[0]), weights = array();
        with_struct<conn_tree_input>([&](auto* input) {
            if (input != nullptr) {
                if (random_.chance(0.8)) input->dim = dim;
                input->n_sources = random_.chance(0.8) ? 1 : small_number();
                input->n_targets = random_.chance(0.8) ? 1 : small_number();
                if (random_.chance(0.9)) input->reserved = 0;
                input->sources = mostly(x);
                input->targets = random_.chance(0.6) ? y : nullptr;
                input->source_radii = random_.chance(0.2) ? &r : nullptr;
                input->target_radii = random_.chance(0.2) ? &s : nullptr;
                input->refine_weights = random_.chance(0.05) ? &weights : nullptr;
            }
            with_struct<conn_tree_options>([&](auto* options) {
                choose(options);
                if (conn_tree_build(tree(), input, options) == CONN_OK) ++n_built;
            });
        });
    }
    int small_number() {
        const int n = number();
        return n > 4 ? 4 : n;
    }
    void choose(conn_tree_options* options) {
        if (options == nullptr || random_.chance(0.2)) return;
        const std::size_t size = options->struct_size;
        *options = CONN_TREE_OPTIONS_INIT;
        options->struct_size = size;
        options->max_particles_in_box = 1 + random_.below(6);
        options->kind = random_.below(3);
        options->coincident = random_.below(2);
        options->hulls = random_.below(3);
        options->skip_prune = random_.chance(0.1) ? 1 : 0;
        options->stick_out_factor = random_.chance(0.4) ? random_.uniform() : -1;
        options->extent_norm = 1 + random_.below(2);
        if (random_.chance(0.2)) spoil(&options->kind, sizeof *options - sizeof size);
    }
    void rebuild() {
        with_struct<conn_lists_options>([&](auto* options) {
            if (options != nullptr) {
                if (random_.chance(0.8)) {
                    const std::size_t size = options->struct_size;
                    *options = CONN_LISTS_OPTIONS_INIT;
                    options->struct_size = size;
                    options->well_sep_is_n_away = 1 + random_.below(3);
                    options->from_sep_smaller_crit = random_.below(4);
                    options->from_sep_siblings = random_.below(2);
                }
                options->source_boxes_mask = options->source_parent_boxes_mask = nullptr;
                if (random_.chance(0.3)) mask(*options);
            }
            if (conn_lists_rebuild(lists(), tree(), options) == CONN_OK) ++n_lists;
        });
    }
    void mask(conn_lists_options& options) {
        conn_tree_view view = CONN_TREE_VIEW_INIT;
        if (conn_tree_acquire(tree_.handle, 0, &view) != CONN_OK) return;
        masks_.assign(static_cast<std::size_t>(view.n_boxes), 1);
        options.source_boxes_mask = masks_.data();
        options.n_mask = random_.chance(0.8) ? view.n_boxes : -1;
        EXPECT_TRUE(ok(conn_tree_release(&view)));
    }
    void acquire() {
        with_struct<conn_tree_view>([&](auto* view) {
            if (conn_tree_acquire(tree(), random_.chance(0.8) ? 0 : number(), view) != CONN_OK)
                return;
            EXPECT_TRUE(ok(conn_tree_release(view)));
            ++n_views;
        });
        with_struct<conn_box_list_view>([&](auto* view) {
            const int which = random_.chance(0.8) ? random_.below(12) : number();
            if (conn_lists_acquire(lists(), which, number(), random_.chance(0.8) ? 0 : number(),
                                   view) == CONN_OK) {
                EXPECT_TRUE(ok(conn_box_list_release(view)));
                ++n_views;
            }
        });
        with_struct<conn_classes_view>([&](auto* view) {
            if (conn_lists_classes_acquire(lists(), number(), 0, view) == CONN_OK) {
                EXPECT_TRUE(ok(conn_lists_classes_release(view)));
                ++n_views;
            }
        });
        if (random_.chance(0.2)) conn_lists_merge_close(lists());
    }
    void look_up() {
        const int dim = 1 + random_.below(3);
        const conn_array x[4] = {points(dim), array(), array(), array()}, r = radii(x[0]);
        const std::int32_t n = random_.chance(0.8) ? 1 : small_number();
        with_struct<conn_box_list_view>([&](auto* view) {
            const int which = random_.below(3);
            const conn_status status =
                which == 0   ? conn_tree_peers(tree(), view)
                : which == 1 ? conn_tree_area_query(tree(), mostly(x), n, mostly(&r), view)
                             : conn_tree_leaves_to_balls(tree(), mostly(x), n, mostly(&r), view);
            if (status != CONN_OK) return;
            EXPECT_TRUE(ok(conn_box_list_release(view)));
            ++n_looked_up;
        });
        std::int64_t count = 0;
        conn_tree_space_invader(tree(), mostly(x), n, mostly(&r),
                                random_.chance(0.5) ? out_.data() : nullptr,
                                random_.chance(0.5) ? room : 0, mostly(&count));
    }
    void choose_particles() {
        std::uint8_t flags[room] = {1, 0, 1};
        std::int64_t starts[room + 1] = {};
        const std::int64_t n = random_.below(room);
        if (random_.chance(0.3)) starts[random_.below(room)] = long_number();
        const conn_array x = points(1 + random_.below(3));
        with_struct<conn_box_list_view>([&](auto* view) {
            if (conn_tree_filter_targets(tree(), mostly(flags), random_.chance(0.9) ? n : -1,
                                         view) == CONN_OK) {
                EXPECT_TRUE(ok(conn_box_list_release(view)));
            }
        });
        with_struct<conn_particles_view>([&](auto* view) {
            const conn_status status =
                random_.chance(0.5)
                    ? conn_tree_filter_targets_in_tree_order(tree(), mostly(flags), n, view)
                    : conn_tree_link_point_sources(tree(), mostly(starts), n + 1, &x, 1, view);
            if (status == CONN_OK) {
                EXPECT_TRUE(ok(conn_particles_release(view)));
            }
        });
    }
    void numbers_out() {
        std::int64_t a = 0, b = 0, counts[room];
        char text[room];
        conn_tree_memory(tree(), mostly(&a), mostly(&b));
        if (random_.chance(0.2)) conn_tree_release_scratch(tree());
        conn_tree_report_text(tree(), mostly(text), random_.below(room), mostly(&a));
        conn_lists_report_text(lists(), mostly(text), random_.below(room), mostly(&a));
        conn_lists_work(lists(), number(), mostly(counts), random_.below(room), mostly(&a),
                        mostly(&b));
        with_struct<conn_tree_options>([&](auto* options) {
            conn_tree_options_init(
                options, random_.chance(0.5) ? sizeof *options : static_cast<size_t>(number()));
        });
        with_struct<conn_lists_options>([&](auto* options) {
            conn_lists_options_init(
                options, random_.chance(0.5) ? sizeof *options : static_cast<size_t>(number()));
        });
    }
    void release_garbage() {
        with_struct<conn_tree_view>([](auto* view) { conn_tree_release(view); });
        with_struct<conn_box_list_view>([](auto* view) { conn_box_list_release(view); });
        with_struct<conn_particles_view>([](auto* view) { conn_particles_release(view); });
        with_struct<conn_classes_view>([](auto* view) { conn_lists_classes_release(view); });
        conn_tree* dead = dead_tree_;
        if (random_.chance(0.1)) {
            EXPECT_TRUE(fails(conn_tree_destroy(&dead), CONN_E_HANDLE));
        }
    }

    Tree tree_{context_};
    InteractionLists lists_{context_};
    conn_tree* dead_tree_ = nullptr;
    std::vector<std::uint8_t> masks_;
    std::array<double, room> out_{};
};

TEST(CapiTreeFuzz, garbage_never_breaks_the_library) {
    int n_built = 0, n_lists = 0, n_views = 0, n_looked_up = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        TreeFuzz fuzz(seed);
        for (int k = 0; k < 2000; ++k) fuzz.call();
        n_built += fuzz.n_built;
        n_lists += fuzz.n_lists;
        n_views += fuzz.n_views;
        n_looked_up += fuzz.n_looked_up;
    }
    EXPECT_GT(n_built, 200) << "too much of the garbage was refused at the door";
    EXPECT_GT(n_lists, 200);
    EXPECT_GT(n_views, 200);
    EXPECT_GT(n_looked_up, 100);
}

}  // namespace
}  // namespace connectivity::test
