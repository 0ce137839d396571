// SPDX-License-Identifier: BSD-3-Clause
#include "locals.hpp"

#include <algorithm>
#include <numeric>

#include <connectivity/base/parallel.hpp>

#include "base/first_exception.hpp"

namespace connectivity::detail {

void take_all(const Cells& cells, CellSet& set) {
    set.is_in.clear();
    set.ids.resize(static_cast<std::size_t>(cells.n));
    std::iota(set.ids.begin(), set.ids.end(), 0);
    set.level_starts.clear();
    for (int level = 0; level <= cells.n_levels; ++level)
        set.level_starts.push_back(static_cast<std::size_t>(cells.level_starts(level)));
}

void take_paths(const Cells& cells, const std::vector<std::int32_t>& particles, CellSet& set) {
    const auto holds_one = [&](CellId c) {
        const auto next = std::lower_bound(particles.begin(), particles.end(), cells.first(c));
        return next != particles.end() && *next < cells.first(c) + cells.count(c);
    };
    set.is_in.assign(static_cast<std::size_t>(cells.n), 0);
    set.ids.clear();
    set.level_starts.clear();
    for (int level = 0; level < cells.n_levels; ++level) {
        set.level_starts.push_back(set.ids.size());
        for (CellId c = cells.level_starts(level); c < cells.level_starts(level + 1); ++c) {
            if (!set.is_in[cells.parent(c)] && c != 0) continue;
            if (!holds_one(c)) continue;
            set.is_in[c] = 1;
            set.ids.push_back(c);
        }
    }
    set.level_starts.push_back(set.ids.size());
}

namespace {

/// Level by level, so that a parent is complete; each child is written with its parent's others.
void pass_down(const Cells& cells, const CellSet& set, double* locals) {
    const CellArrays arrays = cells.arrays();
    for (std::size_t level = 0; level + 2 < set.level_starts.size(); ++level) {
        const std::size_t first = set.level_starts[level];
        for_each_dynamic("gravity/l2l", static_cast<Offset>(set.level_starts[level + 1] - first),
                         [&](int, Offset k) {
                             const CellId c = set.ids[first + k];
                             std::int32_t children[8];
                             int n = 0;
                             for (CellId b = cells.first_child(c);
                                  b < cells.first_child(c) + cells.n_children(c); ++b)
                                 if (set.contains(b)) children[n++] = b;
                             if (n > 0)
                                 expansion_kernels().l2l(cells.order, cells.expansion(c, locals),
                                                         arrays, {children, n, nullptr, nullptr},
                                                         locals);
                         });
    }
}

}  // namespace

void make_locals(const Cells& cells, const CellLists& lists, const Images& images,
                 const CellSet& set, std::vector<UnpackedList>& unpacked, View<double>& locals) {
    ensure_capacity(locals, "gravity/locals", cells.n * cells.stride);
    double* const all = locals.data();
    const CellArrays arrays = cells.arrays();
    FirstException failure;
    const Offset* const offsets = lists.far().offset_data();
    for_each_dynamic("gravity/m2l", static_cast<Offset>(set.ids.size()), [&](int worker, Offset k) {
        if (failure.any()) return;
        const CellId a = set.ids[k];
        const Expansion own = cells.expansion(a, all);
        std::fill_n(own.coefficients, cells.stride, 0.0);
        const Offset n = offsets[a + 1] - offsets[a];
        if (n == 0) return;
        try {
            expansion_kernels().m2l(
                cells.order, arrays,
                unpacked[worker].of(lists.far().value_data() + offsets[a], n, images), own);
        } catch (...) {
            failure.keep();
        }
    });
    failure.rethrow("gravity, for its lists,");
    pass_down(cells, set, all);
}

}  // namespace connectivity::detail
