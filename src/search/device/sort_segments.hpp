// SPDX-License-Identifier: BSD-3-Clause
#pragma once
/// Sorts many lists in place, a team for each: a bitonic network in global memory.
///
/// Invariant: the network is the form in which every comparator puts the smaller value at the lower
/// place, so what lies beyond the end may be taken for infinite and is never touched: any length
/// works. Cost: n log²(n) / 4 comparisons.

#include "spaces.hpp"

namespace connectivity::detail::device {

/// List s is values[offsets[s] - offsets[0]] ... values[offsets[s + 1] - offsets[0]].
template <class Exec>
struct SortSegments {
    const Offset* offsets;
    Slot* values;

    using Member = typename Teams<Exec>::member_type;

    KOKKOS_INLINE_FUNCTION void operator()(const Member& team) const {
        const Offset s = team.league_rank(), first = offsets[s] - offsets[0];
        const int n = static_cast<int>(offsets[s + 1] - offsets[s]);
        int half_size = 1;  // the network has twice as many places, at least n
        while (half_size < n - half_size) half_size *= 2;
        if (n < 2) return;
        for (Offset half = 1; half <= half_size; half *= 2) {
            step(team, values + first, n, half_size, half, true);
            for (Offset h = half / 2; h > 0; h /= 2)
                step(team, values + first, n, half_size, h, false);
        }
    }

private:
    /// Comparators of places in spans of 2 half: mirrored, or half apart.
    KOKKOS_INLINE_FUNCTION static void step(const Member& team, Slot* v, int n, int comparators,
                                            Offset half, bool mirrored) {
        Kokkos::parallel_for(Kokkos::TeamThreadRange(team, comparators), [&](int c) {
            const Offset k = c & (half - 1), span = 2 * (c - k), low = span + k,
                         high = span + (mirrored ? 2 * half - 1 - k : k + half);
            if (high < n && v[high] < v[low]) {
                const Slot value = v[low];
                v[low] = v[high];
                v[high] = value;
            }
        });
        team.team_barrier();
    }
};

template <class Exec>
void sort_segments(Offset n_segments, const Offset* offsets, Slot* values) {
    if (n_segments == 0) return;
    Kokkos::parallel_for("search/device/sort",
                         Teams<Exec>(static_cast<int>(n_segments), Kokkos::AUTO),
                         SortSegments<Exec>{offsets, values});
}

}  // namespace connectivity::detail::device
