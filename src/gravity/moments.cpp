// SPDX-License-Identifier: BSD-3-Clause
// Moments of cells, from the particles of leaves up.
#include <algorithm>
#include <cmath>

#include "cells.hpp"
#include "upward.hpp"

namespace connectivity::detail {

namespace {

double power(double base, int exponent) {
    double result = 1;
    for (; exponent > 0; exponent >>= 1, base *= base)
        if ((exponent & 1) != 0) result *= base;
    return result;
}

/// sum |m| (r / s)^q over a cell's particles, where s is the radius, so that nothing over- or
/// underflows.
double sum_of_powers(const TreeBodies& bodies, const Cells& cells, CellId c, int q) {
    const double unit = 1 / cells.radius(c);
    double sum = 0;
    for (std::int32_t i = cells.first(c); i < cells.first(c) + cells.count(c); ++i) {
        double r2 = 0;
        for (int d = 0; d < 3; ++d) {
            const double x = (bodies.x[d][i] - cells.x(d, c)) * unit;
            r2 += x * x;
        }
        const double even = power(r2, q / 2);
        sum += std::abs(bodies.mass[i]) * ((q & 1) != 0 ? even * std::sqrt(r2) : even);
    }
    return sum;
}

double bound_of_powers(const Cells& cells, CellId c, int q) {
    const double unit = 1 / cells.radius(c);
    double sum = 0;
    for (CellId b = cells.first_child(c); b < cells.first_child(c) + cells.n_children(c); ++b) {
        double d2 = 0;
        for (int d = 0; d < 3; ++d) {
            const double x = cells.x(d, b) - cells.x(d, c);
            d2 += x * x;
        }
        sum += cells.mass(b) * power((std::sqrt(d2) + cells.rho(b)) * unit, q);
    }
    return sum;
}

}  // namespace

void make_rho(const TreeBodies& bodies, int degree, Cells& cells) {
    ensure_capacity(cells.rho, "gravity/rho", cells.n);
    cells.degree = degree;
    for_each_upward("gravity/rho", cells, [&](CellId c) {
        if (!(cells.radius(c) > 0) || !(cells.mass(c) > 0)) {
            cells.rho(c) = 0;
            return;
        }
        const bool few = cells.is_leaf(c) || cells.count(c) <= few_particles;
        const double sum =
            few ? sum_of_powers(bodies, cells, c, degree) : bound_of_powers(cells, c, degree);
        cells.rho(c) = cells.radius(c) * std::min(1.0, std::pow(sum / cells.mass(c), 1.0 / degree));
    });
}

void make_moments(const TreeBodies& bodies, int order, Cells& cells) {
    cells.order = order;
    cells.stride = expansion_stride(order);
    ensure_capacity(cells.moments, "gravity/moments", cells.n * cells.stride);
    double* const moments = cells.moments.data();
    const CellArrays arrays = cells.arrays();
    const ExpansionKernels& kernels = expansion_kernels();
    for_each_upward("gravity/moments", cells, [&](CellId c) {
        const Expansion own = cells.expansion(c, moments);
        std::fill_n(own.coefficients, cells.stride, 0.0);
        if (cells.is_leaf(c)) {
            const std::int32_t i = cells.first(c);
            kernels.p2m(order,
                        {bodies.x[0] + i, bodies.x[1] + i, bodies.x[2] + i, bodies.mass + i,
                         cells.count(c)},
                        own);
            return;
        }
        std::int32_t children[8];
        for (int k = 0; k < cells.n_children(c); ++k) children[k] = cells.first_child(c) + k;
        kernels.m2m(order, arrays, {children, cells.n_children(c), nullptr, nullptr}, own);
    });
}

}  // namespace connectivity::detail
