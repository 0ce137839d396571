// SPDX-License-Identifier: BSD-3-Clause
// Cabana: a Verlet list over a dense grid of cells, of one support for all.
#include <algorithm>

#include <Cabana_Core.hpp>

#include "../conformance.h"

namespace {

using Space = Kokkos::DefaultHostExecutionSpace;
using Memory = Space::memory_space;
using Positions = Kokkos::View<double* [3], Kokkos::LayoutRight, Memory, Kokkos::MemoryUnmanaged>;
using List = Cabana::VerletList<Memory, Cabana::HalfNeighborTag, Cabana::VerletLayoutCSR,
                                Cabana::TeamOpTag, 3>;

void search(const conf_nodes& nodes, conf_answer* answer) {
    const auto n = static_cast<std::size_t>(nodes.n);
    const double R = nodes.radius[0];
    double low[3], high[3];  // of its grid, which must not be thinner than a cell
    for (int d = 0; d < 3; ++d) {
        low[d] = high[d] = nodes.x[d];
        for (std::size_t i = 1; i < n; ++i) {
            low[d] = std::min(low[d], nodes.x[3 * i + static_cast<std::size_t>(d)]);
            high[d] = std::max(high[d], nodes.x[3 * i + static_cast<std::size_t>(d)]);
        }
        low[d] -= R / 2, high[d] += R / 2;
    }
    // It only reads them, but does not compile for constants.
    const Positions x(const_cast<double*>(nodes.x), n);
    List list;
    list.build(Space(), x, 0, n, R, 1.0, low, high);
    const auto& rows = list._data;
    for (std::size_t i = 0; i < n; ++i)
        for (int k = 0; k < rows.counts(i); ++k)
            conf_add_pair(answer, static_cast<std::int64_t>(i),
                          rows.neighbors(static_cast<std::size_t>(rows.offsets(i) + k)));
}

void find_pairs(const conf_nodes* nodes, conf_answer* answer) {
    const Kokkos::ScopeGuard kokkos;
    if (nodes->n > 0) search(*nodes, answer);
}

}  // namespace

extern "C" const conf_library conf_cabana = {
    "Cabana", CONF_SAME_RADIUS_ONLY | CONF_OPEN_ONLY | CONF_THREE_D_ONLY, find_pairs};
