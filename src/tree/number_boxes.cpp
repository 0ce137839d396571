// SPDX-License-Identifier: BSD-3-Clause
#include "number_boxes.hpp"

#include <cmath>

#include <connectivity/base/parallel.hpp>

namespace connectivity::tree_detail {

BoxNumbers number_boxes(const RawTree& raw, bool skip_prune) {
    BoxNumbers numbers;
    numbers.level_starts.push_back(0);
    BoxId next = 0;
    for (const RawLevel& level : raw.levels) {
        std::vector<BoxId> ids(level.size(), -1);
        const BoxId first = next;
        for (std::size_t b = 0; b < level.size(); ++b)
            if (level[b].count > 0 || skip_prune || numbers.ids.empty()) ids[b] = next++;
        if (next == first) break;
        numbers.ids.push_back(std::move(ids));
        numbers.level_starts.push_back(next);
    }
    return numbers;
}

namespace {

void fill_box(const RawTree& raw, const BoxNumbers& numbers, std::size_t level, std::size_t index,
              TreeArrays& arrays) {
    const RawBox& box = raw.levels[level][index];
    const BoxId id = numbers.ids[level][index];
    const Offset aligned = arrays.header.aligned_n_boxes;
    const int dim = arrays.header.dim;
    arrays.levels(id) = static_cast<std::uint8_t>(level);
    arrays.flags(id) = box.is_split() ? box_flag::has_child_sources | box_flag::has_child_targets
                                      : std::uint8_t{0};
    for (int k = 0; k < 1 << dim; ++k) {
        const bool there = (box.children >> k & 1) != 0 && level + 1 < numbers.ids.size();
        const BoxId child = there ? numbers.ids[level + 1][box.child(k)] : 0;
        arrays.children(k * aligned + id) = child > 0 ? child : 0;
    }
    const BoxId parent = level > 0 ? numbers.ids[level - 1][box.parent] : 0;
    arrays.parents(id) = parent;
    for (int d = 0; d < dim; ++d) {
        double& center = arrays.centers(d * aligned + id);
        if (level == 0) {
            // Rounded as boxtree's: lists compare centres. Sums of float32 are exact enough here.
            const double lo = arrays.header.bounding_box_min[d];
            const bool wide = arrays.header.coordinates == CoordinateType::float64;
            center =
                lo +
                (wide ? arrays.header.bounding_box_max[d] - lo : arrays.header.root_extent) / 2;
            continue;
        }
        const double step = std::ldexp(arrays.header.root_extent, -static_cast<int>(level) - 1);
        const bool upper = (box.number >> (dim - 1 - d) & 1) != 0;
        center = arrays.centers(d * aligned + parent) + (upper ? step : -step);
    }
}

}  // namespace

void fill_boxes(const RawTree& raw, const BoxNumbers& numbers, TreeArrays& arrays) {
    const Offset n_boxes = arrays.header.n_boxes, aligned = arrays.header.aligned_n_boxes;
    std::copy(numbers.level_starts.begin(), numbers.level_starts.end(), arrays.level_starts.data());
    for (Offset b = n_boxes; b < aligned; ++b) {
        for (int k = 0; k < 1 << arrays.header.dim; ++k) arrays.children(k * aligned + b) = 0;
        for (int d = 0; d < arrays.header.dim; ++d) arrays.centers(d * aligned + b) = 0;
    }
    constexpr Offset chunk = 1024;
    for (std::size_t level = 0; level < numbers.ids.size(); ++level) {
        const auto n = static_cast<Offset>(numbers.ids[level].size());
        for_each_dynamic("tree/boxes", (n + chunk - 1) / chunk, [&](int, Offset c) {
            for (Offset b = c * chunk; b < std::min(n, (c + 1) * chunk); ++b)
                if (numbers.ids[level][b] >= 0)
                    fill_box(raw, numbers, level, static_cast<std::size_t>(b), arrays);
        });
    }
}

}  // namespace connectivity::tree_detail
