// SPDX-License-Identifier: BSD-3-Clause
#include "program/lists_particles.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace connectivity::program {

namespace {

constexpr const char* hint = "; --open ignores the period";

View<double> joined(std::span<const NodeList> lists, int dim) {
    Offset n = 0;
    for (const auto& nodes : lists) n += nodes.n();
    if (n > max_slots)
        throw Error(Status::too_many,
                    fmt::format("the lists have {} nodes, at most {} fit", n, max_slots));
    auto positions = allocate<double>("program/positions", n * dim);
    Offset at = 0;
    for (const auto& nodes : lists) {
        const Offset count = nodes.n() * dim;
        std::copy_n(nodes.positions().data(), count, positions.data() + at);
        at += count;
    }
    return positions;
}

/// Length of the periodic axes.
double period_of(const Domain& domain, int dim) {
    double period = 0;
    for (int d = 0; d < dim; ++d) {
        const double length = domain.length(d);
        if (length == 0) continue;
        if (period != 0 && std::abs(length - period) > 1e-12 * period)
            throw Error(Status::box, fmt::format("periodic axes have lengths {:.10g} and {:.10g}, "
                                                 "must be equal, as a box tree repeats a cube{}",
                                                 period, length, hint));
        period = length;
    }
    return period;
}

/// Moves the coordinate d of all nodes into [lo, lo + period).
void wrap(const View<double>& x, int d, int dim, double lo, double period) {
    const auto n = static_cast<Offset>(x.size()) / dim;
    for (Offset i = 0; i < n; ++i) {
        double& value = x(i * dim + d);
        if (value >= lo && value < lo + period) continue;
        value -= period * std::floor((value - lo) / period);
        if (value < lo || value >= lo + period) value = lo;  // rounding; NaN stays
    }
}

/// Lower end of the root box on an open axis.
double lowest(const View<double>& x, int d, int dim, double period) {
    const auto n = static_cast<Offset>(x.size()) / dim;
    if (n == 0) return 0;
    double lo = x(d), hi = x(d);
    for (Offset i = 1; i < n; ++i) {
        lo = std::min(lo, x(i * dim + d));
        hi = std::max(hi, x(i * dim + d));
    }
    if (hi > lo + period)
        throw Error(Status::box, fmt::format("nodes extend over {:.10g} on open axis {}, at most "
                                             "{:.10g} fit the periodic root box{}",
                                             hi - lo, d, period, hint));
    return lo;
}

}  // namespace

ListsInput particles_of(std::span<const NodeList> nodes, const Domain& domain, int dim) {
    ListsInput input;
    input.dim = dim;
    input.tree.max_particles_in_box = 64;
    const auto positions = joined(nodes, dim);
    input.sources.n = static_cast<Offset>(positions.size()) / dim;
    input.sources.positions.float64 = positions;
    if (!domain.any_periodic(dim)) return input;
    domain.check(dim);
    const double period = period_of(domain, dim);
    TreeOptions::Box root;
    for (int d = 0; d < dim; ++d) {
        const auto k = static_cast<std::size_t>(d);
        input.tree.periodic[k] = domain.periodic[k];
        if (domain.periodic[k]) wrap(positions, d, dim, domain.lo[k], period);
        root.lo[k] = domain.periodic[k] ? domain.lo[k] : lowest(positions, d, dim, period);
        root.hi[k] = root.lo[k] + period;
    }
    input.tree.bounding_box = root;
    return input;
}

}  // namespace connectivity::program
