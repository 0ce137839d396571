// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/tree/linked_sources.hpp>

#include <string>
#include <vector>

#include "check_array.hpp"

namespace connectivity {

namespace {

using namespace tree_detail;

void check_starts(const TreeView& tree, std::span<const Offset> starts, Offset n_points) {
    const auto n = static_cast<std::size_t>(tree.sources.n);
    if (starts.size() != n + 1)
        throw Error(Status::argument, "there are " + std::to_string(starts.size()) +
                                          " starts of point sources, must be one more than the " +
                                          std::to_string(n) + " sources");
    for (std::size_t i = 0; i <= n; ++i) {
        const Offset least = i == 0 ? 0 : starts[i - 1], most = i == 0 ? 0 : n_points;
        if (starts[i] < least || starts[i] > most || (i == n && starts[i] != n_points))
            throw Error(Status::argument, "start " + std::to_string(i) + " of point sources is " +
                                              std::to_string(starts[i]) + ", must be in [" +
                                              std::to_string(i == n ? n_points : least) + ", " +
                                              std::to_string(most) + "]");
    }
}

}  // namespace

LinkedSources link_point_sources(const TreeView& tree, std::span<const Offset> user_starts,
                                 const ParticleArray& points, CoordinateType coordinates) {
    check_array("point source", points, tree.dim, coordinates);
    check_starts(tree, user_starts, points.n);
    check_values("point source", points, tree.dim, coordinates);
    const Offset n = points.n, n_sources = tree.sources.n;
    const auto integers = [](Offset size) {
        return allocate<std::int32_t>("tree/linked_sources", size);
    };
    LinkedSources out{n,
                      allocate<double>("tree/linked_sources", tree.dim * n),
                      integers(n),
                      integers(n_sources),
                      integers(n_sources),
                      integers(tree.n_boxes),
                      integers(tree.n_boxes),
                      integers(tree.n_boxes)};
    std::vector<std::int32_t> first(n_sources + 1);  // point sources before each source
    std::int32_t next = 0;
    for (Offset i = 0; i < n_sources; ++i) {
        const Offset user = tree.user_source_ids(i);
        first[i] = out.starts(i) = next;
        for (Offset from = user_starts[user]; from < user_starts[user + 1]; ++from, ++next) {
            out.user_point_source_ids(next) = static_cast<std::int32_t>(from);
            for (int d = 0; d < tree.dim; ++d)
                out.positions(d * n + next) = coordinate(points, coordinates, from, d);
        }
        out.counts(i) = next - first[i];
    }
    first[n_sources] = next;
    for (Offset b = 0; b < tree.n_boxes; ++b) {
        const Offset start = tree.sources.box_starts(b);
        out.box_starts(b) = first[start];
        out.box_counts_nonchild(b) =
            first[start + tree.sources.box_counts_nonchild(b)] - first[start];
        out.box_counts_cumul(b) = first[start + tree.sources.box_counts_cumul(b)] - first[start];
    }
    return out;
}

}  // namespace connectivity
