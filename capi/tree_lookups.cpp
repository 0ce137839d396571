// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <span>
#include <string>

#include <connectivity/tree/area_query.hpp>
#include <connectivity/tree/linked_sources.hpp>
#include <connectivity/tree/peer_lists.hpp>
#include <connectivity/tree/target_filter.hpp>

#include "arguments.hpp"
#include "guard.hpp"
#include "tree_objects.hpp"

using namespace connectivity;
using namespace connectivity::capi;

namespace {

struct ParticlesPin final : Handle {
    LinkedSources linked;
    FilteredTargets kept;

    const char* kind() const noexcept override { return "the owner of a particles view"; }
    void drop_views() noexcept override {
        linked = {};
        kept = {};
    }
};

void hand_over_rows(const Csr& rows, const conn_tree& tree, conn_box_list_view* view) {
    LevelBoxList list;
    list.starts = rows.offsets();
    list.lists = rows.values();
    hand_over_list(list, {}, tree.generation, CONN_SPACE_HOST, view);
}

/// Balls of the host, of whatever precision.
struct HostBalls {
    HostParticles keeper;
    ParticleArray balls;

    HostBalls(const conn_tree& tree, const conn_array* centers, std::int32_t n_centers,
              const conn_array* radii)
        : balls(keeper.read(centers, n_centers, tree.view().dim, &required(radii, "radii"),
                            "centers", "radii")) {}
};

/// The tree, which must have particles and not boxes alone.
const conn_tree& tree_with_particles(const conn_tree* tree) {
    const conn_tree& ours = built_tree(tree);
    if (ours.given)
        throw Error(Status::argument,
                    "tree was made by conn_tree_set_boxes and does not know its particles");
    return ours;
}

std::span<const std::int8_t> read_flags(const conn_tree& tree, const std::uint8_t* flags,
                                        std::int64_t n_flags) {
    check_count(flags, n_flags, max_slots, "flags", "n_flags");
    if (n_flags != tree.view().targets.n)
        throw Error(Status::argument, "n_flags = " + std::to_string(n_flags) + ", must be " +
                                          std::to_string(tree.view().targets.n) +
                                          ", one for each target");
    return {reinterpret_cast<const std::int8_t*>(flags), static_cast<std::size_t>(n_flags)};
}

conn_particles_view particles_view(const conn_tree& tree, const conn_particles_view* view) {
    conn_particles_view out = read_view(view, conn_particles_view CONN_PARTICLES_VIEW_INIT);
    out.n_boxes = tree.view().n_boxes;
    out.generation = tree.generation;
    out.dim = tree.view().dim;
    return out;
}

}  // namespace

conn_status conn_tree_peers(const conn_tree* tree, conn_box_list_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_tree& ours = built_tree(tree);
        hand_over_rows(peer_lists(ours.view()), ours, view);
    });
}

conn_status conn_tree_area_query(const conn_tree* tree, const conn_array* centers,
                                 int32_t n_centers, const conn_array* radii,
                                 conn_box_list_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_tree& ours = built_tree(tree);
        const HostBalls host(ours, centers, n_centers, radii);
        hand_over_rows(area_query(ours.view(), host.balls, host.keeper.coordinates()), ours, view);
    });
}

conn_status conn_tree_leaves_to_balls(const conn_tree* tree, const conn_array* centers,
                                      int32_t n_centers, const conn_array* radii,
                                      conn_box_list_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_tree& ours = built_tree(tree);
        const HostBalls host(ours, centers, n_centers, radii);
        hand_over_rows(leaves_to_balls(ours.view(), host.balls, host.keeper.coordinates()), ours,
                       view);
    });
}

conn_status conn_tree_space_invader(const conn_tree* tree, const conn_array* centers,
                                    int32_t n_centers, const conn_array* radii, double* distances,
                                    int64_t capacity, int64_t* count) {
    return guarded_with_runtime(__func__, [&] {
        const conn_tree& ours = built_tree(tree);
        required(count, "count") = ours.view().n_boxes;
        if (distances == nullptr) return;
        check_capacity(capacity, *count);
        const HostBalls host(ours, centers, n_centers, radii);
        copy_out(space_invader_distances(ours.view(), host.balls, host.keeper.coordinates()),
                 distances, capacity, count);
    });
}

conn_status conn_tree_filter_targets(const conn_tree* tree, const uint8_t* flags, int64_t n_flags,
                                     conn_box_list_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_tree& ours = tree_with_particles(tree);
        hand_over_rows(filter_targets_user_order(ours.view(), read_flags(ours, flags, n_flags)),
                       ours, view);
    });
}

conn_status conn_tree_filter_targets_in_tree_order(const conn_tree* tree, const uint8_t* flags,
                                                   int64_t n_flags, conn_particles_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_tree& ours = tree_with_particles(tree);
        conn_particles_view out = particles_view(ours, view);
        auto pin = std::make_unique<ParticlesPin>();
        pin->kept = filter_targets_tree_order(ours.view(), read_flags(ours, flags, n_flags));
        out.n = pin->kept.n;
        out.ids = pin->kept.unfiltered_from_filtered.data();
        out.box_starts = pin->kept.box_starts.data();
        out.box_counts_nonchild = pin->kept.box_counts_nonchild.data();
        write_view(view, out, std::move(pin));
    });
}

conn_status conn_tree_link_point_sources(const conn_tree* tree, const int64_t* user_starts,
                                         int64_t n_starts, const conn_array* points,
                                         int32_t n_points, conn_particles_view* view) {
    return guarded_with_runtime(__func__, [&] {
        const conn_tree& ours = tree_with_particles(tree);
        check_count(user_starts, n_starts, Offset{max_slots} + 1, "user_starts", "n_starts");
        HostParticles keeper;
        const ParticleArray array =
            keeper.read(points, n_points, ours.view().dim, nullptr, "points", "");
        conn_particles_view out = particles_view(ours, view);
        auto pin = std::make_unique<ParticlesPin>();
        pin->linked =
            link_point_sources(ours.view(), {user_starts, static_cast<std::size_t>(n_starts)},
                               array, keeper.coordinates());
        out.n = pin->linked.n;
        out.n_sources = ours.view().sources.n;
        out.ids = pin->linked.user_point_source_ids.data();
        out.box_starts = pin->linked.box_starts.data();
        out.box_counts_nonchild = pin->linked.box_counts_nonchild.data();
        out.box_counts_cumul = pin->linked.box_counts_cumul.data();
        out.positions = pin->linked.positions.data();
        out.starts = pin->linked.starts.data();
        out.counts = pin->linked.counts.data();
        write_view(view, out, std::move(pin));
    });
}

conn_status conn_particles_release(conn_particles_view* view) {
    return guarded(__func__, [&] {
        release_view<ParticlesPin>(view, conn_particles_view CONN_PARTICLES_VIEW_INIT);
    });
}
