// SPDX-License-Identifier: BSD-3-Clause
// vesin: cell lists for molecules. In a periodic box it names a pair once for every image in reach.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <vesin.h>

#include "../conformance.h"

namespace {

using Pair = std::pair<std::size_t, std::size_t>;

/// Each pair of different nodes once, however many images it has.
std::vector<Pair> without_images(const VesinNeighborList& found) {
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < found.length; ++k) {
        const auto [i, j] = std::minmax(found.pairs[k][0], found.pairs[k][1]);
        if (i != j) pairs.emplace_back(i, j);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

void tell(const conf_nodes& nodes, const VesinNeighborList& found, conf_answer* answer) {
    const auto add = [answer](std::size_t i, std::size_t j) {
        conf_add_pair(answer, static_cast<std::int64_t>(i), static_cast<std::int64_t>(j));
    };
    if (nodes.period > 0 && 2 * nodes.radius[0] >= nodes.period) {
        for (const auto& [i, j] : without_images(found)) add(i, j);
    } else {
        for (std::size_t k = 0; k < found.length; ++k) add(found.pairs[k][0], found.pairs[k][1]);
    }
}

void find_pairs(const conf_nodes* nodes, conf_answer* answer) {
    if (nodes->n == 0) return;
    using Vector = double[3];
    const double L = nodes->period;
    const double box[3][3] = {{L, 0, 0}, {0, L, 0}, {0, 0, L}};
    const bool periodic[3] = {L > 0, L > 0, L > 0};
    VesinOptions options{};
    options.cutoff = nodes->radius[0];
    VesinNeighborList found;
    const char* why = "";
    const int status = vesin_neighbors(reinterpret_cast<const Vector*>(nodes->x),
                                       static_cast<std::size_t>(nodes->n), box, periodic,
                                       {VesinCPU, 0}, options, &found, &why);
    if (status != 0)
        conf_refuse(answer, why);
    else
        tell(*nodes, found, answer);
    vesin_free(&found);
}

}  // namespace

extern "C" const conf_library conf_vesin = {"vesin", CONF_SAME_RADIUS_ONLY | CONF_THREE_D_ONLY,
                                            find_pairs};
