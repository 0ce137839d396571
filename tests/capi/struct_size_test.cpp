// SPDX-License-Identifier: BSD-3-Clause
// Hosts compiled against other headers: every struct with a struct_size, as it was in the first
// release, as it will be when it has grown, and in sizes that no host can have.

#include <cstddef>
#include <cstring>
#include <functional>

#include <connectivity_boundary.h>

#include "capi_support.hpp"

namespace connectivity::test {
namespace {

/// A struct in memory of the host that is longer than any version of it.
template <class T>
class HostStruct {
public:
    explicit HostStruct(const T& init) { std::memcpy(bytes_, &init, sizeof init); }

    T* get(std::size_t struct_size) {
        std::memcpy(bytes_, &struct_size, sizeof struct_size);
        return reinterpret_cast<T*>(bytes_);
    }
    unsigned char& operator[](std::size_t byte) { return bytes_[byte]; }

private:
    alignas(T) unsigned char bytes_[sizeof(T) + 64] = {};
};

class CapiStructSizes : public ::testing::Test {
protected:
    CapiStructSizes() {
        conn_map_options options = CONN_MAP_OPTIONS_INIT;
        options.intersection = CONN_INTERSECTION_ALL;
        options.overlap = 1;
        EXPECT_TRUE(ok(built.rebuild(options)));
        const double wall[] = {-0.01, 0, 1, 0};
        EXPECT_TRUE(ok(conn_boundaries_create(context.handle, 2, &boundaries)));
        EXPECT_TRUE(ok(conn_boundaries_add(boundaries, CONN_BOUNDARY_REFLECTING, "wall", wall, 1)));
        EXPECT_TRUE(ok(conn_boundaries_update(boundaries, with_ghosts.handle, built.lists.data(), 1,
                                              CONN_GHOSTS_KEEP)));
    }
    ~CapiStructSizes() override { conn_boundaries_destroy(&boundaries); }

    /// call(T*) reads the struct, or writes it, or both; first is its size in the first release.
    /// Whatever the size that is served, nothing is written beyond it, and it stays what it was.
    template <class T>
    void expect_law(const char* name, const T& init, std::size_t first,
                    const std::function<conn_status(T*)>& call) {
        SCOPED_TRACE(name);
        for (std::size_t size = first; size <= sizeof(T) + 64; size += 4) {
            HostStruct<T> host(init);
            for (std::size_t b = size; b < sizeof(T) + 64; ++b) host[b] = 0xa5;
            T* const given = host.get(size);
            ASSERT_TRUE(ok(call(given))) << "struct_size " << size;
            std::size_t now = 0;
            std::memcpy(&now, given, sizeof now);
            ASSERT_EQ(now, size);
            for (std::size_t b = sizeof(T); b < size; ++b) ASSERT_EQ(host[b], 0) << "byte " << b;
            for (std::size_t b = size; b < sizeof(T) + 64; ++b)
                ASSERT_EQ(host[b], 0xa5) << "byte " << b << " of " << size;
        }
        for (const std::size_t byte : {sizeof(T), sizeof(T) + 63}) {
            HostStruct<T> host(init);
            host[byte] = 1;
            EXPECT_TRUE(fails(call(host.get(sizeof(T) + 64)), CONN_E_UNSUPPORTED,
                              {"byte " + std::to_string(byte)}));
        }
        for (const std::size_t size :
             {std::size_t{0}, sizeof(std::size_t), first - 1, std::size_t{4097}, ~std::size_t{0}}) {
            HostStruct<T> host(init);
            EXPECT_TRUE(fails(call(host.get(size)), CONN_E_STRUCT_SIZE,
                              {"struct_size = " + std::to_string(size), std::to_string(first)}));
        }
    }

    /// The same for a view, which is released again.
    template <class T>
    void expect_view_law(const char* name, const T& init, std::size_t first,
                         const std::function<conn_status(T*)>& acquire,
                         const std::function<conn_status(T*)>& release) {
        expect_law<T>(name, init, first, [&](T* view) {
            const conn_status status = acquire(view);
            return status == CONN_OK ? release(view) : status;
        });
        expect_law<T>(name, init, first, release);
    }

