// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Arguments made of garbage: numbers, arrays and structs that may be anything, handles that are
/// NULL, live, dead or of another kind. Pointers are NULL or point to enough memory.

#include <array>
#include <cmath>
#include <cstring>

#include <connectivity_boundary.h>
#include <support/random.hpp>
#include "capi_support.hpp"

namespace connectivity::test {

class Garbage {
public:
    explicit Garbage(std::uint64_t seed) : random_(seed) {
        for (double& value : memory_) value = random_.uniform();
        nodes_.handle = nullptr;
        for (int k = 0; k < 4; ++k)
            EXPECT_TRUE(ok(conn_nodes_create(context_.handle, "x", 1 + k % 3, 2,
                                             &lists_[static_cast<std::size_t>(k)])));
        dead_nodes_ = lists_[3];
        conn_nodes_destroy(&lists_[3]);
        if (seed % 2 == 1) {  // as Fortran does
            conn_map_options options = CONN_MAP_OPTIONS_INIT;
            options.index_base = index_base_ = 1;
            EXPECT_TRUE(ok(conn_map_destroy(&map_.handle)));
            EXPECT_TRUE(ok(conn_map_create(context_.handle, &options, &map_.handle)));
        }
        EXPECT_TRUE(ok(conn_map_create(context_.handle, nullptr, &dead_map_)));
        conn_map* copy = dead_map_;
        conn_map_destroy(&copy);
        EXPECT_TRUE(ok(conn_boundaries_create(context_.handle, 2, &boundaries_)));
    }
    ~Garbage() {
        conn_pair_field_destroy(&field_);
        conn_boundaries_destroy(&boundaries_);
        for (conn_nodes*& list : lists_) conn_nodes_destroy(&list);
    }
    Garbage(const Garbage&) = delete;
    Garbage& operator=(const Garbage&) = delete;

protected:
    static constexpr int room = 64;  // values behind every data pointer

    std::int32_t number() {
        const int edge[] = {-1, 0, 1, 2, 3, 4, 6, 100, -2147483647, 2147483647};
        return random_.chance(0.9) ? edge[random_.below(random_.chance(0.5) ? 4 : 10)]
                                   : static_cast<int>(random_.bits());
    }
    std::int64_t long_number() {
        return random_.chance(0.8) ? number() : static_cast<std::int64_t>(random_.bits());
    }
    /// Strides and extents inside the memory or so large that they must be refused before a read.
    conn_array array() {
        conn_array a = conn_array_vector(memory_.data(), random_.below(5));
        if (random_.chance(0.7))
            a = conn_array_matrix(memory_.data(), random_.below(5), 1 + random_.below(6));
        if (random_.chance(0.1)) a.data = nullptr;
        if (random_.chance(0.1))
            a.data = reinterpret_cast<char*>(memory_.data()) + random_.below(8);
        if (random_.chance(0.1)) a.space = number();
        if (random_.chance(0.1)) a.dtype = number();
        if (random_.chance(0.1)) a.ndim = number();
        if (random_.chance(0.1)) a.extent[0] = -1 - static_cast<std::int64_t>(random_.bits() >> 2);
        if (random_.chance(0.1))
            a.extent[0] = (std::int64_t{1} << 31) + static_cast<std::int64_t>(random_.bits() >> 2);
        if (random_.chance(0.1)) a.extent[1] = long_number();
        if (random_.chance(0.1)) a.stride[0] = random_.below(6);
        return a;
    }
    conn_nodes* nodes() {
        const int k = random_.below(10);
        return k < 4    ? lists_[k]
               : k == 4 ? dead_nodes_
               : k == 5 ? reinterpret_cast<conn_nodes*>(map_.handle)
                        : lists_[0];
    }
    conn_map* map() {
        const int k = random_.below(10);
        return k == 0   ? nullptr
               : k == 1 ? dead_map_
               : k == 2 ? reinterpret_cast<conn_map*>(lists_[0])
                        : map_.handle;
    }
    conn_context* context() { return random_.chance(0.9) ? context_.handle : nullptr; }

    void spoil(void* data, std::size_t size) {
        auto* bytes = static_cast<unsigned char*>(data);
        for (int k = random_.below(4); k > 0; --k)
            bytes[random_.below(static_cast<int>(size))] =
                static_cast<unsigned char>(random_.bits());
    }
    /// A struct in more memory than any size the library accepts; spoilt or pure noise.
    template <class T, class Call>
    void with_struct(const Call& call) {
        alignas(T) unsigned char bytes[8192] = {};
        if (random_.chance(0.3)) {
            Random noise(random_.bits());
            for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(noise.bits());
        }
        std::size_t size = sizeof(T);
        if (random_.chance(0.2)) size = static_cast<std::size_t>(long_number());
        if (random_.chance(0.2)) size += static_cast<std::size_t>(random_.below(64));
        std::memcpy(bytes, &size, sizeof size);
        if (random_.chance(0.5)) spoil(bytes + sizeof size, sizeof(T) - sizeof size);
        call(reinterpret_cast<T*>(random_.chance(0.95) ? bytes : nullptr));
    }

    Random random_;
    std::int32_t index_base_ = 0;
    std::array<double, room> memory_{};
    Context context_;
    Nodes nodes_{context_, 3};
    Map map_{context_};
    std::array<conn_nodes*, 4> lists_{};
    std::array<std::int32_t, room> numbers_{};
    conn_pair_field* field_ = nullptr;
    conn_boundaries* boundaries_ = nullptr;
    conn_nodes* dead_nodes_ = nullptr;
    conn_map* dead_map_ = nullptr;
};

}  // namespace connectivity::test
