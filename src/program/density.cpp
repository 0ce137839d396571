// SPDX-License-Identifier: BSD-3-Clause
#include "program/density.hpp"

#include <cmath>
#include <numbers>

namespace connectivity::program {

namespace {

/// Cubic spline in q = r/R, without its normalisation.
double spline(double q) {
    const double p = 1 - q;
    return q < 0.5 ? 1 + 6 * q * q * (q - 1) : 2 * p * p * p;
}

/// Normalisation of the spline over R^dim.
constexpr double factor(int dim) {
    constexpr double pi = std::numbers::pi;
    return dim == 1 ? 4.0 / 3.0 : dim == 2 ? 40.0 / (7.0 * pi) : 8.0 / pi;
}

template <int Dim>
struct Density {
    RowsView<> rows;
    Offset first_row, first_slot;
    int list;
    const double *x, *h, *mass;
    double extent;
    Periods<Dim> box;
    double* out;

    double distance(Offset i, Offset j) const {
        double r2 = 0;
        for (int d = 0; d < Dim; ++d) {
            double r = x[i * Dim + d] - x[j * Dim + d];
            if (2 * std::abs(r) > box.length[d]) r = box.wrap(r, d);  // rint is slow, and rare here
            r2 += r * r;
        }
        return std::sqrt(r2);
    }

    void operator()(const Offset i) const {
        const double radius = extent * h[i];
        double sum = radius > 0 ? mass[i] : 0;
        for (const Slot slot : rows(first_row + i, list)) {
            const Offset j = slot - first_slot;
            const double r = distance(i, j);
            if (r < radius) sum += mass[j] * spline(r / radius);
        }
        out[i] = radius > 0 ? factor(Dim) * sum / std::pow(radius, Dim) : 0;
    }
};

template <int Dim>
ConstView<double> density_of_stored(const ConnectivityMap& map, int list, const NodeList& nodes,
                                    const ConstView<double>& mass) {
    auto result = allocate<double>("program/density", nodes.n());
    const auto k = static_cast<std::size_t>(list);
    const Density<Dim> functor{
        map.rows(),   map.layout().row_offset()[k], map.layout().list_offset()[k],
        list,         nodes.positions().data(),     nodes.h().data(),
        mass.data(),  nodes.kernel_extent(),        periods<Dim>(map.options().domain),
        result.data()};
    Kokkos::parallel_for("program/density",
                         Kokkos::RangePolicy<HostExec, Kokkos::IndexType<Offset>>(0, nodes.n()),
                         functor);
    HostExec().fence();
    return result;
}

}  // namespace

ConstView<double> density(const ConnectivityMap& map, int list, const NodeList& nodes,
                          const ConstView<double>& mass) {
    if (nodes.has_tensor() || static_cast<Offset>(mass.size()) != nodes.n())
        throw Error(Status::argument,
                    "density of '" + nodes.name() + "': needs scalar h and a mass for every node");
    const auto& row_offset = map.layout().row_offset();
    const auto k = static_cast<std::size_t>(list);
    if (row_offset[k + 1] - row_offset[k] < nodes.n()) {
        MapOptions options;
        options.pairs = false;
        options.ghost_rows = true;
        options.mode = SearchMode::gather;
        options.method = map.options().method;
        options.domain = map.options().domain;
        options.budget = map.options().budget;
        ConnectivityMap own;
        own.rebuild({&nodes, 1}, options);
        return density(own, 0, nodes, mass);
    }
    if (nodes.dim() == 1) return density_of_stored<1>(map, list, nodes, mass);
    if (nodes.dim() == 2) return density_of_stored<2>(map, list, nodes, mass);
    return density_of_stored<3>(map, list, nodes, mass);
}

}  // namespace connectivity::program
