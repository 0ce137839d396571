// SPDX-License-Identifier: BSD-3-Clause
#include <support/skin.hpp>

#include <algorithm>

#include <support/brute_force.hpp>

namespace connectivity::test {

void build(ConnectivityMap& map, const Case& c, double skin, SearchMethod method) {
    MapOptions options = map_options(c, method);
    options.skin = skin;
    map.rebuild(node_lists(c), options);
}

namespace {
template <class Offsets, class Values>
int missing(const std::vector<Offset>& offsets, const std::vector<Slot>& slots,
            const Offsets& kept_offsets, const Values& kept) {
    int n = 0;
    for (std::size_t r = 0; r + 1 < offsets.size(); ++r)
        for (Offset k = offsets[r]; k < offsets[r + 1]; ++k)
            n += !std::binary_search(kept.data() + kept_offsets(r),
                                     kept.data() + kept_offsets(r + 1),
                                     slots[static_cast<std::size_t>(k)]);
    return n;
}
}  // namespace

int missing(const ConnectivityMap& map, const Case& now) {
    const Expected e = brute_force(now);
    int n = missing(e.row_offsets, e.row_slots, map.rows().offsets, map.rows().slots);
    if (e.pair_offsets.empty()) return n;
    const auto pairs = map.pairs().view();
    return n + missing(e.pair_offsets, e.pair_j, pairs.offsets, pairs.j);
}

}  // namespace connectivity::test
