// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Calls with garbage to all that works on lists a map has: orders, questions, coupling, fields,
/// patches; and to boundaries.

#include <algorithm>

#include "fuzz_garbage.hpp"

namespace connectivity::test {

class FuzzFields : public Garbage {
public:
    using Garbage::Garbage;

    /// calls that got through
    int n_patched = 0, n_summed = 0, n_bounded = 0, n_estimated = 0;

protected:
    void call_fields() {
        switch (random_.below(12)) {
            case 0: return set_ids();
            case 1: return exclude();
            case 2: return patch();
            case 3: return queries();
            case 4: return couple();
            case 5: return field();
            case 6: return sum();
            case 7: return add_boundary();
            case 8: return copies();
            case 9: return reorder();
            case 10: return estimate();
            default: return update_boundaries();
        }
    }

private:
    static std::int32_t is_odd(void*, std::int32_t i, std::int32_t j) { return (i + j) % 2; }
    static double half(void*, std::int32_t i, std::int32_t) { return i % 5 == 4 ? 2 : 0.5; }

    void fill_numbers() {
        for (std::int32_t& value : numbers_) value = number();
        if (random_.chance(0.5))
            for (int k = 0; k < room; ++k) numbers_[static_cast<std::size_t>(k)] = k % 8;
        if (random_.chance(0.5)) numbers_.fill(1);
    }
    std::int32_t* numbers() {
        fill_numbers();
        return random_.chance(0.95) ? numbers_.data() : nullptr;
    }
    void set_ids() {
        static const std::int64_t ids[room] = {3, 3, -1};
        std::int64_t n = 0, n_internal = 0;
        conn_nodes* const list = nodes();
        conn_nodes_size(list, &n, &n_internal);
        if (random_.chance(0.3)) n = random_.below(room);
        conn_array names = conn_array_vector_int64(ids, n),
                   owner = conn_array_vector_int32(
                       numbers(), random_.chance(0.8) ? n - n_internal : random_.below(room));
        if (random_.chance(0.1)) names = array();
        if (random_.chance(0.1)) owner = array();
        conn_nodes_set_ids(list, random_.chance(0.8) ? &names : nullptr,
                           random_.chance(0.8) ? &owner : nullptr);
    }
    void exclude() {
        conn_map_set_exclusion(map(), random_.chance(0.3) ? is_odd : nullptr, nullptr);
    }
    /// Mostly what may work: all stay where they are.
    void patch() {
        conn_pair_field* const fields[] = {field_, pick_field()};
        const int n_fields = random_.chance(0.5) ? 0 : random_.below(3);
        if (random_.chance(0.3)) {
            conn_map_remove_pairs(map(), random_.chance(0.9) ? is_odd : nullptr, nullptr, fields,
                                  n_fields);
            return;
        }
        std::array<std::int32_t, room> keep;
        keep.fill(1);
        fill_numbers();
        for (int k = 0; k < room; ++k) numbers_[static_cast<std::size_t>(k)] = k;
        if (random_.chance(0.5)) keep[static_cast<std::size_t>(random_.below(room))] = number();
        conn_map_info info = CONN_MAP_INFO_INIT;
        conn_map_get_info(map_.handle, &info);
        const std::int64_t n = random_.chance(0.8) ? info.n_slots : long_number();
        if (conn_map_patch(map(), random_.chance(0.95) ? keep.data() : nullptr, numbers_.data(), n,
                           random_.chance(0.9) ? fields : nullptr, n_fields) == CONN_OK)
            ++n_patched;
    }
    void queries() {
        std::int64_t count = 0, pair[room];
        std::uint64_t keys[room];
        std::int32_t out[room];
        const int capacity = random_.below(room);
        std::int32_t* const to = random_.chance(0.8) ? out : nullptr;
        std::int64_t* const counted = random_.chance(0.9) ? &count : nullptr;
        conn_map_key_order(map(), to, to, random_.chance(0.5) ? keys : nullptr, capacity, counted);
        conn_map_traversal(map(), number(), to, capacity, counted);
        conn_map_all_neighbours(map(), number(), number(), to, capacity, counted);
        conn_nodes* const some[4] = {nodes(), nodes(), nodes(), nodes()};
        const int n_lists = random_.below(6) - 1;
        conn_map_common_neighbours(map(), number(), number(), random_.chance(0.5) ? some : nullptr,
                                   std::min(n_lists, 4), to, capacity, counted);
        const std::int32_t *const i = numbers(), *const j = numbers();
        conn_map_find_pairs(map(), random_.chance(0.9) ? capacity : -1, i, j, pair);
    }
    void copies() {
        std::int64_t n[2] = {}, offsets[room];
        std::int32_t slots[room];
        double coupling[room];
        const auto maybe = [&](auto* p) { return random_.chance(0.8) ? p : nullptr; };
        conn_map_rows_copy(map(), maybe(offsets), random_.below(room), maybe(&n[0]), maybe(slots),
                           random_.below(room), maybe(&n[1]));
        conn_map_pairs_copy(map(), maybe(slots), maybe(slots), maybe(coupling), random_.below(room),
                            maybe(&n[0]));
        conn_map_memory(map(), random_.chance(0.5) ? 0 : number(), maybe(&n[0]), maybe(&n[1]));
    }
    /// Layouts inside the memory, or so large that they must be refused.
    void reorder() {
        std::int32_t* const order = numbers();
        std::array<double, room> out;
        conn_array a = conn_array_matrix_of(random_.below(4), memory_.data(), random_.below(6),
                                            1 + random_.below(3));
        a.stride[0] = random_.below(9), a.stride[1] = random_.below(5);
        if (random_.chance(0.1)) a.ndim = number();
        if (random_.chance(0.1)) a.dtype = number();
        if (random_.chance(0.1)) a.space = number();
        if (random_.chance(0.1)) a.extent[1] = -random_.below(5);
        if (random_.chance(0.1))
            a.stride[0] = static_cast<std::int64_t>(random_.bits() >> 2 | 1ull << 62);
        if (random_.chance(0.1)) a.data = nullptr;
        if (order != nullptr && random_.chance(0.7))
            for (int k = 0; k < 6; ++k) order[k] = 5 - k - static_cast<int>(6 - a.extent[0]);
        conn_reorder(random_.chance(0.95) ? &a : nullptr, order,
                     random_.chance(0.9) ? a.extent[0] : long_number(), random_.below(4) - 1,
                     random_.chance(0.9) ? out.data() : nullptr);
    }
    void estimate() {
        conn_nodes* const some[4] = {nodes(), nodes(), nodes(), nodes()};
        with_struct<conn_estimate>([&](auto* s) {
            if (conn_map_estimate(map(), random_.chance(0.95) ? some : nullptr,
                                  random_.chance(0.8) ? 1 : random_.below(6) - 1, s) == CONN_OK)
                ++n_estimated;
        });
        static const conn_log_callback listen = [](void*, std::int32_t, const char* line) {
            EXPECT_NE(line, nullptr);
        };
        conn_context_set_log(context(), random_.chance(0.7) ? random_.below(4) : number(),
                             random_.chance(0.9) ? listen : nullptr, nullptr);
    }
    void couple() {
        std::int64_t n = random_.below(room);
        conn_map_info info = CONN_MAP_INFO_INIT;
        if (random_.chance(0.5) && conn_map_get_info(map_.handle, &info) == CONN_OK)
            n = info.n_pairs;
        if (n > room) n = -n;
        conn_map_set_coupling(map(), random_.chance(0.9) ? memory_.data() : nullptr, n);
        conn_map_set_coupling_function(map(), random_.chance(0.9) ? half : nullptr, nullptr);
    }
    conn_pair_field* pick_field() {
        return random_.chance(0.8)   ? field_
               : random_.chance(0.5) ? nullptr
                                     : reinterpret_cast<conn_pair_field*>(map_.handle);
    }
    void field() {
        if (random_.chance(0.1)) conn_pair_field_destroy(&field_);
        if (field_ == nullptr) conn_pair_field_create(map(), number(), &field_);
        if (random_.chance(0.5)) conn_pair_field_reset(pick_field(), map());
        double* data = nullptr;
        std::int64_t n_pairs = 0;
        std::int32_t n = 0;
        if (conn_pair_field_data(pick_field(), map(), &data, &n_pairs, &n) == CONN_OK)
            std::fill_n(data, n_pairs * n, 1.5);
    }
    void sum() {
        std::array<double, 8192> out;
        const std::int64_t capacity = random_.below(static_cast<int>(out.size()));
        if (conn_pair_field_sum(pick_field(), map(), number(), random_.below(3) - 1,
                                random_.chance(0.9) ? out.data() : nullptr, capacity) == CONN_OK)
            ++n_summed;
    }
    void add_boundary() {
        double planes[12];  // two planes in 3D: a point and a normal each
        for (double& value : planes)
            value = random_.pick({0.0, 1.0, -1.0, 1e300, -2.5, std::nan("")});
        const char* names[] = {"x", "", nullptr, "wall"};
        if (random_.chance(0.2)) {
            conn_boundaries_destroy(&boundaries_);
            conn_boundaries_create(context_.handle, 1 + random_.below(3), &boundaries_);
        }
        conn_boundaries_add(boundaries_, number(), names[random_.below(4)],
                            random_.chance(0.9) ? planes : nullptr, random_.below(2));
    }
    void update_boundaries() {
        conn_nodes* const some[] = {nodes(), nodes(), nodes(), nodes()};
        if (conn_boundaries_update(boundaries_, map(), random_.chance(0.95) ? some : nullptr,
                                   random_.chance(0.8) ? 1 : random_.below(6) - 1,
                                   random_.below(6) - 1) == CONN_OK)
            ++n_bounded;
        std::int64_t n = 0;
        with_struct<conn_boundary_nodes>([&](auto* s) {
            if (conn_boundaries_get_nodes(boundaries_, number(), s) == CONN_OK) n = s->n;
        });
        std::vector<double> values(static_cast<std::size_t>(6 * n) + 6);
        conn_boundaries_fill_ghosts(boundaries_, number(), number(), values.data(), n,
                                    random_.below(8) - 1);
    }
};

}  // namespace connectivity::test
