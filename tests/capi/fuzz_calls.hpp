// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Calls of every function of the C interface with garbage in every argument.

#include <algorithm>

#include "fuzz_fields.hpp"

namespace connectivity::test {

class Fuzz : public FuzzFields {
public:
    using FuzzFields::FuzzFields;

    /// calls that got through
    int n_built = 0, n_views = 0, n_traversed = 0;

    void call() {
        if (random_.chance(0.4)) return call_fields();
        switch (random_.below(19)) {
            case 0: return set_h();
            case 1: return set_tensor();
            case 2: return rebuild();
            case 3: return set_options();
            case 4: return acquire_rows();
            case 5: return acquire_pairs();
            case 6:
                return with_struct<conn_map_info>([&](auto* s) { conn_map_get_info(map(), s); });
            case 7:
                return with_struct<conn_report_entry>(
                    [&](auto* s) { conn_map_report_entry(map(), number(), s); });
            case 8: return report();
            case 9: return two_calls();
            case 10: return create_nodes();
            case 11: return create_context();
            case 12: return release_garbage();
            case 13: conn_status_text(static_cast<int>(random_.bits())); return;
            case 14: conn_abi_sizeof(static_cast<int>(random_.bits())); return;
            case 15: return init();
            case 16: return needs_rebuild();
            case 17: return traverse();
            default: return create_map();
        }
    }

protected:
    /// Good nodes for all lists, and lists of the first.
    void begin_well() {
        for (std::size_t k = 0; k < 3; ++k) {
            const int n = 8 - 2 * static_cast<int>(k);
            const conn_array x = conn_array_matrix(memory_.data(), n, 1 + static_cast<int>(k)),
                             h = conn_array_vector(memory_.data() + 32, n);
            EXPECT_TRUE(ok(conn_nodes_set_h(lists_[k], n, &x, 1, &h)));
        }
        EXPECT_TRUE(ok(conn_map_rebuild(map_.handle, lists_.data(), 1)));
    }

private:
    /// Good nodes for one of the live lists, so that the calls behind have something to do.
    void set_well() {
        const int k = random_.below(3), n = random_.below(8);
        const conn_array x = conn_array_matrix(memory_.data(), n, 1 + k),
                         h = conn_array_vector(memory_.data() + 32, n);
        EXPECT_TRUE(ok(conn_nodes_set_h(lists_[static_cast<std::size_t>(k)], n, &x, 1, &h)));
    }
    void set_h() {
        if (random_.chance(0.5)) return set_well();
        const conn_array x[4] = {array(), array(), array(), array()}, h = array();
        std::int32_t n = number();
        if (n > 4) n = 4;
        conn_nodes_set_h(nodes(), random_.chance(0.8) ? x[0].extent[0] : long_number(), x, n,
                         random_.chance(0.95) ? &h : nullptr);
    }
    void set_tensor() {
        const conn_array x = array();
        conn_array H[6];
        for (conn_array& component : H) component = array();
        conn_nodes_set_tensor(nodes(), x.extent[0], &x, 1, H, random_.chance(0.5) ? 1 : number());
    }
    void rebuild() {
        conn_nodes* some[4] = {nodes(), nodes(), nodes(), nodes()};
        std::int32_t n = random_.chance(0.5) ? 1 : number();
        if (n > 4 && n < 100000) n = 4;
        if (conn_map_rebuild(map(), random_.chance(0.95) ? some : nullptr, n) == CONN_OK) ++n_built;
    }
    void needs_rebuild() {
        conn_nodes* const some[4] = {nodes(), nodes(), nodes(), nodes()};
        std::int32_t n = random_.chance(0.5) ? 1 : number(), needed = 0;
        if (n > 4 && n < 100000) n = 4;
        double drift = 0;
        conn_map_needs_rebuild(map(), random_.chance(0.95) ? some : nullptr, n,
                               random_.chance(0.95) ? &needed : nullptr,
                               random_.chance(0.8) ? &drift : nullptr);
    }
    void traverse() {
        conn_nodes* const some[4] = {nodes(), nodes(), nodes(), nodes()};
        std::int32_t n = random_.chance(0.5) ? 1 : number(), answer = random_.below(20) - 18;
        if (n > 4 && n < 100000) n = 4;
        const conn_rows_callback answers = [](void* data, std::int32_t, std::int64_t n_rows,
                                              const std::int32_t*, const std::int64_t*,
                                              const std::int32_t*) {
            EXPECT_GT(n_rows, 0);
            return std::max(0, *static_cast<const std::int32_t*>(data));
        };
        const std::int32_t what = random_.chance(0.7) ? CONN_ROWS + random_.below(2) : number();
        if (conn_map_traverse(map(), random_.chance(0.95) ? some : nullptr, n, what,
                              random_.chance(0.95) ? answers : nullptr, &answer) == CONN_OK)
            ++n_traversed;
        if (random_.chance(0.1)) conn_set_error(random_.chance(0.5) ? conn_last_error() : nullptr);
    }
    void set_options() {
        with_struct<conn_map_options>([&](auto* s) {
            if (s != nullptr && random_.chance(0.7)) {
                const std::size_t size = s->struct_size;
                *s = CONN_MAP_OPTIONS_INIT;
                s->skin = random_.pick({0.0, 0.0, 1e-3, 1e100});
                s->overlap = random_.chance(0.3) ? 1 : 0;
                s->intersection = random_.chance(0.3) ? random_.below(4) : 0;
                s->order = random_.chance(0.3) ? 1 : 0;
                s->index_base = random_.chance(0.9) ? index_base_ : number();
                s->struct_size = size;
                if (random_.chance(0.5)) spoil(&s->rows, sizeof *s - sizeof size);
            }
            point_well(s);
            conn_map_set_options(map(), s);
        });
    }
    void acquire_rows() {
        with_struct<conn_rows_view>([&](auto* s) {
            if (conn_map_rows_acquire(map(), number(), s) != CONN_OK) return;
            EXPECT_TRUE(ok(conn_map_rows_release(s)));
            ++n_views;
        });
        with_struct<conn_rows_view>([&](auto* s) {
            if (conn_map_overlap_acquire(map(), number(), s) != CONN_OK) return;
            EXPECT_TRUE(ok(conn_map_rows_release(s)));
        });
        with_struct<conn_intersection_view>([&](auto* s) {
            if (conn_map_intersection_acquire(map(), number(), s) != CONN_OK) return;
            EXPECT_TRUE(ok(conn_map_intersection_release(s)));
        });
    }
    void acquire_pairs() {
        with_struct<conn_pairs_view>([&](auto* s) {
            if (conn_map_pairs_acquire(map(), number(), number(), s) != CONN_OK) return;
            EXPECT_TRUE(ok(conn_map_pairs_release(s)));
            ++n_views;
        });
    }
    void release_garbage() {
        with_struct<conn_rows_view>([](auto* s) { conn_map_rows_release(s); });
        with_struct<conn_pairs_view>([](auto* s) { conn_map_pairs_release(s); });
        with_struct<conn_intersection_view>([](auto* s) { conn_map_intersection_release(s); });
    }
    void report() {
        const char* name = nullptr;
        std::int64_t value = 0;
        conn_map_report_counter(map(), number(), random_.chance(0.5) ? &name : nullptr, &value);
        char buffer[room];
        conn_map_report_text(map(), random_.chance(0.8) ? buffer : nullptr, random_.below(room),
                             &value);
    }
    void two_calls() {
        std::int64_t out[room], count = 0;
        std::int32_t nodes_out[room];
        conn_map_offsets(map(), out, random_.chance(0.5) ? nullptr : out, random_.below(room),
                         &count);
        conn_map_spatial_order(map(), number(), nodes_out, random_.below(room), &count);
        conn_nodes_size(nodes(), random_.chance(0.5) ? nullptr : &count, &count);
    }
    /// Arrays that options name are there, with as many values as they say.
    void point_well(conn_map_options* s) {
        static const std::uint8_t flags[room] = {1, 1, 0, 1, 1, 0, 0, 1};
        if (s == nullptr) return;
        s->active = random_.chance(0.2) ? flags : nullptr;
        s->n_active = random_.chance(0.2) ? random_.below(room) : 0;
        s->interactions = random_.chance(0.2) ? flags : nullptr;
        s->n_interactions = random_.chance(0.2) ? random_.below(room) : 0;
    }
    void create_nodes() {
        conn_nodes* made = nullptr;
        const char* names[] = {"x", "", nullptr, "a longer name"};
        conn_nodes_create(context(), names[random_.below(4)], number(), random_.uniform(-1, 3),
                          &made);
        EXPECT_TRUE(ok(conn_nodes_destroy(&made)));
    }
    void create_context() {
        with_struct<conn_context_options>([&](auto* s) {
            conn_context* made = nullptr;
            conn_context_create(s, random_.chance(0.9) ? &made : nullptr);
            EXPECT_TRUE(ok(conn_context_destroy(&made)));
        });
    }
    void create_map() {
        with_struct<conn_map_options>([&](auto* s) {
            conn_map* made = nullptr;
            point_well(s);
            conn_map_create(context(), s, random_.chance(0.9) ? &made : nullptr);
            EXPECT_TRUE(ok(conn_map_destroy(&made)));
        });
    }
    void init() {
        with_struct<conn_map_options>(
            [&](auto* s) { conn_map_options_init(s, static_cast<std::size_t>(long_number())); });
    }
};

}  // namespace connectivity::test