    static constexpr int n = 30;
    Context context;
    Built built{context, 2, {random_nodes(2, n, 1)}};
    Map with_ghosts{context};
    conn_boundaries* boundaries = nullptr;
    conn_map* const map = built.map.handle;
};

/// Bytes up to and with a member.
#define END_OF(type, member) (offsetof(type, member) + sizeof(type::member))

TEST_F(CapiStructSizes, options_of_every_version_are_read) {
    expect_law<conn_context_options>(
        "conn_context_options", CONN_CONTEXT_OPTIONS_INIT,
        END_OF(conn_context_options, budget_bytes), [](conn_context_options* options) {
            conn_context* made = nullptr;
            const conn_status status = conn_context_create(options, &made);
            EXPECT_EQ(made != nullptr, status == CONN_OK);
            if (status == CONN_OK) {
                EXPECT_TRUE(ok(conn_context_destroy(&made)));
            }
            return status;
        });
    expect_law<conn_map_options>(
        "conn_map_options", CONN_MAP_OPTIONS_INIT, END_OF(conn_map_options, budget_bytes),
        [&](conn_map_options* options) { return conn_map_set_options(map, options); });
}

TEST_F(CapiStructSizes, numbers_are_written_into_structs_of_every_version) {
    expect_law<conn_map_info>("conn_map_info", CONN_MAP_INFO_INIT,
                              END_OF(conn_map_info, n_report_counters),
                              [&](conn_map_info* info) { return conn_map_get_info(map, info); });
    expect_law<conn_estimate>("conn_estimate", CONN_ESTIMATE_INIT,
                              END_OF(conn_estimate, relative_error), [&](conn_estimate* estimate) {
                                  return conn_map_estimate(map, built.lists.data(), 1, estimate);
                              });
    expect_law<conn_report_entry>(
        "conn_report_entry", CONN_REPORT_ENTRY_INIT, END_OF(conn_report_entry, reused),
        [&](conn_report_entry* entry) { return conn_map_report_entry(map, 0, entry); });
    expect_law<conn_boundary_nodes>("conn_boundary_nodes", CONN_BOUNDARY_NODES_INIT,
                                    END_OF(conn_boundary_nodes, global_id),
                                    [&](conn_boundary_nodes* nodes) {
                                        return conn_boundaries_get_nodes(boundaries, 0, nodes);
                                    });
}

TEST_F(CapiStructSizes, views_of_every_version_are_acquired_and_released) {
    expect_view_law<conn_rows_view>(
        "conn_rows_view", CONN_ROWS_VIEW_INIT, END_OF(conn_rows_view, owner),
        [&](conn_rows_view* view) { return conn_map_rows_acquire(map, CONN_SPACE_HOST, view); },
        conn_map_rows_release);
    expect_view_law<conn_rows_view>(
        "overlap", CONN_ROWS_VIEW_INIT, END_OF(conn_rows_view, owner),
        [&](conn_rows_view* view) { return conn_map_overlap_acquire(map, CONN_SPACE_HOST, view); },
        conn_map_rows_release);
    expect_view_law<conn_pairs_view>(
        "conn_pairs_view", CONN_PAIRS_VIEW_INIT, END_OF(conn_pairs_view, owner),
        [&](conn_pairs_view* view) {
            return conn_map_pairs_acquire(map, CONN_SPACE_HOST, CONN_PAIRS_EXPAND, view);
        },
        conn_map_pairs_release);
    expect_view_law<conn_intersection_view>(
        "conn_intersection_view", CONN_INTERSECTION_VIEW_INIT,
        END_OF(conn_intersection_view, owner),
        [&](conn_intersection_view* view) {
            return conn_map_intersection_acquire(map, CONN_SPACE_HOST, view);
        },
        conn_map_intersection_release);
}

}  // namespace
}  // namespace connectivity::test
